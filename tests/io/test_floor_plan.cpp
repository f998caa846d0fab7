#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <vector>

#include "incognita/io/floor_plan.hpp"
#include "kth_text.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

TEST_CASE("read_floor_plan goes by the name's ending") {
  const io_test::TemporaryFolder folder;
  ProbabilityGrid map(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(3, 1)});
  map.values() = {0.0F, 1.0F, unknown_probability};
  write_map_server(folder / "m.yaml", map);
  std::filesystem::copy(folder / "m.yaml", folder / "m.yml");
  for (const char* name : {"m.yaml", "m.yml"}) {
    CHECK(read_floor_plan(folder / name).values() ==
          std::vector<FloorCell>{FloorCell::floor, FloorCell::wall, FloorCell::solid});
  }
  const FloorPlan rooms =
      read_floor_plan(folder.with("rooms.xml", io_test::two_rooms(io_test::KthText(), 0.2).text()));
  CHECK(rooms.resolution_m() == 0.05);
  CHECK(rooms.value(rooms.lattice().index_of({2.0, 1.5})) == FloorCell::floor);
}

TEST_CASE("read_floor_plan refuses other names, and names the file") {
  const io_test::TemporaryFolder folder;
  for (const char* name : {"map.png", "map", "map.json", "", ".yaml", "map.XML"}) {
    CHECK_THAT(refusal([&] { return read_floor_plan(name); }), Contains("is not a floor plan"));
  }
  CHECK_THAT(refusal([&] { return read_floor_plan(folder / "none.yaml"); }),
             Contains("none.yaml: there is no such file"));
  CHECK_THAT(refusal([&] { return read_floor_plan(folder / "none.xml"); }),
             Contains("none.xml: there is no such file"));
  std::filesystem::create_directory(folder / "d.xml");
  CHECK_THAT(refusal([&] { return read_floor_plan(folder / "d.xml"); }), Contains("is a folder"));
}
