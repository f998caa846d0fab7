#include <png.h>

#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/io/png.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

/// What a file can hold beside what encode_png writes.
struct PngFeatures {
  int color_type = PNG_COLOR_TYPE_GRAY;
  int bit_depth = 8;
  bool interlaced = false;
  double gamma = 0.0;                   ///< none when 0
  std::vector<png_color> palette = {};  ///< of a palette image
  std::vector<std::uint8_t> palette_alpha = {};
  int transparent_grey = -1;  ///< none when -1
};

std::string file_with(const PngFeatures& features, int width_px, int height_px,
                      const std::vector<std::vector<std::uint8_t>>& rows) {
  std::string content;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  const auto append = [](png_structp to, png_bytep data, std::size_t size) {
    static_cast<std::string*>(png_get_io_ptr(to))->append(data, data + size);
  };
  png_set_write_fn(png, &content, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width_px), static_cast<png_uint_32>(height_px),
               features.bit_depth, features.color_type,
               features.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  if (features.gamma > 0.0) png_set_gAMA(png, info, features.gamma);
  if (!features.palette.empty()) {
    png_set_PLTE(png, info, features.palette.data(), static_cast<int>(features.palette.size()));
  }
  if (!features.palette_alpha.empty()) {
    png_set_tRNS(png, info, features.palette_alpha.data(), static_cast<int>(features.palette_alpha.size()),
                 nullptr);
  }
  if (features.transparent_grey >= 0) {
    png_color_16 grey{};
    grey.gray = static_cast<png_uint_16>(features.transparent_grey);
    png_set_tRNS(png, info, nullptr, 0, &grey);
  }
  std::vector<std::vector<std::uint8_t>> copies = rows;
  std::vector<png_bytep> pointers;
  for (auto& row : copies) pointers.push_back(row.data());
  png_set_rows(png, info, pointers.data());
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  png_destroy_write_struct(&png, &info);
  return content;
}

std::uint32_t crc_of(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (unsigned shift = 32; shift > 0; shift -= 8) bytes += static_cast<char>(value >> (shift - 8) & 0xFFU);
  return bytes;
}

/// The same file with another size in its header, and a check sum that fits.
std::string declaring(std::string content, std::uint32_t width_px, std::uint32_t height_px) {
  content.replace(16, 8, big_endian(width_px) + big_endian(height_px));
  return content.replace(29, 4, big_endian(crc_of(content.substr(12, 17))));
}

Image random_image(int width_px, int height_px, int channels, std::uint64_t seed) {
  Random random(seed);
  Image image{width_px, height_px, channels, {}};
  for (int i = 0; i < width_px * height_px * channels; ++i) {
    image.values.push_back(static_cast<std::uint8_t>(random.index(256)));
  }
  return image;
}

}  // namespace

TEST_CASE("PNG: every value of every channel comes back as it was") {
  const io_test::TemporaryFolder folder;
  for (int channels = 1; channels <= 4; ++channels) {
    const Image image = random_image(37, 23, channels, static_cast<std::uint64_t>(channels));
    write_png(folder / "image.png", image);
    const Image back = read_png(folder / "image.png");
    CHECK(back.width_px == 37);
    CHECK(back.height_px == 23);
    CHECK(back.channels == channels);
    CHECK(back.values == image.values);
  }
  CHECK(folder.names().size() == 1);
}

TEST_CASE("PNG: depths, interlacing, palettes and transparency become 8 bits per channel") {
  // 1, 2 and 4 bits spread over 0..255.
  CHECK(decode_png(file_with({.bit_depth = 1}, 3, 1, {{0b01000000}}), "x").values ==
        std::vector<std::uint8_t>{0, 255, 0});
  CHECK(decode_png(file_with({.bit_depth = 2}, 4, 1, {{0b00011011}}), "x").values ==
        std::vector<std::uint8_t>{0, 85, 170, 255});
  CHECK(decode_png(file_with({.bit_depth = 4}, 2, 1, {{0x3F}}), "x").values ==
        std::vector<std::uint8_t>{51, 255});
  // 16 bits round to 8.
  CHECK(decode_png(file_with({.bit_depth = 16}, 2, 1, {{205, 205, 0, 200}}), "x").values ==
        std::vector<std::uint8_t>{205, 1});

  const Image image = random_image(13, 11, 1, 5);
  std::vector<std::vector<std::uint8_t>> rows;
  for (int row = 0; row < 11; ++row) rows.emplace_back(image.pixel(0, row), image.pixel(0, row) + 13);
  CHECK(decode_png(file_with({.interlaced = true}, 13, 11, rows), "x").values == image.values);
  // A gamma of 1 would change every grey value if it were applied.
  CHECK(decode_png(file_with({.gamma = 1.0}, 13, 11, rows), "x").values == image.values);

  PngFeatures palette{.color_type = PNG_COLOR_TYPE_PALETTE, .palette = {{1, 2, 3}, {254, 254, 254}}};
  const Image colours = decode_png(file_with(palette, 2, 1, {{1, 0}}), "x");
  CHECK(colours.channels == 3);
  CHECK(colours.values == std::vector<std::uint8_t>{254, 254, 254, 1, 2, 3});
  palette.palette_alpha = {7};
  CHECK(decode_png(file_with(palette, 2, 1, {{1, 0}}), "x").values ==
        std::vector<std::uint8_t>{254, 254, 254, 255, 1, 2, 3, 7});
  const Image holes = decode_png(file_with({.transparent_grey = 9}, 2, 1, {{9, 8}}), "x");
  CHECK(holes.channels == 2);
  CHECK(holes.values == std::vector<std::uint8_t>{9, 0, 8, 255});
}

TEST_CASE("PNG: a file cut off anywhere is refused") {
  const std::string good = encode_png(random_image(20, 20, 1, 3), "x");
  for (std::size_t size = 0; size < good.size(); ++size) {
    CAPTURE(size);
    CHECK_THAT(refusal([&] { return decode_png(good.substr(0, size), "cut.png"); }),
               Contains("cut.png: not a valid PNG"));
  }
  CHECK(refusal([&] { return decode_png(good + "more", "x"); }).empty());
}

TEST_CASE("PNG: spoilt files are read or refused") {
  const auto read = [](const std::string& content) { return decode_png(content, "x"); };
  PngFeatures palette{
      .color_type = PNG_COLOR_TYPE_PALETTE, .interlaced = true, .palette = {{1, 2, 3}, {4, 5, 6}}};
  palette.palette_alpha = {7};
  const std::vector<std::vector<std::uint8_t>> rows(9, std::vector<std::uint8_t>(9, 1));
  CHECK(io_test::refused_when_spoilt(encode_png(random_image(9, 9, 4, 3), "x"), 3000, read) > 2000);
  CHECK(io_test::refused_when_spoilt(file_with(palette, 9, 9, rows), 3000, read) > 2000);
}

TEST_CASE(
    "PNG: a size that is too large, or that the file cannot hold, is refused before memory is asked for") {
  const std::string good = encode_png(random_image(4, 4, 1, 3), "x");
  const auto decode = [&](std::uint32_t width_px, std::uint32_t height_px) {
    return refusal([&] { return decode_png(declaring(good, width_px, height_px), "big.png"); });
  };
  CHECK(decode(4, 4).empty());
  CHECK_THAT(decode(65536, 65536), Contains("65536 x 65536 pixels") && Contains("at most 67108864 in all"));
  CHECK_THAT(decode(65537, 1), Contains("not a valid PNG"));
  CHECK_THAT(decode(0x7FFFFFFF, 0x7FFFFFFF), Contains("not a valid PNG"));
  CHECK_THAT(decode(0, 4), Contains("not a valid PNG"));
  CHECK_THAT(decode(8192, 8192), Contains("cannot hold 8192 x 8192 pixels"));
}

TEST_CASE("PNG: what is no PNG, and images that cannot be written") {
  CHECK_THAT(refusal([] { return decode_png("P5\n1 1\n255\nx", "x"); }), Contains("not a valid PNG"));
  CHECK_THAT(refusal([] { return decode_png("", "x"); }), Contains("not a valid PNG"));
  CHECK_THAT(refusal([] { return read_png("missing.png"); }), Contains("no such file"));
  CHECK_THAT(refusal([] { return encode_png(Image{}, "x"); }), Contains("0 x 0 pixels"));
  CHECK(is_png(encode_png(random_image(1, 1, 1, 1), "x")));
  CHECK_FALSE(is_png("PNG"));
}
