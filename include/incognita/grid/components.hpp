/// Connected components of a grid and the region around a seed, in two and three dimensions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "incognita/grid/grid.hpp"

namespace incognita {

/// Which cells touch each other.
enum class Adjacency {
  faces,   ///< 4 neighbours in the plane, 6 in space
  corners  ///< every cell that shares at least a corner: 8 in the plane, 26 in space
};

/// The steps from a cell to its neighbours, in storage order.
template <int Dim>
[[nodiscard]] std::vector<Index<Dim>> neighbor_steps(Adjacency adjacency) {
  std::vector<Index<Dim>> steps;
  Index<Dim> step = Index<Dim>::Constant(-1);
  while (step[Dim - 1] <= 1) {
    const int length = step.cwiseAbs().sum();
    if (length == 1 || (length > 1 && adjacency == Adjacency::corners)) steps.push_back(step);
    ++step[0];
    for (int axis = 0; axis + 1 < Dim && step[axis] > 1; ++axis) {
      step[axis] = -1;
      ++step[axis + 1];
    }
  }
  return steps;
}

namespace detail {

/// Spreads from cell to neighbouring cell of a box. Keeps its scratch from one call to the next.
template <int Dim>
class Flood {
 public:
  /// For the box of `grid`, of which nothing else is kept.
  template <class Value>
  Flood(const Grid<Value, Dim>& grid, Adjacency adjacency)
      : box_(grid.box()), steps_(neighbor_steps<Dim>(adjacency)) {
    for (int axis = 0; axis < Dim; ++axis) stride_[axis] = grid.stride(axis);
    for (const Index<Dim>& step : steps_) {
      offset_steps_.push_back(stride_.dot(step.template cast<Offset>()));
    }
  }

  /// Visits the seed and all that can be reached through cells that claim(offset) accepts; claim must refuse
  /// a cell that it has accepted before. The seed must lie in the box. Returns how many cells were accepted.
  template <class Claim>
  std::size_t operator()(const Index<Dim>& seed, Claim&& claim) {
    std::size_t claimed = 0;
    if (claim(offset_of(seed))) {
      open_.push_back(seed);
      ++claimed;
    }
    while (!open_.empty()) {
      const Index<Dim> index = open_.back();
      open_.pop_back();
      const Offset offset = offset_of(index);
      const bool inner =
          (index.array() > box_.lower.array()).all() && (index.array() < box_.upper.array() - 1).all();
      for (std::size_t s = 0; s < steps_.size(); ++s) {
        const Index<Dim> neighbor = index + steps_[s];
        if ((inner || box_.contains(neighbor)) && claim(offset + offset_steps_[s])) {
          open_.push_back(neighbor);
          ++claimed;
        }
      }
    }
    return claimed;
  }

 private:
  [[nodiscard]] Offset offset_of(const Index<Dim>& index) const {
    return stride_.dot((index - box_.lower).template cast<Offset>());
  }

  IndexBox<Dim> box_;
  Eigen::Matrix<Offset, Dim, 1> stride_;
  std::vector<Index<Dim>> steps_;
  std::vector<Offset> offset_steps_;
  std::vector<Index<Dim>> open_;
};

}  // namespace detail

/// Which component each cell of a grid belongs to.
template <int Dim>
struct Components {
  static constexpr std::int32_t none = -1;  ///< of cells in no component
  Grid<std::int32_t, Dim>
      labels;  ///< 0, 1, ... in the storage order of the components' first cells, or `none`
  std::vector<std::size_t> sizes;  ///< cells of each component

  /// The label of the component with the most cells, the first of equals; `none` when there is none.
  [[nodiscard]] std::int32_t largest() const {
    std::int32_t best = none;
    for (std::size_t label = 0; label < sizes.size(); ++label) {
      if (best == none || sizes[label] > sizes[static_cast<std::size_t>(best)]) {
        best = static_cast<std::int32_t>(label);
      }
    }
    return best;
  }
};

/// The connected components of the cells for which belongs(value) holds. O(cells).
template <class Value, int Dim, class Belongs>
[[nodiscard]] Components<Dim> connected_components(const Grid<Value, Dim>& grid, Adjacency adjacency,
                                                   Belongs&& belongs) {
  constexpr std::int32_t none = Components<Dim>::none;
  Components<Dim> components{Grid<std::int32_t, Dim>(grid.lattice(), grid.box(), none), {}};
  detail::Flood<Dim> flood(grid, adjacency);
  for (Offset first = 0; first < static_cast<Offset>(grid.size()); ++first) {
    if (components.labels[first] != none || !belongs(grid[first])) continue;
    const auto label = static_cast<std::int32_t>(components.sizes.size());
    components.sizes.push_back(flood(grid.index_at(first), [&](Offset offset) {
      if (components.labels[offset] != none || !belongs(grid[offset])) return false;
      components.labels[offset] = label;
      return true;
    }));
  }
  return components;
}

/// The cells that can be reached from `seed` through cells for which belongs(value) holds: 1 for those, 0 for
/// the others, with the grid's lattice and box. All 0 when the seed itself does not belong or lies outside of
/// the box. O(cells).
template <class Value, int Dim, class Belongs>
[[nodiscard]] Grid<std::uint8_t, Dim> flood_fill(const Grid<Value, Dim>& grid, const Index<Dim>& seed,
                                                 Adjacency adjacency, Belongs&& belongs) {
  Grid<std::uint8_t, Dim> reached(grid.lattice(), grid.box(), 0);
  if (!grid.contains(seed)) return reached;
  detail::Flood<Dim> flood(grid, adjacency);
  flood(seed, [&](Offset offset) {
    if (reached[offset] != 0 || !belongs(grid[offset])) return false;
    reached[offset] = 1;
    return true;
  });
  return reached;
}

}  // namespace incognita
