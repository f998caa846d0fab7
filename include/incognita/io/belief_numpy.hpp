/// Beliefs as NumPy arrays, with a JSON file that says where they lie.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "incognita/io/atomic_file.hpp"
#include "incognita/io/belief.hpp"
#include "incognita/io/npy.hpp"
#include "incognita/map/map.hpp"

namespace incognita {

namespace detail {

/// Rows from the smallest y up, columns from the smallest x: as a grid has its cells.
[[nodiscard]] inline NpyArray<float> npy_of(const Grid<float, 2>& grid) {
  const Index<2> extent = grid.box().extent();
  return {{static_cast<std::size_t>(extent.y()), static_cast<std::size_t>(extent.x())}, grid.values()};
}

}  // namespace detail

/// What a frame file says of a box of cells.
[[nodiscard]] inline std::string belief_frame_text(const Lattice<2>& lattice, const IndexBox<2>& cells) {
  const Index<2> extent = cells.extent();
  nlohmann::ordered_json json;
  json["format"] = "incognita belief";
  json["version"] = 1;
  json["shape"] = {extent.y(), extent.x()};
  json["resolution_m"] = lattice.resolution_m();
  json["origin_m"] = {lattice.origin_m().x(), lattice.origin_m().y()};
  json["first_cell"] = {cells.lower.x(), cells.lower.y()};
  json["row_order"] = "row 0 has the smallest y, column 0 the smallest x";
  json["cell_extent"] =
      "[row, column] covers origin_m + (first_cell + (column, row)) resolution_m and as far on as a cell reaches";
  json["units"] = {{"length", "m"}, {"log_odds", "nats, ln(p / (1 - p))"}, {"probability", "of being occupied"}};
  json["unknown"] = {{"log_odds", 0.0}, {"probability", 0.5}};
  return json.dump(2) + '\n';
}

/// Writes a belief, cut to the cells that say something, as `stem`_log_odds.npy and `stem`_probability.npy
/// (float32, shape (rows, columns), row 0 with the smallest y; unknown is 0 and 0.5) and `stem`_frame.json:
/// resolution_m, origin_m (the lower left corner of cell (0, 0)), first_cell (the x and y index of
/// [0, 0]), shape, row order and units. So numpy's imshow needs origin="lower". The arrays are written first, the
/// frame last. A map that says nothing gives arrays of shape (0, 0). Throws
/// InputError when a file cannot be written.
template <class Cell>
void write_belief_numpy(const std::filesystem::path& stem, const Map<Cell, 2>& map) {
  const Grid<float, 2> log_odds = belief_log_odds(map);
  Grid<float, 2> probability = log_odds;
  for (float& value : probability.values()) {
    value = static_cast<float>(probability_of_log_odds(static_cast<double>(value)));
  }
  const auto file = [&stem](const char* ending) { return std::filesystem::path(stem) += ending; };
  write_npy(file("_log_odds.npy"), detail::npy_of(log_odds));
  write_npy(file("_probability.npy"), detail::npy_of(probability));
  write_file_atomically(file("_frame.json"), belief_frame_text(log_odds.lattice(), log_odds.box()));
}

}  // namespace incognita
