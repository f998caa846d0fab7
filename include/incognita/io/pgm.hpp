/// PGM images: P5 (binary) and P2 (plain), the grey images of the netpbm family.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/io/atomic_file.hpp"
#include "incognita/io/image.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/read_file.hpp"

namespace incognita {

namespace detail {

/// Walks through the numbers of a PGM file, comments skipped.
class PgmReader {
 public:
  PgmReader(std::string_view unread, const std::filesystem::path& file) : unread_(unread), file_(file) {}

  /// The next number, at most `value_max`; `what` names it in errors.
  [[nodiscard]] int number(const char* what, int value_max) {
    skip_space_and_comments();
    if (unread_.empty())
      throw InputError(file_, std::string("not a valid PGM: the file ends before ") + what);
    const auto fail = [&](const std::string& bound) {
      const std::size_t length = std::min(unread_.find_first_of(" \t\n\v\f\r#"), unread_.size());
      throw InputError(file_, std::string("not a valid PGM: ") + what + " is " + shown(unread_.substr(0, length)) + ", but must be " + bound);
    };
    std::int64_t value = 0;
    std::size_t digits = 0;
    for (; digits < unread_.size() && unread_[digits] >= '0' && unread_[digits] <= '9'; ++digits) {
      value = value * 10 + (unread_[digits] - '0');
      if (value > value_max) fail("at most " + std::to_string(value_max));
    }
    if (digits == 0 || (digits < unread_.size() && !is_space(unread_[digits]) && unread_[digits] != '#')) fail("a whole number");
    unread_.remove_prefix(digits);
    return static_cast<int>(value);
  }

  /// What follows the one white-space character that ends the header.
  [[nodiscard]] std::string_view after_header() const {
    if (unread_.empty() || !is_space(unread_[0])) {
      throw InputError(file_, "not a valid PGM: white space must follow the largest grey value, not " + shown(unread_.substr(0, 1)));
    }
    return unread_.substr(1);
  }

 private:
  static bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

  void skip_space_and_comments() {
    while (!unread_.empty() && (is_space(unread_[0]) || unread_[0] == '#')) {
      const std::size_t length = unread_[0] == '#' ? unread_.find_first_of("\n\r") : 1;
      unread_.remove_prefix(length == std::string_view::npos ? unread_.size() : length);
    }
  }

  std::string_view unread_;
  const std::filesystem::path& file_;
};

/// `value` of 0..value_max as 0..255, rounded; a greater one is an error.
[[nodiscard]] inline std::uint8_t grey_of(int value, int value_max, const std::filesystem::path& file) {
  if (value > value_max) {
    throw InputError(file, "not a valid PGM: a pixel is " + std::to_string(value) + ", but must be at most " +
                               std::to_string(value_max));
  }
  return static_cast<std::uint8_t>((value * 255 + value_max / 2) / value_max);
}

}  // namespace detail

/// Whether a file that starts with `content` is a PGM.
[[nodiscard]] inline bool is_pgm(std::string_view content) {
  return content.starts_with("P2") || content.starts_with("P5");
}

/// The grey image that `content`, a whole PGM file, holds; the first one if there are several. Comments may
/// stand anywhere in the header (and between the numbers of P2); grey values of up to 65535 are scaled to
/// 255. `file` is only named in errors. Throws InputError when it is malformed, truncated or too large
/// (before memory is asked for).
[[nodiscard]] inline Image decode_pgm(std::string_view content, const std::filesystem::path& file) {
  if (!is_pgm(content)) throw InputError(file, "not a valid PGM: it starts with " + shown(content.substr(0, 2)) + ", but must start with P2 or P5");
  detail::PgmReader reader(content.substr(2), file);
  constexpr int any = std::numeric_limits<int>::max();
  const int width_px = reader.number("the width", any);
  const int height_px = reader.number("the height", any);
  require_image_size(file, width_px, height_px);
  const int value_max = reader.number("the largest grey value", 65535);
  if (value_max == 0)
    throw InputError(file, "not a valid PGM: the largest grey value is 0, but must be 1 to 65535");

  const bool binary = content[1] == '5';
  const std::string_view raster = reader.after_header();
  const std::size_t value_bytes = value_max > 255 ? 2 : 1;
  const std::size_t count = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  // A plain pixel takes a digit and, between two, a space.
  const std::size_t needed_bytes = binary ? count * value_bytes : 2 * count - 1;
  if (raster.size() < needed_bytes) {
    throw InputError(file, "not a valid PGM: " + std::to_string(width_px) + " x " +
                               std::to_string(height_px) + " pixels need at least " +
                               std::to_string(needed_bytes) + " bytes, but " + std::to_string(raster.size()) +
                               " follow the header");
  }

  Image image{width_px, height_px, 1, std::vector<std::uint8_t>(count)};
  const auto byte = [raster](std::size_t i) { return int{static_cast<unsigned char>(raster[i])}; };
  for (std::size_t i = 0; i < count; ++i) {
    int value = 0;
    if (!binary) {
      value = reader.number("a pixel", 65535);
    } else {
      value = value_bytes == 1 ? byte(i) : byte(2 * i) * 256 + byte(2 * i + 1);
    }
    image.values[i] = detail::grey_of(value, value_max, file);
  }
  return image;
}

/// The bytes of a P5 file with this image, which must be grey (one channel). `file` is only named in errors.
/// Throws InputError for another number of channels and for sizes that require_image_size refuses.
[[nodiscard]] inline std::string encode_pgm(const Image& image, const std::filesystem::path& file) {
  require_image_size(file, image.width_px, image.height_px);
  if (image.channels != 1) {
    throw InputError(file, "cannot be written as PGM: the image has " + std::to_string(image.channels) +
                               " channels, but must have 1");
  }
  std::string content =
      "P5\n" + std::to_string(image.width_px) + ' ' + std::to_string(image.height_px) + "\n255\n";
  content.append(image.values.begin(), image.values.end());
  return content;
}

/// Reads a PGM file; see decode_pgm. Throws InputError.
[[nodiscard]] inline Image read_pgm(const std::filesystem::path& file) {
  return decode_pgm(read_file(file, image_file_size_max_bytes), file);
}

/// Writes a P5 file, which replaces one that is there only when complete. Throws InputError.
inline void write_pgm(const std::filesystem::path& file, const Image& image) {
  write_file_atomically(file, encode_pgm(image, file));
}

}  // namespace incognita
