#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/estimation/scan_consistency.hpp"
#include "incognita/map/map.hpp"
#include "room.hpp"

using namespace incognita;

namespace {

/// The map of the room after a few scans from its middle.
Map<> mapped_room() {
  Map<> map;
  for (int scan = 0; scan < 6; ++scan) {
    map.update(room::scan_of(room::box(room::kTurned), room::kTurned, 720), room::kTurned, Eigen::Matrix3d::Zero());
  }
  return map;
}

}  // namespace

TEST_CASE("A scan agrees with the map at the place where it was taken", "[estimation]") {
  const Map<> map = mapped_room();
  Random random(1);
  for (int draw = 0; draw < 50; ++draw) {
    const Pose2 pose = room::kTurned * Pose2{random.uniform(-2.0, 2.0), random.uniform(-1.0, 1.0), random.uniform(-3.0, 3.0)};
    const ScanConsistency at_home = scan_consistency(map, room::scan_of(room::box(room::kTurned), pose), pose);
    CHECK(at_home.judged() > 40);
    CHECK(at_home.share() > 0.85);
    CHECK(at_home.holds({}));
    // A metre further across the room, walls are passed or missed.
    const Pose2 off = pose * Pose2{1.1 * std::cos(draw), 1.1 * std::sin(draw), 0.7};
    const ScanConsistency elsewhere = scan_consistency(map, room::scan_of(room::box(room::kTurned), pose), off);
    CHECK(elsewhere.share() < at_home.share() - 0.3);
  }
}

TEST_CASE("Scans in a corridor agree with maps of coarse cells as with those of fine ones", "[estimation]") {
  for (const double resolution_m : {0.1, 0.2, 0.3}) {
    for (const double turn_rad : {0.0, 0.1, 0.3, 0.7}) {
      Random random(5);
      // 40 m long: nearly all of it is seen at a grazing angle, by beams that cut the edges of cells.
      const Pose2 T_map_corridor{0.37, -0.21, turn_rad};
      const std::vector<room::Wall> walls = room::box(T_map_corridor, 20.0, 1.0);
      const auto noisy_scan_at = [&](const Pose2& pose) {
        Scan<2> scan = room::scan_of(walls, pose, circular_beams(360, 25.0));
        for (std::size_t beam = 0; beam < scan.size(); ++beam) {
          if (scan.reading(beam) == Reading::hit) scan.set_range_m(beam, scan.range_m(beam) + random.normal(0.0, 0.02));
        }
        return scan;
      };
      Map<> map({.resolution_m = resolution_m});
      for (double x_m = -18.0; x_m <= 18.0; x_m += 2.0) {
        const Pose2 pose = T_map_corridor * Pose2{x_m, 0.3, 0.0};
        map.update(noisy_scan_at(pose), pose, Eigen::Matrix3d::Zero());
      }
      for (int draw = 0; draw < 40; ++draw) {
        const Pose2 pose = T_map_corridor * Pose2{random.uniform(-15.0, 15.0), random.uniform(-0.4, 0.4), random.uniform(-3.0, 3.0)};
        const Scan<2> scan = noisy_scan_at(pose);
        const ScanConsistency at_home = scan_consistency(map, scan, pose);
        CAPTURE(resolution_m, turn_rad, at_home.agreeing, at_home.contradicting);
        CHECK(at_home.judged() > 40);
        CHECK(at_home.share() > 0.77);
        CHECK_FALSE(scan_consistency(map, scan, pose * Pose2{0.0, 0.0, 0.5}).holds({}));
      }
    }
  }
}

TEST_CASE("Only what the map knows is judged", "[estimation]") {
  const Scan<2> scan = room::scan_of(room::box(room::kTurned), room::kTurned);
  const ScanConsistency unknown = scan_consistency(Map<>(), scan, room::kTurned);
  CHECK(unknown.judged() == 0);
  CHECK(unknown.share() == 1.0);
  CHECK(unknown.holds({}));

  const Map<> map = mapped_room();
  Scan<2> bad(circular_beams(360, 10.0));
  for (std::size_t beam = 0; beam < bad.size(); ++beam) bad.set_range_m(beam, std::numeric_limits<double>::quiet_NaN());
  CHECK(scan_consistency(map, bad, room::kTurned).judged() == 0);
  CHECK(scan_consistency(map, Scan<2>(circular_beams(0, 10.0)), room::kTurned).judged() == 0);
}

TEST_CASE("Beams through walls and ends in free space contradict", "[estimation]") {
  const Map<> map = mapped_room();
  const Scan<2> blinded(circular_beams(360, 10.0));  // nothing within 10 m, walls or no walls
  const ScanConsistency through = scan_consistency(map, blinded, room::kTurned);
  CHECK(through.agreeing == 0);
  CHECK(through.contradicting == 60);
  CHECK_FALSE(through.holds({}));

  Scan<2> crowded(circular_beams(360, 10.0));
  for (std::size_t beam = 0; beam < crowded.size(); ++beam) crowded.set_range_m(beam, 0.9);
  const ScanConsistency within = scan_consistency(map, crowded, room::kTurned);
  CHECK(within.agreeing == 0);
  CHECK(within.contradicting == 60);

  // A person before the robot hides a few walls, and is no reason for doubt.
  Scan<2> person = room::scan_of(room::box(room::kTurned), room::kTurned);
  for (std::size_t beam = 20; beam < 60; ++beam) person.set_range_m(beam, 0.8);
  CHECK(scan_consistency(map, person, room::kTurned).holds({}));
}

TEST_CASE("Consistency refuses parameters outside of their bounds", "[estimation]") {
  ConsistencyParams params;
  params.tolerance_m = -0.2;
  CHECK_THROWS_WITH(params.validate(), Catch::Contains("tolerance_m") && Catch::Contains("-0.2"));
  params = {};
  params.tolerance_cells = -1.0;
  CHECK_THROWS_WITH(params.validate(), Catch::Contains("tolerance_cells") && Catch::Contains("-1"));
  params = {};
  params.share_min = 1.5;
  CHECK_THROWS_WITH(params.validate(), Catch::Contains("share_min") && Catch::Contains("1.5"));
  params = {};
  params.beams_max = 0;
  CHECK_THROWS_WITH(params.validate(), Catch::Contains("beams_max"));
}
