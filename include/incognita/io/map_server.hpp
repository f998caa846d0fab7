/// Maps of ROS map_server: an image and a YAML file beside it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>

#include "incognita/core/error.hpp"
#include "incognita/grid/floor_plan.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/io/atomic_file.hpp"
#include "incognita/io/image.hpp"
#include "incognita/io/image_file.hpp"
#include "incognita/io/map_metadata.hpp"
#include "incognita/io/pgm.hpp"
#include "incognita/io/png.hpp"

namespace incognita {

/// The probability that a cell is occupied, 0 to 1; NaN where the map says that it does not know.
using ProbabilityGrid = Grid<float, 2>;

/// What a ProbabilityGrid holds where the map does not know.
inline constexpr float unknown_probability = std::numeric_limits<float>::quiet_NaN();

namespace detail {

/// How light a pixel is, 0..255: the mean of its channels, as map_server takes it. In trinary mode alpha
/// counts as a channel (beside red, green and blue, also of a grey image), as it always did in ROS.
[[nodiscard]] inline double lightness(const std::uint8_t* pixel, int channels, bool count_alpha) {
  const bool grey = channels <= 2;
  const int colours = grey ? 3 * pixel[0] : pixel[0] + pixel[1] + pixel[2];
  if (channels % 2 == 1 || !count_alpha) return colours / 3.0;
  return (colours + pixel[channels - 1]) / 4.0;
}

/// What map_server makes of one pixel.
[[nodiscard]] inline float probability_of_pixel(const std::uint8_t* pixel, int channels,
                                                const MapMetadata& metadata) {
  const double light = lightness(pixel, channels, metadata.mode == MapMode::trinary);
  if (metadata.mode == MapMode::raw) {
    const double percent = std::round(light);
    return percent <= 100.0 ? static_cast<float>(percent / 100.0) : unknown_probability;
  }
  const bool transparent = channels % 2 == 0 && pixel[channels - 1] != 255;
  if (metadata.mode == MapMode::scale && transparent) return unknown_probability;
  const double occupied = (metadata.negate ? light : 255.0 - light) / 255.0;
  if (occupied > metadata.occupied_thresh) return 1.0F;
  if (occupied < metadata.free_thresh) return 0.0F;
  if (metadata.mode == MapMode::trinary) return unknown_probability;
  return static_cast<float>((occupied - metadata.free_thresh) /
                            (metadata.occupied_thresh - metadata.free_thresh));
}

}  // namespace detail

/// What the pixels of an image say, by map_server's rules. With p = (255 - lightness) / 255, or lightness /
/// 255 when negate is set:
/// - trinary: p > occupied_thresh is 1, p < free_thresh is 0, anything else unknown;
/// - scale: the same, but between the thresholds linear from 0 to 1, and unknown where the pixel is at all
/// transparent;
/// - raw: lightness 0..100 is the probability in percent, more is unknown; thresholds and negate do not
/// count. Cell (0, 0) is the lower left pixel. O(pixels).
[[nodiscard]] inline ProbabilityGrid probabilities_of(const Image& image, const MapMetadata& metadata) {
  ProbabilityGrid grid(Lattice<2>(metadata.resolution_m, metadata.origin_m),
                       {Index<2>(0, 0), Index<2>(image.width_px, image.height_px)}, unknown_probability);
  Offset offset = 0;
  for (int row = image.height_px - 1; row >= 0; --row) {
    for (int column = 0; column < image.width_px; ++column) {
      grid[offset++] = detail::probability_of_pixel(image.pixel(column, row), image.channels, metadata);
    }
  }
  return grid;
}

/// Reads a map_server map by its YAML file; the image is PNG or PGM. Throws InputError.
[[nodiscard]] inline ProbabilityGrid read_map_server(const std::filesystem::path& yaml_file) {
  const MapMetadata metadata = read_map_metadata(yaml_file);
  return probabilities_of(read_image(metadata.image), metadata);
}

/// From which probability on a cell is a wall or floor.
struct FloorThresholds {
  double wall_above = 0.65;    ///< a probability of occupancy
  double floor_below = 0.196;  ///< a probability likewise
};

/// A map as a floor plan: a wall above one probability, floor below another, solid between them and where the
/// map does not know. A map read in trinary mode holds 0, 1 and unknown alone, so that the thresholds do not
/// matter.
[[nodiscard]] inline FloorPlan floor_plan_of(const ProbabilityGrid& map,
                                             const FloorThresholds& thresholds = {}) {
  FloorPlan plan(map.lattice(), map.box(), FloorCell::solid);
  std::transform(map.values().begin(), map.values().end(), plan.values().begin(), [&](float probability) {
    if (static_cast<double>(probability) > thresholds.wall_above) return FloorCell::wall;
    return static_cast<double>(probability) < thresholds.floor_below ? FloorCell::floor : FloorCell::solid;
  });
  return plan;
}

/// The image of a map_server map.
enum class MapImage {
  png,  ///< with alpha where it is needed
  pgm   ///< grey, for readers that know no other
};

/// Writes a grid as `yaml_file` and an image of the same name beside it, so that map_server and
/// read_map_server give it back: in trinary mode 1 above a probability of 0.65, 0 below 0.196, unknown
/// between; in scale mode the probability to 1/510; in raw mode to 1/200. `probability_of(value)` gives the
/// probability of a cell, NaN where it is unknown. Unknown cells in scale mode need an alpha channel, hence
/// PNG. The image is complete before the YAML file appears, and each replaces an older one only when
/// complete. Throws InputError when a file cannot be written and std::invalid_argument for a grid without
/// cells, with a probability outside of 0..1, or with unknown cells in scale mode as PGM.
template <class Value, class ProbabilityOf>
void write_map_server(const std::filesystem::path& yaml_file, const Grid<Value, 2>& grid,
                      ProbabilityOf&& probability_of, MapMode mode = MapMode::trinary,
                      MapImage format = MapImage::png) {
  require(!grid.box().empty(), "write_map_server", "the number of cells", 0.0, ">= 1");
  const Index<2> extent = grid.box().extent();
  require_image_size(yaml_file, extent.x(), extent.y());

  MapMetadata metadata;
  metadata.image =
      std::filesystem::path(yaml_file).replace_extension(format == MapImage::png ? ".png" : ".pgm");
  metadata.resolution_m = grid.resolution_m();
  metadata.origin_m =
      grid.lattice().origin_m() + grid.box().lower.template cast<double>() * grid.resolution_m();
  metadata.mode = mode;
  if (mode == MapMode::scale) {
    metadata.occupied_thresh = 1.0;
    metadata.free_thresh = 0.0;
  }

  const int channels = mode == MapMode::scale && format == MapImage::png ? 2 : 1;
  Image image{extent.x(), extent.y(), channels, {}};
  image.values.reserve(grid.size() * static_cast<std::size_t>(channels));
  for (int row = 0; row < extent.y(); ++row) {
    Offset offset = Offset{extent.y() - 1 - row} * extent.x();
    for (int column = 0; column < extent.x(); ++column, ++offset) {
      const auto p = static_cast<double>(probability_of(grid[offset]));
      const bool unknown = std::isnan(p);
      require(unknown || (p >= 0.0 && p <= 1.0), "write_map_server", "a probability", p, "in 0..1, or NaN where it is unknown");
      double grey = 0.0;
      if (mode == MapMode::trinary) {
        grey = p > metadata.occupied_thresh ? 0.0 : p < metadata.free_thresh ? 254.0 : 205.0;
      } else if (mode == MapMode::raw) {
        grey = unknown ? 255.0 : 100.0 * p;
      } else {
        if (unknown && channels == 1) {
          throw_invalid("write_map_server", "the format", "PGM", "PNG for unknown cells in scale mode");
        }
        grey = unknown ? 0.0 : 255.0 * (1.0 - p);
      }
      image.values.push_back(static_cast<std::uint8_t>(std::lround(grey)));
      if (channels == 2) image.values.push_back(unknown ? 0 : 255);
    }
  }

  format == MapImage::png ? write_png(metadata.image, image) : write_pgm(metadata.image, image);
  write_file_atomically(yaml_file, map_metadata_text(metadata));
}

/// Writes a grid of probabilities; see above.
inline void write_map_server(const std::filesystem::path& yaml_file, const ProbabilityGrid& grid,
                             MapMode mode = MapMode::trinary, MapImage format = MapImage::png) {
  write_map_server(
      yaml_file, grid, [](float probability) { return probability; }, mode, format);
}

}  // namespace incognita
