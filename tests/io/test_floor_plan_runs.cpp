#include <catch2/catch.hpp>
#include <string>

#include "../simulation/plans.hpp"
#include "incognita/io/floor_plan_runs.hpp"
#include "recordings.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

FloorPlan taken(const std::string& bytes) {
  ByteReader reader(bytes, "file");
  FloorPlan plan = take_floor_plan(reader);
  reader.require_end();
  return plan;
}

/// A plan's bytes with others from where the box begins.
std::string with_box(const std::string& box_and_runs) {
  ByteWriter bytes;
  for (const double value : {0.1, 0.0, 0.0}) bytes.number(value);
  return bytes.bytes() + box_and_runs;
}

std::string runs_refusal(const std::string& bytes) {
  return refusal([&] { return taken(bytes); });
}

}  // namespace

TEST_CASE("a floor plan is runs of equal cells, a byte each") {
  FloorPlan plan(Lattice<2>(0.5, {1.0, -2.0}), {{-3, 2}, {67, 4}}, FloorCell::wall);  // 70 x 2
  plan.set({66, 2}, FloorCell::floor);
  plan.set({66, 3}, FloorCell::solid);
  const std::string bytes = io_test::payload_of(put_floor_plan, plan);
  ByteWriter expected;
  for (const double value : {0.5, 1.0, -2.0}) expected.number(value);
  // From (-3, 2), 70 x 2: walls 69 = 64 + 5, floor, walls 69, solid.
  CHECK(bytes == expected.bytes() + "\x05\x04\x46\x02" + std::string("\x7F\x44\x00\x7F\x44\x80", 6));
}

TEST_CASE("floor plans come back, whatever they are of") {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const FloorPlan plan = io_test::any_plan(random);
    const std::string bytes = io_test::payload_of(put_floor_plan, plan);
    const FloorPlan again = taken(bytes);
    REQUIRE(again.box() == plan.box());
    REQUIRE(again.values() == plan.values());
    REQUIRE(again.resolution_m() == plan.resolution_m());
    REQUIRE(again.lattice().origin_m() == plan.lattice().origin_m());
    REQUIRE(again.value({-5000, 0}) == FloorCell::solid);
    for (std::size_t size = 0; size < bytes.size(); ++size) REQUIRE(runs_refusal(bytes.substr(0, size)) != "");
  }
}

TEST_CASE("a plan of straight walls takes a few bytes a row") {
  const FloorPlan plan = test::room(800, 300, 0.05);
  CHECK(io_test::payload_of(put_floor_plan, plan).size() < plan.size() / 40);
}

TEST_CASE("no floor plan is larger than its bytes allow") {
  using std::string;
  CHECK(taken(with_box(string("\0\0\x40\x01\x3F", 5))).size() == 64);
  CHECK_THAT(runs_refusal(with_box(string("\0\0\x41\x01\x3F", 5))), Contains("a floor plan of 65 cells, though only 1 bytes follow"));
  CHECK_THAT(runs_refusal(with_box(string("\0\0\x40\x01\x3E", 5))), Contains("only 0 bytes"));
  CHECK_THAT(runs_refusal(with_box(string("\0\0\x10\x01\x1F", 5))), Contains("a run of 32 cells beyond the end"));
  CHECK_THAT(runs_refusal(with_box(string("\0\0\x10\x01\xCF", 5))), Contains("a cell of no known kind"));
  CHECK_THAT(runs_refusal(with_box(string("\0\0\xFF\xFF\xFF\xFF\x7F\x01\x3F", 9))), Contains("cells along an axis, which must be at most 268435456"));
  CHECK_THAT(runs_refusal(with_box(string("\xFF\xFF\xFF\xFF\x0F\0\x01\x01\x00", 9))), Contains("a number of -2147483648"));
  ByteWriter flat;
  for (const double value : {0.0, 0.0, 0.0}) flat.number(value);
  CHECK_THAT(runs_refusal(flat.bytes() + string("\0\0\0\0", 4)), Contains("a resolution of 0.000000, which must be > 0"));
}
