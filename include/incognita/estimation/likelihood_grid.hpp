/// How well end points of beams fit the surfaces of a map, on a fine grid: for searches that ask for the same
/// cells often.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/estimation/surface_map.hpp"
#include "incognita/grid/lattice.hpp"

namespace incognita {

/// exp(-d^2 / (2 sigma^2)) for the distance d from the centre of a cell to the nearest surface, 0 beyond 3
/// sigma, in steps of 1 / value_max (Olson, "Real-time correlative scan matching", 2009, section III-B). A
/// planar surface is the piece of its line that is one cell of the surface map long, any other is a point. A
/// surface counts only for beams that face it: there is one layer for each of 8 viewing directions. The
/// layers are stacked, layer after layer, row after row. Memory: 8 bytes a cell. Reading is safe from many
/// threads.
template <int Dim = 2>
class LikelihoodGrid {
  static_assert(Dim == 2, "searches are planar");

 public:
  static constexpr int layer_count = 8;  ///< of viewing directions
  static constexpr int value_max = 255;  ///< what likelihood 1 is stored as

  /// The layer of a beam's direction: the nearest multiple of pi / 4. The angle must lie within +-100 rad.
  [[nodiscard]] static int layer_of(double direction_rad) {
    // Lifted above 0, where a cast rounds down, by a multiple of 8 layers.
    return static_cast<int>(direction_rad * (4.0 / std::numbers::pi) + 128.5) & (layer_count - 1);
  }

  /// Rasterises the surfaces near columns x rows cells of the lattice, from its cell (0, 0). Throws
  /// std::invalid_argument unless sigma_m is finite and > 0. O(cells + surfaces * (surface cell + 6 sigma)^2
  /// / resolution^2).
  void rebuild(const SurfaceMap<Dim>& surfaces, const Lattice<Dim>& lattice, int columns, int rows,
               double sigma_m) {
    require_positive("LikelihoodGrid", "sigma_m", sigma_m);
    columns_ = columns;
    rows_ = rows;
    values_.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * layer_count, 0);
    row_.resize(static_cast<std::size_t>(columns));
    tabulate(sigma_m);
    const double half_length_m = 0.5 * surfaces.params().cell_m;
    Box<Point<Dim>> box_m{lattice.origin_m(), lattice.origin_m()};
    box_m.upper[0] += columns * lattice.resolution_m();
    box_m.upper[1] += rows * lattice.resolution_m();
    surfaces.for_each_in(box_m.padded(half_length_m + reach_m_),
                         [&](const Surface<Dim>& surface) { draw(surface, half_length_m, lattice); });
  }

  [[nodiscard]] int columns() const { return columns_; }  ///< of each row
  /// Rows of one layer.
  [[nodiscard]] int rows() const { return rows_; }
  /// layer_count * rows() rows of columns() values.
  [[nodiscard]] const std::vector<std::uint8_t>& values() const { return values_; }

  /// The likelihood in a cell, in 1 / value_max; nothing is checked.
  [[nodiscard]] int value(int layer, int column, int row) const {
    return values_[static_cast<std::size_t>((layer * rows_ + row) * columns_ + column)];
  }

 private:
  static constexpr int table_size = 4096;

  void tabulate(double sigma_m) {
    reach_m_ = 3.0 * sigma_m;
    per_m2_ = table_size / (reach_m_ * reach_m_);
    if (sigma_m == table_sigma_m_) return;
    table_sigma_m_ = sigma_m;
    for (int i = 0; i < table_size; ++i) {
      const double squared = 9.0 * (i + 0.5) / table_size;
      table_[static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(std::lround(value_max * std::exp(-0.5 * squared)));
    }
  }

  void draw(const Surface<Dim>& surface, double half_length_m, const Lattice<Dim>& lattice) {
    std::array<bool, layer_count> seen{};
    for (int layer = 0; layer < layer_count; ++layer) {
      const double angle_rad = layer * (std::numbers::pi / 4.0);
      seen[static_cast<std::size_t>(layer)] =
          surface.faces(Point<Dim>(std::cos(angle_rad), std::sin(angle_rad)));
    }
    const double half_m = surface.planar ? half_length_m : 0.0;
    const Point<Dim> along =
        surface.planar ? Point<Dim>(-surface.normal[1], surface.normal[0]) : Point<Dim>(1.0, 0.0);
    const Point<Dim> extent_m(std::abs(along[0]) * half_m + reach_m_, std::abs(along[1]) * half_m + reach_m_);
    const Index<Dim> lower = lattice.index_of(difference(surface.mean_m, extent_m));
    const Index<Dim> upper = lattice.index_of(sum(surface.mean_m, extent_m));
    const int first = std::max(lower[0], 0);
    const int last = std::min(upper[0], columns_ - 1);
    for (int row = std::max(lower[1], 0); row <= std::min(upper[1], rows_ - 1); ++row) {
      const Point<Dim> start_m = difference(lattice.center_m(Index<Dim>(0, row)), surface.mean_m);
      for (int column = first; column <= last; ++column) {
        const double x_m = start_m[0] + column * lattice.resolution_m();
        const double along_m = along[0] * x_m + along[1] * start_m[1];
        const double across_m = along[0] * start_m[1] - along[1] * x_m;
        const double beyond_m = std::max(std::abs(along_m) - half_m, 0.0);
        const double entry = per_m2_ * (across_m * across_m + beyond_m * beyond_m);
        row_[static_cast<std::size_t>(column)] =
            entry < table_size ? table_[static_cast<std::size_t>(entry)] : std::uint8_t{0};
      }
      for (int layer = 0; layer < layer_count; ++layer) {
        if (!seen[static_cast<std::size_t>(layer)]) continue;
        std::uint8_t* values = values_.data() + static_cast<std::ptrdiff_t>(layer * rows_ + row) * columns_;
        for (int column = first; column <= last; ++column) {
          values[column] = std::max(values[column], row_[static_cast<std::size_t>(column)]);
        }
      }
    }
  }

  int columns_ = 0;
  int rows_ = 0;
  double reach_m_ = 0.0;
  double per_m2_ = 0.0;
  double table_sigma_m_ = 0.0;
  std::array<std::uint8_t, table_size> table_{};
  std::vector<std::uint8_t> row_;
  std::vector<std::uint8_t> values_;
};

}  // namespace incognita
