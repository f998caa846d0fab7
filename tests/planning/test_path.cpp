#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "drawn_plan.hpp"
#include "incognita/core/random.hpp"
#include "incognita/planning/path.hpp"

using namespace incognita;

namespace {

/// The cost along a path by fine sampling.
double sampled_cost_m(const TravelCostField& field, const std::vector<Eigen::Vector2d>& path_m) {
  const Polyline path(path_m);
  constexpr int samples_per_m = 400;
  const int samples = std::max(1, static_cast<int>(path.length_m() * samples_per_m));
  double sum = 0.0;
  for (int sample = 0; sample < samples; ++sample) {
    const Eigen::Vector2d at_m = path.point_at(path.length_m() * (sample + 0.5) / samples);
    sum += static_cast<double>(field.cost_per_m(field.lattice().index_of(at_m)));
  }
  return path.length_m() * sum / samples;
}

double distance_to_segment_m(const Eigen::Vector2d& point_m, const Eigen::Vector2d& a_m,
                             const Eigen::Vector2d& b_m) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (int sample = 0; sample <= 400; ++sample) {
    nearest_m = std::min(nearest_m, (a_m + (b_m - a_m) * sample / 400.0 - point_m).norm());
  }
  return nearest_m;
}

}  // namespace

TEST_CASE("A found path runs from the start to the goal's centre", "[planning]") {
  const OccupancyGrid<2> belief = draw({".....#...", ".....#...", ".........", "....."}, 0.5);
  const TravelCostField field(belief, clearance_of(belief), {0.3, 1.9});
  const auto path_m = find_path(field, {7, 3});
  REQUIRE(path_m.front() == Eigen::Vector2d(0.3, 1.9));
  REQUIRE(path_m.back() == Eigen::Vector2d(3.75, 1.75));
  REQUIRE(find_path(field, {5, 3}).empty());
  REQUIRE(find_path(field, {50, 3}).empty());
}

TEST_CASE("A shortened path keeps clearance, ends and cost, and has fewer corners", "[planning]") {
  Random random(1);
  std::size_t paths = 0;
  std::size_t corners_before = 0;
  std::size_t corners_after = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const OccupancyGrid<2> belief = random_belief(random, 80, 60, 0.1);
    const Index<2> start = belief.index_at(static_cast<Offset>(random.index(belief.size())));
    const Eigen::Vector2d aside_m{random.uniform(-0.049, 0.049), random.uniform(-0.049, 0.049)};
    const Eigen::Vector2d start_m = belief.lattice().center_m(start) + aside_m;
    const TravelCostField field(belief, clearance_of(belief), start_m);
    if (!field.is_proper(start)) continue;
    for (int goals = 0; goals < 20; ++goals) {
      const auto path_m = find_path(field, belief.index_at(static_cast<Offset>(random.index(belief.size()))));
      if (path_m.size() < 3) continue;
      const auto shorter_m = shorten_path(field, path_m);
      ++paths;
      corners_before += path_m.size();
      corners_after += shorter_m.size();
      REQUIRE(shorter_m.front() == path_m.front());
      REQUIRE(shorter_m.back() == path_m.back());
      for (std::size_t i = 1; i < shorter_m.size(); ++i) {
        traverse<2>(belief.lattice(), shorter_m[i - 1], shorter_m[i],
                    [&](const Index<2>& index) { REQUIRE(field.is_passable(index)); });
      }
      REQUIRE(Polyline(shorter_m).length_m() <= Polyline(path_m).length_m() * (1.0 + 1e-9));
      // 2 % by slack, and what a cost sampled every half cell errs by.
      REQUIRE(sampled_cost_m(field, shorter_m) <= 1.05 * sampled_cost_m(field, path_m) + 0.05);
    }
  }
  REQUIRE(paths > 100);
  REQUIRE(corners_after * 5 < corners_before);
}

TEST_CASE("In the open a path becomes a straight line", "[planning]") {
  OccupancyGrid<2> belief(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(100, 100)}, Occupancy::unknown);
  belief.values().assign(belief.size(), Occupancy::free);
  const TravelCostField field(belief, clearance_of(belief), {1.0, 1.0});
  const auto path_m = shorten_path(field, find_path(field, {93, 37}));
  REQUIRE(path_m.size() == 2);
}

TEST_CASE("Steps away from a wall stay when a path is shortened", "[planning]") {
  OccupancyGrid<2> belief(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(50, 50)}, Occupancy::unknown);
  belief.values().assign(belief.size(), Occupancy::free);
  for (int x = 0; x < 50; ++x) belief.set({x, 0}, Occupancy::occupied);
  const TravelCostField field(belief, clearance_of(belief), {2.5, 0.15});
  REQUIRE_FALSE(field.is_proper({25, 1}));
  const auto path_m = find_path(field, {45, 10});
  const auto shorter_m = shorten_path(field, path_m);
  std::size_t first_proper = 0;
  while (!field.is_proper(belief.lattice().index_of(path_m[first_proper]))) {
    REQUIRE(shorter_m.at(first_proper) == path_m[first_proper]);
    ++first_proper;
  }
  REQUIRE(first_proper >= 1);
  REQUIRE(shorter_m.size() < path_m.size());
}

TEST_CASE("A negative slack is refused", "[planning]") {
  const OccupancyGrid<2> belief = draw({"..."}, 0.5);
  const TravelCostField field(belief, clearance_of(belief), {0.1, 0.1});
  REQUIRE_THROWS_WITH(shorten_path(field, find_path(field, {2, 0}), -0.1), Catch::Contains("slack is -0.1"));
}

TEST_CASE("A path is blocked exactly by what lies within its radius ahead", "[planning]") {
  Random random(2);
  int blocked = 0;
  int clear = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double resolution_m = random.uniform(0.05, 0.2);
    const Lattice<2> lattice(resolution_m, {random.uniform(-1.0, 1.0), 0.0});
    std::vector<Eigen::Vector2d> points_m;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d point_m{random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0)};
      points_m.push_back(point_m);
    }
    const Polyline path(points_m);
    const double from_m = trial % 2 == 0 ? 0.0 : random.uniform(0.0, path.length_m());
    const double radius_m = random.uniform(0.05, 0.6);
    const Index<2> obstacle = lattice.index_of({random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0)});

    double distance_m =
        distance_to_segment_m(lattice.center_m(obstacle), path.point_at(from_m), path.point_at(from_m));
    for (std::size_t i = 1; i < points_m.size(); ++i) {
      if (path.arc_m(i) < from_m) continue;
      const Eigen::Vector2d begin_m = path.arc_m(i - 1) < from_m ? path.point_at(from_m) : points_m[i - 1];
      distance_m =
          std::min(distance_m, distance_to_segment_m(lattice.center_m(obstacle), begin_m, points_m[i]));
    }
    if (std::abs(distance_m - radius_m) < 0.01) continue;  // nearer than the reference samples
    const bool is_clear = path_is_clear(
        path, lattice, radius_m, [&](const Index<2>& index) { return index == obstacle; }, from_m);
    REQUIRE(is_clear == (distance_m > radius_m));
    ++(is_clear ? clear : blocked);
  }
  REQUIRE(blocked > 30);
  REQUIRE(clear > 50);
}

TEST_CASE("A path of no or one place can be asked whether it is clear", "[planning]") {
  const auto everywhere = [](const Index<2>&) { return true; };
  REQUIRE(path_is_clear(Polyline(), Lattice<2>(0.1), 0.2, everywhere));
  REQUIRE_FALSE(path_is_clear(Polyline({Eigen::Vector2d(1.0, 1.0)}), Lattice<2>(0.1), 0.2, everywhere));
  const Polyline straight({Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(5.0, 0.0)});
  const auto behind = [](const Index<2>& index) { return index.x() < 10; };
  REQUIRE_FALSE(path_is_clear(straight, Lattice<2>(0.1), 0.2, behind));
  REQUIRE(path_is_clear(straight, Lattice<2>(0.1), 0.2, behind, 1.5));
  REQUIRE(path_is_clear(straight, Lattice<2>(0.1), 0.2, behind, 99.0));
}
