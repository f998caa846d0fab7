/// Office buildings of any size from a seed: corridors in rings, rooms, halls with columns, furniture.
#pragma once

#include <utility>

#include "incognita/core/random.hpp"
#include "incognita/grid/floor_plan.hpp"
#include "incognita/simulation/building_layout.hpp"
#include "incognita/simulation/building_params.hpp"
#include "incognita/simulation/corridor_net.hpp"
#include "incognita/simulation/furniture.hpp"
#include "incognita/simulation/room_rows.hpp"

namespace incognita {

/// Lays out a building from (0, 0) to `size_m`: the footprint is cut into blocks by corridors, and blocks are filled with rows of rooms that face
/// them, or made halls. A disc of `robot_radius_m` gets from each place where it fits, at the centre of a cell, to all others. Wherever both
/// sides have room for it, the corridors form rings. Throws std::invalid_argument as BuildingParams::validate does. O(area), whatever the
/// resolution.
[[nodiscard]] inline BuildingLayout lay_out_building(const BuildingParams& params, Random& random) {
  params.validate();
  const detail::BuildingCells cells(params);
  detail::CorridorNet net = detail::CorridorCutter(cells, params.hall_chance, random).cut();
  detail::RoomRows rows(cells, random);
  for (const detail::BuildingBlock& block : net.blocks) rows.fill(block);
  BuildingLayout layout{Lattice<2>(params.resolution_m), {{0, 0}, cells.size}, std::move(net.corridors), rows.take()};
  detail::Furnisher furnisher(cells, params.furniture_share, random);
  for (BuildingRoom& room : layout.rooms) furnisher.furnish(room);
  return layout;
}

/// The floor plan of such a building. Throws likewise, and std::length_error above FloorPlan::cell_count_max cells. O(cells).
[[nodiscard]] inline FloorPlan make_building(const BuildingParams& params, Random& random) {
  return draw_layout(lay_out_building(params, random));
}

}  // namespace incognita
