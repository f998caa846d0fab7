/// Images in memory, as the image files hold them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "incognita/io/input_error.hpp"

namespace incognita {

/// No image is wider or higher than this, nor has it more pixels: a hostile file must not ask for all of the
/// memory.
inline constexpr int image_side_max_px = 1 << 16;
/// The most pixels.
inline constexpr std::int64_t image_area_max_px = std::int64_t{1} << 26;
/// No image file is larger than this: 16 bits for each pixel of the largest image.
inline constexpr std::size_t image_file_size_max_bytes = std::size_t{1} << 28;

/// 8 bits per channel, row 0 at the top, channels of a pixel side by side: 1 is grey, 2 grey and alpha, 3
/// red, green and blue, 4 those and alpha.
struct Image {
  int width_px = 0;                  ///< columns
  int height_px = 0;                 ///< rows
  int channels = 1;                  ///< 1 to 4
  std::vector<std::uint8_t> values;  ///< height_px * width_px * channels

  /// The first channel of a pixel; nothing is checked.
  [[nodiscard]] const std::uint8_t* pixel(int column, int row) const {
    return values.data() + (static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px) +
                            static_cast<std::size_t>(column)) *
                               static_cast<std::size_t>(channels);
  }
};

/// Throws InputError unless an image of this size is allowed. Call it before allocating one.
inline void require_image_size(const std::filesystem::path& file, std::int64_t width_px,
                               std::int64_t height_px) {
  if (width_px >= 1 && width_px <= image_side_max_px && height_px >= 1 && height_px <= image_side_max_px &&
      width_px * height_px <= image_area_max_px) {
    return;
  }
  throw InputError(file, "the image has " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                             " pixels, but must have 1 to " + std::to_string(image_side_max_px) +
                             " a side and at most " + std::to_string(image_area_max_px) + " in all");
}

}  // namespace incognita
