/// The corridors of a generated building: they cut its floor into blocks that rooms are made of.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/simulation/building_params.hpp"

namespace incognita::detail {

/// A rectangle of a building between corridors and outer walls, whose walls lie outside of it.
struct BuildingBlock {
  IndexBox<2> floor;
  std::array<std::array<bool, 2>, 2> has_corridor{};  ///< [axis][0: at the lower face, 1: at the upper]
  bool is_hall = false;

  /// The axis along which it is longer, x of equals.
  [[nodiscard]] int long_axis() const { return floor.extent().x() >= floor.extent().y() ? 0 : 1; }
};

/// Corridors and the blocks between them.
struct CorridorNet {
  std::vector<IndexBox<2>> corridors;
  std::vector<BuildingBlock> blocks;
};

/// Cuts a building. Where it is large enough, a ring of corridors comes first, two of which run from outer wall to outer wall. All that is
/// cut inside of it has corridors on all sides, so that each further corridor, which joins two of them, closes one more loop.
class CorridorCutter {
 public:
  CorridorCutter(const BuildingCells& cells, double hall_chance, Random& random)
      : cells_(cells), hall_chance_(hall_chance), random_(random) {}

  [[nodiscard]] CorridorNet cut() {
    const int edge = cells_.wall;
    BuildingBlock all{.floor = {{edge, edge}, {cells_.size.x() - edge, cells_.size.y() - edge}}};
    const int width = all.floor.extent().minCoeff() > cells_.of(main_ring_m) ? cells_.main_corridor : cells_.corridor;
    if (all.floor.extent().minCoeff() >= 3 * comfortable_side() + 2 * across(width)) {
      cut_ring(all, width);
    } else {
      cut_spine(all);
    }
    return std::move(net_);
  }

 private:
  static constexpr double main_ring_m = 40.0;   // buildings wider than this have a main corridor around
  static constexpr double main_block_m = 60.0;  // blocks longer than this are cut by main corridors
  static constexpr double row_m = 50.0;         // how long rows of rooms are, about

  /// What a corridor takes of a block, with its walls.
  [[nodiscard]] int across(int width) const { return width + 2 * cells_.wall; }

  /// So that not all rooms beside a cut are as small as rooms may be.
  [[nodiscard]] int comfortable_side() const { return std::max(cells_.side_min, std::min(cells_.depth_max, cells_.side_min * 7 / 5)); }

  /// Cuts a block by a corridor across `axis`, whose lower wall begins at `at`; returns what lies below and above.
  [[nodiscard]] std::pair<BuildingBlock, BuildingBlock> cut_at(const BuildingBlock& block, int axis, int at, int width) {
    const auto a = static_cast<std::size_t>(axis);
    const int wall = cells_.wall;
    std::pair<BuildingBlock, BuildingBlock> parts{block, block};
    parts.first.floor.upper[axis] = at;
    parts.first.has_corridor[a][1] = true;
    parts.second.floor.lower[axis] = at + across(width);
    parts.second.has_corridor[a][0] = true;
    IndexBox<2> corridor = block.floor;
    corridor.lower[axis] = at + wall;
    corridor.upper[axis] = at + wall + width;
    // Through the walls of the corridors that it ends at.
    if (block.has_corridor[1 - a][0]) corridor.lower[1 - axis] -= wall;
    if (block.has_corridor[1 - a][1]) corridor.upper[1 - axis] += wall;
    net_.corridors.push_back(corridor);
    return parts;
  }

  /// A row of rooms along each outer wall, between them and what is left inside a ring.
  void cut_ring(const BuildingBlock& all, int width) {
    const Index<2> extent = all.floor.extent();
    const bool is_long = 2 * extent.maxCoeff() > 3 * extent.minCoeff();
    const int first = is_long ? 1 - all.long_axis() : draw_between(random_, 0, 1);
    BuildingBlock middle = all;
    for (const int axis : {first, 1 - first}) {
      const int rest = middle.floor.extent()[axis] - 2 * across(width);
      // Where it is narrow, a third for either side and a third for the middle, about.
      const int deepest = std::min(cells_.depth_max, std::max(comfortable_side(), rest * 9 / 25));
      const int shallowest = std::min(deepest, std::max(comfortable_side(), deepest * 7 / 10));
      const int lower = draw_between(random_, shallowest, deepest);
      const int upper = draw_between(random_, shallowest, deepest);
      const auto [below, rest_above] = cut_at(middle, axis, middle.floor.lower[axis] + lower, width);
      const auto [inside, above] = cut_at(rest_above, axis, rest_above.floor.upper[axis] - upper - across(width), width);
      net_.blocks.push_back(below);
      net_.blocks.push_back(above);
      middle = inside;
    }
    cut_inside(middle);
  }

  /// One corridor, from end to end.
  void cut_spine(const BuildingBlock& all) {
    const int axis = 1 - all.long_axis();
    const int rest = all.floor.extent()[axis] - across(cells_.corridor);
    const int lower = std::clamp(draw_share(random_, rest, 0.4, 0.6), cells_.side_min, rest - cells_.side_min);
    const auto [below, above] = cut_at(all, axis, all.floor.lower[axis] + lower, cells_.corridor);
    net_.blocks.push_back(below);
    net_.blocks.push_back(above);
  }

  /// Cuts a block with corridors around it until it is a hall, or no deeper than two rooms and not too long.
  void cut_inside(BuildingBlock block) {
    const int longer = block.long_axis();
    const int length = block.floor.extent()[longer];
    const int depth = block.floor.extent()[1 - longer];
    if (may_be_hall(length, depth)) {
      block.is_hall = happens(random_, hall_chance_);
      if (block.is_hall) {
        net_.blocks.push_back(block);
        return;
      }
    }
    const int width = length > cells_.of(main_block_m) ? cells_.main_corridor : cells_.corridor;
    const int row = cells_.of(random_.uniform(0.6, 1.2) * row_m);
    if ((depth > 4 * cells_.depth_max || length > row) && length >= 2 * comfortable_side() + across(width)) {
      const int rest = length - across(width);
      const int lower = std::clamp(draw_share(random_, rest, 0.35, 0.65), comfortable_side(), rest - comfortable_side());
      cut_inside_at(block, longer, lower, width);
    } else if (depth > 2 * cells_.depth_max + cells_.wall && depth >= 2 * comfortable_side() + across(cells_.corridor)) {
      // A lane of two rows of rooms, at either side.
      const int rest = depth - across(cells_.corridor);
      const int deepest = std::min(2 * cells_.depth_max + cells_.wall, rest - comfortable_side());
      const int lane = draw_between(random_, std::min(deepest, std::max(comfortable_side(), deepest * 3 / 4)), deepest);
      cut_inside_at(block, 1 - longer, happens(random_, 0.5) ? lane : rest - lane, cells_.corridor);
    } else {
      net_.blocks.push_back(block);
    }
  }

  void cut_inside_at(const BuildingBlock& block, int axis, int lower, int width) {
    const auto [below, above] = cut_at(block, axis, block.floor.lower[axis] + lower, width);
    cut_inside(below);
    cut_inside(above);
  }

  [[nodiscard]] bool may_be_hall(int length, int depth) const {
    return 2 * depth >= 3 * cells_.depth_max && depth <= cells_.hall_side_max && 2 * length <= 3 * cells_.hall_side_max && length <= 3 * depth;
  }

  const BuildingCells& cells_;
  double hall_chance_;
  Random& random_;
  CorridorNet net_;
};

}  // namespace incognita::detail
