/// PNG images, by libpng.
#pragma once

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

#include "incognita/io/atomic_file.hpp"
#include "incognita/io/image.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/read_file.hpp"

namespace incognita {

namespace detail {

/// libpng reports an error by a jump that runs no destructors. So the functions that call it are noexcept,
/// own nothing and return false after an error; the owner of this state throws.
class PngReader {
 public:
  explicit PngReader(std::string_view file) : unread_(file) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &on_error, &on_warning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  /// What went wrong, after a function has returned false.
  [[nodiscard]] const char* message() const { return message_.data(); }
  [[nodiscard]] std::int64_t width_px() const { return png_get_image_width(png_, info_); }
  [[nodiscard]] std::int64_t height_px() const { return png_get_image_height(png_, info_); }
  [[nodiscard]] int channels() const { return png_get_channels(png_, info_); }
  /// Bits of a row in the file, before they are made 8 bits per channel.
  [[nodiscard]] std::int64_t bits_per_pixel() const { return bits_per_pixel_; }

  /// Reads up to the pixels and asks for 8 bits per channel, colours as they are: no gamma, no palette.
  [[nodiscard]] bool read_header() noexcept {
    if (info_ == nullptr) return false;
    if (setjmp(jump_) != 0) return false;
    png_set_read_fn(png_, this, &on_read);
    png_set_user_limits(png_, image_side_max_px, image_side_max_px);
    png_read_info(png_, info_);
    bits_per_pixel_ = std::int64_t{png_get_channels(png_, info_)} * png_get_bit_depth(png_, info_);
    png_set_expand(png_);
    png_set_scale_16(png_);
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  /// Reads the pixels and all that follows them.
  [[nodiscard]] bool read_pixels(std::uint8_t* pixels, std::size_t row_bytes, int height) noexcept {
    if (setjmp(jump_) != 0) return false;
    for (int pass = 0; pass < passes_; ++pass) {
      for (int row = 0; row < height; ++row) {
        png_read_row(png_, pixels + static_cast<std::size_t>(row) * row_bytes, nullptr);
      }
    }
    png_read_end(png_, nullptr);
    return true;
  }

 private:
  [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
    auto* reader = static_cast<PngReader*>(png_get_error_ptr(png));
    std::strncpy(reader->message_.data(), message, reader->message_.size() - 1);
    std::longjmp(reader->jump_, 1);
  }

  static void on_warning(png_structp, png_const_charp) {}

  static void on_read(png_structp png, png_bytep to, std::size_t size) {
    auto* reader = static_cast<PngReader*>(png_get_io_ptr(png));
    if (size > reader->unread_.size()) png_error(png, "the file ends too early");
    std::memcpy(to, reader->unread_.data(), size);
    reader->unread_.remove_prefix(size);
  }

  std::string_view unread_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::int64_t bits_per_pixel_ = 0;
  int passes_ = 1;
  std::array<char, 200> message_{"libpng cannot be started"};
  std::jmp_buf jump_;
};

}  // namespace detail

/// Whether a file that starts with `content` is a PNG.
[[nodiscard]] inline bool is_png(std::string_view content) {
  return content.starts_with("\x89PNG\r\n\x1a\n");
}

/// The image that `content`, a whole PNG file, holds. Any colour type, depth and interlacing; palettes and
/// transparent colours become channels, 16 bits become 8, gamma and colour profiles are ignored. `file` is
/// only named in errors. Throws InputError when it is malformed, truncated or too large (before memory is
/// asked for).
[[nodiscard]] inline Image decode_png(std::string_view content, const std::filesystem::path& file) {
  detail::PngReader reader(content);
  const auto fail = [&] { throw InputError(file, std::string("not a valid PNG: ") + reader.message()); };
  if (!reader.read_header()) fail();
  require_image_size(file, reader.width_px(), reader.height_px());
  // Deflate packs 1032 bytes into one at best: a short file that declares a large image is refused at once.
  const std::int64_t packed_bytes =
      reader.width_px() * reader.height_px() * reader.bits_per_pixel() / 8 / 1032;
  if (packed_bytes > static_cast<std::int64_t>(content.size())) {
    throw InputError(file, "not a valid PNG: " + std::to_string(content.size()) + " bytes cannot hold " +
                               std::to_string(reader.width_px()) + " x " +
                               std::to_string(reader.height_px()) + " pixels");
  }
  Image image{
      static_cast<int>(reader.width_px()), static_cast<int>(reader.height_px()), reader.channels(), {}};
  const std::size_t row_bytes =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.channels);
  image.values.resize(row_bytes * static_cast<std::size_t>(image.height_px));
  if (!reader.read_pixels(image.values.data(), row_bytes, image.height_px)) fail();
  return image;
}

/// The bytes of a PNG file with this image, values unchanged. `file` is only named in errors. Throws
/// InputError.
[[nodiscard]] inline std::string encode_png(const Image& image, const std::filesystem::path& file) {
  require_image_size(file, image.width_px, image.height_px);
  constexpr std::array<png_uint_32, 4> formats{PNG_FORMAT_GRAY, PNG_FORMAT_GA, PNG_FORMAT_RGB,
                                               PNG_FORMAT_RGBA};
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width_px);
  png.height = static_cast<png_uint_32>(image.height_px);
  png.format = formats.at(static_cast<std::size_t>(image.channels - 1));
  std::string content(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
  png_alloc_size_t size = content.size();
  if (png_image_write_to_memory(&png, content.data(), &size, 0, image.values.data(), 0, nullptr) == 0) {
    throw InputError(file, std::string("cannot be written as PNG: ") + png.message);
  }
  content.resize(size);
  return content;
}

/// Reads a PNG file; see decode_png. Throws InputError.
[[nodiscard]] inline Image read_png(const std::filesystem::path& file) {
  return decode_png(read_file(file, image_file_size_max_bytes), file);
}

/// Writes a PNG file, which replaces one that is there only when complete. Throws InputError.
inline void write_png(const std::filesystem::path& file, const Image& image) {
  write_file_atomically(file, encode_png(image, file));
}

}  // namespace incognita
