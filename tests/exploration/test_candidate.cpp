#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/entropy/behavioral.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/exploration/candidate.hpp"

namespace incognita {

TEST_CASE("gains of candidates are the same bits for any number of threads") {
  Random random(13);
  GainParams params;
  params.range_max_m = 3.0;
  params.beams = 24;
  Map<TBayes> map(MapParams{0.2, 0.5});
  Scan<2> scan(circular_beams(120, 3.0));
  for (std::size_t beam = 0; beam < scan.size(); beam += 2) scan.set_range_m(beam, random.uniform(1.0, 2.0));
  map.update(scan, {}, Eigen::Matrix3d::Identity() * 1e-4);
  map.reserve({Eigen::Vector2d(-8.0, -8.0), Eigen::Vector2d(8.0, 8.0)});
  std::vector<Candidate> candidates(13);
  for (Candidate& candidate : candidates) {
    candidate.path = Polyline({Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0)),
                               Eigen::Vector2d(random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0))});
  }
  const EntropyTable table(Behavioral{2.0});
  const DvlEkf filter;
  const auto gains = [&](int threads, CandidateScratch<TBayes>& scratch) {
    for (Candidate& candidate : candidates) candidate.gain_nats = -1.0;
    evaluate_candidates(map, table, filter, candidates, params, threads, scratch);
    std::vector<double> result;
    for (const Candidate& candidate : candidates) result.push_back(candidate.gain_nats);
    return result;
  };
  CandidateScratch<TBayes> kept;
  const std::vector<double> expected = gains(1, kept);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    GainWorkspace<TBayes> alone;
    CHECK(expected[i] == information_gain(map, table, filter, candidates[i].path, params, alone));
  }
  for (const int threads : {2, 4, 3, 1, 0}) {
    CandidateScratch<TBayes> fresh;
    CHECK(gains(threads, fresh) == expected);
    CHECK(gains(threads, kept) == expected);
  }
  candidates.clear();
  CHECK(gains(2, kept).empty());
}

}  // namespace incognita
