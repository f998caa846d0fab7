#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/map.hpp"
#include "incognita/testing/cell_policy_laws.hpp"
#include "reference.hpp"

using namespace incognita;
using Catch::Matchers::Contains;

namespace {

static_assert(PoseAwarePolicy<Dispersion> && OncePolicy<Dispersion> && !ClearingPolicy<Dispersion>);
static_assert(sizeof(Dispersion::State) == 8);
static_assert(!std::is_convertible_v<Dispersion::Params, Dispersion>);

Eigen::Matrix3d random_covariance(Random& random) {
  Eigen::Matrix3d root;
  for (int i = 0; i < 9; ++i) root(i / 3, i % 3) = random.uniform(-1.0, 1.0);
  const Eigen::Matrix3d shape = root * root.transpose() + 0.02 * Eigen::Matrix3d::Identity();
  const double position_m = std::pow(10.0, random.uniform(-2.0, 0.5));
  const Eigen::Vector3d sigmas(position_m, position_m * random.uniform(0.3, 1.0), std::pow(10.0, random.uniform(-4.0, -1.0)));
  const Eigen::Vector3d scale = sigmas.array() / shape.diagonal().array().sqrt();
  return scale.asDiagonal() * shape * scale.asDiagonal();
}

double exact_log_odds(const Eigen::Matrix3d& covariance, const Eigen::Vector2d& direction, double range_m,
                      const RangeBearingNoise& noise, double side_m) {
  const MeasuredPoint point = measured_point(Eigen::Vector2d::Zero(), covariance, direction, range_m, noise);
  return dispersion_log_odds<2>(point.covariance_m2, Eigen::Vector2d::Constant(side_m));
}

}  // namespace

TEST_CASE("A measured point's covariance is that of samples, to first order", "[dispersion]") {
  Random random(1);
  for (int draw = 0; draw < 20; ++draw) {
    const Eigen::Matrix3d covariance = 1e-4 * random_covariance(random);
    const RangeBearingNoise noise{random.uniform(1e-4, 1e-3), random.uniform(1e-5, 1e-4)};
    const Pose2 pose{1.0, -2.0, random.uniform(-3.0, 3.0)};
    const double range_m = random.uniform(0.5, 10.0);
    const double bearing_rad = random.uniform(-3.0, 3.0);
    const MeasuredPoint point = measured_point(pose, covariance, range_m, bearing_rad, noise);
    const auto at = [&](const Eigen::Matrix<double, 5, 1>& error) {
      const double angle_rad = pose.yaw_rad + error[2] + bearing_rad + error[4];
      const double far_m = range_m + error[3];
      return Eigen::Vector2d(pose.x_m + error[0] + far_m * std::cos(angle_rad), pose.y_m + error[1] + far_m * std::sin(angle_rad));
    };
    Eigen::Matrix<double, 2, 5> jacobian;
    for (int i = 0; i < 5; ++i) {
      Eigen::Matrix<double, 5, 1> error = Eigen::Matrix<double, 5, 1>::Zero();
      error[i] = 1e-6;
      jacobian.col(i) = (at(error) - at(-error)) / 2e-6;
    }
    Eigen::Matrix<double, 5, 5> errors = Eigen::Matrix<double, 5, 5>::Zero();
    errors.topLeftCorner<3, 3>() = covariance;
    errors(3, 3) = noise.range_m * noise.range_m;
    errors(4, 4) = noise.bearing_rad * noise.bearing_rad;
    const Eigen::Matrix2d expected = jacobian * errors * jacobian.transpose();
    REQUIRE((point.mean_m - at(Eigen::Matrix<double, 5, 1>::Zero())).norm() < 1e-12);
    REQUIRE((point.covariance_m2 - expected).norm() < 1e-8 * expected.norm());
  }
}

TEST_CASE("The view of a scan agrees with the integrals to its stated error", "[dispersion]") {
  Random random(2);
  std::vector<double> errors;
  for (int draw = 0; draw < 400; ++draw) {
    const Eigen::Matrix3d covariance = random_covariance(random);
    const RangeBearingNoise noise{draw % 2 == 0 ? 0.12 : std::pow(10.0, random.uniform(-2.0, -0.7)), 0.00218};
    const double range_max_m = random.uniform(3.0, 30.0);
    const double side_m = draw % 3 == 0 ? random.uniform(0.05, 0.2) : 0.1;
    const DispersionView view(covariance, range_max_m, noise, side_m);
    for (int point = 0; point < 10; ++point) {
      const double angle_rad = random.uniform(-3.2, 3.2);
      const Eigen::Vector2d direction(std::cos(angle_rad), std::sin(angle_rad));
      const double range_m = random.uniform(0.0, range_max_m);
      const double exact = std::min<double>(DispersionView::log_odds_max, exact_log_odds(covariance, direction, range_m, noise, side_m));
      const double fast = view.beam(direction, range_m).log_odds_at(static_cast<float>(range_m));
      errors.push_back(std::abs(fast - exact));
      INFO("exact " << exact << ", range " << range_m << ", side " << side_m << ", noise " << noise.range_m << "\n" << covariance);
      REQUIRE(errors.back() < 0.1);
    }
  }
  std::sort(errors.begin(), errors.end());
  REQUIRE(errors[errors.size() * 99 / 100] < 0.01);
}

TEST_CASE("A cell approaches what scans tell of it, and keeps what it knows better", "[dispersion]") {
  Random random(3);
  int kept = 0;
  int fallen = 0;
  for (const double kappa : {0.0, 0.3, 0.5, 1.0}) {
    Dispersion::Params params;
    params.kappa = kappa;
    params.sigma_max_m = 0.4;
    const Dispersion policy(params);
    for (int cell = 0; cell < 20; ++cell) {
      Dispersion::State state;
      REQUIRE(policy.dispersion_log_odds(state) == policy.beta_log_odds());
      REQUIRE_FALSE(state.is_explored);
      for (ScanStamp stamp = 1; stamp <= 30; ++stamp) {
        const double sigma_m = std::pow(10.0, random.uniform(-2.0, 0.5));
        const auto beam = policy.beam(sigma_m * sigma_m);
        const auto range_m = static_cast<float>(random.uniform(0.0, 20.0));
        const float told = beam.log_odds_at(range_m);
        const float before = policy.dispersion_log_odds(state);
        policy.pass(state, beam, -range_m, stamp);
        const float after = policy.dispersion_log_odds(state);
        REQUIRE(state.is_explored);
        REQUIRE(after >= std::min(before, told) - 1e-6F);
        REQUIRE(after <= std::max(before, told) + 1e-6F);
        const bool is_kept = before > std::max(policy.beta_log_odds(), told);
        REQUIRE(after == (is_kept ? before : before + static_cast<float>(kappa) * (told - before)));
        if (before > policy.beta_log_odds()) REQUIRE(after >= before);  // explored cells never get worse
        kept += is_kept;
        fallen += after < before;
        if (kappa == 0.0) REQUIRE(after == before);
        // Another beam of the same scan
        policy.pass(state, policy.beam(1e-6), 0.0F, stamp);
        policy.hit(state, policy.beam(1e-6), 0.0F, stamp);
        REQUIRE(policy.dispersion_log_odds(state) == after);
      }
    }
  }
  REQUIRE(kept > 100);
  REQUIRE(fallen > 20);  // those beyond what is tolerated may, against the text's claim
}

TEST_CASE("Beta is the dispersion probability of what is tolerated", "[dispersion]") {
  for (const double sigma_m : {0.2, 0.6, 1.0}) {
    Dispersion::Params params;
    params.sigma_max_m = sigma_m;
    params.box_side_m = 0.2;
    const Dispersion policy(params);
    const double along_one = std::erf(0.1 / (sigma_m * std::sqrt(2.0)));
    REQUIRE(policy.beta() == Approx(along_one * along_one).epsilon(1e-9));
    REQUIRE(policy.beta_log_odds() == Approx(std::log(policy.beta() / (1.0 - policy.beta()))));
    REQUIRE(policy.dispersion_probability({}) == Approx(policy.beta()).epsilon(1e-6));
  }
}

TEST_CASE("A map of dispersion equals a slow reference", "[dispersion]") {
  Random random(4);
  Dispersion::Params params;
  params.sigma_max_m = 0.5;
  params.noise = {0.05, 0.01};
  const Dispersion policy(params);
  Map<Dispersion> map({0.1, 0.5}, policy);
  struct Cell {
    double dispersion = 0.0;
    double occupancy = 0.0;
    bool is_explored = false;
  };
  std::map<reference::Key<2>, Cell> cells;
  const double beta = policy.beta_log_odds();
  for (int n = 0; n < 12; ++n) {
    const Pose2 pose = reference::random_pose<2>(random);
    const Eigen::Matrix3d covariance = 0.1 * random_covariance(random);
    const Scan<2> scan = reference::random_scan<2>(random, 30, 6.0, 0.1);
    map.update(scan, pose, covariance);

    std::set<reference::Key<2>> seen;
    const auto see = [&](const reference::Key<2>& key, const Eigen::Vector2d& direction, double range_m, double step) {
      if (!seen.insert(key).second) return;
      Cell& cell = cells[key];
      const double old = cell.is_explored ? cell.dispersion : beta;
      const double told = exact_log_odds(covariance, direction, range_m, params.noise, params.box_side_m);
      cell.dispersion = old > std::max(beta, told) ? old : old + 0.5 * (told - old);
      cell.occupancy = std::clamp(cell.occupancy + step, -10.0, 10.0);
      cell.is_explored = true;
    };
    for (const bool hits : {true, false}) {
      for (std::size_t beam = 0; beam < scan.size(); ++beam) {
        const double z_m = scan.range_m(beam);
        if (!(z_m > 0.0 && z_m <= scan.range_max_m())) continue;
        const bool is_hit = z_m < scan.range_max_m();
        const Eigen::Vector2d direction = pose * scan.direction(beam) - pose.position();
        auto walk = reference::cells_on<2>(pose.position(), pose.position() + direction * (is_hit ? z_m + 0.05 : z_m), 0.1);
        if (hits) {
          if (is_hit) see(walk.back(), direction, z_m, 0.85);
          continue;
        }
        if (is_hit) walk.pop_back();
        for (const auto& key : walk) {
          const Eigen::Vector2d center(0.1 * (key[0] + 0.5), 0.1 * (key[1] + 0.5));
          see(key, direction, (center - pose.position()).norm(), -0.4);
        }
      }
    }
    std::size_t found = 0;
    for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
      const Index<2> index = map.grid().index_at(offset);
      const Dispersion::State& state = map.grid()[offset];
      const auto cell = cells.find({index[0], index[1]});
      REQUIRE(state.is_explored == (cell != cells.end()));
      if (cell == cells.end()) continue;
      ++found;
      REQUIRE(map.log_odds(index) == Approx(cell->second.occupancy).margin(0.001 * (n + 1)));
      REQUIRE(policy.dispersion_log_odds(state) == Approx(cell->second.dispersion).margin(0.1));
    }
    REQUIRE(found == cells.size());
  }
}

TEST_CASE("A pose that is known to nothing leaves cells finite", "[dispersion]") {
  Map<Dispersion> map;
  for (const double variance_m2 : {1e6, 1e20, 1e40}) {
    map.update(Scan<2>(circular_beams(60, 5.0)), {}, Eigen::Vector3d(variance_m2, variance_m2, 1.0).asDiagonal());
    for (const Dispersion::State& state : map.grid().values()) REQUIRE(std::isfinite(state.dispersion_log_odds));
  }
}

TEST_CASE("Dispersion cells keep the laws of a cell policy", "[dispersion]") {
  CHECK(check_cell_policy_laws(Dispersion()).text() == "");
  Dispersion::Params params;
  params.kappa = 0.0;
  params.log_odds_max = 31.0;
  params.log_odds_min = -31.0;
  params.hit = 31.0;
  params.pass = -31.0;
  CHECK(check_cell_policy_laws(Dispersion(params)).text() == "");
}

TEST_CASE("Dispersion refuses bad parameters", "[dispersion]") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto with = [](auto change) {
    Dispersion::Params params;
    change(params);
    return Dispersion(params);
  };
  REQUIRE_THROWS_WITH(with([](auto& p) { p.sigma_max_m = 0.0; }), Contains("sigma_max_m is 0"));
  REQUIRE_THROWS_WITH(with([](auto& p) { p.sigma_max_m = 0.01; }), Contains("sigma_max_m is 0.01"));   // beta is 1 to a view
  REQUIRE_THROWS_WITH(with([](auto& p) { p.sigma_max_m = 1e-6; }), Contains("sigma_max_m is 1e-06"));  // and to a double
  REQUIRE_THROWS_WITH(with([](auto& p) { p.sigma_max_m = 1e6; }), Contains("sigma_max_m is 1e+06"));
  REQUIRE_NOTHROW(with([](auto& p) { p.sigma_max_m = 0.02; }));
  REQUIRE_THROWS_WITH(with([](auto& p) { p.box_side_m = -0.1; }), Contains("box_side_m is -0.1"));
  REQUIRE_THROWS_WITH(with([](auto& p) { p.kappa = 1.5; }), Contains("kappa is 1.5, but must be in [0, 1]"));
  REQUIRE_THROWS_WITH(with([](auto& p) { p.kappa = -0.1; }), Contains("kappa"));
  REQUIRE_THROWS_WITH(with([=](auto& p) { p.kappa = kNan; }), Contains("kappa is nan"));
  REQUIRE_THROWS_WITH(with([](auto& p) { p.noise.range_m = -1.0; }), Contains("range_m is -1"));
  REQUIRE_THROWS_WITH(with([=](auto& p) { p.noise.bearing_rad = kNan; }), Contains("bearing_rad is nan"));
  REQUIRE_THROWS_WITH(with([](auto& p) { p.hit = 0.0; }), Contains("hit is 0"));
  REQUIRE_THROWS_WITH(with([](auto& p) { p.pass = 0.4; }), Contains("pass is 0.4"));
  REQUIRE_THROWS_WITH(with([](auto& p) { p.log_odds_min = -40.0; }), Contains("log_odds_min is -40"));
  REQUIRE_THROWS_WITH(with([=](auto& p) { p.log_odds_max = kNan; }), Contains("log_odds_max is nan"));
}
