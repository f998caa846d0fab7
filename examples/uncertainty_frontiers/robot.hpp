/// A robot that knows its heading, finds its position by landmarks, and keeps maps of dispersion.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/estimation/landmark_slam.hpp"
#include "incognita/geometry/d_optimality.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/map.hpp"
#include "incognita/simulation/range_sensor.hpp"
#include "uncertainty_frontiers/worlds.hpp"

namespace uncertainty_frontiers {

using Belief = incognita::Map<incognita::Dispersion>;

inline constexpr double sight_m = 5.0;         ///< of the LiDAR and of landmarks
inline constexpr double body_radius_m = 0.2;
inline constexpr double pace_m = 0.25;         ///< from one scan to the next
inline constexpr int scans_per_pace = 3;        ///< 12 Hz at 1 m/s
inline constexpr double noise_m2_per_m = 0.01;  ///< Q, which is that of one step of 1 m

[[nodiscard]] inline Belief make_belief(double sigma_max_m) {
  incognita::Dispersion::Params params;
  params.sigma_max_m = sigma_max_m;
  return Belief({}, incognita::Dispersion(params));
}

/// Drives in a world; where it believes to be is another matter. The frame of the maps is the world's, where the robot believes to
/// start.
class Robot {
 public:
  /// One map for each tolerated sigma, all of them fed the same.
  Robot(const Place& place, const Eigen::Vector2d& start_m, const std::vector<double>& sigmas_max_m, std::uint64_t seed)
      : place_(place), random_(seed), sensor_({incognita::circular_beams(720, sight_m), 0.03}, seed + 1000), truth_m_(start_m),
        start_m_(start_m), slam_({noise_m2_per_m * pace_m, 0.01, 0.01}) {
    for (const double sigma_max_m : sigmas_max_m) maps_.push_back(make_belief(sigma_max_m));
    // The start is known to within P_0.
    const Eigen::Vector2d error_m(0.1 * random_.normal(), 0.1 * random_.normal());
    if (place_.world.disc_is_clear(start_m + error_m, body_radius_m)) truth_m_ += error_m;
    look();
  }

  [[nodiscard]] Eigen::Vector2d position_m() const { return start_m_ + slam_.position_m(); }
  [[nodiscard]] const Eigen::Vector2d& truth_m() const { return truth_m_; }
  [[nodiscard]] const incognita::LandmarkSlam<2>& slam() const { return slam_; }
  [[nodiscard]] Eigen::Vector2d landmark_m(std::size_t index) const { return start_m_ + slam_.landmark_m(index); }
  [[nodiscard]] const Belief& map(std::size_t index) const { return maps_[index]; }
  [[nodiscard]] double distance_m() const { return distance_m_; }
  [[nodiscard]] const std::vector<Eigen::Vector2d>& path_m() const { return path_m_; }
  [[nodiscard]] double position_sigma_m() const { return incognita::mean_sigma(slam_.position_covariance_m2()); }

  /// A pace along a vector, or all of it, and a look around. False when a wall is in the way.
  bool step(const Eigen::Vector2d& away_m) {
    const double length_m = std::min(pace_m, away_m.norm());
    if (length_m < 1e-9) return true;
    // The robot gets where it is told to but for an error that odometry does not see; a wall stops it, which odometry sees.
    const double sigma_m = std::sqrt(noise_m2_per_m * pace_m);
    const Eigen::Vector2d error_m = sigma_m * Eigen::Vector2d(random_.normal(), random_.normal());
    Eigen::Vector2d step_m = away_m.normalized() * length_m + error_m;
    bool is_free = true;
    while (!place_.world.disc_is_clear(truth_m_ + step_m, body_radius_m) && step_m.norm() > 1e-3) {
      step_m *= 0.5;
      is_free = false;
    }
    if (!is_free && !place_.world.disc_is_clear(truth_m_ + step_m, body_radius_m)) step_m.setZero();
    truth_m_ += step_m;
    distance_m_ += step_m.norm();
    slam_.move(step_m - error_m);
    look();
    return is_free;
  }

 private:
  void look() {
    std::vector<incognita::Sighting<2>> sightings;
    for (std::size_t i = 0; i < place_.landmarks_m.size(); ++i) {
      const Eigen::Vector2d away_m = place_.landmarks_m[i] - truth_m_;
      const double range_m = away_m.norm();
      if (range_m > sight_m || place_.world.cast_ray_m(truth_m_, away_m / range_m, range_m) < range_m - 0.2) continue;
      sightings.push_back({static_cast<int>(i), away_m + 0.1 * Eigen::Vector2d(random_.normal(), random_.normal())});
    }
    slam_.observe(sightings);
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    covariance.topLeftCorner<2, 2>() = slam_.position_covariance_m2();
    for (int n = 0; n < scans_per_pace; ++n) {
      const incognita::Scan<2>& scan = sensor_.measure(place_.world, {truth_m_.x(), truth_m_.y(), 0.0});
      for (Belief& map : maps_) map.update(scan, {position_m().x(), position_m().y(), 0.0}, covariance);
    }
    path_m_.push_back(position_m());
  }

  const Place& place_;
  incognita::Random random_;
  incognita::RangeSensor sensor_;
  Eigen::Vector2d truth_m_;
  Eigen::Vector2d start_m_;
  incognita::LandmarkSlam<2> slam_;
  std::vector<Belief> maps_;
  std::vector<Eigen::Vector2d> path_m_;
  double distance_m_ = 0.0;
};

}  // namespace uncertainty_frontiers
