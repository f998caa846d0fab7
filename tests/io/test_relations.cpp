#include <catch2/catch.hpp>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "incognita/io/relations.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

std::string parse_refusal(const std::string& text) {
  return refusal([&] { return parse_relations(text, "a.txt"); });
}

}  // namespace

TEST_CASE("relations: lines, comments and Windows line ends") {
  const auto relations = parse_relations("# t1 t2 ...\n\n1.5 2.5 3 -4 9 8 7 0.5\r\n\t2 1 0 0 0 0 0 +4", "x");
  REQUIRE(relations.size() == 2);
  CHECK(relations[0].from_s == 1.5);
  CHECK(relations[0].to_s == 2.5);
  CHECK(relations[0].T_from_to.x_m == 3.0);
  CHECK(relations[0].T_from_to.y_m == -4.0);
  CHECK(relations[0].T_from_to.yaw_rad == 0.5);
  CHECK(relations[1].T_from_to.yaw_rad == Approx(4.0 - 2.0 * std::numbers::pi));
}

TEST_CASE("relations: a bad line is refused with its number") {
  for (const std::string bad :
       {"1 2 3 4 5", "1 2 3 4 5 6 7 8 9", "1 2 3 x 5 6 7 8", "1 2 3 4 5 6 7 nan", "inf 2 3 4 5 6 7 8"}) {
    CAPTURE(bad);
    CHECK_THAT(parse_refusal("# first\n1 2 0 0 0 0 0 0\n" + bad),
               Contains("a.txt: line 3 is \"" + bad + "\"") && Contains("eight finite numbers"));
  }
  CHECK_THAT(parse_refusal(""), Contains("a.txt: holds no relations"));
  CHECK_THAT(refusal([] { return read_relations("missing.txt"); }), Contains("no such file"));
  const std::string good = "1.5 2.5 3 -4 9 8 7 0.5\n2 1 0 0 0 0 0 4\n";
  CHECK(io_test::refused_when_spoilt(
            good, 3000, [](const std::string& text) { return parse_relations(text, "x"); }) > 500);
}

TEST_CASE("relations: those of the Intel Research Lab") {
  const std::filesystem::path file = std::filesystem::path(INCOGNITA_DATA_DIR) / "intel" / "relations.txt";
  if (!std::filesystem::exists(file)) {
    WARN("skipped: " << file << " is not there");
    return;
  }
  CHECK(read_relations(file).size() == 2984);
}
