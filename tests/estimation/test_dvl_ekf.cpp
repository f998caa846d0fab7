#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "room.hpp"

using namespace incognita;

namespace {

const std::vector<room::Wall> kRoom = room::box(room::kTurned);
const Eigen::Matrix3d kSmall = Eigen::Vector3d(1e-6, 1e-6, 1e-6).asDiagonal();

DvlEkf::Params start_at(const Pose2& pose, int scans_held = 0) {
  DvlEkf::Params params;
  params.start = {pose, kSmall};
  params.start_scans_held = scans_held;
  return params;
}

/// A filter and a map that have learnt the room at its true pose.
template <class MapType>
DvlEkf learnt(const DvlEkf::Params& params, MapType& map, int scans = 3) {
  DvlEkf filter(params);
  const Scan<2> scan = room::scan_of(kRoom, params.start.pose);
  for (int n = 0; n < scans; ++n) {
    map.update(scan, params.start.pose, params.start.covariance);
    filter.learn(scan);
  }
  return filter;
}

}  // namespace

TEST_CASE("The start pose is held for a number of scans of a robot that stands", "[estimation]") {
  Random random(1);
  const Pose2 start{1.0, -2.0, 0.7};
  DvlEkf filter(start_at(start, 20));
  Map<> map;
  const Scan<2> scan = room::scan_of(kRoom, start, 90);
  for (int n = 0; n < 20; ++n) {
    REQUIRE_FALSE(filter.is_ready());
    for (int step = 0; step < 5; ++step) {
      filter.predict({random.normal(0.0, 0.001), 0.0, random.normal(0.0, 0.0004)}, 0.02);
    }
    REQUIRE(filter.belief().covariance(0, 0) > 1e-6);
    const CorrectionReport report = filter.correct(scan, map);
    filter.learn(scan);
    REQUIRE(report.associations == 0);
    REQUIRE(room::position_error_m(filter.belief().pose, start) == 0.0);
    REQUIRE(filter.belief().pose.yaw_rad == start.yaw_rad);
    REQUIRE(filter.belief().covariance == kSmall);
  }
  REQUIRE(filter.is_ready());
  REQUIRE(filter.correct(scan, map).associations > 0);
  REQUIRE(DvlEkf(start_at(start, 0)).is_ready());
}

TEST_CASE("The held start ends for good when the robot drives off, however slowly", "[estimation]") {
  const Scan<2> nothing(circular_beams(36, 10.0));
  const Map<> map;
  for (const double speed_m : {0.03, 0.09, 0.5}) {
    DvlEkf filter(start_at({}, 20));
    for (int n = 0; n < 15; ++n) {
      filter.predict({speed_m, 0.0, 0.0}, 0.1);
      filter.correct(nothing, map);
    }
    REQUIRE(filter.is_ready());
    REQUIRE(filter.belief().pose.x_m == Approx(15 * speed_m));
    REQUIRE(filter.belief().covariance(0, 0) == Approx(1e-6 + 0.0316 * 0.0316 * 1.5).epsilon(1e-3));
    // Back at the start, it is a place like any other.
    for (int n = 0; n < 15; ++n) {
      filter.predict({-speed_m, 0.0, 0.0}, 0.1);
      filter.correct(nothing, map);
    }
    REQUIRE(filter.belief().pose.x_m == Approx(0.0).margin(1e-12));
    REQUIRE(filter.belief().covariance(0, 0) > 0.002);
  }
  DvlEkf turns(start_at({}, 20));
  for (int n = 0; n < 15; ++n) {
    turns.predict({0.0, 0.0, 0.02}, 0.1);
    turns.correct(nothing, map);
  }
  REQUIRE(turns.is_ready());
  REQUIRE(turns.belief().pose.yaw_rad == Approx(0.3));
}

TEST_CASE("Prediction is dead reckoning", "[estimation]") {
  DvlEkf::Params params = start_at({0.0, 0.0, 0.5});
  DvlEkf filter(params);
  filter.predict({1.0, 0.0, 0.1}, 0.5);
  const PoseBelief expected = propagate(params.start, {1.0, 0.0, 0.1}, params.noise, 0.5);
  REQUIRE(room::position_error_m(filter.belief().pose, expected.pose) == 0.0);
  REQUIRE(filter.belief().covariance == expected.covariance);
  const PoseBelief imagined = filter.imagine_motion(params.start, {1.0, 0.0, 0.1}, 0.5);
  REQUIRE(imagined.covariance == expected.covariance);
}

TEST_CASE("Registration in a map built at the true pose finds a displaced robot", "[estimation]") {
  const Pose2 truth = room::kTurned * Pose2{0.4, -0.3, 2.0};
  Map<> map;
  DvlEkf filter = learnt(start_at(truth), map);
  const Scan<2> scan = room::scan_of(kRoom, truth);
  filter.predict({0.04, 0.03, 2.0 * 3.14159265 / 180.0}, 0.5);
  REQUIRE(room::position_error_m(filter.belief().pose, truth) == Approx(0.05).epsilon(0.01));
  CorrectionReport report;
  for (int correction = 0; correction < 15; ++correction) {
    report = filter.correct(scan, map);
    filter.predict({}, 0.1);
  }
  REQUIRE(room::position_error_m(filter.belief().pose, truth) < 0.002);
  REQUIRE(room::heading_error_rad(filter.belief().pose, truth) < 0.001);
  REQUIRE(report.associations == 360);
  REQUIRE(report.residual_rms_m < 0.01);
}

TEST_CASE("A robot that drives around a turned room stays localised", "[estimation]") {
  Random random(2);
  Pose2 truth = room::kTurned * Pose2{-1.0, -0.5, 0.0};
  Map<> map;
  DvlEkf filter(start_at(truth, 20));
  DvlEkf odometry(start_at(truth, 0));
  double squares_m2 = 0.0;
  for (int scan_index = 0; scan_index < 600; ++scan_index) {
    const bool drives = filter.is_ready();
    for (int step = 0; step < 5; ++step) {
      const Pose2 increment = drives ? Pose2{0.01, 0.0, 0.012} : Pose2{};
      truth = truth * increment;
      const Pose2 measured{increment.x_m + random.normal(0.0, 0.001), 0.0,
                           increment.yaw_rad + random.normal(0.0, 0.0004)};
      filter.predict(measured, 0.02);
      odometry.predict(measured, 0.02);
    }
    Scan<2> scan = room::scan_of(kRoom, truth, 90);
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      scan.set_range_m(beam, scan.range_m(beam) + random.normal(0.0, 0.01));
    }
    filter.correct(scan, map);
    map.update(scan, filter.belief().pose, filter.belief().covariance);
    filter.learn(scan);
    squares_m2 += std::pow(room::position_error_m(filter.belief().pose, truth), 2) / 600.0;
  }
  CAPTURE(room::position_error_m(odometry.belief().pose, truth));
  REQUIRE(std::sqrt(squares_m2) < 0.02);
  REQUIRE(room::heading_error_rad(filter.belief().pose, truth) < 0.01);
}

TEST_CASE("A heading that is measured corrects as the scalar Kalman formula says", "[estimation]") {
  Random random(3);
  for (int draw = 0; draw < 100; ++draw) {
    DvlEkf::Params params;
    params.start = {{random.normal(), random.normal(), random.uniform(-3.1, 3.1)},
                    room::random_covariance(random, 0.3)};
    DvlEkf filter(params);
    const double measured_rad = wrap_angle_rad(params.start.pose.yaw_rad + random.normal(0.0, 0.3));
    const double sigma_rad = std::pow(10.0, random.uniform(-3.0, 0.0));
    filter.correct_heading(measured_rad, sigma_rad);

    // The information form of the same: one more row (0, 0, 1) with weight 1 / sigma^2.
    Eigen::Matrix3d information = params.start.covariance.inverse();
    information(2, 2) += 1.0 / (sigma_rad * sigma_rad);
    const Eigen::Matrix3d covariance = information.inverse();
    const double innovation_rad =
        std::remainder(measured_rad - params.start.pose.yaw_rad, 2.0 * std::acos(-1.0));
    const Eigen::Vector3d step = covariance.col(2) * innovation_rad / (sigma_rad * sigma_rad);
    const Pose2 expected{params.start.pose.x_m + step.x(), params.start.pose.y_m + step.y(),
                         params.start.pose.yaw_rad + step.z()};
    REQUIRE(room::position_error_m(filter.belief().pose, expected) < 1e-7);
    REQUIRE(room::heading_error_rad(filter.belief().pose, expected) < 1e-7);
    REQUIRE((filter.belief().covariance - covariance).norm() < 1e-7);
  }
  DvlEkf filter;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  REQUIRE_THROWS_AS(filter.correct_heading(kNan, 0.1), std::invalid_argument);
  for (const double bad : {0.0, -0.1, kNan})
    REQUIRE_THROWS_AS(filter.correct_heading(0.0, bad), std::invalid_argument);
  REQUIRE(filter.belief().covariance == kSmall);
}

TEST_CASE("The covariance stays symmetric and positive definite over 10^5 updates of every kind",
          "[estimation]") {
  for (const DvlEkf::Form form : {DvlEkf::Form::registration, DvlEkf::Form::ray}) {
    Random random(4);
    Pose2 truth = room::kTurned;
    Map<> map;
    DvlEkf::Params params = start_at(truth);
    params.form = form;
    DvlEkf filter = learnt(params, map);
    for (int update = 0; update < 50000; ++update) {
      const double kind = random.uniform();
      if (kind < 0.5) {
        const Pose2 increment{random.normal(0.0, 0.05), random.normal(0.0, 0.05), random.normal(0.0, 0.1)};
        const Pose2 next = truth * increment;
        const bool inside = std::abs((room::kTurned.inverse() * next).x_m) < 2.0 &&
                            std::abs((room::kTurned.inverse() * next).y_m) < 1.0;
        if (inside) truth = next;
        const double error = random.uniform() < 0.01 ? 0.05 : 0.002;
        filter.predict(
            (inside ? increment : Pose2{}) * Pose2{random.normal(0.0, error), 0.0, random.normal(0.0, error)},
            std::pow(10.0, random.uniform(-4.0, 1.0)));
      } else if (kind < 0.8) {
        filter.correct(room::scan_of(kRoom, truth, 1 + random.index(12)), map);
      } else {
        filter.correct_heading(truth.yaw_rad + random.normal(0.0, 0.01),
                               std::pow(10.0, random.uniform(-5.0, 0.0)));
      }
      const Eigen::Matrix3d& covariance = filter.belief().covariance;
      CAPTURE(update, kind);
      if (!filter.belief().pose.is_finite() ||
          (covariance - covariance.transpose()).cwiseAbs().maxCoeff() >
              1e-12 * covariance.cwiseAbs().maxCoeff() ||
          Eigen::LLT<Eigen::Matrix3d>(covariance).info() != Eigen::Success) {
        FAIL("not symmetric positive definite:\n" << covariance);
      }
    }
  }
}

TEST_CASE("Form::ray runs, and sees no heading that it does not share with the position", "[estimation]") {
  DvlEkf::Params params = start_at(room::kTurned);
  params.form = DvlEkf::Form::ray;
  params.start.covariance = Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal();
  Map<> map;
  DvlEkf filter = learnt(params, map);
  REQUIRE(filter.surfaces().size() == 0);
  const CorrectionReport report = filter.correct(room::scan_of(kRoom, room::kTurned), map);
  REQUIRE(report.associations == 360);
  REQUIRE(report.residual_rms_m < 0.1);
  REQUIRE(filter.belief().pose.yaw_rad == room::kTurned.yaw_rad);
  REQUIRE(filter.belief().covariance(2, 2) == Approx(0.01).epsilon(1e-12));
  REQUIRE(filter.belief().covariance(0, 0) < 0.01 - 1e-5);

  // A robot that is 10 cm off across the room is drawn back.
  DvlEkf displaced = learnt(params, map);
  displaced.predict({0.1, 0.0, 0.0}, 1e-3);
  for (int n = 0; n < 30; ++n) {
    displaced.correct(room::scan_of(kRoom, room::kTurned), map);
    displaced.predict({}, 1.0);
  }
  REQUIRE(room::position_error_m(displaced.belief().pose, room::kTurned) < 0.07);

  // Without a hit, and with a map that knows nothing: the prior.
  DvlEkf alone(params);
  REQUIRE(alone.correct(room::scan_of(kRoom, room::kTurned), Map<>()).associations == 0);
  REQUIRE(alone.correct(Scan<2>(circular_beams(36, 10.0)), map).associations == 0);
  REQUIRE(room::position_error_m(alone.belief().pose, room::kTurned) == 0.0);
}

TEST_CASE("Form::ray takes the first occupied cell along each beam, as (11) has it", "[estimation]") {
  // One beam along x, one occupied cell: a scalar Kalman update by hand.
  DvlEkf::Params params = start_at({0.05, 0.05, 0.0});
  params.form = DvlEkf::Form::ray;
  params.start.covariance = Eigen::Vector3d(0.04, 0.01, 0.01).asDiagonal();
  Map<LogOdds> map;
  map.update(Scan<2>(planar_beams(1, 0.0, 0.0, 10.0), {3.03}), params.start.pose, kSmall);
  const Index<2> cell(31, 0);
  REQUIRE(map.log_odds(cell) == 0.85F);
  DvlEkf filter(params);
  const CorrectionReport report = filter.correct(Scan<2>(planar_beams(1, 0.0, 0.0, 10.0), {2.9}), map);
  REQUIRE(report.associations == 1);
  const double p = map.probability(cell);
  const double residual_m = 2.9 + 0.05 - 3.1;
  const double noise_m2 = (p * p * 0.39 * 0.39 + (1.0 - p) * (1.0 - p) * 9.0) / 1.2;
  const double gain = -0.04 / (0.04 + noise_m2);
  REQUIRE(report.residual_rms_m == Approx(std::abs(residual_m)).epsilon(1e-9));
  REQUIRE(filter.belief().pose.x_m == Approx(0.05 + gain * residual_m).epsilon(1e-9));
  REQUIRE(filter.belief().covariance(0, 0) == Approx(0.04 * noise_m2 / (0.04 + noise_m2)).epsilon(1e-9));
  REQUIRE(filter.belief().covariance(1, 1) == Approx(0.01).epsilon(1e-9));
}

TEST_CASE("The decoupled filter takes hits for certain above its threshold and leaves out all others",
          "[estimation]") {
  for (const DvlEkf::Form form : {DvlEkf::Form::registration, DvlEkf::Form::ray}) {
    const auto corrected = [&](bool coupled, float log_odds) {
      LogOdds::Params cells;
      cells.hit = log_odds;
      cells.log_odds_max = log_odds;
      Map<LogOdds> map({}, LogOdds(cells));
      DvlEkf::Params params = start_at(room::kTurned);
      params.form = form;
      params.coupled = coupled;
      params.start.covariance = Eigen::Vector3d(0.01, 0.01, 0.001).asDiagonal();
      DvlEkf filter = learnt(params, map);
      const CorrectionReport report = filter.correct(room::scan_of(kRoom, room::kTurned), map);
      return std::pair(report.associations, filter.belief().covariance);
    };
    const Eigen::Matrix3d prior = Eigen::Vector3d(0.01, 0.01, 0.001).asDiagonal();
    // p = 0.6 is below the threshold of 0.65, p = 0.73 and 0.99 are above it.
    const auto [none, unchanged] = corrected(false, 0.4F);
    REQUIRE(none == 0);
    REQUIRE(unchanged == prior);
    const auto [some, coupled] = corrected(true, 0.4F);
    REQUIRE(some > 300);
    REQUIRE(coupled(0, 0) < 0.01);
    const auto likely = corrected(false, 1.0F);
    const auto certain = corrected(false, 5.0F);
    REQUIRE(likely.first > 300);
    REQUIRE((likely.second - certain.second).norm() < 1e-15);
    REQUIRE(likely.second(0, 0) < corrected(true, 1.0F).second(0, 0));
  }
}

TEST_CASE("An imagined scan weighs as many scans as it stands for, by (11a)", "[estimation]") {
  Random random(5);
  DvlEkf::Params params;
  const DvlEkf filter(params);
  params.coupled = false;
  const DvlEkf decoupled(params);
  for (int draw = 0; draw < 50; ++draw) {
    const PoseBelief prior{{1.0, 2.0, 3.0}, room::random_covariance(random, 0.3)};
    std::vector<RayObservation> hits(1 + random.index(40));
    Eigen::Matrix3d coupled_information = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d decoupled_information = Eigen::Matrix3d::Zero();
    for (RayObservation& hit : hits) {
      const double angle_rad = random.uniform(-3.0, 3.0);
      hit = {{std::cos(angle_rad), std::sin(angle_rad)}, 5.0, random.uniform(0.5, 1.0)};
      const Eigen::Vector3d row(hit.direction.x(), hit.direction.y(), 0.0);
      const double p = hit.probability;
      coupled_information += row * row.transpose() / (p * p * 0.1521 + (1.0 - p) * (1.0 - p) * 9.0);
      decoupled_information += row * row.transpose() / 0.1521;
    }
    const double scans = random.uniform(1.0, 20.0);
    const auto expected = [&](const Eigen::Matrix3d& information) {
      return Eigen::Matrix3d((prior.covariance.inverse() + scans * 1.2 / 60.0 * information).inverse());
    };
    const PoseBelief seen = filter.imagine_scan(prior, hits, 60, scans);
    REQUIRE((seen.covariance - expected(coupled_information)).norm() < 1e-8);
    REQUIRE(room::position_error_m(seen.pose, prior.pose) == 0.0);
    REQUIRE(
        (decoupled.imagine_scan(prior, hits, 60, scans).covariance - expected(decoupled_information)).norm() <
        1e-8);
  }
}

TEST_CASE("The filter refuses parameters outside of their bounds", "[estimation]") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = [](auto&& change) {
    DvlEkf::Params params;
    change(params);
    REQUIRE_THROWS_AS(DvlEkf(params), std::invalid_argument);
  };
  using Params = DvlEkf::Params;
  for (const double bad : {-0.1, kNan}) {
    refuses([&](Params& params) { params.noise.position_m_per_sqrt_s = bad; });
    refuses([&](Params& params) { params.noise.yaw_rad_per_sqrt_s = bad; });
    refuses([&](Params& params) { params.start_hold_distance_m = bad; });
    refuses([&](Params& params) { params.start_hold_turn_rad = bad; });
    refuses([&](Params& params) { params.decoupled_probability_min = bad; });
    refuses([&](Params& params) { params.start.covariance(0, 0) = bad; });
    refuses([&](Params& params) { params.registration.gamma = bad; });
    refuses([&](Params& params) { params.surfaces.cell_m = bad; });
    refuses([&](Params& params) { params.ray.gamma = bad; });
    refuses([&](Params& params) { params.imagined.gamma = bad; });
  }
  refuses([](Params& params) { params.noise.position_m_per_sqrt_s = 0.0; });
  refuses([](Params& params) { params.decoupled_probability_min = 1.0; });
  refuses([](Params& params) { params.start_scans_held = -1; });
  refuses([&](Params& params) { params.start.pose.yaw_rad = kNan; });
}
