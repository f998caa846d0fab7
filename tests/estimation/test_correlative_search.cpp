#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/estimation/correlative_search.hpp"
#include "incognita/estimation/registration.hpp"
#include "room.hpp"

using namespace incognita;
using Catch::Matchers::Contains;

namespace {

using std::numbers::pi;

/// Surfaces as scans from some poses leave them.
SurfaceMap<2> mapped(const std::vector<room::Wall>& walls, const std::vector<Pose2>& poses) {
  SurfaceMap<2> surfaces;
  for (const Pose2& pose : poses) {
    const Scan<2> scan = room::scan_of(walls, pose);
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (scan.reading(beam) != Reading::hit) continue;
      surfaces.add(pose * scan.end_point_m(beam), pose.rotation() * scan.direction(beam));
    }
  }
  surfaces.refresh_normals();
  return surfaces;
}

/// A rectangle with a pillar and a partition, so that no turn and no mirror takes it to itself.
std::vector<room::Wall> asymmetric_room(const Pose2& T_map_room) {
  std::vector<room::Wall> walls = room::box(T_map_room);
  const auto add = [&](double x0, double y0, double x1, double y1) {
    walls.push_back({T_map_room * Eigen::Vector2d(x0, y0), T_map_room * Eigen::Vector2d(x1, y1)});
  };
  add(1.0, -2.0, 1.0, -0.7);
  add(-2.2, 0.9, -1.7, 0.9);
  add(-1.7, 0.9, -1.7, 1.4);
  add(-1.7, 1.4, -2.2, 1.4);
  add(-2.2, 1.4, -2.2, 0.9);
  return walls;
}

/// A few walls and blobs anywhere, seen from anywhere.
SurfaceMap<2> random_surfaces(Random& random) {
  SurfaceMap<2> surfaces;
  for (int piece = 0; piece < 6; ++piece) {
    const Eigen::Vector2d from{random.uniform(-2.0, 2.0),
                               random.uniform(-2.0, 2.0)};  // braces: drawn in order
    const double angle_rad = random.uniform(-pi, pi);
    const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
    const double view_rad = random.uniform(-pi, pi);
    const bool is_blob = piece % 3 == 2;
    for (int n = 0; n < 60; ++n) {
      const Eigen::Vector2d point =
          is_blob ? Eigen::Vector2d(from + 0.1 * Eigen::Vector2d{random.normal(), random.normal()})
                  : Eigen::Vector2d(from + 0.02 * n * along);
      surfaces.add(point, {std::cos(view_rad), std::sin(view_rad)});
    }
  }
  surfaces.refresh_normals();
  return surfaces;
}

Scan<2> random_scan(Random& random, std::size_t beams) {
  const double first_rad = random.uniform(-pi, pi);
  Scan<2> scan(planar_beams(beams, first_rad, random.uniform(0.02, 0.2), 4.0));
  for (std::size_t beam = 0; beam < beams; ++beam) {
    if (random.uniform() < 0.8) scan.set_range_m(beam, random.uniform(0.3, 2.5));
  }
  return scan;
}

/// What CorrelativeSearch promises, by looking at every pose.
class BruteForce {
 public:
  BruteForce(const Scan<2>& scan, const SurfaceMap<2>& surfaces, const Pose2& center,
             const Eigen::Matrix3d* covariance, const SearchWindow& window,
             const CorrelativeSearchParams& params)
      : params_(params) {
    double longest_m = 0.0;
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (scan.reading(beam) != Reading::hit) continue;
      longest_m = std::max(longest_m, scan.range_m(beam));
      ++hits_;
    }
    if (hits_ == 0) return;
    double yaw_step_rad = params.yaw_step_rad > 0.0 ? params.yaw_step_rad : params.step_m / longest_m;
    half_x_ = static_cast<int>(std::floor(window.x_m / params.step_m + 1e-6));
    half_y_ = static_cast<int>(std::floor(window.y_m / params.step_m + 1e-6));
    half_turn_ = static_cast<int>(std::floor(std::min(window.yaw_rad, pi) / yaw_step_rad + 1e-6));
    turns_ = 2 * half_turn_ + 1;
    circle_ = window.yaw_rad >= pi;
    if (circle_) {
      turns_ = static_cast<int>(std::ceil(2.0 * pi / yaw_step_rad - 1e-6));
      half_turn_ = turns_ / 2;
      yaw_step_rad = 2.0 * pi / turns_;
    }
    yaw_step_rad_ = yaw_step_rad;
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    if (covariance != nullptr) {
      const double step_m2 = params.step_m * params.step_m / 12.0;
      information =
          (*covariance + diagonal_covariance(step_m2, step_m2, yaw_step_rad * yaw_step_rad / 12.0)).inverse();
    }

    // The likelihood of cells around the centre, far enough for every end point.
    const int reach = static_cast<int>(std::ceil(longest_m / params.step_m)) + 2;
    const int columns = 2 * (reach + half_x_) + 2;
    const int rows = 2 * (reach + half_y_) + 2;
    const Eigen::Vector2d corner(center.x_m - (reach + half_x_) * params.step_m,
                                 center.y_m - (reach + half_y_) * params.step_m);
    LikelihoodGrid<2> likelihood;
    likelihood.rebuild(surfaces, Lattice<2>(params.step_m, corner), columns, rows, params.sigma_m);

    values_.assign(static_cast<std::size_t>(turns_ * width() * height()), -1e300);
    scores_.assign(values_.size(), 0);
    for (int turn = 0; turn < turns_; ++turn) {
      const double offset_rad = (turn - half_turn_) * yaw_step_rad;
      const Pose2 turned{0.0, 0.0, center.yaw_rad + offset_rad};
      struct End {
        int column, row, layer;
      };
      std::vector<End> ends;
      for (std::size_t beam = 0; beam < scan.size(); ++beam) {
        if (scan.reading(beam) != Reading::hit) continue;
        const Eigen::Vector2d end = turned * scan.end_point_m(beam) / params.step_m;
        const Eigen::Vector2d direction = turned * scan.direction(beam);
        const double eighths = std::atan2(direction.y(), direction.x()) / (pi / 4.0);
        ends.push_back({static_cast<int>(std::floor(end.x() + reach)),
                        static_cast<int>(std::floor(end.y() + reach)),
                        static_cast<int>(std::lround(eighths) + 8) % 8});
      }
      for (int y = 0; y < height(); ++y) {
        for (int x = 0; x < width(); ++x) {
          long score = 0;
          for (const End& end : ends) score += likelihood.value(end.layer, end.column + x, end.row + y);
          const Eigen::Vector3d offset((x - half_x_) * params.step_m, (y - half_y_) * params.step_m,
                                       offset_rad);
          const double cost = params.prior_weight * offset.dot(information * offset) * 255.0 * hits_;
          if (score > 0) value(x, y, turn) = static_cast<double>(score) - std::floor(cost);
          scores_[index(x, y, turn)] = score;
        }
      }
    }
  }

  struct Found {
    int x, y, turn;
    double score, objective;
  };

  [[nodiscard]] std::vector<Found> candidates() const {
    std::vector<Found> maxima;
    const double unit = 1.0 / (255.0 * hits_);
    for (int turn = 0; turn < turns_; ++turn) {
      for (int y = 0; y < height(); ++y) {
        for (int x = 0; x < width(); ++x) {
          const std::size_t at = index(x, y, turn);
          if (scores_[at] > 0 && is_maximum(x, y, turn)) {
            maxima.push_back({x, y, turn, static_cast<double>(scores_[at]) * unit, values_[at] * unit});
          }
        }
      }
    }
    // In order of index already; a stable sort keeps that among equals.
    std::stable_sort(maxima.begin(), maxima.end(),
                     [](const Found& a, const Found& b) { return a.objective > b.objective; });
    std::vector<Found> taken;
    for (const Found& found : maxima) {
      if (static_cast<int>(taken.size()) == params_.candidates_max) break;
      if (found.objective < maxima[0].objective - params_.objective_margin - 1e-12) break;
      const bool is_near = std::any_of(taken.begin(), taken.end(), [&](const Found& other) {
        int turns = std::abs(found.turn - other.turn);
        if (circle_) turns = std::min(turns, turns_ - turns);
        return std::hypot(found.x - other.x, found.y - other.y) * params_.step_m <
                   params_.separation_m - 1e-9 &&
               turns * yaw_step_rad_ < params_.separation_rad - 1e-9;
      });
      if (!is_near) taken.push_back(found);
    }
    return taken;
  }

  [[nodiscard]] Pose2 pose(const Pose2& center, const Found& found) const {
    return {center.x_m + (found.x - half_x_) * params_.step_m,
            center.y_m + (found.y - half_y_) * params_.step_m,
            center.yaw_rad + (found.turn - half_turn_) * yaw_step_rad_};
  }

 private:
  [[nodiscard]] int width() const { return 2 * half_x_ + 1; }
  [[nodiscard]] int height() const { return 2 * half_y_ + 1; }
  [[nodiscard]] std::size_t index(int x, int y, int turn) const {
    return static_cast<std::size_t>((turn * height() + y) * width() + x);
  }
  double& value(int x, int y, int turn) { return values_[index(x, y, turn)]; }

  [[nodiscard]] bool is_maximum(int x, int y, int turn) const {
    for (int dturn = -1; dturn <= 1; ++dturn) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          int other_turn = turn + dturn;
          if (circle_) other_turn = (other_turn + turns_) % turns_;
          if (other_turn < 0 || other_turn >= turns_ || x + dx < 0 || x + dx >= width() || y + dy < 0 ||
              y + dy >= height()) {
            continue;
          }
          const std::size_t here = index(x, y, turn);
          const std::size_t there = index(x + dx, y + dy, other_turn);
          if (values_[there] > values_[here] || (values_[there] == values_[here] && there < here))
            return false;
        }
      }
    }
    return true;
  }

  CorrelativeSearchParams params_;
  int hits_ = 0;
  int half_x_ = 0;
  int half_y_ = 0;
  int half_turn_ = 0;
  int turns_ = 0;
  bool circle_ = false;
  double yaw_step_rad_ = 0.0;
  std::vector<double> values_;
  std::vector<long> scores_;
};

/// Requires a search to find what looking at every pose finds; returns how many candidates.
std::size_t compare(CorrelativeSearch<2>& search, const Scan<2>& scan, const SurfaceMap<2>& surfaces,
                    const Pose2& center, const Eigen::Matrix3d* covariance, const SearchWindow& window) {
  const BruteForce every(scan, surfaces, center, covariance, window, search.params());
  const std::vector<BruteForce::Found> expected = every.candidates();
  const std::vector<SearchCandidate>& found =
      covariance != nullptr ? search.find(scan, surfaces, PoseBelief{center, *covariance}, window)
                            : search.find(scan, surfaces, center, window);
  CAPTURE(covariance != nullptr, window.x_m, window.y_m, window.yaw_rad);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CAPTURE(i);
    const Pose2 pose = every.pose(center, expected[i]);
    REQUIRE(found[i].score == Approx(expected[i].score).epsilon(1e-12));
    REQUIRE(found[i].objective == Approx(expected[i].objective).epsilon(1e-12).margin(1e-12));
    REQUIRE(found[i].pose.x_m == Approx(pose.x_m).margin(1e-12));
    REQUIRE(found[i].pose.y_m == Approx(pose.y_m).margin(1e-12));
    REQUIRE(std::abs(angle_between_rad(found[i].pose.yaw_rad, pose.yaw_rad)) < 1e-12);
  }
  return found.size();
}

}  // namespace

TEST_CASE("A search finds what looking at every pose finds", "[estimation]") {
  Random random(1);
  CorrelativeSearchParams params;
  std::size_t compared = 0;
  for (int draw = 0; draw < 72; ++draw) {
    CAPTURE(draw);
    const SurfaceMap<2> surfaces = random_surfaces(random);
    const Scan<2> scan = random_scan(random, 20);
    const Pose2 center{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-pi, pi)};
    params.step_m = draw % 4 == 3 ? 0.1 : 0.05;
    params.yaw_step_rad = draw % 2 == 0 ? 0.0 : 0.04;
    params.candidates_max = draw % 3 == 0 ? 1 : 12;
    params.objective_margin = draw % 5 == 0 ? 1.0 : 0.1;
    params.separation_m = draw % 7 == 0 ? 0.1 : 0.3;
    // From a single pose to windows of several levels, square and not, a part of the circle and all of it.
    SearchWindow window{random.uniform(0.0, 0.5), random.uniform(0.0, 0.5), random.uniform(0.0, 0.3)};
    if (draw % 6 == 1) window = {random.uniform(1.0, 1.6), random.uniform(0.3, 1.6), 0.2};
    if (draw % 12 == 2) window = {0.9, 1.3, pi};
    if (draw % 12 == 8) window = {0.0, 0.0, 4.0};
    if (window.yaw_rad >= pi) params.yaw_step_rad = 0.1;

    CorrelativeSearch<2> search(params);
    const Eigen::Matrix3d covariance = room::random_covariance(random, draw % 4 == 0 ? 0.05 : 0.3);
    compared += compare(search, scan, surfaces, center, nullptr, window);
    compared += compare(search, scan, surfaces, center, &covariance, window);
  }
  REQUIRE(compared > 300);
}

TEST_CASE("A search is seamless all around", "[estimation]") {
  Random random(8);
  const auto walls = asymmetric_room(room::kTurned);
  const SurfaceMap<2> surfaces = mapped(walls, {room::kTurned});
  CorrelativeSearchParams params;
  params.objective_margin = 1.0;
  for (int draw = 0; draw < 20; ++draw) {
    CAPTURE(draw);
    params.separation_rad = draw % 2 == 0 ? 1.0 : 0.0;
    CorrelativeSearch<2> search(params);
    // The truth is where the first turn meets the last.
    const Pose2 truth = room::kTurned * Pose2{0.0, 0.0, random.uniform(-pi, pi)};
    const Pose2 center{truth.x_m, truth.y_m, truth.yaw_rad + pi + random.uniform(-0.02, 0.02)};
    const Scan<2> scan = room::scan_of(walls, truth, 30);
    REQUIRE(compare(search, scan, surfaces, center, nullptr, {0.05, 0.0, pi}) > 2);
    REQUIRE(std::abs(angle_between_rad(
                search.find(scan, surfaces, center, {0.0, 0.0, pi}).at(0).pose.yaw_rad, truth.yaw_rad)) <
            0.02);
  }
}

TEST_CASE("A displaced and turned robot is found in a room at any angle", "[estimation]") {
  Random random(2);
  CorrelativeSearch<2> search;
  for (int draw = 0; draw < 20; ++draw) {
    CAPTURE(draw);
    const Pose2 T_map_room{random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-pi, pi)};
    const auto walls = asymmetric_room(T_map_room);
    const SurfaceMap<2> surfaces =
        mapped(walls, {T_map_room * Pose2{-0.5, -0.5, 0.0}, T_map_room * Pose2{2.0, 0.0, 1.0},
                       T_map_room * Pose2{-2.5, 1.7, 0}});
    const Pose2 truth =
        T_map_room * Pose2{random.uniform(-1.5, 0.7), random.uniform(-1.5, 0.7), random.uniform(-pi, pi)};
    const Scan<2> scan = room::scan_of(walls, truth, 180);
    const bool is_kidnapped = draw % 5 == 4;
    const SearchWindow window = is_kidnapped ? SearchWindow{2.0, 2.0, pi} : SearchWindow{};
    const Pose2 guess{truth.x_m + random.uniform(-1.0, 1.0) * window.x_m,
                      truth.y_m + random.uniform(-1.0, 1.0) * window.y_m,
                      truth.yaw_rad + random.uniform(-1.0, 1.0) * window.yaw_rad};
    const auto& found = search.find(scan, surfaces, guess, window);
    REQUIRE_FALSE(found.empty());
    REQUIRE(std::hypot(found[0].pose.x_m - truth.x_m, found[0].pose.y_m - truth.y_m) < 0.06);
    REQUIRE(std::abs(angle_between_rad(found[0].pose.yaw_rad, truth.yaw_rad)) < 0.025);
    REQUIRE(found[0].score > 0.8);

    // What follows in use: registration from the best candidate.
    RegistrationParams registration;
    registration.iterations = 8;
    const PoseBelief start{found[0].pose, diagonal_covariance(1e-2, 1e-2, 1e-3)};
    const Registration refined = register_scan(start, scan, surfaces, registration);
    REQUIRE(std::hypot(refined.belief.pose.x_m - truth.x_m, refined.belief.pose.y_m - truth.y_m) < 0.01);
    REQUIRE(std::abs(angle_between_rad(refined.belief.pose.yaw_rad, truth.yaw_rad)) < 0.005);
  }
}

TEST_CASE("Candidates come best first and keep their distance", "[estimation]") {
  Random random(3);
  CorrelativeSearchParams params;
  params.objective_margin = 0.5;
  CorrelativeSearch<2> search(params);
  std::size_t pairs = 0;
  for (int draw = 0; draw < 10; ++draw) {
    const SurfaceMap<2> surfaces = random_surfaces(random);
    const auto& found = search.find(random_scan(random, 30), surfaces, Pose2{}, SearchWindow{1.0, 1.0, 0.3});
    REQUIRE(found.size() <= 12);
    for (std::size_t a = 0; a < found.size(); ++a) {
      REQUIRE(found[a].score > 0.0);
      REQUIRE(found[a].score <= 1.0);
      REQUIRE(found[a].objective == found[a].score);
      REQUIRE(found[a].objective >= found[0].objective - 0.5 - 1e-12);
      for (std::size_t b = 0; b < a; ++b, ++pairs) {
        REQUIRE(found[b].objective >= found[a].objective);
        const double apart_m =
            std::hypot(found[a].pose.x_m - found[b].pose.x_m, found[a].pose.y_m - found[b].pose.y_m);
        const double turned_rad = std::abs(angle_between_rad(found[a].pose.yaw_rad, found[b].pose.yaw_rad));
        REQUIRE((apart_m > 0.3 - 1e-9 || turned_rad > 0.1 - 1e-9));
      }
    }
  }
  REQUIRE(pairs > 50);
}

TEST_CASE("In a corridor the prior decides along it", "[estimation]") {
  // Two walls along x: every x fits.
  SurfaceMap<2> surfaces;
  std::vector<room::Wall> walls{{{-8.0, 1.0}, {8.0, 1.0}}, {{8.0, -1.0}, {-8.0, -1.0}}};
  for (double x_m = -8.0; x_m < 8.0; x_m += 0.01) {
    surfaces.add({x_m, 1.0}, {0.0, 1.0});
    surfaces.add({x_m, -1.0}, {0.0, -1.0});
  }
  surfaces.refresh_normals();
  BeamPattern<2> beams = circular_beams(180, 4.0);
  const Scan<2> scan = room::scan_of(walls, Pose2{0.0, 0.1, 0.02}, beams);
  CorrelativeSearch<2> search;
  const PoseBelief belief{{0.0, 0.0, 0.0}, diagonal_covariance(0.09, 0.09, 0.01)};
  const auto& found = search.find(scan, surfaces, belief, SearchWindow{1.0, 0.3, 0.2});
  REQUIRE_FALSE(found.empty());
  REQUIRE(std::abs(found[0].pose.x_m) < 0.11);
  REQUIRE(found[0].pose.y_m == Approx(0.1).margin(0.03));
  REQUIRE(found[0].pose.yaw_rad == Approx(0.02).margin(0.02));
  REQUIRE(found[0].objective <= found[0].score);
}

TEST_CASE("A covariance of zero is a prior like any other", "[estimation]") {
  const auto walls = asymmetric_room({});
  const SurfaceMap<2> surfaces = mapped(walls, {Pose2{}});
  const Scan<2> scan = room::scan_of(walls, {0.05, 0.0, 0.0}, 180);
  CorrelativeSearchParams params;
  REQUIRE(CorrelativeSearch<2>(params).find(scan, surfaces, Pose2{}, SearchWindow{}).at(0).pose.x_m > 0.0);
  params.prior_weight = 1.0;
  CorrelativeSearch<2> search(params);
  const auto& found = search.find(scan, surfaces, PoseBelief{}, SearchWindow{});
  REQUIRE_FALSE(found.empty());
  // One step is sqrt(12) sigma off, and costs more than any score gains.
  REQUIRE(found[0].pose.x_m == 0.0);
  REQUIRE(found[0].pose.y_m == 0.0);
  REQUIRE(found[0].pose.yaw_rad == 0.0);
  REQUIRE(found[0].objective == found[0].score);
}

TEST_CASE("Where there is nothing to find, nothing is found", "[estimation]") {
  CorrelativeSearch<2> search;
  const auto walls = asymmetric_room({});
  const Scan<2> scan = room::scan_of(walls, Pose2{});
  const SurfaceMap<2> surfaces = mapped(walls, {Pose2{}});
  REQUIRE_FALSE(search.find(scan, surfaces, Pose2{}, SearchWindow{}).empty());
  REQUIRE(search.find(scan, SurfaceMap<2>(), Pose2{}, SearchWindow{}).empty());
  REQUIRE(search.find(scan, SurfaceMap<2>(), Pose2{}, SearchWindow{1.0, 1.0, pi}).empty());
  REQUIRE(search.find(scan, surfaces, Pose2{50.0, -70.0, 1.0}, SearchWindow{}).empty());
  REQUIRE(search.find(Scan<2>(circular_beams(90, 5.0)), surfaces, PoseBelief{}, SearchWindow{}).empty());
  Scan<2> invalid(circular_beams(90, 5.0));
  for (std::size_t beam = 0; beam < 90; ++beam)
    invalid.set_range_m(beam, std::numeric_limits<double>::quiet_NaN());
  REQUIRE(search.find(invalid, surfaces, Pose2{}, SearchWindow{}).empty());
}

TEST_CASE("A search leaves nothing behind for the next", "[estimation]") {
  Random random(6);
  CorrelativeSearch<2> used;
  for (int draw = 0; draw < 10; ++draw) {
    const SurfaceMap<2> surfaces = random_surfaces(random);
    const Scan<2> scan = random_scan(random, 10 + 5 * static_cast<std::size_t>(draw % 3));
    const SearchWindow window{random.uniform(0.0, 1.5), random.uniform(0.0, 1.5), random.uniform(0.0, 0.3)};
    CorrelativeSearch<2> fresh;
    const auto& a = used.find(scan, surfaces, Pose2{}, window);
    const auto& b = fresh.find(scan, surfaces, Pose2{}, window);
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      REQUIRE(a[i].objective == b[i].objective);
      REQUIRE(a[i].pose.x_m == b[i].pose.x_m);
      REQUIRE(a[i].pose.y_m == b[i].pose.y_m);
      REQUIRE(a[i].pose.yaw_rad == b[i].pose.yaw_rad);
    }
  }
}

TEST_CASE("Searches with bad values are refused", "[estimation]") {
  using Params = CorrelativeSearchParams;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto refuses = [](auto&& change, const char* field) {
    Params params;
    change(params);
    REQUIRE_THROWS_WITH(CorrelativeSearch<2>(params), Contains(field));
    REQUIRE_THROWS_AS(CorrelativeSearch<2>(params), std::invalid_argument);
  };
  for (const double bad : {-0.1, nan, infinity}) {
    refuses([&](Params& params) { params.step_m = bad; }, "step_m");
    refuses([&](Params& params) { params.yaw_step_rad = bad; }, "yaw_step_rad");
    refuses([&](Params& params) { params.sigma_m = bad; }, "sigma_m");
    refuses([&](Params& params) { params.prior_weight = bad; }, "prior_weight");
    refuses([&](Params& params) { params.separation_m = bad; }, "separation_m");
    refuses([&](Params& params) { params.separation_rad = bad; }, "separation_rad");
    refuses([&](Params& params) { params.objective_margin = bad; }, "objective_margin");
  }
  refuses([](Params& params) { params.step_m = 0.0; }, "step_m");
  refuses([](Params& params) { params.sigma_m = 0.0; }, "sigma_m");
  refuses([](Params& params) { params.candidates_max = 0; }, "candidates_max");

  Random random(7);
  const SurfaceMap<2> surfaces = random_surfaces(random);
  const Scan<2> scan = random_scan(random, 40);
  CorrelativeSearch<2> search;
  const auto refuses_window = [&](const SearchWindow& window, const char* field) {
    REQUIRE_THROWS_WITH(search.find(scan, surfaces, Pose2{}, window), Contains(field));
    REQUIRE_THROWS_AS(search.find(scan, surfaces, PoseBelief{}, window), std::invalid_argument);
  };
  for (const double bad : {-0.1, nan, infinity}) {
    refuses_window({bad, 0.3, 0.2}, "x_m");
    refuses_window({0.3, bad, 0.2}, "y_m");
    refuses_window({0.3, 0.3, bad}, "yaw_rad");
  }
  refuses_window({300.0, 0.3, 0.2}, "x_m");
  refuses_window({0.3, 300.0, 0.2}, "y_m");
  refuses_window({204.0, 0.3, 0.2}, "cells");
  Params fine;
  fine.yaw_step_rad = 1e-6;
  REQUIRE_THROWS_WITH(CorrelativeSearch<2>(fine).find(scan, surfaces, Pose2{}, SearchWindow{}),
                      Contains("yaw_rad"));
  REQUIRE_THROWS_AS(search.find(scan, surfaces, Pose2{nan, 0.0, 0.0}, SearchWindow{}), std::invalid_argument);
  PoseBelief bad;
  bad.covariance(0, 0) = -1.0;
  REQUIRE_THROWS_AS(search.find(scan, surfaces, bad, SearchWindow{}), std::invalid_argument);
}
