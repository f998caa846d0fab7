#include <catch2/catch.hpp>
#include <string>

#include "incognita/io/polygons.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

TEST_CASE("polygons: a line each, comments and Windows line ends") {
  const auto polygons = parse_polygons("# a fence\n\n0,0 4,0 4,2.5\r\n\t-1,+1  1e0,1 1,-0.5 0,0 ", "x");
  REQUIRE(polygons.size() == 2);
  CHECK(polygons[0] == Polygon{{0.0, 0.0}, {4.0, 0.0}, {4.0, 2.5}});
  CHECK(polygons[1] == Polygon{{-1.0, 1.0}, {1.0, 1.0}, {1.0, -0.5}, {0.0, 0.0}});
}

TEST_CASE("polygons: a bad corner or line is refused with its number") {
  const auto parse_refusal = [](const std::string& text) { return refusal([&] { return parse_polygons(text, "a.txt"); }); };
  for (const std::string bad : {"1", "1,", ",1", "1,2,3", "1;2", "x,1", "nan,0", "0,inf", "1e999,0"}) {
    CAPTURE(bad);
    CHECK_THAT(parse_refusal("# first\n0,0 1,0 1,1\n0,0 1,0 " + bad),
               Contains("a.txt: line 3 has the corner \"" + bad + "\"") && Contains("two finite numbers"));
  }
  CHECK_THAT(parse_refusal("0,0 1,1"), Contains("a.txt: line 1 has 2 corners") && Contains("3 or more"));
  CHECK_THAT(parse_refusal("# nothing\n"), Contains("a.txt: holds no polygons"));
  CHECK_THAT(refusal([] { return read_polygons("missing.txt"); }), Contains("no such file"));
  CHECK(io_test::refused_when_spoilt("0,0 4,0 4,2.5\n-1,1 1,1 1,-0.5 0,0\n", 3000,
                                     [](const std::string& text) { return parse_polygons(text, "x"); }) > 500);
}
