/// Rooms of straight walls to be scanned exactly, in a frame of any angle and offset.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "incognita/core/angles.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/sensor/scan.hpp"

namespace room {

using incognita::Pose2;
using incognita::Scan;

struct Wall {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

/// A rectangle around the origin of the room's frame, with walls given in the map's frame.
inline std::vector<Wall> box(const Pose2& T_map_room, double half_width_m = 3.0, double half_height_m = 2.0) {
  const Eigen::Vector2d a = T_map_room * Eigen::Vector2d(-half_width_m, -half_height_m);
  const Eigen::Vector2d b = T_map_room * Eigen::Vector2d(half_width_m, -half_height_m);
  const Eigen::Vector2d c = T_map_room * Eigen::Vector2d(half_width_m, half_height_m);
  const Eigen::Vector2d d = T_map_room * Eigen::Vector2d(-half_width_m, half_height_m);
  return {{a, b}, {b, c}, {c, d}, {d, a}};
}

/// A turned and offset frame, so that no wall is parallel to any lattice.
inline const Pose2 kTurned{0.37, -0.21, 0.3};

/// Ranges by solving origin + t direction = from + s (to - from) for each wall.
inline Scan<2> scan_of(const std::vector<Wall>& walls, const Pose2& T_map_sensor,
                       incognita::BeamPattern<2> beams) {
  Scan<2> scan(std::move(beams));
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const Eigen::Vector2d direction = T_map_sensor.rotation() * scan.direction(beam);
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Wall& wall : walls) {
      Eigen::Matrix2d sides;
      sides.col(0) = direction;
      sides.col(1) = wall.from - wall.to;
      if (std::abs(sides.determinant()) < 1e-12) continue;
      const Eigen::Vector2d at = sides.inverse() * (wall.from - T_map_sensor.position());
      if (at.x() > 0.0 && at.y() >= 0.0 && at.y() <= 1.0) nearest_m = std::min(nearest_m, at.x());
    }
    if (nearest_m < scan.range_max_m()) scan.set_range_m(beam, nearest_m);
  }
  return scan;
}

inline Scan<2> scan_of(const std::vector<Wall>& walls, const Pose2& T_map_sensor, std::size_t beams = 360) {
  return scan_of(walls, T_map_sensor, incognita::circular_beams(beams, 10.0));
}

/// The derivative of a function of (x, y, yaw) by central differences, one column an input.
template <int Rows, class Function>
Eigen::Matrix<double, Rows, 3> numerical_jacobian(const Pose2& at, Function&& function, double step = 1e-6) {
  Eigen::Matrix<double, Rows, 3> jacobian;
  for (int column = 0; column < 3; ++column) {
    const auto moved = [&](double by) {
      Pose2 pose = at;
      (column == 0 ? pose.x_m : column == 1 ? pose.y_m : pose.yaw_rad) += by;
      return pose;
    };
    const Eigen::Matrix<double, Rows, 1> above = function(moved(step));
    const Eigen::Matrix<double, Rows, 1> below = function(moved(-step));
    jacobian.col(column) = (above - below) / (2.0 * step);
  }
  return jacobian;
}

/// R R^T of a random R: symmetric positive definite, with all correlations.
template <class Random>
Eigen::Matrix3d random_covariance(Random& random, double sigma) {
  Eigen::Matrix3d root;
  for (Eigen::Index entry = 0; entry < 9; ++entry) root(entry) = random.normal(0.0, sigma);
  return root * root.transpose() + 1e-3 * sigma * sigma * Eigen::Matrix3d::Identity();
}

inline double position_error_m(const Pose2& a, const Pose2& b) { return (a.position() - b.position()).norm(); }

inline double heading_error_rad(const Pose2& a, const Pose2& b) {
  return std::abs(incognita::angle_between_rad(a.yaw_rad, b.yaw_rad));
}

}  // namespace room
