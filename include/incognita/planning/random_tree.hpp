/// Trees of random motions with costs of any kind: RRT and RRT* (LaValle; Karaman and Frazzoli).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <utility>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/core/random.hpp"
#include "incognita/geometry/box.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita {

/// What a way costs. A State is what the cost at a place depends on, such as the distance travelled; it is carried from
/// place to place, so that a cost may depend on all of the way and may even fall along it.
template <class Cost>
concept WayCost = requires(const Cost& cost, const typename Cost::State& state, const Eigen::Vector2d& place_m) {
  { cost.start() } -> std::same_as<typename Cost::State>;
  { cost.extend(state, place_m, place_m) } -> std::same_as<typename Cost::State>;
  { cost.total(state) } -> std::convertible_to<double>;
};

/// The length of a way, in metres.
struct LengthCost {
  /// What the length at a place depends on.
  struct State {
    double length_m = 0.0;  ///< driven so far
  };
  [[nodiscard]] State start() const { return {}; }  ///< nothing driven
  /// After a straight piece, in the frame of the tree.
  [[nodiscard]] State extend(const State& state, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) const {
    return {state.length_m + distance(from_m, to_m)};
  }
  [[nodiscard]] double total(const State& state) const { return state.length_m; }  ///< in metres
};

/// How a tree grows.
struct RandomTreeParams {
  double step_m = 1.0;     ///< the longest edge of a new place, > 0
  double radius_m = 5.0;   ///< RRT*: how far parents are sought and children rewired, >= 0; with 0 the tree is an RRT
  int samples = 2000;      ///< places tried, > 0

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("RandomTreeParams", "step_m", step_m);
    require_non_negative("RandomTreeParams", "radius_m", radius_m);
    require(samples > 0, "RandomTreeParams", "samples", samples, "> 0");
  }
};

/// A tree of places from a root, each with its parent and what the way to it costs.
template <WayCost Cost>
class RandomTree {
 public:
  using State = typename Cost::State;                                ///< of the cost
  static constexpr std::size_t none = static_cast<std::size_t>(-1);  ///< no node

  /// A place of the tree.
  struct Node {
    Eigen::Vector2d place_m;  ///< in the frame of the box
    std::size_t parent;       ///< `none` for the root, which is first
    State state;              ///< of the cost there
    double cost;              ///< cost.total(state), in the unit of the cost
  };

  /// Grows a tree from a root over a box. Each sample, uniform in the box, is taken a step towards it from the nearest place; with
  /// a radius, the new place's parent is the one within it that makes its cost least, and those within it that are cheaper by way of
  /// the new place become its children. is_clear(from, to) says whether a straight way may be driven. States are carried on to all
  /// that hangs on what was rewired, and no place becomes its own ancestor, which costs that fall along a way would ask for.
  /// Throws std::invalid_argument for bad parameters, a root that is not finite, or a box without area. O(samples * places).
  template <class IsClear>
  RandomTree(const Eigen::Vector2d& root_m, const Box<Eigen::Vector2d>& box_m, IsClear&& is_clear, const Cost& cost, Random& random,
             const RandomTreeParams& params = {}) {
    params.validate();
    for (int axis = 0; axis < 2; ++axis) {
      require(std::isfinite(root_m[axis]), "RandomTree", "a coordinate of the root", root_m[axis], "finite");
      require_positive("RandomTree", "the side of the box", box_m.upper[axis] - box_m.lower[axis]);
    }
    const State start = cost.start();
    nodes_.push_back({root_m, none, start, cost.total(start)});
    children_.emplace_back();
    std::vector<std::size_t> around;
    for (int sample = 0; sample < params.samples; ++sample) {
      const double x_m = random.uniform(box_m.lower[0], box_m.upper[0]);
      const double y_m = random.uniform(box_m.lower[1], box_m.upper[1]);
      const std::size_t nearest = nearest_to({x_m, y_m});
      const Eigen::Vector2d from_m = nodes_[nearest].place_m;
      const double away_m = distance(from_m, {x_m, y_m});
      if (!(away_m > 0.0)) continue;
      const double share = std::min(1.0, params.step_m / away_m);
      const Eigen::Vector2d place_m(from_m[0] + share * (x_m - from_m[0]), from_m[1] + share * (y_m - from_m[1]));
      if (!is_clear(from_m, place_m)) continue;
      around.clear();
      if (params.radius_m > 0.0) {
        for (std::size_t other = 0; other < nodes_.size(); ++other) {
          if (distance(nodes_[other].place_m, place_m) <= params.radius_m) around.push_back(other);
        }
      }
      add(place_m, nearest, around, is_clear, cost);
      rewire(around, is_clear, cost);
    }
  }

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }  ///< the root first, in the order of their samples

  /// The places from the root to a node.
  [[nodiscard]] std::vector<Eigen::Vector2d> way_to(std::size_t node) const {
    std::vector<Eigen::Vector2d> way;
    for (std::size_t at = node; at != none; at = nodes_[at].parent) way.push_back(nodes_[at].place_m);
    std::reverse(way.begin(), way.end());
    return way;
  }

 private:
  [[nodiscard]] std::size_t nearest_to(const Eigen::Vector2d& place_m) const {
    std::size_t nearest = 0;
    double least_m = distance(nodes_[0].place_m, place_m);
    for (std::size_t node = 1; node < nodes_.size(); ++node) {
      const double away_m = distance(nodes_[node].place_m, place_m);
      if (away_m < least_m) {
        least_m = away_m;
        nearest = node;
      }
    }
    return nearest;
  }

  /// A new place below the cheapest parent.
  template <class IsClear>
  void add(const Eigen::Vector2d& place_m, std::size_t nearest, const std::vector<std::size_t>& around, IsClear&& is_clear,
           const Cost& cost) {
    std::size_t parent = nearest;
    State state = cost.extend(nodes_[nearest].state, nodes_[nearest].place_m, place_m);
    double total = cost.total(state);
    for (const std::size_t other : around) {
      State by_other = cost.extend(nodes_[other].state, nodes_[other].place_m, place_m);
      const double total_by_other = cost.total(by_other);
      if (total_by_other >= total || !is_clear(nodes_[other].place_m, place_m)) continue;
      parent = other;
      state = std::move(by_other);
      total = total_by_other;
    }
    children_[parent].push_back(nodes_.size());
    nodes_.push_back({place_m, parent, std::move(state), total});
    children_.emplace_back();
  }

  /// Hangs those around the last place below it that it makes cheaper.
  template <class IsClear>
  void rewire(const std::vector<std::size_t>& around, IsClear&& is_clear, const Cost& cost) {
    const std::size_t last = nodes_.size() - 1;
    for (const std::size_t other : around) {
      const State state = cost.extend(nodes_[last].state, nodes_[last].place_m, nodes_[other].place_m);
      if (cost.total(state) >= nodes_[other].cost || is_ancestor(other, last)) continue;
      if (!is_clear(nodes_[last].place_m, nodes_[other].place_m)) continue;
      std::erase(children_[nodes_[other].parent], other);
      nodes_[other].parent = last;
      children_[last].push_back(other);
      carry_on(other, cost);
    }
  }

  [[nodiscard]] bool is_ancestor(std::size_t candidate, std::size_t node) const {
    for (std::size_t at = node; at != none; at = nodes_[at].parent) {
      if (at == candidate) return true;
    }
    return false;
  }

  /// The states of a node and all below it, from its parent's.
  void carry_on(std::size_t node, const Cost& cost) {
    std::vector<std::size_t> open{node};
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      const Node& parent = nodes_[nodes_[at].parent];
      nodes_[at].state = cost.extend(parent.state, parent.place_m, nodes_[at].place_m);
      nodes_[at].cost = cost.total(nodes_[at].state);
      open.insert(open.end(), children_[at].begin(), children_[at].end());
    }
  }

  std::vector<Node> nodes_;
  std::vector<std::vector<std::size_t>> children_;
};

}  // namespace incognita
