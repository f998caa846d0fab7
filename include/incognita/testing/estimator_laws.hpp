/// The laws of Estimator as a check that any test can call, for the library's estimators and for a user's.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/estimation/estimator.hpp"
#include "incognita/testing/law_report.hpp"

namespace incognita {

namespace estimator_laws {

/// The scan of an empty room of 8 m x 6 m at T_room_sensor, which must lie inside of it; the room's frame is
/// at its centre.
[[nodiscard]] inline Scan<2> scan_of_room(const Pose2& T_room_sensor, std::size_t beams) {
  Scan<2> scan(circular_beams(beams, 10.0));
  const Eigen::Vector2d half_m(4.0, 3.0);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const Eigen::Vector2d direction = T_room_sensor.rotation() * scan.direction(beam);
    double range_m = 10.0;
    for (int axis = 0; axis < 2; ++axis) {
      if (direction[axis] == 0.0) continue;
      const double wall_m = std::copysign(half_m[axis], direction[axis]);
      range_m = std::min(range_m, (wall_m - T_room_sensor.position()[axis]) / direction[axis]);
    }
    scan.set_range_m(beam, range_m);
  }
  return scan;
}

/// True when `larger` - `smaller` has no negative eigenvalue, within rounding of the larger.
[[nodiscard]] inline bool is_at_most(const Eigen::Matrix3d& smaller, const Eigen::Matrix3d& larger) {
  const Eigen::Matrix3d difference = larger - smaller;
  if (!difference.allFinite()) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(difference, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().minCoeff() >= -1e-9 * larger.cwiseAbs().maxCoeff();
}

/// To the bit.
[[nodiscard]] inline bool is_equal(const PoseBelief& a, const PoseBelief& b) {
  return a.pose.x_m == b.pose.x_m && a.pose.y_m == b.pose.y_m && a.pose.yaw_rad == b.pose.yaw_rad &&
         a.covariance == b.covariance;
}

/// Within 1e-9 m and 1e-9 rad.
[[nodiscard]] inline bool is_near(const Pose2& a, const Pose2& b) {
  return (a.position() - b.position()).norm() <= 1e-9 &&
         std::abs(angle_between_rad(a.yaw_rad, b.yaw_rad)) <= 1e-9;
}

/// Whether the pose is finite, and the covariance one.
[[nodiscard]] inline bool is_sound(const PoseBelief& belief) {
  return belief.pose.is_finite() && is_covariance(belief.covariance);
}

/// A filter and its map in an empty room, driven by seeded odometry with errors.
template <class Filter>
struct Drive {
  Filter filter;          ///< that is driven
  Map<> map{};            ///< that the filter reads
  Pose2 T_start_robot{};  ///< the true pose
  Random random{1};       ///< of the odometry's errors

  /// A motion in the robot's own frame, within 0.1 s, and a scan.
  void scan_once(const Pose2& increment) {
    T_start_robot = T_start_robot * increment;
    const Pose2 measured{increment.x_m + random.normal(0.0, 0.005), increment.y_m,
                         wrap_angle_rad(increment.yaw_rad + random.normal(0.0, 0.002))};
    filter.predict(measured, 0.1);
    const Scan<2> scan = scan_of_room(T_start_robot, 72);
    static_cast<void>(filter.correct(scan, map));
    if (!is_sound(filter.belief())) return;
    map.update(scan, filter.belief().pose, filter.belief().covariance);
    filter.learn(scan);
  }

  /// Around the room's centre, never near its walls.
  void drive_on() { scan_once({0.05, 0.0, random.uniform(0.02, 0.12)}); }
};

}  // namespace estimator_laws

/// Checks the laws on the page of Estimator (estimation/estimator.hpp) with `fresh`, an estimator that has
/// seen nothing yet, on a seeded drive through an empty room. An estimator that passes may still break a law
/// elsewhere.
template <Estimator Filter>
[[nodiscard]] LawReport check_estimator_laws(const Filter& fresh) {
  using namespace estimator_laws;
  LawReport report;
  if (!is_sound(fresh.belief())) {
    report.check(false, "the covariance of a new estimator is symmetric and positive semi-definite");
    return report;
  }

  Drive<Filter> drive{fresh};
  int scans = 0;
  for (; scans < 1000 && !drive.filter.is_ready(); ++scans) drive.scan_once(Pose2{});
  if (!drive.filter.is_ready()) {
    report.check(false, "ready after 1000 scans of a robot that stands");
    return report;
  }
  Drive<Filter> twin = drive;

  for (int step = 0; step < 300; ++step) {
    drive.drive_on();
    twin.drive_on();
    const std::string at = " after " + std::to_string(step + 1) + " scans of a drive";
    if (!is_sound(drive.filter.belief())) {
      report.check(false, "the covariance stays symmetric and positive semi-definite, violated" + at);
      return report;
    }
    if (!is_equal(drive.filter.belief(), twin.filter.belief())) {
      report.check(false, "equal calls give equal beliefs, violated" + at);
      break;
    }
  }

  Random random(2);
  const Filter& driven = drive.filter;
  for (int draw = 0; draw < 50; ++draw) {
    const std::string at = ", violated at draw " + std::to_string(draw);
    const Pose2 increment{random.normal(0.0, 1.0), random.normal(0.0, 1.0), random.normal(0.0, 2.0)};
    const double duration_s = random.uniform(0.01, 10.0);
    const PoseBelief before = driven.belief();

    Filter moved = driven;
    moved.predict(increment, duration_s);
    report.check(is_near(moved.belief().pose, before.pose * increment),
                 "predict composes the pose with the increment" + at);
    const PoseBelief imagined = driven.imagine_motion(before, increment, duration_s);
    report.check(is_near(imagined.pose, before.pose * increment),
                 "imagine_motion composes the pose with the increment" + at);
    report.check(is_sound(moved.belief()) && is_sound(imagined),
                 "the covariance of a motion is symmetric and positive semi-definite" + at);

    Filter stands = driven;
    stands.predict(Pose2{}, duration_s);
    report.check(is_at_most(before.covariance, stands.belief().covariance),
                 "predict does not reduce the covariance of a robot that stands" + at);

    Eigen::Matrix3d root;
    for (Eigen::Index entry = 0; entry < 9; ++entry) root(entry) = random.normal(0.0, 0.5);
    const PoseBelief prior{increment, root * root.transpose()};
    std::vector<RayObservation> hits(1 + random.index(60));
    for (RayObservation& hit : hits) {
      const double angle_rad = random.uniform(-3.2, 3.2);
      hit = {{std::cos(angle_rad), std::sin(angle_rad)}, random.normal(0.0, 0.3), random.uniform()};
    }
    const PoseBelief seen =
        driven.imagine_scan(prior, hits, hits.size() + random.index(60), random.uniform(1.0, 30.0));
    report.check(is_sound(seen),
                 "the covariance of an imagined scan is symmetric and positive semi-definite" + at);
    report.check(is_at_most(seen.covariance, prior.covariance), "imagine_scan never adds variance" + at);
    const PoseBelief unseen = driven.imagine_scan(prior, {}, 60, 1.0);
    report.check(
        is_at_most(unseen.covariance, prior.covariance) && is_at_most(prior.covariance, unseen.covariance),
        "imagine_scan without hits leaves the covariance as it is" + at);
    report.check(is_equal(driven.belief(), before), "imagining changes nothing" + at);
  }

  for (const double range_m : {10.0, std::numeric_limits<double>::quiet_NaN(), -1.0}) {
    Scan<2> scan(circular_beams(36, 10.0));
    for (std::size_t beam = 0; beam < scan.size(); ++beam) scan.set_range_m(beam, range_m);
    Filter corrected = driven;
    const CorrectionReport correction = corrected.correct(scan, drive.map);
    report.check(is_equal(corrected.belief(), driven.belief()) && correction.associations == 0,
                 "a scan without hits leaves pose and covariance as they are, violated by readings of " +
                     std::to_string(range_m) + " m");
  }
  return report;
}

}  // namespace incognita
