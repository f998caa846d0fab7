#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/entropy/behavioral.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/exploration/information_gain.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/cells/t_bayes.hpp"

namespace incognita {
namespace {

GainParams coarse_params() {
  GainParams params;
  params.pose_spacing_m = 0.8;
  params.beams = 37;
  params.range_max_m = 4.0;
  return params;
}

/// Half of a room, seen from two places: walls, free space, and unknown behind.
template <class Cell>
Map<Cell> half_seen_room(Random& random, const Cell& cell = Cell{}) {
  Map<Cell> map(MapParams{0.2, 0.5}, cell);
  for (const Eigen::Vector2d& position : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.7, 0.4)}) {
    Scan<2> scan(circular_beams(90, 6.0));
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      const Eigen::Vector2d direction = scan.direction(beam);
      if (direction.x() > 0.3) continue;  // that side is open
      const double to_x_m = std::abs(direction.x()) > 0.0 ? (-2.1 - position.x()) / direction.x() : 1e9;
      const double to_y_m = (direction.y() > 0.0 ? 1.7 - position.y() : -1.9 - position.y()) / direction.y();
      double range_m = 6.0;
      for (const double wall_m : {to_x_m, to_y_m}) {
        if (wall_m > 0.0) range_m = std::min(range_m, wall_m);
      }
      scan.set_range_m(beam, std::min(6.0, std::max(0.1, range_m + random.normal(0.0, 0.01))));
    }
    map.update(scan, {position.x(), position.y(), 0.0}, Eigen::Matrix3d::Identity() * 1e-4);
  }
  map.reserve({Eigen::Vector2d(-12.0, -12.0), Eigen::Vector2d(12.0, 12.0)});
  return map;
}

Polyline random_path(Random& random) {
  std::vector<Eigen::Vector2d> points_m{{0.313, 0.171}};
  for (int corner = 0; corner < 3; ++corner) {
    points_m.push_back(points_m.back() + Eigen::Vector2d(random.uniform(-0.9, 1.2), random.uniform(-0.9, 0.9)));
  }
  return Polyline(points_m);
}

PoseBelief start_of(const Polyline& path, double variance_m2) {
  const Eigen::Vector2d start = path.points_m().front();
  return {{start.x(), start.y(), 0.6}, Eigen::Vector3d(variance_m2, 2.0 * variance_m2, 1e-3).asDiagonal()};
}

DvlEkf ekf_at(const PoseBelief& start) {
  DvlEkf::Params params;
  params.start = start;
  return DvlEkf(params);
}

DeadReckoning reckoning_at(const PoseBelief& start) {
  DeadReckoning::Params params;
  params.start = start;
  params.noise = {0.1, 0.05};
  return DeadReckoning(params);
}

/// (7) written out, element by element.
Eigen::Matrix3d spread(const Eigen::Matrix3d& before, const Eigen::Vector2d& step, const MotionNoise& noise,
                       double duration_s) {
  Eigen::Matrix3d jacobian;
  jacobian << 1.0, 0.0, -step.y(), 0.0, 1.0, step.x(), 0.0, 0.0, 1.0;
  Eigen::Matrix3d after = jacobian * before * jacobian.transpose();
  after(0, 0) += noise.position_m_per_sqrt_s * noise.position_m_per_sqrt_s * duration_s;
  after(1, 1) += noise.position_m_per_sqrt_s * noise.position_m_per_sqrt_s * duration_s;
  after(2, 2) += noise.yaw_rad_per_sqrt_s * noise.yaw_rad_per_sqrt_s * duration_s;
  return after;
}

struct BlockedCell {
  double enter_m = std::numeric_limits<double>::infinity();
  double leave_m = 0.0;
  Index<2> index = Index<2>::Zero();
};

/// The first cell on a ray with log-odds above the bound, found by asking every cell of the map.
template <class Cell>
BlockedCell first_blocked(const Map<Cell>& map, const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                          float above) {
  BlockedCell first;
  const double half_m = 0.5 * map.resolution_m();
  for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
    if (!(map.log_odds(offset) > above)) continue;
    const Index<2> index = map.grid().index_at(offset);
    const Eigen::Vector2d to_center = map.lattice().center_m(index) - origin;
    double enter_m = 0.0;
    double leave_m = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 2; ++axis) {
      if (direction[axis] == 0.0) {
        if (std::abs(to_center[axis]) >= half_m) leave_m = 0.0;
        continue;
      }
      const double middle_m = to_center[axis] / direction[axis];
      const double halfway_m = half_m / std::abs(direction[axis]);
      enter_m = std::max(enter_m, middle_m - halfway_m);
      leave_m = std::min(leave_m, middle_m + halfway_m);
    }
    if (leave_m > enter_m && enter_m < first.enter_m) first = {enter_m, leave_m, index};
  }
  return first;
}

/// Algorithm 1, lines 1 to 14, on a copy of the map, with the entropy of all cells before and after by the exact measure.
template <class Cell, class Measure>
double slow_gain(Map<Cell> map, const Measure& measure, PoseBelief belief, const MotionNoise& noise,
                 const RayUpdateParams* imagined, const Polyline& path, const GainParams& params) {
  const auto map_entropy_nats = [&] {
    double sum = 0.0;
    for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
      sum += measure(1.0 / (1.0 + std::exp(std::abs(static_cast<double>(map.log_odds(offset))))));
    }
    return sum;
  };
  const double before_nats = map_entropy_nats();
  const std::size_t cells_before = map.grid().size();

  const int steps = static_cast<int>(std::ceil(path.length_m() / params.pose_spacing_m));
  Eigen::Vector2d at = path.points_m().front();
  for (int step = 1; step <= steps; ++step) {
    double left_m = path.length_m() * step / steps;
    Eigen::Vector2d to = path.points_m().back();
    for (std::size_t corner = 1; corner < path.points_m().size(); ++corner) {
      const Eigen::Vector2d side = path.points_m()[corner] - path.points_m()[corner - 1];
      if (left_m <= side.norm()) {
        to = path.points_m()[corner - 1] + side.normalized() * left_m;
        break;
      }
      left_m -= side.norm();
    }
    const double duration_s = (to - at).norm() / params.speed_m_per_s;
    belief.covariance = spread(belief.covariance, to - at, noise, duration_s);
    at = to;

    Scan<2> scan(circular_beams(static_cast<std::size_t>(params.beams), params.range_max_m));
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      const BlockedCell blocked = first_blocked(map, at, scan.direction(beam), map.blocked_above());
      if (blocked.enter_m >= params.range_max_m) continue;
      const double range_m = 0.5 * (blocked.enter_m + blocked.leave_m) - map.hit_push_m();
      if (range_m <= 0.0 || range_m >= params.range_max_m) {
        scan.set_range_m(beam, std::numeric_limits<double>::quiet_NaN());
        continue;
      }
      scan.set_range_m(beam, range_m);
      if (imagined == nullptr) continue;
      const double p = map.probability(blocked.index);
      const double variance_m2 = p * p * imagined->dvl.occupied_m2 + (1.0 - p) * (1.0 - p) * imagined->dvl.unoccupied_m2;
      Eigen::Vector3d h = Eigen::Vector3d::Zero();
      h.head<2>() = (at - map.lattice().center_m(blocked.index)).normalized();
      information += imagined->gamma / params.beams / variance_m2 * h * h.transpose();
    }
    const double scans = std::max(1.0, duration_s * params.scan_rate_hz);
    belief.covariance = (belief.covariance.inverse() + scans * information).inverse();
    belief.covariance = (0.5 * (belief.covariance + belief.covariance.transpose())).eval();
    map.update(scan, {at.x(), at.y(), 0.0}, belief.covariance);
  }
  REQUIRE(map.grid().size() == cells_before);
  return before_nats - map_entropy_nats();
}

template <class Cell>
std::size_t changed_count(const Overlay<Cell>& overlay) {
  std::size_t count = 0;
  overlay.for_each_changed_cell([&](const auto&) { ++count; });
  return count;
}

template <class Cell>
void check_against_slow_gain(std::uint64_t seed, const Cell& cell = Cell{}) {
  Random random(seed);
  for (int round = 0; round < 6; ++round) {
    const Map<Cell> map = half_seen_room<Cell>(random, cell);
    const Polyline path = random_path(random);
    const GainParams params = coarse_params();
    const Behavioral measure{round % 2 == 0 ? 0.5 : 2.0};
    const EntropyTable table(measure);
    const PoseBelief start = start_of(path, random.uniform(1e-4, 0.3));
    GainWorkspace<Cell> workspace;

    const DvlEkf ekf = ekf_at(start);
    const double gain = information_gain(map, table, ekf, path, params, workspace);
    const double slow = slow_gain(map, measure, start, ekf.params().noise, &ekf.params().imagined, path, params);
    const double table_error = 2.0 * table.max_error_nats() * static_cast<double>(changed_count(workspace.overlay));
    CAPTURE(round, table_error);
    CHECK(gain > 10.0);
    CHECK(gain == Approx(slow).epsilon(1e-5).margin(table_error));

    const double reckoned = information_gain(map, table, reckoning_at(start), path, params, workspace);
    CHECK(reckoned == Approx(slow_gain(map, measure, start, {0.1, 0.05}, nullptr, path, params))
                          .epsilon(1e-5)
                          .margin(table_error));
  }
}

}  // namespace

TEST_CASE("information gain is the entropy that predicted scans take from a copy of the map") {
  SECTION("TBayes, robust") { check_against_slow_gain<TBayes>(1); }
  SECTION("TBayes, literal within bounds") {
    TBayes::Params literal;
    literal.rule = TBayes::Rule::literal;
    check_against_slow_gain<TBayes>(2, TBayes(literal));
  }
  SECTION("LogOdds") { check_against_slow_gain<LogOdds>(3); }
}

TEST_CASE("information gain leaves the map and the filter as they are") {
  Random random(4);
  const Map<TBayes> map = half_seen_room<TBayes>(random);
  const Polyline path = random_path(random);
  const DvlEkf filter = ekf_at(start_of(path, 0.01));
  std::vector<float> before;
  for (Offset i = 0; i < static_cast<Offset>(map.grid().size()); ++i) before.push_back(map.log_odds(i));
  GainWorkspace<TBayes> workspace;
  CHECK(information_gain(map, EntropyTable(Shannon{}), filter, path, coarse_params(), workspace) > 0.0);
  std::vector<float> after;
  for (Offset i = 0; i < static_cast<Offset>(map.grid().size()); ++i) after.push_back(map.log_odds(i));
  CHECK(before == after);
  CHECK(filter.belief().covariance(0, 0) == 0.01);
}

TEST_CASE("a path that leads nowhere gains nothing") {
  Random random(5);
  const Map<TBayes> map = half_seen_room<TBayes>(random);
  const Polyline path = random_path(random);
  const DvlEkf filter = ekf_at(start_of(path, 0.01));
  GainWorkspace<TBayes> workspace;
  const EntropyTable table(Shannon{});
  CHECK(information_gain(map, table, filter, Polyline{}, coarse_params(), workspace) == 0.0);
  CHECK(information_gain(map, table, filter, Polyline({path.points_m().front()}), coarse_params(), workspace) == 0.0);
  CHECK(changed_count(workspace.overlay) == 0);
}

TEST_CASE("a path out of the room that the map has is refused") {
  Random random(7);
  const Map<TBayes> map = half_seen_room<TBayes>(random);
  const DvlEkf filter;
  GainWorkspace<TBayes> workspace;
  const EntropyTable table(Shannon{});
  for (const Eigen::Vector2d& to : {Eigen::Vector2d(30.0, 0.0), Eigen::Vector2d(0.0, -1e6), Eigen::Vector2d(1e9, 1e9)}) {
    const Polyline path({Eigen::Vector2d(0.0, 0.0), to});
    GainParams params = coarse_params();
    params.pose_spacing_m = 1e15;
    CHECK_THROWS_AS(information_gain(map, table, filter, path, params, workspace), std::length_error);
  }
}

TEST_CASE("a workspace that has served before gives the same bits as a new one") {
  Random random(6);
  const Map<TBayes> large = half_seen_room<TBayes>(random);
  Map<TBayes> empty(MapParams{0.3, 0.5});
  empty.reserve({Eigen::Vector2d(-9.0, -9.0), Eigen::Vector2d(9.0, 9.0)});
  const EntropyTable table(Behavioral{0.7});
  GainWorkspace<TBayes> kept;
  for (int round = 0; round < 8; ++round) {
    const Map<TBayes>& map = round % 3 == 2 ? empty : large;
    const Polyline path = random_path(random);
    const DvlEkf filter = ekf_at(start_of(path, 0.02));
    GainWorkspace<TBayes> fresh;
    const double expected = information_gain(map, table, filter, path, coarse_params(), fresh);
    CHECK(information_gain(map, table, filter, path, coarse_params(), kept) == expected);
    // Also for other beams.
    GainParams other = coarse_params();
    other.beams = 7;
    other.range_max_m = 2.0;
    GainWorkspace<TBayes> fresh_other;
    CHECK(information_gain(map, table, filter, path, other, kept) ==
          information_gain(map, table, filter, path, other, fresh_other));
  }
}

// Theorem 5.1 of Seo et al. holds for cells that were never hit and whose residual r has r^2 >= S, and only there.
TEST_CASE("far before the end of its beams a more certain pose clears unknown cells better") {
  GainParams params = coarse_params();
  params.beams = 60;
  Map<TBayes> map(MapParams{0.2, 0.5});
  map.reserve({Eigen::Vector2d(-8.0, -8.0), Eigen::Vector2d(8.0, 8.0)});
  const Eigen::Vector2d goal(0.433, 0.291);
  const Polyline path({Eigen::Vector2d(0.113, 0.071), goal});
  REQUIRE(path.length_m() < params.pose_spacing_m);
  const EntropyTable shannon(Shannon{});
  const MotionNoise noise{0.1, 0.05};

  GainWorkspace<TBayes> certain;
  GainWorkspace<TBayes> uncertain;
  const PoseBelief start = start_of(path, 1e-3);
  const PoseBelief spread_start = start_of(path, 0.4);
  (void)information_gain(map, shannon, reckoning_at(start), path, params, certain);
  (void)information_gain(map, shannon, reckoning_at(spread_start), path, params, uncertain);

  const Eigen::Matrix3d covariance = spread(spread_start.covariance, goal - path.points_m().front(), noise,
                                            path.length_m() / params.speed_m_per_s);
  const double sigma_m = position_sigma_m(covariance);
  const double s_max_m2 = sigma_m * sigma_m + TBayes::Params{}.dvl.occupied_m2;
  std::size_t compared = 0;
  std::size_t strictly = 0;
  REQUIRE(changed_count(certain.overlay) == changed_count(uncertain.overlay));
  certain.overlay.for_each_changed_cell([&](const Index<2>& index) {
    const double distance_m = (map.lattice().center_m(index) - goal).norm();
    const double residual_m = params.range_max_m - distance_m;
    if (residual_m <= 0.0 || residual_m * residual_m < s_max_m2) return;
    ++compared;
    const float sure = certain.overlay.log_odds(index);
    const float unsure = uncertain.overlay.log_odds(index);
    CHECK(sure <= unsure);
    CHECK(shannon(sure) <= shannon(unsure));
    if (sure < unsure) ++strictly;
  });
  CHECK(compared > 200);
  CHECK(strictly > 50);
}

TEST_CASE("gain parameters out of bounds are refused by name") {
  const auto refused = [](auto change, const char* field) {
    GainParams params;
    change(params);
    CHECK_THROWS_WITH(params.validate(), Catch::Contains("GainParams") && Catch::Contains(field));
  };
  refused([](GainParams& p) { p.pose_spacing_m = 0.0; }, "pose_spacing_m");
  refused([](GainParams& p) { p.beams = 0; }, "beams");
  refused([](GainParams& p) { p.range_max_m = -1.0; }, "range_max_m");
  refused([](GainParams& p) { p.speed_m_per_s = std::nan(""); }, "speed_m_per_s");
  refused([](GainParams& p) { p.scan_rate_hz = 0.0; }, "scan_rate_hz");
}

}  // namespace incognita
