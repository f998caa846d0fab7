#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/metrics/relations_error.hpp"

using namespace incognita;

namespace {

Pose2 random_pose(Random& random) {
  return {random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0), random.uniform(-3.14, 3.14)};
}

struct Drive {
  std::vector<double> times_s;
  std::vector<Pose2> poses;
  std::vector<PoseRelation> relations;
};

/// A trajectory with true relations between random pairs of its poses.
Drive random_drive(Random& random) {
  Drive drive;
  for (std::size_t i = 0; i < 30; ++i) {
    drive.times_s.push_back(1e9 + 0.1 * static_cast<double>(i));
    drive.poses.push_back(random_pose(random));
  }
  for (int i = 0; i < 50; ++i) {
    const std::size_t from = random.index(30);
    const std::size_t to = random.index(30);
    drive.relations.push_back(
        {drive.times_s[from], drive.times_s[to], drive.poses[from].inverse() * drive.poses[to]});
  }
  return drive;
}

}  // namespace

TEST_CASE("relations error: a true trajectory has none, in any frame") {
  Random random(1);
  const Drive drive = random_drive(random);
  const Pose2 T_other_frame = random_pose(random);
  std::vector<Pose2> moved;
  for (const Pose2& pose : drive.poses) moved.push_back(T_other_frame * pose);
  for (const std::vector<Pose2>& poses : {drive.poses, moved}) {
    const RelationsError error = relations_error(drive.times_s, poses, drive.relations);
    CHECK(error.matched == 50);
    CHECK(error.translation_mean_m == Approx(0.0).margin(1e-12));
    CHECK(error.rotation_mean_rad == Approx(0.0).margin(1e-12));
  }
}

TEST_CASE("relations error: by homogeneous matrices") {
  Random random(2);
  Drive drive = random_drive(random);
  double translation_m = 0.0;
  double rotation_rad = 0.0;
  const auto matrix = [](const Pose2& pose) {
    Eigen::Matrix3d T = Eigen::Matrix3d::Identity();
    T.topLeftCorner<2, 2>() = Eigen::Rotation2D<double>(pose.yaw_rad).toRotationMatrix();
    T.topRightCorner<2, 1>() = pose.position();
    return T;
  };
  for (PoseRelation& relation : drive.relations) {
    const Eigen::Matrix3d truth = matrix(relation.T_from_to);
    relation.T_from_to = random_pose(random);
    const Eigen::Matrix3d error = matrix(relation.T_from_to).inverse() * truth;
    translation_m += error.topRightCorner<2, 1>().norm() / 50.0;
    rotation_rad += std::acos(std::clamp(0.5 * (error(0, 0) + error(1, 1)), -1.0, 1.0)) / 50.0;
  }
  const RelationsError error = relations_error(drive.times_s, drive.poses, drive.relations);
  CHECK(error.translation_mean_m == Approx(translation_m));
  CHECK(error.rotation_mean_rad == Approx(rotation_rad));
}

TEST_CASE("relations error: only relations whose stamps are there count") {
  const std::vector<double> times_s{0.0, 1.0, 2.0};
  const std::vector<Pose2> poses{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<PoseRelation> relations{{0.0, 1.0 + 9e-6, {1.25, 0, 0.5}},  // 0.25 m and 0.5 rad off
                                            {0.0, 1.0 + 2e-5, {9, 9, 0}},
                                            {-1.0, 2.0, {9, 9, 0}},
                                            {2.0, 0.0, {-2, 0, 0}}};
  const RelationsError error = relations_error(times_s, poses, relations);
  CHECK(error.matched == 2);
  CHECK(error.translation_mean_m == Approx(0.125));
  CHECK(error.rotation_mean_rad == Approx(0.25));
  CHECK(relations_error(times_s, poses, relations, 1e-3).matched == 3);
  const RelationsError none = relations_error(times_s, poses, {});
  CHECK(none.matched == 0);
  CHECK(none.translation_mean_m == 0.0);
}

TEST_CASE("relations error: what does not fit is refused") {
  const std::vector<double> falling_s{1.0, 0.0};
  const std::vector<Pose2> poses(2);
  CHECK_THROWS_WITH(relations_error(std::vector<double>{0.0}, poses, {}),
                    "relations_error: 1 times for 2 poses, but must be as many");
  CHECK_THROWS_AS(relations_error(falling_s, poses, {}), std::invalid_argument);
  CHECK_THROWS_AS(relations_error(std::vector<double>{0.0, 1.0}, poses, {}, -1.0), std::invalid_argument);
}
