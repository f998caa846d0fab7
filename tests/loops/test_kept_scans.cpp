#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/loops/kept_scans.hpp"

using namespace incognita;

namespace {

/// A drift with `pieces` pieces, all born at the origin.
MapDrift drift_of(int pieces) {
  MapDrift::Params params;
  params.scans_per_piece = 1;
  MapDrift drift(params);
  for (int piece = 0; piece < pieces; ++piece) (void)drift.piece_of_scan(Eigen::Matrix3d::Identity(), {0.0, 0.0});
  return drift;
}

std::vector<Pose2> poses_of(const KeptScans& kept, const MapDrift& drift) {
  std::vector<Pose2> poses;
  kept.for_each_pose(drift, [&](const Pose2& pose) { poses.push_back(pose); });
  return poses;
}

}  // namespace

TEST_CASE("Kept scans come back as they were, clear and invalid readings included", "[loops]") {
  const MapDrift drift = drift_of(1);
  KeptScans kept(10);
  Scan<2> scan(circular_beams(6, 29.9));  // 29.9 is no float
  scan.set_range_m(0, 1.2345678);
  scan.set_range_m(1, std::numeric_limits<double>::quiet_NaN());
  scan.set_range_m(2, -1.0);
  const Scan<2> narrow(planar_beams(4, -0.5, 0.2, 5.0));
  const Eigen::Matrix3d covariance = diagonal_covariance(1.0, 2.0, 3.0);
  kept.add(scan, {{1.0, 2.0, 0.5}, covariance}, 0, drift.twist(0));
  kept.add(narrow, {{3.0, 2.0, 0.5}, covariance}, 0, drift.twist(0));
  kept.add(scan, {{4.0, 2.0, 0.5}, covariance}, 0, drift.twist(0));
  std::vector<std::size_t> sizes;
  kept.for_each(drift, [&](const Scan<2>& again, const PoseBelief& belief) {
    sizes.push_back(again.size());
    CHECK(belief.covariance == covariance);
    CHECK(belief.pose.y_m == 2.0);
    if (again.size() != scan.size()) return;
    CHECK(again.has_beams_of(scan));
    CHECK(std::abs(again.range_m(0) - scan.range_m(0)) < 1e-6);
    for (std::size_t beam = 0; beam < scan.size(); ++beam) CHECK(again.reading(beam) == scan.reading(beam));
  });
  CHECK(sizes == std::vector<std::size_t>{6, 4, 6});
}

TEST_CASE("Poses of kept scans move with their pieces, by what these moved since", "[loops]") {
  Random random(1);
  MapDrift drift = drift_of(2);
  const Scan<2> scan(circular_beams(4, 10.0));
  drift.set_twist(1, {0.3, -0.1, 0.02});
  KeptScans kept(10);
  const Pose2 pose{7.0, -3.0, 1.1};
  kept.add(scan, {pose, Eigen::Matrix3d::Zero()}, 0, drift.twist(0));
  kept.add(scan, {pose, Eigen::Matrix3d::Zero()}, 1, drift.twist(1));
  CHECK(poses_of(kept, drift)[1].x_m == pose.x_m);

  const Eigen::Vector3d twist(0.02, 0.01, 0.001);
  drift.set_twist(1, drift.twist(1) + twist);
  const auto poses = poses_of(kept, drift);
  CHECK(poses[0].x_m == pose.x_m);
  // A small motion about the map's origin.
  CHECK(poses[1].x_m == Approx(pose.x_m + 0.02 - 0.001 * pose.y_m));
  CHECK(poses[1].y_m == Approx(pose.y_m + 0.01 + 0.001 * pose.x_m));
  CHECK(poses[1].yaw_rad == Approx(pose.yaw_rad + 0.001));
  const Eigen::Vector3d back = twist_between(pose, poses[1]);
  CHECK((back - twist).norm() < 1e-12);

  drift.settle();
  CHECK(kept.unsettled_max_m(drift) == 0.0);
  drift.set_twist(1, drift.twist(1) + Eigen::Vector3d(0.03, 0.04, 0.0));
  CHECK(kept.unsettled_max_m(drift) == Approx(0.05));
}

TEST_CASE("When too many scans are kept, every second one is let go, and so of those that follow", "[loops]") {
  const MapDrift drift = drift_of(1);
  const Scan<2> scan(circular_beams(4, 10.0));
  KeptScans kept(8);
  for (int n = 0; n < 100; ++n) {
    kept.add(scan, {{static_cast<double>(n), 0.0, 0.0}, Eigen::Matrix3d::Zero()}, 0, drift.twist(0));
    REQUIRE(kept.size() <= 8);
    REQUIRE(kept.size() >= std::min<std::size_t>(4, static_cast<std::size_t>(n) + 1));
    const auto poses = poses_of(kept, drift);
    const double stride = poses.size() > 1 ? poses[1].x_m - poses[0].x_m : 1.0;
    for (std::size_t i = 0; i < poses.size(); ++i) REQUIRE(poses[i].x_m == stride * static_cast<double>(i));
    REQUIRE(static_cast<double>(n) < poses.back().x_m + stride);
  }
  CHECK_THROWS_WITH(KeptScans(1), Catch::Contains("scans_max") && Catch::Contains("1"));
}
