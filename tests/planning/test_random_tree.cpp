#include <Eigen/Core>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include "incognita/planning/landmark_cost.hpp"
#include "incognita/planning/random_tree.hpp"

using namespace incognita;
using Catch::Matchers::Contains;

namespace {

const Box<Eigen::Vector2d> kRoom{{0.0, 0.0}, {20.0, 12.0}};

/// A wall from below at x = 10 with a gap above y = 9.
bool is_clear(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  if ((from.x() < 10.0) == (to.x() < 10.0)) return true;
  const double share = (10.0 - from.x()) / (to.x() - from.x());
  return from.y() + share * (to.y() - from.y()) > 9.0;
}

/// Landmarks of known uncertainty, each seen within 3 m.
struct Beacons {
  template <class Visit>
  void operator()(const Eigen::Vector2d& place_m, Visit&& visit) const {
    if ((place_m - Eigen::Vector2d(3.0, 2.0)).norm() < 3.0) visit(0.1);
    if ((place_m - Eigen::Vector2d(6.0, 3.0)).norm() < 3.0) visit(0.4);
    if ((place_m - Eigen::Vector2d(15.0, 10.0)).norm() < 3.0) visit(0.05);
  }
};

/// Every node's state anew, from the root along its way; the tree's own must be the same, to the bit.
template <class Cost>
void require_consistent(const RandomTree<Cost>& tree, const Cost& cost, double edge_max_m) {
  const auto& nodes = tree.nodes();
  REQUIRE(nodes.front().parent == RandomTree<Cost>::none);
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    std::vector<std::size_t> way;
    std::set<std::size_t> seen;
    for (std::size_t at = node; at != RandomTree<Cost>::none; at = nodes[at].parent) {
      REQUIRE(seen.insert(at).second);  // no place is its own ancestor
      way.push_back(at);
    }
    REQUIRE(way.back() == 0);
    auto state = cost.start();
    for (std::size_t i = way.size() - 1; i > 0; --i) {
      const auto& from = nodes[way[i]].place_m;
      const auto& to = nodes[way[i - 1]].place_m;
      REQUIRE(is_clear(from, to));
      REQUIRE((to - from).norm() <= edge_max_m + 1e-9);
      state = cost.extend(state, from, to);
    }
    REQUIRE(cost.total(state) == nodes[node].cost);
    REQUIRE(tree.way_to(node).size() == way.size());
    REQUIRE(tree.way_to(node).front() == nodes.front().place_m);
    REQUIRE(tree.way_to(node).back() == nodes[node].place_m);
  }
}

template <class Cost>
double cheapest_near(const RandomTree<Cost>& tree, const Eigen::Vector2d& goal, double within_m) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& node : tree.nodes()) {
    if ((node.place_m - goal).norm() < within_m) least = std::min(least, node.cost);
  }
  return least;
}

}  // namespace

TEST_CASE("A tree's costs are those of its ways, however it was rewired", "[planning]") {
  RandomTreeParams params;
  params.samples = 800;
  for (const double radius_m : {0.0, 2.5, 5.0}) {
    params.radius_m = radius_m;
    Random random(1);
    const LengthCost length;
    const RandomTree<LengthCost> by_length({2.0, 2.0}, kRoom, is_clear, length, random, params);
    require_consistent(by_length, length, std::max(radius_m, params.step_m));

    for (const LandmarkRule rule : {LandmarkRule::best, LandmarkRule::last}) {
      LandmarkCostParams cost_params;
      cost_params.start_odometry_m = 3.0;
      cost_params.rule = rule;
      const LandmarkCost<Beacons> cost({}, cost_params);
      Random again(2);
      const RandomTree<LandmarkCost<Beacons>> tree({2.0, 8.0}, kRoom, is_clear, cost, again, params);
      require_consistent(tree, cost, std::max(radius_m, params.step_m));
      std::size_t falling = 0;
      for (const auto& node : tree.nodes()) {
        if (node.parent != tree.none && node.cost < tree.nodes()[node.parent].cost) ++falling;
      }
      REQUIRE(falling > 3);  // the cost falls where a landmark comes in sight: what rewiring must stand
    }
  }
}

TEST_CASE("RRT* finds the short way, RRT a way", "[planning]") {
  const Eigen::Vector2d start(2.0, 2.0);
  const Eigen::Vector2d goal(18.0, 2.0);
  const double shortest_m = 2.0 * std::hypot(8.0, 7.0);  // over the end of the wall
  RandomTreeParams params;
  double rrt_m = 0.0;
  double star_m = 0.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const double radius_m : {0.0, 3.0}) {
      params.radius_m = radius_m;
      Random random(seed);
      const RandomTree<LengthCost> tree(start, kRoom, is_clear, {}, random, params);
      (radius_m > 0.0 ? star_m : rrt_m) += cheapest_near(tree, goal, 0.5) / 5.0;
    }
  }
  REQUIRE(star_m > shortest_m - 0.5);
  REQUIRE(star_m < 1.06 * shortest_m);
  REQUIRE(rrt_m > 1.1 * shortest_m);
}

TEST_CASE("A way by landmarks is cheaper than the straight one where odometry is dear", "[planning]") {
  // From left to right above the wall; landmarks lie on a detour.
  const auto seen = [](const Eigen::Vector2d& place_m, auto&& visit) {
    if (place_m.y() > 10.0) visit(0.01);
  };
  const LandmarkCost<decltype(seen)> cost(seen, {});
  RandomTreeParams params;
  Random random(3);
  const auto clear = [](const Eigen::Vector2d&, const Eigen::Vector2d&) { return true; };
  const RandomTree<LandmarkCost<decltype(seen)>> tree({1.0, 7.0}, kRoom, clear, cost, random, params);
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t node = 0; node < tree.nodes().size(); ++node) {
    if ((tree.nodes()[node].place_m - Eigen::Vector2d(19.0, 7.0)).norm() < 1.0 && tree.nodes()[node].cost < least) {
      best = node;
      least = tree.nodes()[node].cost;
    }
  }
  REQUIRE(best != 0);
  std::size_t with_landmark = 0;
  for (const Eigen::Vector2d& place : tree.way_to(best)) with_landmark += place.y() > 10.0 ? 1 : 0;
  REQUIRE(with_landmark >= 2);
}

TEST_CASE("Equation (A.15) by hand", "[planning]") {
  LandmarkCostParams params;
  params.cell_m = 0.5;
  params.process_sigma_m = 0.1;
  params.start_odometry_m = 2.0;
  for (const LandmarkRule rule : {LandmarkRule::best, LandmarkRule::last}) {
    params.rule = rule;
    const LandmarkCost<Beacons> cost({}, params);
    auto state = cost.start();
    REQUIRE(cost.total(state) == Approx(4.0));
    state = cost.extend(state, {12.0, 0.0}, {10.0, 0.0});  // none in sight: 4 cells more, twice
    REQUIRE(cost.total(state) == Approx(4.0 + 4.0 + 4.0));
    state = cost.extend(state, {10.0, 0.0}, {4.5, 2.5});  // two in sight
    const double length_cells = 4.0 + 2.0 * std::hypot(5.5, 2.5);
    const double sigma_m = rule == LandmarkRule::best ? 0.1 : 0.4;
    REQUIRE(cost.total(state) == Approx(length_cells + 2.0 * sigma_m / (0.5 * 0.1)));
  }
}

TEST_CASE("One seed makes one tree", "[planning]") {
  RandomTreeParams params;
  params.samples = 300;
  Random one(9);
  Random other(9);
  const RandomTree<LengthCost> a({1.0, 1.0}, kRoom, is_clear, {}, one, params);
  const RandomTree<LengthCost> b({1.0, 1.0}, kRoom, is_clear, {}, other, params);
  REQUIRE(a.nodes().size() == b.nodes().size());
  for (std::size_t node = 0; node < a.nodes().size(); ++node) {
    REQUIRE(a.nodes()[node].place_m == b.nodes()[node].place_m);
    REQUIRE(a.nodes()[node].parent == b.nodes()[node].parent);
  }
}

TEST_CASE("A tree refuses what it cannot grow in", "[planning]") {
  Random random(1);
  const auto grow = [&](const Box<Eigen::Vector2d>& box, const RandomTreeParams& params) {
    return RandomTree<LengthCost>({1.0, 1.0}, box, is_clear, {}, random, params).nodes().size();
  };
  RandomTreeParams params;
  params.step_m = 0.0;
  REQUIRE_THROWS_WITH(grow(kRoom, params), Contains("step_m is 0"));
  params = {};
  params.radius_m = -1.0;
  REQUIRE_THROWS_WITH(grow(kRoom, params), Contains("radius_m is -1"));
  params = {};
  params.samples = 0;
  REQUIRE_THROWS_WITH(grow(kRoom, params), Contains("samples is 0"));
  REQUIRE_THROWS_WITH(grow({{0.0, 0.0}, {0.0, 5.0}}, {}), Contains("the side of the box is 0"));
  REQUIRE_THROWS_WITH(RandomTree<LengthCost>({std::numeric_limits<double>::quiet_NaN(), 1.0}, kRoom, is_clear, {}, random),
                      Contains("a coordinate of the root is nan"));
  LandmarkCostParams cost;
  cost.cell_m = 0.0;
  REQUIRE_THROWS_WITH(LandmarkCost<Beacons>({}, cost), Contains("cell_m is 0"));
  cost = {};
  cost.process_sigma_m = -1.0;
  REQUIRE_THROWS_WITH(LandmarkCost<Beacons>({}, cost), Contains("process_sigma_m is -1"));
}
