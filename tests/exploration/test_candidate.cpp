#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "../planning/drawn_plan.hpp"
#include "incognita/core/random.hpp"
#include "incognita/entropy/behavioral.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/exploration/candidate.hpp"

namespace incognita {
namespace {

/// Whether the line between the centres of two cells meets an occupied cell whose half side is `half_cells`: all cells
/// of the grid are asked. The target's own cell counts too.
bool is_hidden(const OccupancyGrid<2>& belief, const Index<2>& from, const Index<2>& to, double half_cells) {
  const Eigen::Vector2d way = (to - from).cast<double>();
  for (Offset offset = 0; offset < static_cast<Offset>(belief.size()); ++offset) {
    if (belief[offset] != Occupancy::occupied) continue;
    const Eigen::Vector2d center = (belief.index_at(offset) - from).cast<double>();
    double enter = 0.0;
    double leave = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
      if (way[axis] == 0.0) {
        if (std::abs(center[axis]) >= half_cells) leave = -1.0;
        continue;
      }
      const double a = (center[axis] - half_cells) / way[axis];
      const double b = (center[axis] + half_cells) / way[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (leave >= enter) return true;
  }
  return false;
}

/// Squared distance in cells and cost of the best viewpoint, by asking all cells.
std::pair<int, float> best_viewpoint(const OccupancyGrid<2>& belief, const TravelCostField& field,
                                     const Index<2>& target, int radius_half_cells, double half_cells) {
  std::pair<int, float> best{std::numeric_limits<int>::max(), 0.0F};
  for (Offset offset = 0; offset < static_cast<Offset>(belief.size()); ++offset) {
    const Index<2> index = belief.index_at(offset);
    const int distance2 = (index - target).squaredNorm();
    if (4 * distance2 > radius_half_cells * radius_half_cells || !field.reaches(index)) continue;
    const std::pair<int, float> ranked{distance2, field.cost_m(index)};
    if (ranked < best && !is_hidden(belief, index, target, half_cells)) best = ranked;
  }
  return best;
}

}  // namespace

TEST_CASE("the viewpoint is the nearest reachable cell from which the target is seen") {
  Random random(11);
  int found = 0;
  int certain = 0;
  for (int round = 0; round < 150; ++round) {
    const OccupancyGrid<2> belief = random_belief(random, 30, 26, 0.1);
    const auto random_cell = [&] {
      return Index<2>(static_cast<int>(random.index(30)) - 7, static_cast<int>(random.index(26)) + 3);
    };
    Index<2> start = random_cell();
    while (belief.value(start) != Occupancy::free) start = random_cell();
    const TravelCostField field(belief, clearance_of(belief), belief.lattice().center_m(start));
    const Index<2> target = random_cell();
    const int radius_half_cells = 2 + static_cast<int>(random.index(18));
    const double radius_m = radius_half_cells * 0.05;
    const auto viewpoint = find_viewpoint(belief, field, target, radius_m);

    // A line through the very corner of a cell may count either way.
    const auto strict = best_viewpoint(belief, field, target, radius_half_cells, 0.5 + 1e-6);
    const auto lenient = best_viewpoint(belief, field, target, radius_half_cells, 0.5 - 1e-6);
    const auto none = std::numeric_limits<int>::max();
    CAPTURE(round, radius_m);
    if (!viewpoint) {
      CHECK(strict.first == none);
      continue;
    }
    ++found;
    const std::pair<int, float> chosen{(*viewpoint - target).squaredNorm(), field.cost_m(*viewpoint)};
    CHECK(field.reaches(*viewpoint));
    CHECK_FALSE(is_hidden(belief, *viewpoint, target, 0.5 - 1e-6));
    CHECK(chosen <= strict);
    CHECK(chosen >= lenient);
    if (strict == lenient) ++certain;
  }
  CHECK(found > 40);
  CHECK(certain > 30);
}

TEST_CASE("the unknown cells beside a frontier are found once each, also outside of the grid") {
  Random random(12);
  for (int round = 0; round < 30; ++round) {
    const OccupancyGrid<2> belief = random_belief(random, 24, 20, 0.1);
    for (const Frontier<2>& frontier : find_frontiers(belief, FrontierParams{})) {
      std::set<std::pair<int, int>> expected;
      for (int y = belief.box().lower.y() - 1; y <= belief.box().upper.y(); ++y) {
        for (int x = belief.box().lower.x() - 1; x <= belief.box().upper.x(); ++x) {
          if (belief.value({x, y}) != Occupancy::unknown) continue;
          const bool beside = std::any_of(frontier.cells.begin(), frontier.cells.end(), [&](const Index<2>& cell) {
            return (cell - Index<2>(x, y)).cwiseAbs().sum() == 1;
          });
          if (beside) expected.emplace(x, y);
        }
      }
      std::set<std::pair<int, int>> found;
      const std::vector<Index<2>> unknown = unknown_beside(belief, frontier);
      for (const Index<2>& cell : unknown) found.emplace(cell.x(), cell.y());
      CHECK(found == expected);
      CHECK(found.size() == unknown.size());
      CHECK_FALSE(found.empty());
    }
  }
}

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
