#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <vector>

#include "../allocations.hpp"
#include "incognita/core/random.hpp"
#include "incognita/entropy/behavioral.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/exploration/candidate.hpp"
#include "incognita/frontier/frontier_layer.hpp"
#include "incognita/map/entropy_layer.hpp"
#include "incognita/map/map.hpp"
#include "room.hpp"

using namespace incognita;
using test::allocation_count;

TEST_CASE("A filter in a room that it knows allocates nothing for a scan, and for pieces only now and then", "[estimation]") {
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  Random random(1);
  DvlEkf filter;
  Map<> map;
  std::size_t in_correct = 0;
  std::size_t in_learn = 0;
  for (int scan_number = 0; scan_number < 1500; ++scan_number) {
    const double along_m = 0.5 * std::sin(0.01 * scan_number);
    const Pose2 truth{along_m, 0.0, 0.0};
    Scan<2> scan = room::scan_of(walls, truth);
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (scan.reading(beam) == Reading::hit) scan.set_range_m(beam, scan.range_m(beam) + random.normal(0.0, 0.01));
    }
    const double step_m = 0.5 * (std::sin(0.01 * (scan_number + 1)) - std::sin(0.01 * scan_number));
    const bool is_warm = scan_number >= 1000;
    std::size_t before = allocation_count();
    const CorrectionReport report = filter.correct(scan, map);
    if (is_warm) in_correct += allocation_count() - before;
    REQUIRE(report.trusted);
    map.update(scan, filter.belief().pose, filter.belief().covariance);
    before = allocation_count();
    filter.learn(scan);
    if (is_warm) in_learn += allocation_count() - before;
    filter.predict({step_m, 0.0, 0.0}, 0.1);
  }
  CHECK(in_correct == 0);
  CHECK(in_learn <= 3);  // the list of pieces, which doubles
}

TEST_CASE("A map that has grown, what follows it, and predictions on it allocate nothing", "[map]") {
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  Random random(2);
  const EntropyTable entropy(Behavioral{0.7});
  const DvlEkf filter;
  Map<> map;
  map.reserve({Eigen::Vector2d(-16.0, -16.0), Eigen::Vector2d(16.0, 16.0)});
  OccupancyLayer occupancy(map.lattice());
  FrontierLayer frontier(map.lattice());
  EntropyLayer<EntropyTable> information(map.lattice(), entropy);
  CandidateScratch<TBayes> scratch;
  std::vector<Candidate> candidates(3);
  for (Candidate& candidate : candidates) {
    candidate.path = Polyline({Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0))});
  }
  std::size_t in_update = 0;
  std::size_t in_layers = 0;
  std::size_t in_candidates = 0;
  for (int scan_number = 0; scan_number < 400; ++scan_number) {
    const Pose2 truth{0.4 * std::sin(0.1 * scan_number), 0.3 * std::cos(0.07 * scan_number), 0.01 * scan_number};
    const Scan<2> scan = room::scan_of(walls, truth);
    const bool is_warm = scan_number >= 200;
    std::size_t before = allocation_count();
    map.update(scan, truth, Eigen::Matrix3d::Identity() * 1e-4);
    if (is_warm) in_update += allocation_count() - before;
    before = allocation_count();
    occupancy.follow(map);
    frontier.follow(occupancy);
    information.follow(map);
    if (is_warm) in_layers += allocation_count() - before;
    before = allocation_count();
    evaluate_candidates(map, entropy, filter, candidates, GainParams{}, 1, scratch);
    if (is_warm) in_candidates += allocation_count() - before;
  }
  CHECK(in_update == 0);
  CHECK(in_layers == 0);
  CHECK(in_candidates == 0);
}
