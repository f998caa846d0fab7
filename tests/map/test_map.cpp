#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/map.hpp"
#include "reference.hpp"

using namespace incognita;

namespace {

static_assert(std::is_same_v<Map<>, Map<TBayes, 2>>);
static_assert(Map<LogOdds, 3>::dimension == 3);
static_assert(std::is_same_v<Map<LogOdds>::State, LogOdds::State>);
static_assert(!std::is_convertible_v<MapParams, Map<>>);

constexpr double kDoubleNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kDoubleInfinity = std::numeric_limits<double>::infinity();

bool same_state(const TBayes::State& a, const TBayes::State& b) {
  return a.log_odds == b.log_odds && a.settled_by == b.settled_by && a.hits == b.hits;
}
bool same_state(const LogOdds::State& a, const LogOdds::State& b) {
  return a.log_odds == b.log_odds && a.hit_by == b.hit_by;
}

template <class Cell, int Dim>
bool same_map(const Map<Cell, Dim>& a, const Map<Cell, Dim>& b) {
  if (a.stamp() != b.stamp() || a.grid().box().lower != b.grid().box().lower ||
      a.grid().box().upper != b.grid().box().upper) {
    return false;
  }
  for (Offset offset = 0; offset < static_cast<Offset>(a.grid().size()); ++offset) {
    if (!same_state(a.grid()[offset], b.grid()[offset])) return false;
  }
  return true;
}

/// The greatest difference from the reference, over every cell of the map and of the reference.
template <class Cell, class Rule, int Dim>
double largest_error(const Map<Cell, Dim>& map, const reference::SlowMap<Rule, Dim>& slow) {
  double largest = 0.0;
  std::size_t found = 0;
  for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
    const Index<Dim> index = map.grid().index_at(offset);
    reference::Key<Dim> key;
    for (int axis = 0; axis < Dim; ++axis) key[static_cast<std::size_t>(axis)] = index[axis];
    const auto cell = slow.cells.find(key);
    double expected = 0.0;
    if (cell != slow.cells.end()) {
      ++found;
      expected = cell->second.log_odds;
    }
    const double error = std::abs(static_cast<double>(map.log_odds(index)) - expected);
    largest = std::max(largest, error / (1.0 + std::abs(expected)));
  }
  return found == slow.cells.size() ? largest : kDoubleInfinity;
}

template <int Dim, class Cell>
void compare_with_reference(const Cell& policy, const MapParams& params, std::uint64_t seed) {
  Random random(seed);
  Map<Cell, Dim> map(params, policy);
  reference::SlowMap<decltype(reference::rule_of(policy)), Dim> slow{
      reference::rule_of(policy), params.resolution_m, params.resolution_m * params.hit_push_cells};
  const int scans = Dim == 2 ? 12 : 6;
  std::size_t ignored = 0;
  for (int scan_index = 0; scan_index < scans; ++scan_index) {
    const Pose<Dim> T_map_sensor = reference::random_pose<Dim>(random);
    const auto covariance = reference::random_covariance<Dim>(random);
    const Scan<Dim> scan = reference::random_scan<Dim>(random, 30, Dim == 2 ? 6.0 : 3.0, 0.1);
    const ScanReport report = map.update(scan, T_map_sensor, covariance);
    slow.update(scan, T_map_sensor, covariance);
    REQUIRE(report.beams_used + report.beams_ignored == 30);
    ignored += report.beams_ignored;
    REQUIRE(largest_error(map, slow) < 2e-5);
  }
  REQUIRE(ignored > 0);
  REQUIRE(slow.cells.size() > 500);
}

Scan<2> one_beam(double range_m, double range_max_m = 10.0) {
  return Scan<2>(planar_beams(1, 0.0, 0.0, range_max_m), {range_m});
}

const Eigen::Matrix3d kExact = Eigen::Matrix3d::Zero();

}  // namespace

TEST_CASE("A map equals a slow reference in the plane", "[map]") {
  for (const double push : {0.5, 0.0, 1.3}) {
    for (const double resolution_m : {0.1, 0.23}) {
      const MapParams params{resolution_m, push};
      compare_with_reference<2>(TBayes(), params, 1);
      compare_with_reference<2>(TBayes(TBayes::literal_params()), params, 2);
      compare_with_reference<2>(LogOdds(), params, 3);
    }
  }
  LogOdds::Params passes_count;
  passes_count.hits_win = false;
  compare_with_reference<2>(LogOdds(passes_count), {}, 4);
}

TEST_CASE("A map equals a slow reference in space", "[map]") {
  compare_with_reference<3>(TBayes(), {0.2, 0.5}, 5);
  compare_with_reference<3>(TBayes(TBayes::literal_params()), {0.15, 0.0}, 6);
  compare_with_reference<3>(LogOdds(), {0.2, 0.5}, 7);
}

TEST_CASE("Beams that are to be ignored change nothing and are counted", "[map]") {
  Random random(8);
  Map<> with;
  Map<> without;
  for (int draw = 0; draw < 20; ++draw) {
    const Pose2 T_map_sensor = reference::random_pose<2>(random);
    const Eigen::Matrix3d covariance = reference::random_covariance<2>(random);
    const Scan<2> scan = reference::random_scan<2>(random, 40, 8.0, 0.4);
    BeamPattern<2> valid;
    valid.range_max_m = 8.0;
    std::vector<double> ranges_m;
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (scan.range_m(beam) > 0.0 && scan.range_m(beam) <= 8.0) {
        valid.directions.push_back(scan.direction(beam));
        ranges_m.push_back(scan.range_m(beam));
      }
    }
    const ScanReport report = with.update(scan, T_map_sensor, covariance);
    without.update(Scan<2>(valid, ranges_m), T_map_sensor, covariance);
    REQUIRE(report.beams_used == ranges_m.size());
    REQUIRE(report.beams_ignored == 40 - ranges_m.size());
    REQUIRE(same_map(with, without));
  }
}

TEST_CASE("A scan without beams or without valid ones changes no cell", "[map]") {
  Map<> map;
  map.update(one_beam(3.0), {}, kExact);
  const Map<> before = map;
  Scan<2> bad(circular_beams(5, 10.0));
  for (std::size_t beam = 0; beam < 5; ++beam) bad.set_range_m(beam, kDoubleNan);
  for (const Scan<2>& scan : {Scan<2>(circular_beams(0, 10.0)), bad}) {
    const ScanReport report = map.update(scan, {1.0, 0.0, 0.5}, kExact);
    REQUIRE(report.beams_used == 0);
    REQUIRE(report.beams_ignored == scan.size());
  }
  for (Offset offset = 0; offset < static_cast<Offset>(before.grid().size()); ++offset) {
    const Index<2> index = before.grid().index_at(offset);
    REQUIRE(map.log_odds(index) == before.log_odds(index));
  }
}

TEST_CASE("A bad pose or covariance is refused and the map is unchanged", "[map]") {
  Random random(9);
  Map<> map;
  for (int draw = 0; draw < 3; ++draw) {
    map.update(reference::random_scan<2>(random, 60, 6.0), reference::random_pose<2>(random), kExact);
  }
  const Map<> before = map;
  const Scan<2> scan = reference::random_scan<2>(random, 60, 6.0);
  const Pose2 good{1.0, 2.0, 0.3};

  for (const double bad : {kDoubleNan, kDoubleInfinity, -kDoubleInfinity}) {
    REQUIRE_THROWS_AS(map.update(scan, {bad, 0.0, 0.0}, kExact), std::invalid_argument);
    REQUIRE_THROWS_AS(map.update(scan, {0.0, bad, 0.0}, kExact), std::invalid_argument);
    REQUIRE_THROWS_AS(map.update(scan, {0.0, 0.0, bad}, kExact), std::invalid_argument);
    for (Eigen::Index entry = 0; entry < 9; ++entry) {
      Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
      covariance(entry) = bad;
      REQUIRE_THROWS_AS(map.update(scan, good, covariance), std::invalid_argument);
    }
  }
  Eigen::Matrix3d indefinite = Eigen::Matrix3d::Identity();
  indefinite(0, 1) = indefinite(1, 0) = 1.1;
  Eigen::Matrix3d asymmetric = Eigen::Matrix3d::Identity();
  asymmetric(0, 1) = 0.5;
  Eigen::Matrix3d negative = Eigen::Matrix3d::Identity();
  negative(2, 2) = -1e-3;
  for (const Eigen::Matrix3d& covariance : {indefinite, asymmetric, negative}) {
    REQUIRE_THROWS_AS(map.update(scan, good, covariance), std::invalid_argument);
  }

  // Out of the lattice's reach, and so far away that the map between would not fit.
  REQUIRE_THROWS_AS(map.update(scan, {1e9, 0.0, 0.0}, kExact), std::length_error);
  REQUIRE_THROWS_AS(map.update(scan, {0.0, -1e300, 0.0}, kExact), std::length_error);
  REQUIRE_THROWS_AS(map.update(scan, {1e7, 1e7, 0.0}, kExact), std::length_error);
  REQUIRE_THROWS_AS(map.reserve({{-1e7, -1e7}, {1e7, 1e7}}), std::length_error);
  REQUIRE_THROWS_AS(map.reserve({{0.0, 0.0}, {kDoubleInfinity, 1.0}}), std::length_error);
  REQUIRE_THROWS_AS(map.reserve({{0.0, kDoubleNan}, {1.0, 1.0}}), std::length_error);
  REQUIRE(same_map(map, before));

  // A pose of which nothing is uncertain, or only a direction, is fine.
  REQUIRE_NOTHROW(map.update(scan, good, Eigen::Matrix3d::Ones()));
  REQUIRE_NOTHROW(map.update(scan, good, kExact));
  REQUIRE_FALSE(same_map(map, before));
}

TEST_CASE("A map far from its origin is as good as one near it", "[map]") {
  Map<> map;
  map.update(one_beam(3.0), {1e6, -1e6, 0.0}, kExact);
  REQUIRE(map.log_odds(map.lattice().index_of({1e6 + 3.05, -1e6})) > 0.0F);
  REQUIRE(map.log_odds(map.lattice().index_of({1e6 + 1.0, -1e6})) < -1.0F);
  REQUIRE(map.grid().size() < 1000);
}

TEST_CASE("A map grows where a robot goes and keeps its cells", "[map]") {
  Random random(10);
  Map<> walked;
  Map<> reserved;
  reserved.reserve({{-60.0, -60.0}, {60.0, 60.0}});
  const auto box = reserved.grid().box();
  for (int step = 0; step < 60; ++step) {
    const double angle_rad = 0.4 * step;
    const Pose2 T_map_sensor{0.8 * step * std::cos(angle_rad), 0.8 * step * std::sin(angle_rad), angle_rad};
    const Scan<2> scan = reference::random_scan<2>(random, 20, 5.0);
    walked.update(scan, T_map_sensor, kExact);
    reserved.update(scan, T_map_sensor, kExact);
  }
  REQUIRE(reserved.grid().box().lower == box.lower);
  REQUIRE(reserved.grid().box().upper == box.upper);
  REQUIRE(walked.grid().size() < 2 * reserved.grid().size());
  std::size_t touched = 0;
  for (Offset offset = 0; offset < static_cast<Offset>(reserved.grid().size()); ++offset) {
    const Index<2> index = reserved.grid().index_at(offset);
    REQUIRE(walked.log_odds(index) == reserved.log_odds(index));
    if (reserved.log_odds(index) != 0.0F) ++touched;
  }
  REQUIRE(touched > 5000);
}

TEST_CASE("Beams that end on the faces of cells stay within the map", "[map]") {
  // Rounding may put such an end point to either side of the face, differently in each place that computes
  // it.
  Random random(11);
  for (int draw = 0; draw < 3000; ++draw) {
    const double angle_rad = random.uniform(-3.1, 3.1);
    const Pose2 T_map_sensor{random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-3.1, 3.1)};
    const double across = std::cos(angle_rad + T_map_sensor.yaw_rad);
    if (std::abs(across) < 0.1) continue;
    const double face_m = (std::floor(T_map_sensor.x_m / 0.1) + (across > 0.0 ? 8.0 : -7.0)) * 0.1;
    Map<LogOdds> map({0.1, 0.0});
    const Scan<2> scan(planar_beams(1, angle_rad, 0.0, 20.0), {(face_m - T_map_sensor.x_m) / across});
    map.update(scan, T_map_sensor, kExact);
    int occupied = 0;
    for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
      if (map.log_odds(offset) > 0.0F) ++occupied;
    }
    REQUIRE(occupied == 1);
  }
}

TEST_CASE("A hit lies half a cell behind the face that was measured", "[map]") {
  for (const double push : {0.5, 0.0}) {
    Map<> map({0.2, push});
    // The face between cells 9 and 10, measured a little short, as noise has it.
    map.update(one_beam(2.0 - 0.05 - 0.1), {0.1, 0.1, 0.0}, kExact);
    REQUIRE((map.log_odds(Index<2>(10, 0)) > 0.0F) == (push == 0.5));
    REQUIRE((map.log_odds(Index<2>(9, 0)) > 0.0F) == (push == 0.0));
    REQUIRE(map.hit_push_m() == 0.2 * push);
  }
}

TEST_CASE("Hits of a scan come before its passes, whatever the order of the beams", "[map]") {
  // Two beams at small angles: one ends in a cell that the other passes.
  const auto scan_of = [](bool swapped) {
    BeamPattern<2> beams;
    const Point<2> near(1.0, 0.0);
    const Point<2> far(std::cos(0.01), std::sin(0.01));
    beams.directions = swapped ? std::vector<Point<2>>{far, near} : std::vector<Point<2>>{near, far};
    return Scan<2>(beams, swapped ? std::vector<double>{6.0, 2.0} : std::vector<double>{2.0, 6.0});
  };
  Map<LogOdds> a;
  Map<LogOdds> b;
  a.update(scan_of(false), {0.07, 0.05, 0.0}, kExact);
  b.update(scan_of(true), {0.07, 0.05, 0.0}, kExact);
  REQUIRE(same_map(a, b));
  REQUIRE(a.log_odds(Index<2>(21, 0)) == 0.85F);
}

TEST_CASE("Beams at the maximum range free cells and never hit", "[map]") {
  Map<> map;
  const Scan<2> scan(circular_beams(90, 5.0));
  for (int n = 0; n < 5; ++n) map.update(scan, {}, kExact);
  for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
    REQUIRE(map.log_odds(offset) <= 0.0F);
    REQUIRE(map.grid()[offset].hits == 0);
  }
  REQUIRE(map.log_odds(Index<2>(30, 0)) < -1.0F);
}

TEST_CASE("Only the position's covariance along the beam weakens an update", "[map]") {
  const auto hit_with = [](const Eigen::Matrix3d& covariance) {
    Map<> map;
    map.update(one_beam(2.0), {0.07, 0.05, 0.0}, covariance);
    return map.log_odds(Index<2>(21, 0));
  };
  const float exact = hit_with(kExact);
  REQUIRE(hit_with(Eigen::Vector3d(0.0, 4.0, 1.0).asDiagonal()) == exact);
  REQUIRE(hit_with(Eigen::Vector3d(0.25, 0.0, 0.0).asDiagonal()) < exact);
  REQUIRE(hit_with(Eigen::Vector3d(4.0, 0.0, 0.0).asDiagonal()) < 0.0F);
}

TEST_CASE("A map that runs out of stamps starts them anew without mixing up scans", "[map]") {
  // Scan 5 hits a cell. Scans up to the last stamp look elsewhere. The scan that is number 5 again passes the
  // cell: its own stamp must not look like that of the old hit.
  Map<LogOdds> map;
  const Pose2 there{0.07, 0.05, 0.0};
  const Pose2 elsewhere{0.07, 0.05, 3.0};
  const Index<2> cell(21, 0);
  for (int n = 1; n <= 4; ++n) map.update(one_beam(0.3), elsewhere, kExact);
  map.update(one_beam(2.0), there, kExact);
  REQUIRE(map.stamp() == 5);
  REQUIRE(map.log_odds(cell) == 0.85F);
  while (map.stamp() < Map<LogOdds>::stamp_last) map.update(one_beam(0.3), elsewhere, kExact);
  for (int n = 1; n <= 4; ++n) map.update(one_beam(0.3), elsewhere, kExact);
  REQUIRE(map.stamp() == 4);
  map.update(one_beam(5.0), there, kExact);
  REQUIRE(map.stamp() == 5);
  REQUIRE(map.log_odds(cell) == 0.85F - 0.4F);
}

TEST_CASE("A map before and after the wrap of its stamps takes the same scans to the same belief", "[map]") {
  Map<> map;
  const Scan<2> tiny(circular_beams(0, 10.0));
  while (map.stamp() < Map<>::stamp_last - 10) map.update(tiny, {}, kExact);
  Map<> fresh;
  fresh.update(tiny, {}, kExact);
  Random random(12);
  for (int n = 0; n < 30; ++n) {
    const Pose2 T_map_sensor{0.01 * n, 0.0, 0.02 * n};
    const Scan<2> scan = reference::random_scan<2>(random, 30, 4.0);
    map.update(scan, T_map_sensor, kExact);
    fresh.update(scan, T_map_sensor, kExact);
    for (Offset offset = 0; offset < static_cast<Offset>(fresh.grid().size()); ++offset) {
      REQUIRE(map.log_odds(fresh.grid().index_at(offset)) == fresh.log_odds(offset));
    }
  }
  REQUIRE(map.stamp() == 20);
}

TEST_CASE("Probabilities belong to natural log-odds", "[map]") {
  REQUIRE(probability_of_log_odds(0.0) == 0.5);
  REQUIRE(probability_of_log_odds(std::log(3.0)) == Approx(0.75).epsilon(1e-15));
  REQUIRE(probability_of_log_odds(-1e30) == 0.0);
  REQUIRE(probability_of_log_odds(1e30) == 1.0);
  Map<> map;
  REQUIRE(map.probability(Index<2>(5, -7)) == 0.5);
  REQUIRE(map.log_odds(Index<2>(5, -7)) == 0.0F);
}

TEST_CASE("A map reduces to free, occupied and unknown cells", "[map]") {
  Map<> map;
  for (int n = 0; n < 3; ++n) map.update(one_beam(2.0), {0.07, 0.05, 0.0}, kExact);
  map.reserve({{-1.0, -1.0}, {3.0, 3.0}});
  const OccupancyGrid<2> occupancy = classify(map);
  REQUIRE(occupancy.box().lower == map.grid().box().lower);
  REQUIRE(occupancy.box().upper == map.grid().box().upper);
  REQUIRE(occupancy.value({21, 0}) == Occupancy::occupied);
  REQUIRE(occupancy.value({10, 0}) == Occupancy::free);
  REQUIRE(occupancy.value({22, 0}) == Occupancy::unknown);
  REQUIRE(occupancy.value({1000, 0}) == Occupancy::unknown);
  for (Offset offset = 0; offset < static_cast<Offset>(occupancy.size()); ++offset) {
    REQUIRE(occupancy[offset] == OccupancyThresholds{}.classify(map.log_odds(occupancy.index_at(offset))));
  }
  REQUIRE(classify(map, {-1.0F, 100.0F}).value({21, 0}) == Occupancy::unknown);
  REQUIRE_THROWS_AS(classify(map, {0.0F, 1.0F}), std::invalid_argument);
}

TEST_CASE("A map refuses parameters outside of their bounds", "[map]") {
  for (const double bad : {0.0, -0.1, kDoubleNan, kDoubleInfinity}) {
    REQUIRE_THROWS_AS(Map<>({bad, 0.5}), std::invalid_argument);
  }
  for (const double bad : {-0.1, kDoubleNan, kDoubleInfinity})
    REQUIRE_THROWS_AS(Map<>({0.1, bad}), std::invalid_argument);
  REQUIRE_NOTHROW(Map<>({0.1, 0.0}));
}
