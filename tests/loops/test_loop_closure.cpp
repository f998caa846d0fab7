#include <Eigen/Core>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "../estimation/room.hpp"
#include "incognita/core/random.hpp"
#include "incognita/entropy/behavioral.hpp"
#include "incognita/estimation/slam.hpp"
#include "incognita/exploration/explorer.hpp"
#include "incognita/loops/loop_closure.hpp"
#include "incognita/map/occupancy.hpp"
#include "incognita/testing/estimator_laws.hpp"
#include "ring.hpp"

using namespace incognita;
using test::ring;
using test::way_around;

namespace {

struct Drive {
  double error_max_m = 0.0;       ///< after a whole lap
  double doubled_share = 0.0;     ///< of the occupied cells, those more than 0.2 m from any wall
  int redrawn = 0;
  std::size_t scans_kept = 0;
};

double distance_to_wall_m(const Eigen::Vector2d& point_m, const std::vector<room::Wall>& walls) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const room::Wall& wall : walls) {
    const Eigen::Vector2d along = wall.to - wall.from;
    const double share = std::clamp((point_m - wall.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest_m = std::min(nearest_m, (point_m - wall.from - share * along).norm());
  }
  return nearest_m;
}

/// One and a half laps. Once the scanner sees nothing for 11 m, while odometry errs by 0.05 m and 0.004 rad: what is mapped then
/// hangs together, and is off.
Drive drive_around(const LoopClosingDvlEkf::Params& filter_params) {
  const std::vector<room::Wall> walls = ring();
  const std::vector<Pose2> way = way_around(1.5);
  Random random(5);
  LoopClosingDvlEkf::Params params = filter_params;
  params.start.pose = way.front();
  params.uses_compass = false;
  Slam<Map<>, LoopClosingDvlEkf> slam{LoopClosingDvlEkf(params)};
  const auto scan_at = [&](const Pose2& pose) {
    Scan<2> scan = room::scan_of(walls, pose, circular_beams(180, 5.0));
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (scan.reading(beam) == Reading::hit) scan.set_range_m(beam, scan.range_m(beam) + random.normal(0.0, 0.005));
    }
    return scan;
  };
  Drive drive;
  for (int still = 0; still < 20; ++still) slam.observe(scan_at(way.front()));
  for (std::size_t i = 1; i < way.size(); ++i) {
    Pose2 increment = way[i - 1].inverse() * way[i];
    const bool is_blind = i >= 300 && i < 410;
    increment.x_m += is_blind ? 0.05 / 110.0 : random.normal(0.0, 0.001);
    increment.yaw_rad += is_blind ? -0.004 / 110.0 : random.normal(0.0, 0.001);
    slam.move(increment, 0.1);
    Scan<2> scan = scan_at(way[i]);
    for (std::size_t beam = 0; is_blind && beam < scan.size(); ++beam) {
      scan.set_range_m(beam, std::numeric_limits<double>::quiet_NaN());
    }
    if (slam.observe(scan).is_redrawn) ++drive.redrawn;
    if (i > way.size() * 5 / 6) {
      drive.error_max_m = std::max(drive.error_max_m, distance(slam.belief().pose.position(), way[i].position()));
    }
  }
  double occupied = 0.0;
  const OccupancyGrid<2> occupancy = classify(slam.map());
  for (Offset offset = 0; offset < static_cast<Offset>(occupancy.size()); ++offset) {
    if (occupancy[offset] != Occupancy::occupied) continue;
    occupied += 1.0;
    const Eigen::Vector2d center_m = occupancy.lattice().center_m(occupancy.index_at(offset));
    if (distance_to_wall_m(center_m, walls) > 0.2) drive.doubled_share += 1.0;
  }
  drive.doubled_share /= occupied;
  drive.scans_kept = slam.filter().loops().kept().size();
  return drive;
}

LoopClosingDvlEkf::Params closing(bool closes_loops) {
  LoopClosingDvlEkf::Params params;
  params.loops.closes_loops = closes_loops;
  return params;
}

}  // namespace

TEST_CASE("A ring that does not close is torn without loops, and whole with them", "[loops]") {
  const Drive torn = drive_around(closing(false));
  const Drive whole = drive_around(closing(true));
  CHECK(torn.redrawn == 0);
  CHECK(torn.scans_kept == 0);
  CHECK(torn.error_max_m > 0.1);
  CHECK(torn.doubled_share > 0.03);
  CHECK(whole.redrawn > 0);
  CHECK(whole.scans_kept > 1000);
  CHECK(whole.error_max_m < 0.6 * torn.error_max_m);
  CHECK(whole.doubled_share < 0.2 * torn.doubled_share);
}

TEST_CASE("What is new is moved by as much as it is off from what is old, also far off", "[loops]") {
  Random random(7);
  for (const double off_m : {0.03, 0.06, 0.1}) {
    const double towards_rad = random.uniform(-3.0, 3.0);
    const Eigen::Vector2d off(off_m * std::cos(towards_rad), off_m * std::sin(towards_rad));
    const std::vector<room::Wall> walls = room::box(room::kTurned);
    const Pose2 robot = room::kTurned * Pose2{0.3, -0.2, 0.4};
    MapDrift::Params drift_params;
    drift_params.scans_per_piece = 1;
    MapDrift drift(drift_params);
    SurfaceMap<2> surfaces;
    LoopClosure loops;
    const RegistrationParams registration;
    const Scan<2> nothing(circular_beams(360, 10.0));
    const int pieces = 41;
    for (int piece = 0; piece < pieces; ++piece) {
      REQUIRE(drift.piece_of_scan(diagonal_covariance(1e-4, 1e-4, 1e-5), robot.position()) == piece);
      REQUIRE(loops.add_keyframe({nothing, robot, {}}, registration, surfaces, drift).norm() == 0.0);
      loops.keep(nothing, {robot, Eigen::Matrix3d::Zero()}, piece, drift);
      loops.add_motion(diagonal_covariance(1e-3, 1e-3, 1e-4), robot.position());
    }
    // The left half of the room was seen first, the right half last, and put down elsewhere.
    const Scan<2> scan = room::scan_of(walls, robot, 720);
    for (int pass = 0; pass < 5; ++pass) {
      for (std::size_t beam = 0; beam < scan.size(); ++beam) {
        const Eigen::Vector2d direction = robot.rotation() * scan.direction(beam);
        const Eigen::Vector2d at_m = robot * scan.end_point_m(beam);
        const bool is_old = (room::kTurned.inverse() * at_m).x() < 0.0;
        surfaces.add(is_old ? at_m : at_m + off, direction, is_old ? 0 : pieces - 1,
                     [](int, const Eigen::Vector2d&) { return Eigen::Vector2d(0.0, 0.0); });
      }
    }
    surfaces.refresh_normals();
    REQUIRE(drift.piece_of_scan(diagonal_covariance(1e-4, 1e-4, 1e-5), robot.position()) == pieces);
    const Eigen::Vector3d moved = loops.add_keyframe({scan, robot, {}}, registration, surfaces, drift);
    CAPTURE(off_m, towards_rad, moved, drift.twist(pieces - 1));
    CHECK(twist_shift_m(moved, robot.position()).norm() < 0.01);
    const Eigen::Vector2d shift = twist_shift_m(drift.twist(pieces - 1), robot.position());
    CHECK((shift + off).norm() < 0.1 * off_m + 0.005);
    // Those between share it in the order of their birth.
    for (int piece = 1; piece < pieces; ++piece) {
      const Eigen::Vector2d at = twist_shift_m(drift.twist(piece), robot.position());
      const Eigen::Vector2d expected = shift * (static_cast<double>(piece) / (pieces - 1));
      REQUIRE((at - expected).norm() < 0.03 * off_m + 0.002);
    }
    CHECK(loops.is_redraw_due() == (off_m > 0.05));
  }
}

TEST_CASE("An explorer whose map is drawn again goes on deciding in it", "[loops]") {
  const std::vector<room::Wall> walls = ring();
  const std::vector<Pose2> way = way_around(1.2);
  LoopClosingDvlEkf::Params filter = closing(true);
  filter.start.pose = way.front();
  filter.loops.solution_shift_m = filter.loops.redraw_shift_m = 1e-6;  // whatever moves
  ExplorerParams params;
  params.threads = 1;
  params.gain.range_max_m = 5.0;
  Explorer<Map<>, Behavioral, LoopClosingDvlEkf> explorer(params, Map<>{}, Behavioral{}, LoopClosingDvlEkf(filter));
  Random random(1);
  int decided_after = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    explorer.move(way[i - 1].inverse() * way[i] * Pose2{0.0, 0.0, random.normal(0.0, 0.002)}, 0.1);
    const int redraws = explorer.filter().loops().redraws();
    explorer.observe(room::scan_of(walls, way[i], circular_beams(90, 5.0)));
    const bool has_decided = explorer.decide();
    if (explorer.filter().loops().redraws() == redraws) continue;
    CHECK((has_decided || explorer.stopped()));
    ++decided_after;
  }
  CHECK(decided_after > 0);
  CHECK((!explorer.stopped() || *explorer.stopped() != StopReason::lost));
}

TEST_CASE("A filter whose loops are not closed is the filter without loops, to the bit", "[loops]") {
  const std::vector<room::Wall> walls = ring();
  const std::vector<Pose2> way = way_around(0.3);
  LoopClosingDvlEkf::Params params = closing(false);
  params.start.pose = way.front();
  DvlEkf::Params plain_params;
  plain_params.start.pose = way.front();
  Slam<Map<>, LoopClosingDvlEkf> slam{LoopClosingDvlEkf(params)};
  Slam<Map<>, DvlEkf> plain{DvlEkf(plain_params)};
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Pose2 increment = way[i - 1].inverse() * way[i] * Pose2{0.001, 0.0, 0.0005};
    const Scan<2> scan = room::scan_of(walls, way[i], circular_beams(90, 5.0));
    slam.move(increment, 0.1);
    plain.move(increment, 0.1);
    slam.observe(scan);
    plain.observe(scan);
    REQUIRE(slam.belief().pose.x_m == plain.belief().pose.x_m);
    REQUIRE(slam.belief().pose.yaw_rad == plain.belief().pose.yaw_rad);
    REQUIRE(slam.belief().covariance == plain.belief().covariance);
  }
}

TEST_CASE("A map that was given is not lost when it is drawn again", "[loops]") {
  const std::vector<room::Wall> walls = ring();
  Map<> given;
  const Pose2 far{60.0, 60.0, 0.0};
  given.update(room::scan_of(room::box(far), far, circular_beams(360, 5.0)), far, Eigen::Matrix3d::Zero());
  LoopClosingDvlEkf::Params params = closing(true);
  params.loops.solution_shift_m = params.loops.redraw_shift_m = 1e-6;  // whatever moves
  const std::vector<Pose2> way = way_around(1.2);
  params.start.pose = way.front();
  Slam<Map<>, LoopClosingDvlEkf> slam(LoopClosingDvlEkf(params), given);
  int redrawn = 0;
  Random random(1);
  for (std::size_t i = 1; i < way.size(); ++i) {
    slam.move(way[i - 1].inverse() * way[i] * Pose2{0.0, 0.0, random.normal(0.0, 0.002)}, 0.1);
    if (slam.observe(room::scan_of(walls, way[i], circular_beams(90, 5.0))).is_redrawn) ++redrawn;
  }
  REQUIRE(redrawn > 0);
  const Index<2> wall = given.lattice().index_of(far.position() + Eigen::Vector2d(3.05, 0.0));
  CHECK(given.probability(wall) > 0.8);
  CHECK(slam.map().probability(wall) == given.probability(wall));
  CHECK(distance(slam.belief().pose.position(), way.back().position()) < 0.2);
}

TEST_CASE("The filter that closes loops keeps the laws of an estimator", "[loops]") {
  CHECK(check_estimator_laws(LoopClosingDvlEkf()).text() == "");
}

TEST_CASE("Parameters of loops out of bounds are refused by name", "[loops]") {
  const auto refused = [](auto change, const char* field, const char* value) {
    LoopClosure::Params params;
    change(params);
    CHECK_THROWS_WITH(LoopClosure(params), Catch::Contains(field) && Catch::Contains(value));
  };
  refused([](auto& p) { p.age_share_min = 0.75; }, "age_share_min", "0.75");
  refused([](auto& p) { p.age_gap_pieces = 0; }, "age_gap_pieces", "0");
  refused([](auto& p) { p.pieces_between_solutions = -3; }, "pieces_between_solutions", "-3");
  refused([](auto& p) { p.redraw_shift_m = 0.0; }, "redraw_shift_m", "0");
  refused([](auto& p) { p.scans_max = 1; }, "scans_max", "1");
}
