#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/geometry/pose3.hpp"
#include "incognita/io/octomap.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/prior.hpp"
#include "support.hpp"

#ifdef INCOGNITA_HAS_OCTOMAP
#include <octomap/octomap.h>
#endif

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

const std::string comments = "# Octomap OcTree binary file\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n";

/// What OctoMap 1.9.7 writes for a tree of 0.1 m with (0.05, 0.05, 0.05) hit, (0.15, 0.05, 0.05) missed and
/// (-0.05, 0.25, 0.05) hit.
const std::string three_voxels = comments + "id OcTree\nsize 34\nres 0.1\ndata\n" +
                                 std::string("\x00\xf0\x0c\x00\x0c\x00\x0c\x00\x0c\x00\x0c\x00\x0c\x00\x0c\x00\x0c\x00\x0c\x00\x0c\x00\x0c"
                                             "\x00\x0c\x00\x0c\x00\xc0\x00\x08\x00\x03\x00\x03\x00\x03\x00\x03\x00\x03\x00\x03\x00\x03\x00"
                                             "\x03\x00\x03\x00\x03\x00\x03\x00\x03\x00\x03\x00\x03\x00\x06\x00",
                                             62);

using Voxels = std::map<std::array<int, 3>, bool>;

/// The voxels of a tree by another way than the library's: a stack of nodes still to be read, in the file's order,
/// each with its middle in half voxels and its depth. Fails the test for what is no tree.
Voxels voxels_of(const std::string& content) {
  struct Node {
    std::array<std::int64_t, 3> middle;  // in half voxels from the origin
    int depth;
  };
  const std::size_t data = content.find("data\n") + 5;
  std::size_t at = data;
  Voxels voxels;
  std::vector<Node> unread{{{0, 0, 0}, 0}};
  std::size_t nodes = 1;
  while (!unread.empty()) {
    const Node node = unread.back();
    unread.pop_back();
    REQUIRE(at + 2 <= content.size());
    std::vector<Node> inner;
    for (int child = 0; child < 8; ++child) {
      const auto byte = static_cast<unsigned char>(content[at + (child >= 4 ? 1 : 0)]);
      const bool first_bit = (byte & (1 << (child % 4 * 2))) != 0;
      const bool second_bit = (byte & (2 << (child % 4 * 2))) != 0;
      if (!first_bit && !second_bit) continue;
      ++nodes;
      const std::int64_t quarter = std::int64_t{1} << (15 - node.depth);  // half of a child's side, in half voxels
      Node place = node;
      ++place.depth;
      for (int axis = 0; axis < 3; ++axis) place.middle[static_cast<std::size_t>(axis)] += (child >> axis & 1) != 0 ? quarter : -quarter;
      if (first_bit && second_bit) {
        inner.push_back(place);
        continue;
      }
      const std::int64_t half = quarter;
      for (std::int64_t z = place.middle[2] - half; z < place.middle[2] + half; z += 2) {
        for (std::int64_t y = place.middle[1] - half; y < place.middle[1] + half; y += 2) {
          for (std::int64_t x = place.middle[0] - half; x < place.middle[0] + half; x += 2) {
            voxels[{static_cast<int>(std::floor(static_cast<double>(x) / 2)), static_cast<int>(std::floor(static_cast<double>(y) / 2)),
                    static_cast<int>(std::floor(static_cast<double>(z) / 2))}] = second_bit;
          }
        }
      }
    }
    at += 2;
    unread.insert(unread.end(), inner.rbegin(), inner.rend());
  }
  CHECK(at == content.size());
  CHECK(content.find("size " + std::to_string(nodes) + "\n") != std::string::npos);
  return voxels;
}

template <int Dim>
Voxels voxels_of(const OccupancyGrid<Dim>& grid, int z = 0) {
  Voxels voxels;
  for (Offset offset = 0; offset < static_cast<Offset>(grid.size()); ++offset) {
    if (grid[offset] == Occupancy::unknown) continue;
    const Index<Dim> at = grid.index_at(offset);
    voxels[{at[0], at[1], Dim == 3 ? at[Dim - 1] : z}] = grid[offset] == Occupancy::occupied;
  }
  return voxels;
}

template <int Dim>
OccupancyGrid<Dim> random_grid(std::uint64_t seed, double resolution_m, const IndexBox<Dim>& box, double known) {
  Random random(seed);
  OccupancyGrid<Dim> grid(Lattice<Dim>(resolution_m), box, Occupancy::unknown);
  for (Occupancy& cell : grid.values()) {
    if (random.uniform() < known) cell = random.uniform() < 0.3 ? Occupancy::occupied : Occupancy::free;
  }
  return grid;
}

std::string octomap_refusal(const std::string& content) {
  return refusal([&] { return decode_octomap(content, "a.bt"); });
}

std::string octomap_with_header(const std::string& header) { return comments + header + "data\n" + three_voxels.substr(three_voxels.size() - 62); }

}  // namespace

TEST_CASE("OctoMap: what liboctomap wrote is read, and written again to the byte") {
  const OccupancyGrid<2> plane = decode_octomap(three_voxels, "a.bt");
  CHECK(plane.resolution_m() == 0.1);
  CHECK(plane.box() == IndexBox<2>{Index<2>(-1, 0), Index<2>(2, 3)});
  CHECK(voxels_of(plane) == Voxels{{{0, 0, 0}, true}, {{1, 0, 0}, false}, {{-1, 2, 0}, true}});
  const OccupancyGrid<3> space = decode_octomap_space(three_voxels, "a.bt");
  CHECK(voxels_of(space) == voxels_of(plane));
  CHECK(encode_octomap(plane) == three_voxels);
  CHECK(encode_octomap(space) == three_voxels);
}

TEST_CASE("OctoMap: planes and spaces come back, and an independent reader sees the same") {
  for (const double known : {0.02, 0.5, 1.0}) {
    const auto plane = random_grid<2>(3, 0.05, {Index<2>(-37, -9), Index<2>(20, 31)}, known);
    CHECK(voxels_of(encode_octomap(plane)) == voxels_of(plane));
    CHECK(voxels_of(decode_octomap(encode_octomap(plane), "a.bt")) == voxels_of(plane));
    const auto space = random_grid<3>(4, 0.2, {Index<3>(-5, -9, -3), Index<3>(6, 4, 5)}, known);
    CHECK(voxels_of(encode_octomap(space)) == voxels_of(space));
    CHECK(voxels_of(decode_octomap_space(encode_octomap(space), "a.bt")) == voxels_of(space));
  }
}

TEST_CASE("OctoMap: equal voxels become one leaf") {
  OccupancyGrid<3> space(Lattice<3>(0.1), {Index<3>(-8, -8, -8), Index<3>(8, 8, 8)}, Occupancy::free);
  const std::string free = encode_octomap(space);
  // The root, 12 nodes in each octant down to a cube of 8 a side, and no voxel.
  CHECK(free.find("size 105\n") != std::string::npos);
  CHECK(voxels_of(free) == voxels_of(space));
  space.set({0, 0, 0}, Occupancy::occupied);
  const std::string one = encode_octomap(space);
  CHECK(one.find("size 129\n") != std::string::npos);  // 8 more at each of three levels
  CHECK(voxels_of(one) == voxels_of(space));
  CHECK(voxels_of(decode_octomap_space(one, "a.bt")) == voxels_of(space));
}

TEST_CASE("OctoMap: a plane lies at the height that is asked for, and is seen between heights") {
  const io_test::TemporaryFolder folder;
  const auto plane = random_grid<2>(5, 0.1, {Index<2>(-4, -4), Index<2>(4, 4)}, 0.7);
  for (const auto& [z_m, z] : std::vector<std::pair<double, int>>{{0.3, 3}, {0.25, 2}, {-0.05, -1}, {1.0, 10}}) {
    write_octomap(folder / "a.bt", plane, z_m);
    CHECK(voxels_of(io_test::content_of(folder / "a.bt")) == voxels_of(plane, z));
    CHECK(voxels_of(read_octomap(folder / "a.bt", {z * 0.1, (z + 1) * 0.1})) == voxels_of(plane));
    CHECK(read_octomap(folder / "a.bt", {(z + 1) * 0.1, 99.0}).box().empty());
    CHECK(read_octomap(folder / "a.bt", {-99.0, z * 0.1}).box().empty());
  }
  // Occupied wins over free, free over unknown.
  OccupancyGrid<3> column(Lattice<3>(0.1), {Index<3>(0, 0, 0), Index<3>(2, 1, 3)}, Occupancy::unknown);
  column.set({0, 0, 0}, Occupancy::free);
  column.set({0, 0, 1}, Occupancy::occupied);
  column.set({0, 0, 2}, Occupancy::free);
  column.set({1, 0, 2}, Occupancy::free);
  write_octomap(folder / "b.bt", column);
  CHECK(voxels_of(read_octomap(folder / "b.bt")) == Voxels{{{0, 0, 0}, true}, {{1, 0, 0}, false}});
  CHECK(voxels_of(read_octomap(folder / "b.bt", {0.2, 0.3})) == Voxels{{{0, 0, 0}, false}, {{1, 0, 0}, false}});
  CHECK(voxels_of(read_octomap(folder / "b.bt", {0.0, 0.1})) == Voxels{{{0, 0, 0}, false}});
}

TEST_CASE("OctoMap: a belief goes out by OctoMap's threshold and comes back as a prior") {
  const io_test::TemporaryFolder folder;
  Grid<float, 2> given(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(4, 1)}, 0.0F);
  given.values() = {-0.1F, 0.0F, 0.1F, 3.0F};
  const Map<LogOdds> map(given);
  write_belief_octomap(folder / "a.bt", map);
  CHECK(voxels_of(io_test::content_of(folder / "a.bt")) == Voxels{{{0, 0, 0}, false}, {{2, 0, 0}, true}, {{3, 0, 0}, true}});
  const Map<LogOdds> back =
      map_with_prior<LogOdds>(octomap_probabilities(read_octomap(folder / "a.bt")), {}, {}, LogOdds(LogOdds::octomap_params()));
  CHECK(back.probability({0, 0}) == Approx(0.1192).margin(1e-4));
  CHECK(back.log_odds(Index<2>(1, 0)) == 0.0F);
  CHECK(back.probability({2, 0}) == Approx(0.971).margin(1e-3));
  write_belief_octomap(folder / "a.bt", map, 0.0, OccupancyThresholds{});
  CHECK(voxels_of(io_test::content_of(folder / "a.bt")) == Voxels{{{3, 0, 0}, true}});
  write_belief_octomap(folder / "empty.bt", Map<LogOdds>());
  CHECK(io_test::content_of(folder / "empty.bt") == comments + "id OcTree\nsize 0\nres 0.1\ndata\n");
  CHECK(read_octomap(folder / "empty.bt").box().empty());
}

TEST_CASE("OctoMap: its thresholds") {
  const OccupancyThresholds thresholds = OccupancyThresholds::octomap();
  thresholds.validate();
  CHECK(thresholds.classify(-1e-6F) == Occupancy::free);
  CHECK(thresholds.classify(0.0F) == Occupancy::unknown);
  CHECK(thresholds.classify(1e-6F) == Occupancy::occupied);
  const auto logit = [](double p) { return std::log(p / (1.0 - p)); };
  const LogOdds::Params cells = LogOdds::octomap_params();
  CHECK(logit(OctoMapDefaults::clamping_threshold_min) == Approx(static_cast<double>(cells.log_odds_min)).margin(0.001));
  CHECK(logit(OctoMapDefaults::clamping_threshold_max) == Approx(static_cast<double>(cells.log_odds_max)).margin(0.012));
  CHECK(logit(OctoMapDefaults::probability_hit) == Approx(static_cast<double>(cells.hit)).margin(0.006));
  CHECK(logit(OctoMapDefaults::probability_miss) == Approx(static_cast<double>(cells.pass)).margin(0.006));
}

TEST_CASE("OctoMap: the ends of its keys, and lattices that it cannot hold") {
  OccupancyGrid<2> ends(Lattice<2>(0.1), {Index<2>(-32768, 32767), Index<2>(-32767, 32768)}, Occupancy::occupied);
  CHECK(voxels_of(encode_octomap(ends, -3276.8)) == Voxels{{{-32768, 32767, -32768}, true}});
  CHECK_THROWS_WITH(encode_octomap(ends, -3276.9),
                    "write_octomap: a cell's distance from the origin, in cells, is -32769, but must be in -32768..32767, as OctoMap's "
                    "keys have 16 bits");
  CHECK_THROWS_AS(encode_octomap(ends, NAN), std::invalid_argument);
  for (const Index<2>& far : {Index<2>(-32769, 0), Index<2>(0, 32768)}) {
    const OccupancyGrid<2> grid(Lattice<2>(0.1), box_of_cell<2>(far), Occupancy::free);
    CHECK_THROWS_AS(encode_octomap(grid), std::invalid_argument);
  }
  // A lattice that is shifted by whole cells is OctoMap's, one that is not is none.
  const OccupancyGrid<2> whole(Lattice<2>(0.1, Point<2>(0.3, -0.7)), {Index<2>(0, 0), Index<2>(1, 1)}, Occupancy::occupied);
  CHECK(voxels_of(encode_octomap(whole)) == Voxels{{{3, -7, 0}, true}});
  const OccupancyGrid<2> half(Lattice<2>(0.1, Point<2>(0.35, 0.0)), {Index<2>(0, 0), Index<2>(1, 1)}, Occupancy::occupied);
  CHECK_THROWS_WITH(encode_octomap(half), Contains("write_octomap: the lattice's origin, in cells, is 3.5, but must be a whole number"));
}

TEST_CASE("OctoMap: what is not understood is refused") {
  const std::string good = "id OcTree\nsize 34\nres 0.1\n";
  CHECK(octomap_refusal(octomap_with_header(good)).empty());
  CHECK(octomap_refusal(octomap_with_header("# more\r\nres 0.1\n\nsize 34\r\nid OcTree\n")).empty());
  for (const auto& [header, what] : std::vector<std::pair<std::string, std::string>>{
           {"id ColorOcTree\nsize 34\nres 0.1\n", "its id is \"ColorOcTree\", but must be OcTree"},
           {"id OcTree\nsize 33\nres 0.1\n", "it has 34 nodes, but its size is 33"},
           {"id OcTree\nsize -1\nres 0.1\n", "its size is \"-1\""},
           {"id OcTree\nsize 1.5\nres 0.1\n", "its size is \"1.5\""},
           {"id OcTree\nsize 34\nres 0\n", "its res is \"0\""},
           {"id OcTree\nsize 34\nres nan\n", "its res is \"nan\""},
           {"id OcTree\nsize 34\nres\n", "its res is \"\""},
           {"id OcTree\nsize 34\n", "lacks one of id, size and res"},
           {"size 34\nres 0.1\n", "lacks one of id, size and res"},
           {"id OcTree\nsize 34\nres 0.1\ncolour red\n", "the line \"colour red\""},
           {"id OcTree\nsize 0\nres 0.1\n", "it goes on after its tree by 62 bytes"}}) {
    CAPTURE(header);
    CHECK_THAT(octomap_refusal(octomap_with_header(header)), Contains("a.bt: not a valid .bt file: ") && Contains(what));
  }
  CHECK_THAT(octomap_refusal(""), Contains("must start with"));
  CHECK_THAT(octomap_refusal("# Octomap OcTree file\n"), Contains("must start with"));
  CHECK_THAT(octomap_refusal(comments + good), Contains("ends before the line \"data\""));
  CHECK_THAT(octomap_refusal(three_voxels.substr(0, three_voxels.size() - 1)), Contains("ends within its tree"));
  CHECK_THAT(octomap_refusal(three_voxels + "x"), Contains("goes on after its tree by 1 bytes"));
  // A node below the last level, and leaves that stand for more cells than are allowed.
  std::string deep = three_voxels;
  deep.replace(deep.size() - 2, 1, "\x03");
  CHECK_THAT(octomap_refusal(deep), Contains("deeper than 16 levels"));
  const std::string large = comments + "id OcTree\nsize 9\nres 0.1\ndata\n\x55\x55";
  CHECK_THAT(octomap_refusal(large), Contains("spans more than 268435456 cells"));
  CHECK_THAT(refusal([] { return read_octomap("missing.bt"); }), Contains("no such file"));
  CHECK_THAT(refusal([] {
               write_octomap("/proc/none/a.bt", OccupancyGrid<2>(Lattice<2>(0.1)));
               return 0;
             }),
             Contains("cannot be written"));
}

TEST_CASE("OctoMap: files cut off or spoilt are read or refused") {
  for (std::size_t size = 0; size < three_voxels.size(); ++size) CHECK_FALSE(octomap_refusal(three_voxels.substr(0, size)).empty());
  // Without much room: a spoilt tree may span anything.
  CHECK(io_test::refused_when_spoilt(three_voxels, 2000, [](const std::string& text) {
          return decode_octomap(text, "a.bt", {0.0, 0.05}).size();
        }) > 1000);
}

#ifdef INCOGNITA_HAS_OCTOMAP

TEST_CASE("OctoMap: liboctomap has the defaults that are stated") {
  const octomap::OcTree tree(0.1);
  CHECK(tree.getProbHit() == Approx(OctoMapDefaults::probability_hit));
  CHECK(tree.getProbMiss() == Approx(OctoMapDefaults::probability_miss));
  CHECK(tree.getOccupancyThres() == Approx(OctoMapDefaults::occupancy_threshold));
  CHECK(tree.getClampingThresMin() == Approx(OctoMapDefaults::clamping_threshold_min));
  CHECK(tree.getClampingThresMax() == Approx(OctoMapDefaults::clamping_threshold_max));
}

TEST_CASE("OctoMap: liboctomap reads what is written, and writes what is read") {
  for (const double known : {0.1, 1.0}) {
    const auto space = random_grid<3>(11, 0.05, {Index<3>(-9, -20, -3), Index<3>(16, 8, 9)}, known);
    const std::string written = encode_octomap(space);
    std::istringstream in(written);
    octomap::OcTree tree(1.0);
    REQUIRE(tree.readBinary(in));
    CHECK(tree.getResolution() == 0.05);
    for (Offset offset = 0; offset < static_cast<Offset>(space.size()); ++offset) {
      const Point<3> center_m = space.lattice().center_m(space.index_at(offset));
      const octomap::OcTreeNode* node = tree.search(center_m.x(), center_m.y(), center_m.z());
      REQUIRE((node != nullptr) == (space[offset] != Occupancy::unknown));
      if (node != nullptr) REQUIRE(tree.isNodeOccupied(node) == (space[offset] == Occupancy::occupied));
    }
    std::ostringstream out;
    REQUIRE(tree.writeBinary(out));
    CHECK(out.str() == written);

    // A tree of its own making, with rays, pruned.
    octomap::OcTree made(0.1);
    Random random(12);
    for (int ray = 0; ray < 300; ++ray) {
      made.insertRay({0.03F, 0.02F, 0.01F}, {static_cast<float>(random.uniform(-3.0, 3.0)), static_cast<float>(random.uniform(-3.0, 3.0)),
                                             static_cast<float>(random.uniform(-1.0, 1.0))});
    }
    std::ostringstream of_its_own;
    REQUIRE(made.writeBinary(of_its_own));
    const OccupancyGrid<3> read = decode_octomap_space(of_its_own.str(), "a.bt");
    CHECK(encode_octomap(read) == of_its_own.str());
    std::size_t voxels = 0;
    made.expand();
    for (auto leaf = made.begin_leafs(); leaf != made.end_leafs(); ++leaf, ++voxels) {
      const Index<3> at = read.lattice().index_of({leaf.getX(), leaf.getY(), leaf.getZ()});
      REQUIRE(read.value(at) == (made.isNodeOccupied(*leaf) ? Occupancy::occupied : Occupancy::free));
    }
    CHECK(voxels == voxels_of(read).size());
  }
}

#endif
