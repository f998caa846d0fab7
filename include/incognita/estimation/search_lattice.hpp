/// The poses that a search looks at, and how far each is from where the robot was thought to be.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>

#include <Eigen/Core>

#include "incognita/core/angles.hpp"
#include "incognita/core/error.hpp"
#include "incognita/estimation/information.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita {

/// How far from its centre a search looks, each way, in the axes of the map's frame. A yaw of pi or more is
/// all around.
struct SearchWindow {
  double x_m = 0.3;       ///< >= 0
  double y_m = 0.3;       ///< >= 0
  double yaw_rad = 0.21;  ///< >= 0

  /// Throws std::invalid_argument for values that are not finite and >= 0.
  void validate() const {
    require_non_negative("SearchWindow", "x_m", x_m);
    require_non_negative("SearchWindow", "y_m", y_m);
    require_non_negative("SearchWindow", "yaw_rad", yaw_rad);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("x_m, y_m, yaw_rad", x_m, y_m, yaw_rad);
  }
};

/// Poses of a lattice around a centre: centre + (i step_m, j step_m, k yaw_step_rad), within the window. `at`
/// counts from the smallest offsets. All around, the yaw step is shortened to divide the circle, and the last
/// turn has the first as its neighbour.
struct SearchLattice {
  /// A pose of the lattice, by its steps.
  struct At {
    int x = 0;     ///< in steps of step_m along the map's x axis
    int y = 0;     ///< along its y axis
    int turn = 0;  ///< in steps of yaw_step_rad
  };
  static constexpr double half_max = 4096.0;    ///< the most steps of position each way, without a unit
  static constexpr double turns_max = 65536.0;  ///< the most headings, without a unit

  Pose2 center;               ///< T_map_robot, the yaw wrapped
  double step_m = 0.0;        ///< between positions, along each axis
  double yaw_step_rad = 0.0;  ///< between headings
  At half;                    ///< where the centre is
  At size;                    ///< how many there are along each axis
  bool is_circle = false;     ///< whether headings go all around

  /// Throws std::invalid_argument for windows of more than half_max steps each way or turns_max turns.
  SearchLattice(const Pose2& center_pose, const SearchWindow& window, double position_step_m,
                double turn_step_rad)
      : center(center_pose), step_m(position_step_m), yaw_step_rad(turn_step_rad) {
    constexpr double circle_rad = 2.0 * std::numbers::pi;
    constexpr double slack = 1e-6;  // a bound that is a multiple of the step counts as reached
    center.yaw_rad = wrap_angle_rad(center.yaw_rad);
    const double x = std::floor(window.x_m / step_m + slack);
    const double y = std::floor(window.y_m / step_m + slack);
    require(x <= half_max, "SearchWindow", "x_m", window.x_m, "at most 4096 steps");
    require(y <= half_max, "SearchWindow", "y_m", window.y_m, "at most 4096 steps");
    const double yaw_rad = std::min(window.yaw_rad, std::numbers::pi);
    const double turns = 2.0 * std::floor(yaw_rad / yaw_step_rad + slack) + 1.0;
    require(turns <= turns_max, "SearchWindow", "yaw_rad", window.yaw_rad, "at most 32767 steps");
    half = {static_cast<int>(x), static_cast<int>(y), static_cast<int>(turns) / 2};
    size = {2 * half.x + 1, 2 * half.y + 1, static_cast<int>(turns)};
    if (window.yaw_rad >= std::numbers::pi || turns * yaw_step_rad > circle_rad * (1.0 - slack)) {
      is_circle = true;
      size.turn = static_cast<int>(std::ceil(circle_rad / yaw_step_rad - slack));
      half.turn = size.turn / 2;
      yaw_step_rad = circle_rad / size.turn;
    }
  }

  /// Of a turn from the centre's heading.
  [[nodiscard]] double yaw_offset_rad(int turn) const { return (turn - half.turn) * yaw_step_rad; }

  /// T_map_robot of a place of the lattice; the yaw is wrapped.
  [[nodiscard]] Pose2 pose(const At& at) const {
    return {center.x_m + (at.x - half.x) * step_m, center.y_m + (at.y - half.y) * step_m,
            wrap_angle_rad(center.yaw_rad + yaw_offset_rad(at.turn))};
  }

  /// How many turns apart two are, the shorter way round.
  [[nodiscard]] int turns_between(int a, int b) const {
    const int apart = std::abs(a - b);
    return is_circle ? std::min(apart, size.turn - apart) : apart;
  }
};

/// The squared Mahalanobis distance of lattice poses from the centre, and a lower bound of it over
/// rectangles. To the covariance it adds that of a pose rounded to the lattice (step^2 / 12), so a singular
/// one will do.
class SearchPrior {
 public:
  SearchPrior() = default;  ///< to be assigned to before it is asked

  /// The covariance over (x, y, yaw), in the axes of the map's frame.
  SearchPrior(const Eigen::Matrix3d& covariance, const SearchLattice& lattice) {
    // The heading first: then one turn of the lattice fixes the first coordinate.
    const std::array<int, 3> order{2, 0, 1};
    const std::array<double, 3> steps{lattice.yaw_step_rad, lattice.step_m, lattice.step_m};
    Eigen::Matrix3d permuted;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        permuted(row, column) =
            covariance(order[static_cast<std::size_t>(row)], order[static_cast<std::size_t>(column)]);
      }
      permuted(row, row) +=
          steps[static_cast<std::size_t>(row)] * steps[static_cast<std::size_t>(row)] / 12.0;
    }
    factor_ = lower_factor(permuted);
    // No pivot is below what was added; rounding must not make it 0.
    for (int axis = 0; axis < 3; ++axis) {
      factor_(axis, axis) =
          std::max(factor_(axis, axis), steps[static_cast<std::size_t>(axis)] / std::sqrt(12.0));
    }
  }

  /// At most the squared distance of any offset with this yaw and x and y within their limits; exact for one
  /// offset. Without a unit.
  [[nodiscard]] double distance_min(double yaw_rad, double x_min_m, double x_max_m, double y_min_m,
                                    double y_max_m) const {
    const double turned = yaw_rad / factor_(0, 0);
    const double x_low = (x_min_m - factor_(1, 0) * turned) / factor_(1, 1);
    const double x_high = (x_max_m - factor_(1, 0) * turned) / factor_(1, 1);
    const double along_low = factor_(2, 1) * (factor_(2, 1) > 0.0 ? x_high : x_low);
    const double along_high = factor_(2, 1) * (factor_(2, 1) > 0.0 ? x_low : x_high);
    const double y_low = (y_min_m - factor_(2, 0) * turned - along_low) / factor_(2, 2);
    const double y_high = (y_max_m - factor_(2, 0) * turned - along_high) / factor_(2, 2);
    return turned * turned + square_min(x_low, x_high) + square_min(y_low, y_high);
  }

 private:
  [[nodiscard]] static double square_min(double low, double high) {
    const double nearest = std::max({low, -high, 0.0});
    return nearest * nearest;
  }

  Eigen::Matrix3d factor_ = zero<Eigen::Matrix3d>();
};

}  // namespace incognita
