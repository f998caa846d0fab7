#include <catch2/catch.hpp>
#include <cstdint>

#include "incognita/io/image.hpp"
#include "support.hpp"

using namespace incognita;

namespace {

bool is_allowed(std::int64_t width_px, std::int64_t height_px) {
  return io_test::refusal([&] {
           require_image_size("x.png", width_px, height_px);
           return 0;
         })
      .empty();
}

}  // namespace

TEST_CASE("pixels lie row by row, channels side by side") {
  const Image image{2, 2, 3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
  CHECK(*image.pixel(0, 0) == 0);
  CHECK(*image.pixel(1, 0) == 3);
  CHECK(*image.pixel(0, 1) == 6);
  CHECK(image.pixel(1, 1)[2] == 11);
}

TEST_CASE("image sizes have bounds") {
  CHECK(is_allowed(1, 1));
  CHECK(is_allowed(65536, 1024));
  CHECK_FALSE(is_allowed(65536, 1025));
  CHECK_FALSE(is_allowed(65537, 1));
  CHECK_FALSE(is_allowed(1, 65537));
  CHECK_FALSE(is_allowed(0, 1));
  CHECK_FALSE(is_allowed(1, 0));
  CHECK_FALSE(is_allowed(-1, -1));
  CHECK_FALSE(is_allowed(std::int64_t{1} << 40, std::int64_t{1} << 40));
}
