#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/io/pgm.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

using Values = std::vector<std::uint8_t>;

Values values_of(const std::string& content) { return decode_pgm(content, "x").values; }

std::string pgm_refusal(const std::string& content) {
  return refusal([&] { return decode_pgm(content, "x.pgm"); });
}

}  // namespace

TEST_CASE("PGM: every value comes back as it was") {
  const io_test::TemporaryFolder folder;
  Random random(1);
  Image image{37, 23, 1, {}};
  for (int i = 0; i < 37 * 23; ++i) image.values.push_back(static_cast<std::uint8_t>(random.index(256)));
  write_pgm(folder / "image.pgm", image);
  const Image back = read_pgm(folder / "image.pgm");
  CHECK(back.width_px == 37);
  CHECK(back.height_px == 23);
  CHECK(back.channels == 1);
  CHECK(back.values == image.values);
}

TEST_CASE("PGM: plain and binary, with comments anywhere in the header") {
  CHECK(values_of("P2 3 1 255 0 205 254") == Values{0, 205, 254});
  CHECK(values_of("P2\n# one\n3 # two\n#three\n\n1\n#\n255\n#four\n0\n205 # five\n254\n") ==
        Values{0, 205, 254});
  CHECK(values_of("P5 3 1 255 abc") == Values{'a', 'b', 'c'});
  CHECK(values_of("P5# CREATOR: x 0.05 m/pix\r\n3 1\r\n# 7 7\r\n255\nabc") == Values{'a', 'b', 'c'});
  CHECK(values_of("P5 3#\n1 255\n#\n ") == Values{'#', '\n', ' '});  // the raster may start with anything
  const Image image = decode_pgm("P2 2 3 255 1 2 3 4 5 6", "x");
  CHECK(image.width_px == 2);
  CHECK(*image.pixel(1, 2) == 6);
}

TEST_CASE("PGM: grey values are scaled to 255") {
  CHECK(values_of("P2 3 1 1 0 1 1") == Values{0, 255, 255});
  CHECK(values_of("P2 3 1 100 0 50 100") == Values{0, 128, 255});
  CHECK(values_of("P2 3 1 65535 0 32768 65535") == Values{0, 128, 255});
  CHECK(values_of(std::string("P5 2 1 65535 \xCD\xCD\x01\x00", 17)) == Values{205, 1});
  CHECK(values_of(std::string("P5 2 1 256 \x01\x00\x00\x80", 15)) == Values{255, 128});
}

TEST_CASE("PGM: a file cut off anywhere is refused") {
  const std::string binary = "P5\n# a comment\n4 3\n255\nabcdefghijkl";
  for (std::size_t size = 0; size < binary.size(); ++size) {
    CAPTURE(size);
    CHECK_THAT(pgm_refusal(binary.substr(0, size)), Contains("x.pgm: not a valid PGM"));
  }
  const std::string wide = std::string("P5 2 2 65535 \1\2\3\4\5\6\7\x8", 21);
  for (std::size_t size = 0; size < wide.size(); ++size)
    CHECK_FALSE(pgm_refusal(wide.substr(0, size)).empty());
  // Of a plain file the last number may be cut without a trace: the format has no end mark.
  const std::string plain = "P2\n4 3\n255\n1 2 3 4 5 6 7 8 9 10 11 12\n";
  for (std::size_t size = 0; size + 2 < plain.size(); ++size) {
    CAPTURE(size);
    CHECK_FALSE(pgm_refusal(plain.substr(0, size)).empty());
  }
}

TEST_CASE("PGM: spoilt files are read or refused") {
  const auto read = [](const std::string& content) { return decode_pgm(content, "x"); };
  CHECK(io_test::refused_when_spoilt("P5\n# a comment\n4 3\n255\nabcdefghijkl", 5000, read) > 1000);
  CHECK(io_test::refused_when_spoilt("P2\n4 3\n255\n1 2 3 4 5 6 7 8 9 10 11 12\n", 5000, read) > 1000);
}

TEST_CASE("PGM: bad headers and values are refused with their cause") {
  CHECK_THAT(pgm_refusal("P5 65536 65536 255\n"), Contains("65536 x 65536 pixels"));
  CHECK_THAT(pgm_refusal("P5 8192 8192 255\nabc"), Contains("need at least 67108864 bytes, but 3 follow"));
  CHECK_THAT(pgm_refusal("P2 8192 8192 255\n1 2"), Contains("need at least"));
  CHECK_THAT(pgm_refusal("P5 99999999999999999999 1 255\nx"), Contains("the width is \"99999999999999999999\", but must be at most"));
  CHECK_THAT(pgm_refusal("P5 0 1 255\nx"), Contains("0 x 1 pixels"));
  CHECK_THAT(pgm_refusal("P5 -1 1 255\nx"), Contains("the width is \"-1\", but must be a whole number"));
  CHECK_THAT(pgm_refusal("P5 1 1.5 255\nx"), Contains("the height is \"1.5\", but must be a whole number"));
  CHECK_THAT(pgm_refusal("P5 1 1 0\nx"), Contains("the largest grey value is 0"));
  CHECK_THAT(pgm_refusal("P5 1 1 65536\nx"), Contains("the largest grey value is \"65536\", but must be at most 65535"));
  CHECK_THAT(pgm_refusal("P5 1 1 255#c\nx"), Contains("white space must follow the largest grey value, not \"#\""));
  CHECK_THAT(pgm_refusal("P5 1 1 99\nx"), Contains("a pixel is 120, but must be at most 99"));
  CHECK_THAT(pgm_refusal("P2 1 1 99 100"), Contains("a pixel is 100, but must be at most 99"));
  CHECK_THAT(pgm_refusal("P2 2 1 99 1 x"), Contains("a pixel is \"x\", but must be a whole number"));
  CHECK_THAT(pgm_refusal("P6 1 1 255\nxyz"), Contains("it starts with \"P6\", but must start with P2 or P5"));
  CHECK_THAT(pgm_refusal(""), Contains("must start with P2 or P5"));
  CHECK_THAT(refusal([] { return encode_pgm(Image{1, 1, 2, {1, 2}}, "x"); }), Contains("has 2 channels"));
}
