#include <catch2/catch.hpp>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/estimation/slam.hpp"
#include "incognita/map/map.hpp"
#include "room.hpp"

using namespace incognita;

namespace {

bool same_cells(const Map<>& a, const Map<>& b) {
  if (a.grid().size() != b.grid().size()) return false;
  for (Offset offset = 0; offset < static_cast<Offset>(a.grid().size()); ++offset) {
    if (a.log_odds(offset) != b.log_odds(offset)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("Slam corrects by the map, then maps, then learns", "[estimation]") {
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  DvlEkf filter;
  Map<> map;
  Slam<Map<>, DvlEkf> slam{DvlEkf()};
  Pose2 truth;
  for (int n = 0; n < 60; ++n) {
    const Scan<2> scan = room::scan_of(walls, truth);
    const SlamReport report = slam.observe(scan);
    const CorrectionReport correction = filter.correct(scan, map);
    REQUIRE(correction.trusted);
    const ScanReport mapped = map.update(scan, filter.belief().pose, filter.belief().covariance);
    filter.learn(scan);
    REQUIRE(report.correction.associations == correction.associations);
    REQUIRE(report.scan.beams_used == mapped.beams_used);
    REQUIRE_FALSE(report.is_redrawn);
    REQUIRE(slam.belief().pose.x_m == filter.belief().pose.x_m);
    const Pose2 increment{n < 25 ? 0.0 : 0.03, 0.0, n < 25 ? 0.0 : 0.02};
    slam.move(increment, 0.1);
    filter.predict(increment, 0.1);
    truth = truth * increment;
  }
  CHECK(same_cells(slam.map(), map));
}

TEST_CASE("A scan that the filter does not trust leaves the map as it was", "[estimation]") {
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  Slam<Map<>, DvlEkf> slam{DvlEkf()};
  for (int n = 0; n < 30; ++n) {
    slam.observe(room::scan_of(walls, {}));
    slam.move({}, 0.1);
  }
  const Map<> before = slam.map();
  const Scan<2> elsewhere = room::scan_of(room::box({}, 0.8, 0.9), {});
  const SlamReport report = slam.observe(elsewhere);
  REQUIRE_FALSE(report.correction.trusted);
  CHECK(report.scan.beams_used == 0);
  CHECK(report.scan.beams_ignored == elsewhere.size());
  CHECK(same_cells(slam.map(), before));
}

TEST_CASE("Slam builds upon the map it is given, with any filter", "[estimation]") {
  Map<> given;
  given.update(room::scan_of(room::box({20.0, 0.0, 0.0}), {20.0, 0.0, 0.0}), {20.0, 0.0, 0.0}, Eigen::Matrix3d::Zero());
  const Index<2> wall = given.lattice().index_of({23.05, 0.0});
  Slam<Map<>, DeadReckoning> slam(DeadReckoning(), given);
  slam.observe(room::scan_of(room::box({}), {}));
  CHECK(slam.map().probability(wall) == given.probability(wall));
  CHECK(slam.map().probability(given.lattice().index_of({3.05, 0.0})) > 0.6);
}

TEST_CASE("Motion that is none is refused, and changes nothing", "[estimation]") {
  Slam<Map<>, DvlEkf> slam{DvlEkf()};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(slam.move({nan, 0.0, 0.0}, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(slam.move({}, -0.1), std::invalid_argument);
  CHECK(slam.belief().pose.x_m == 0.0);
}
