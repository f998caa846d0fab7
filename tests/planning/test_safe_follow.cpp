#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <stdexcept>
#include <vector>

#include "drawn_plan.hpp"
#include "incognita/planning/path.hpp"
#include "incognita/planning/safe_follow.hpp"
#include "incognita/planning/visit_cost.hpp"

using namespace incognita;

namespace {

bool is_known_free(Occupancy cell) { return cell == Occupancy::free; }

/// A unicycle's pose after driving with constant speeds.
Pose2 driven(const Pose2& pose, const Twist2& twist, double duration_s) {
  const double turn_rad = twist.turn_rate_rad_per_s * duration_s;
  const double middle_rad = pose.yaw_rad + 0.5 * turn_rad;
  const double chord = std::abs(turn_rad) > 1e-9 ? std::sin(0.5 * turn_rad) / (0.5 * turn_rad) : 1.0;
  const double way_m = twist.speed_m_per_s * duration_s * chord;
  return {pose.x_m + way_m * std::cos(middle_rad), pose.y_m + way_m * std::sin(middle_rad), pose.yaw_rad + turn_rad};
}

}  // namespace

TEST_CASE("A unicycle that drives to a goal stays in the set that its motion is predicted to stay in", "[planning]") {
  Random random(1);
  SafeFollowParams params;
  for (int draw = 0; draw < 200; ++draw) {
    params.speed_max_m_per_s = draw % 3 == 0 ? 0.2 : 5.0;
    params.turn_rate_max_rad_per_s = draw % 5 == 0 ? 0.5 : 10.0;
    Pose2 pose{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-3.1, 3.1)};
    const Eigen::Vector2d goal(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
    const DiscHull set = motion_prediction(pose, goal);
    const double begin_m = (goal - pose.position()).norm();
    for (int step = 0; step < 20000; ++step) {
      pose = driven(pose, drive_to(pose, goal, params), 1e-3);
      CAPTURE(draw, step, pose.x_m, pose.y_m);
      REQUIRE(set.distance_to({pose.position(), pose.position()}) < 2e-3);
    }
    REQUIRE((goal - pose.position()).norm() < std::max(0.05, 0.2 * begin_m));
  }
  CHECK(drive_to({1.0, 2.0, 0.3}, {1.0, 2.0}, params).speed_m_per_s == 0.0);
  CHECK(drive_to({1.0, 2.0, 0.3}, {1.0, 2.0}, params).turn_rate_rad_per_s == 0.0);
}

TEST_CASE("The distance to the exterior is that to the nearest cell out of the space", "[planning]") {
  Random random(2);
  for (int draw = 0; draw < 100; ++draw) {
    const OccupancyGrid<2> belief = random_belief(random, 30, 24, 0.1);
    const CellSet control = erode(belief, 0.1, is_known_free);
    const Eigen::Vector2d somewhere = belief.lattice().center_m(belief.index_at(static_cast<Offset>(random.index(belief.size()))));
    const Eigen::Vector2d elsewhere = somewhere + Eigen::Vector2d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    const DiscHull set(somewhere, elsewhere, random.uniform(0.0, 0.5));
    double expected_m = std::numeric_limits<double>::infinity();
    const IndexBox<2> box = belief.box().padded(30);
    for (int y = box.lower.y(); y < box.upper.y(); ++y) {
      for (int x = box.lower.x(); x < box.upper.x(); ++x) {
        if (control.value({x, y}) != 0) continue;
        const Eigen::Vector2d middle = belief.lattice().center_m({x, y});
        const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.05);
        expected_m = std::min(expected_m, set.distance_to({middle - half, middle + half}));
      }
    }
    for (const double bound_m : {0.1, 0.7}) {
      REQUIRE(distance_to_exterior_m(set, control, bound_m) == Approx(std::min(bound_m, expected_m)).margin(1e-9));
    }
  }
}

TEST_CASE("A robot follows paths to their ends without leaving the control space, and its goal never goes back", "[planning]") {
  Random random(3);
  int followed = 0;
  double nearest_m = 1.0;
  for (int draw = 0; draw < 60; ++draw) {
    const OccupancyGrid<2> belief = random_belief(random, 60, 50, 0.1);
    const BodyParams body{0.2, draw % 2 == 0 ? 0.05 : 0.15, CellShape::centers};
    const SafeSpaces spaces = safe_spaces(belief, body);
    std::vector<Index<2>> places;
    for (Offset i = 0; i < static_cast<Offset>(spaces.plan.size()); ++i) {
      if (spaces.plan[i] != 0) places.push_back(spaces.plan.index_at(i));
    }
    if (places.size() < 2) continue;
    const Eigen::Vector2d start_m = belief.lattice().center_m(places[random.index(places.size())]);
    TravelCostField field(belief.lattice());
    field.restart(visit_cost(belief, spaces.plan), start_m);
    const Index<2> goal = places[random.index(places.size())];
    if (!field.reaches(goal)) continue;
    SafeFollowParams params;
    params.speed_max_m_per_s = draw % 3 == 0 ? 0.26 : 1.0;
    params.turn_rate_max_rad_per_s = draw % 3 == 0 ? 0.8 : 1.0;
    SafePathFollower follower(Polyline(find_path(field, goal)), params);
    Pose2 pose{start_m.x(), start_m.y(), random.uniform(-3.1, 3.1)};
    double parameter = 0.0;
    for (int step = 0; step < 20000 && !follower.is_finished(); ++step) {
      const Twist2 command = follower.command(pose, spaces.control, 0.1);
      REQUIRE(follower.parameter() >= parameter);
      parameter = follower.parameter();
      REQUIRE(command.speed_m_per_s >= 0.0);
      REQUIRE(command.speed_m_per_s <= params.speed_max_m_per_s);
      REQUIRE(std::abs(command.turn_rate_rad_per_s) <= params.turn_rate_max_rad_per_s);
      for (int part = 0; part < 10; ++part) {
        pose = driven(pose, command, 0.01);
        CAPTURE(draw, step, pose.x_m, pose.y_m);
        REQUIRE(spaces.control.value(belief.lattice().index_of(pose.position())) == 1);
      }
      nearest_m = std::min(nearest_m, distance_to_exterior_m(DiscHull(pose.position(), pose.position(), 0.0), spaces.control, 1.0));
    }
    CAPTURE(draw, follower.parameter(), (pose.position() - belief.lattice().center_m(goal)).norm());
    REQUIRE(follower.is_finished());
    REQUIRE((pose.position() - belief.lattice().center_m(goal)).norm() <= params.goal_tolerance_m);
    ++followed;
  }
  CHECK(followed > 20);
  CHECK(nearest_m < 0.1);  // some ways were narrow
}

TEST_CASE("A path through a passage one cell wide is followed on fine grids, with no margin", "[planning]") {
  for (const double resolution_m : {0.1, 0.05, 0.03}) {
    OccupancyGrid<2> belief(Lattice<2>(resolution_m), {{0, 0}, {60, 21}}, Occupancy::unknown);
    belief.values().assign(belief.size(), Occupancy::free);
    const BodyParams body{9.2 * resolution_m, 0.0, CellShape::centers};
    const SafeSpaces spaces = safe_spaces(belief, body);
    const auto at = [&](int x) { return belief.lattice().center_m({x, 10}); };
    REQUIRE(spaces.plan.value({30, 10}) == 1);
    REQUIRE(spaces.plan.value({30, 12}) == 0);
    SafePathFollower follower(Polyline({at(15), at(45)}));
    Pose2 pose{at(15).x(), at(15).y(), 0.0};
    for (int step = 0; step < 5000 && !follower.is_finished(); ++step) {
      pose = driven(pose, follower.command(pose, spaces.control, 0.1), 0.1);
      REQUIRE(spaces.control.value(belief.lattice().index_of(pose.position())) == 1);
    }
    CHECK(follower.is_finished());
  }
}

TEST_CASE("A path without length is followed to its place, an empty one is finished", "[planning]") {
  const OccupancyGrid<2> belief(Lattice<2>(0.1), {{0, 0}, {20, 20}}, Occupancy::free);
  const CellSet control = erode(belief, 0.1, is_known_free);
  SafePathFollower none(Polyline{});
  CHECK(none.is_finished());
  CHECK(none.command({}, control, 0.1).speed_m_per_s == 0.0);
  SafePathFollower stay(Polyline({{1.0, 1.0}}));
  CHECK_FALSE(stay.is_finished());
  CHECK(stay.command({1.0, 1.0, 0.0}, control, 0.1).speed_m_per_s == 0.0);
  CHECK(stay.is_finished());
  for (const double bad : {-0.1, std::nan("")}) CHECK_THROWS_AS(stay.command({1.0, 1.0, 0.0}, control, bad), std::invalid_argument);
  SafeFollowParams params;
  params.speed_max_m_per_s = 0.0;
  CHECK_THROWS_AS(SafePathFollower(Polyline{}, params), std::invalid_argument);
}
