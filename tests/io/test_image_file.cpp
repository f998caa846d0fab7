#include <catch2/catch.hpp>
#include <string>

#include "incognita/io/image_file.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;

TEST_CASE("read_image goes by what a file holds, not by its name") {
  const io_test::TemporaryFolder folder;
  const Image image{2, 1, 1, {7, 8}};
  CHECK(read_image(folder.with("a.pgm", encode_png(image, "x"))).values == image.values);
  CHECK(read_image(folder.with("b.png", encode_pgm(image, "x"))).values == image.values);
  CHECK(read_image(folder.with("c", "P2 2 1 255 7 8")).values == image.values);
}

TEST_CASE("read_image refuses other files") {
  const io_test::TemporaryFolder folder;
  for (const char* content : {"", "P", "P4 1 1 x", "GIF89a", "\x89PN"}) {
    const auto file = folder.with("image", content);
    CHECK_THAT(io_test::refusal([&] { return read_image(file); }), Contains("neither a PNG nor a PGM"));
  }
}
