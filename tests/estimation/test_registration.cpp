#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "coarse_surfaces.hpp"
#include "incognita/core/random.hpp"
#include "incognita/estimation/registration.hpp"
#include "room.hpp"

using namespace incognita;

namespace {

/// All surfaces are there with one probability.
struct Certainty : CertainSurfaces {
  double probability;
  explicit Certainty(double p) : probability(p) {}
  [[nodiscard]] double occupied_probability(const Surface<2>& /*surface*/) const { return probability; }
};

/// An excess variance from a function of the surface and the Jacobian.
template <class Function>
struct Excess : CertainSurfaces {
  Function function;
  explicit Excess(Function f) : function(f) {}
  [[nodiscard]] double excess_variance_m2(const Surface<2>& surface, const Eigen::Vector3d& jacobian) const {
    return function(surface, jacobian);
  }
};

/// The surfaces of walls seen without error from `poses`.
SurfaceMap<2> surfaces_of(const std::vector<room::Wall>& walls, const std::vector<Pose2>& poses) {
  SurfaceMap<2> surfaces;
  for (const Pose2& T_map_sensor : poses) {
    const Scan<2> scan = room::scan_of(walls, T_map_sensor, 720);
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (scan.reading(beam) != Reading::hit) continue;
      surfaces.add(T_map_sensor * scan.end_point_m(beam), T_map_sensor.rotation() * scan.direction(beam));
    }
  }
  surfaces.refresh_normals();
  return surfaces;
}

Pose2 moved(const Pose2& pose, double x_m, double y_m, double yaw_rad) {
  return {pose.x_m + x_m, pose.y_m + y_m, wrap_angle_rad(pose.yaw_rad + yaw_rad)};
}

/// What register_scan says it minimises, halved, with the surfaces that the beams match at `matched_at`: a
/// squared Mahalanobis distance and Cauchy's function of each beam's distance to its line or point.
struct Cost {
  const PoseBelief& prior;
  const Scan<2>& scan;
  const RegistrationParams& params;
  std::vector<SurfaceMatch> matches;
  std::size_t associations = 0;

  Cost(const PoseBelief& prior_belief, const Scan<2>& seen, const SurfaceMap<2>& surfaces,
       const RegistrationParams& parameters, const Pose2& matched_at)
      : prior(prior_belief), scan(seen), params(parameters) {
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      matches.emplace_back();
      if (scan.reading(beam) != Reading::hit) continue;
      matches.back() = match_surface(surfaces, matched_at * scan.end_point_m(beam),
                                     matched_at.rotation() * scan.direction(beam), params);
      if (matches.back().surface != nullptr) ++associations;
    }
  }

  [[nodiscard]] double operator()(const Pose2& at) const {
    const Eigen::Vector3d step(at.x_m - prior.pose.x_m, at.y_m - prior.pose.y_m,
                               at.yaw_rad - prior.pose.yaw_rad);
    double cost = 0.5 * step.dot(prior.covariance.inverse() * step);
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      const SurfaceMatch& match = matches[beam];
      if (match.surface == nullptr) continue;
      const Eigen::Vector2d offset = at * scan.end_point_m(beam) - match.surface->mean_m;
      const double distance_m = match.is_line ? std::abs(match.surface->normal.dot(offset)) : offset.norm();
      const double scale_m2 = params.residual_scale_m * params.residual_scale_m;
      const double robust_m2 = 0.5 * scale_m2 * std::log1p(distance_m * distance_m / scale_m2);
      cost += (match.is_line ? 1.0 : params.point_weight) * params.gamma / static_cast<double>(associations) *
              robust_m2 / params.dvl.occupied_m2;
    }
    return cost;
  }

  [[nodiscard]] Eigen::Vector3d gradient(const Pose2& at) const {
    return room::numerical_jacobian<1>(
               at, [this](const Pose2& pose) { return Eigen::Matrix<double, 1, 1>((*this)(pose)); })
        .transpose();
  }
};

const Eigen::Matrix3d kWide = Eigen::Vector3d(0.05 * 0.05, 0.05 * 0.05, 0.035 * 0.035).asDiagonal();

}  // namespace

TEST_CASE("The end point's Jacobian is the derivative of the end point", "[estimation]") {
  Random random(1);
  for (int draw = 0; draw < 200; ++draw) {
    const Pose2 pose{random.normal(), random.normal(), random.uniform(-3.0, 3.0)};
    const Eigen::Vector2d point(random.normal(0.0, 5.0), random.normal(0.0, 5.0));
    const double angle_rad = random.uniform(-3.0, 3.0);
    const Eigen::Vector2d axis(std::cos(angle_rad), std::sin(angle_rad));
    const Eigen::Matrix<double, 1, 3> numerical = room::numerical_jacobian<1>(
        pose, [&](const Pose2& at) { return Eigen::Matrix<double, 1, 1>(axis.dot(at * point)); });
    REQUIRE((end_point_jacobian(axis, pose.rotation() * point) - numerical.transpose()).norm() < 1e-7);
  }
}

TEST_CASE("An end point is matched to the nearest line of its side, else to a point", "[estimation]") {
  const RegistrationParams params;
  SurfaceMap<2> surfaces(coarse_params());
  for (double x_m = -0.5; x_m < 0.5; x_m += 0.01) {
    surfaces.add({x_m, 0.03}, {0.0, 1.0});   // a wall's lower face
    surfaces.add({x_m, 0.17}, {0.0, -1.0});  // and its upper one
  }
  surfaces.add({3.05, 3.05}, {0.0, 1.0});  // a lone point
  surfaces.refresh_normals();

  for (const double y_m : {-0.1, 0.05, 0.15}) {
    const SurfaceMatch below = match_surface(surfaces, {0.07, y_m}, {0.3, 0.8}, params);
    REQUIRE(below.surface != nullptr);
    REQUIRE(below.is_line);
    REQUIRE(below.surface->normal.y() == Approx(-1.0));
    REQUIRE(std::abs(below.surface->mean_m.x() - 0.07) < 0.1);
    const SurfaceMatch above = match_surface(surfaces, {0.07, y_m}, {0.3, -0.8}, params);
    REQUIRE(above.surface != nullptr);
    REQUIRE(above.surface->normal.y() == Approx(1.0));
  }
  // Across the line by more than 0.3 m, or beyond its end by more than 0.25 m.
  REQUIRE(match_surface(surfaces, {0.0, -0.28}, {0.0, 1.0}, params).surface == nullptr);
  REQUIRE(match_surface(surfaces, {0.72, 0.03}, {0.0, 1.0}, params).surface == nullptr);

  const SurfaceMatch point = match_surface(surfaces, {3.05, 3.15}, {0.0, 1.0}, params);
  REQUIRE(point.surface != nullptr);
  REQUIRE_FALSE(point.is_line);
  REQUIRE(match_surface(surfaces, {3.05, 3.21}, {0.0, 1.0}, params).surface == nullptr);
  REQUIRE(match_surface(surfaces, {3.05, 3.15}, {0.0, -1.0}, params).surface == nullptr);
}

TEST_CASE("Among lines the match weighs the way along them by a quarter", "[estimation]") {
  SurfaceMap<2>::Params short_lines = coarse_params();
  short_lines.pool_radius_m = 0.12;
  SurfaceMap<2> surfaces(short_lines);
  for (int n = 0; n < 9; ++n) {
    surfaces.add({0.02 + 0.02 * n, 0.10}, {0.0, 1.0});  // around (0.1, 0.10)
    surfaces.add({0.22 + 0.02 * n, 0.02}, {0.0, 1.0});  // around (0.3, 0.02)
  }
  surfaces.refresh_normals();
  RegistrationParams params;
  params.along_weight = 0.25;
  const auto matched_y_m = [&](double y_m) {
    const SurfaceMatch match = match_surface(surfaces, {0.15, y_m}, {0.0, 1.0}, params);
    REQUIRE(match.is_line);
    return match.surface->mean_m.y();
  };
  // With t^2 / 4, r^2 + t^2 / 4 of the first and of the second: 0.0087 > 0.0057, then 0.0036 < 0.0063.
  REQUIRE(matched_y_m(0.010) == Approx(0.02));
  REQUIRE(matched_y_m(0.045) == Approx(0.10));
}

TEST_CASE("Registration finds a robot's pose in a turned room to millimetres", "[estimation]") {
  Random random(2);
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  const SurfaceMap<2> surfaces = surfaces_of(walls, {room::kTurned * Pose2{0.5, 0.2, 1.0}});
  for (int draw = 0; draw < 20; ++draw) {
    const Pose2 truth = room::kTurned * Pose2{random.uniform(-1.5, 1.5), random.uniform(-1.0, 1.0),
                                              random.uniform(-3.1, 3.1)};
    const Scan<2> scan = room::scan_of(walls, truth);
    const double angle_rad = random.uniform(-3.1, 3.1);
    const double turn_rad = (draw % 2 == 0 ? 1.0 : -1.0) * 2.0 * 3.14159265 / 180.0;
    PoseBelief belief{moved(truth, 0.05 * std::cos(angle_rad), 0.05 * std::sin(angle_rad), turn_rad), kWide};
    Registration last;
    for (int correction = 0; correction < 10; ++correction) {
      last = register_scan(belief, scan, surfaces, RegistrationParams{});
      belief.pose = last.belief.pose;
    }
    CAPTURE(draw, last.associations, last.residual_rms_m);
    REQUIRE(room::position_error_m(belief.pose, truth) < 0.001);
    REQUIRE(room::heading_error_rad(belief.pose, truth) < 0.0005);
    REQUIRE(last.associations > 350);
    REQUIRE(last.residual_rms_m < 0.01);
  }
}

TEST_CASE("Where registration converges, the gradient of its cost vanishes", "[estimation]") {
  Random random(3);
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  const SurfaceMap<2> surfaces = surfaces_of(walls, {room::kTurned});
  RegistrationParams params;
  params.iterations = 200;
  for (int draw = 0; draw < 10; ++draw) {
    const Pose2 truth =
        room::kTurned * Pose2{random.uniform(-1.0, 1.0), random.uniform(-0.5, 0.5), 0.3 * draw};
    Scan<2> scan = room::scan_of(walls, truth);
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      scan.set_range_m(beam, scan.range_m(beam) + random.normal(0.0, 0.02));
    }
    const PoseBelief prior{moved(truth, 0.02, -0.01, 0.01), room::random_covariance(random, 0.03)};
    const Pose2 found = register_scan(prior, scan, surfaces, params).belief.pose;
    const Cost cost(prior, scan, surfaces, params, found);
    CAPTURE(draw);
    REQUIRE(cost.gradient(found).norm() < 1e-4 * cost.gradient(prior.pose).norm());
    REQUIRE(cost(found) < cost(prior.pose));
    for (int direction = 0; direction < 20; ++direction) {
      const Pose2 near =
          moved(found, random.normal(0.0, 1e-3), random.normal(0.0, 1e-3), random.normal(0.0, 1e-3));
      REQUIRE(cost(near) > cost(found));
    }
  }
}

TEST_CASE("Registration's covariance is the inverse of its cost's curvature", "[estimation]") {
  // Only lines, met exactly: Gauss-Newton's approximation is then the Hessian itself.
  SurfaceMap<2> surfaces;
  const std::vector<room::Wall> walls = room::box(room::kTurned, 3.0, 2.0);
  surfaces = surfaces_of(walls, {room::kTurned});
  BeamPattern<2> beams;
  for (const double degrees : {0.0, 5.0, -7.0, 85.0, 95.0, 180.0, 172.0, 265.0, 280.0}) {
    beams.directions.emplace_back(std::cos(degrees * 3.14159265358979 / 180.0),
                                  std::sin(degrees * 3.14159265358979 / 180.0));
  }
  const Scan<2> scan = room::scan_of(walls, room::kTurned, beams);
  const PoseBelief prior{room::kTurned, kWide};
  const RegistrationParams params;
  const Registration found = register_scan(prior, scan, surfaces, params);
  REQUIRE(found.associations == 9);
  REQUIRE(room::position_error_m(found.belief.pose, room::kTurned) < 1e-6);
  const Cost cost(prior, scan, surfaces, params, room::kTurned);
  const Eigen::Matrix3d hessian = room::numerical_jacobian<3>(
      room::kTurned,
      [&](const Pose2& at) {
        return Eigen::Vector3d(
            room::numerical_jacobian<1>(
                at, [&](const Pose2& pose) { return Eigen::Matrix<double, 1, 1>(cost(pose)); }, 1e-4)
                .transpose());
      },
      1e-4);
  REQUIRE((hessian * found.belief.covariance - Eigen::Matrix3d::Identity()).norm() < 1e-3);

  // gamma / N_h: the same beams twice say no more than once.
  const std::vector<Point<2>> once = beams.directions;
  beams.directions.insert(beams.directions.end(), once.begin(), once.end());
  const Registration doubled =
      register_scan(prior, room::scan_of(walls, room::kTurned, beams), surfaces, params);
  REQUIRE(doubled.associations == 18);
  REQUIRE((doubled.belief.covariance - found.belief.covariance).norm() < 1e-12);
}

TEST_CASE("The less certain the surface, the less registration trusts it", "[estimation]") {
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  const SurfaceMap<2> surfaces = surfaces_of(walls, {room::kTurned});
  const Scan<2> scan = room::scan_of(walls, room::kTurned);
  const PoseBelief prior{moved(room::kTurned, 0.05, 0.0, 0.0), kWide};
  double trace = 0.0;
  double error_m = 0.0;
  for (const double p : {0.95, 0.7, 0.5, 0.2}) {
    const Registration found = register_scan(
        prior, scan, surfaces, RegistrationParams{}, Certainty(p));
    REQUIRE(found.belief.covariance.trace() > trace);
    REQUIRE(room::position_error_m(found.belief.pose, room::kTurned) > error_m);
    trace = found.belief.covariance.trace();
    error_m = room::position_error_m(found.belief.pose, room::kTurned);
  }
  // One certainty for all surfaces acts as 1 / R_x of (10): 0.01 m^2 at p = 1, 2.2525 at p = 1/2.
  RegistrationParams strong;
  strong.gamma *= 2.2525 / 0.01;
  const Registration half = register_scan(
      prior, scan, surfaces, strong, Certainty(0.5));
  const Registration certain = register_scan(prior, scan, surfaces, RegistrationParams{});
  REQUIRE((half.belief.covariance - certain.belief.covariance).norm() <
          1e-9 * certain.belief.covariance.norm());
}

TEST_CASE("An error that surfaces share is not averaged over beams", "[estimation]") {
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  const SurfaceMap<2> surfaces = surfaces_of(walls, {room::kTurned});
  const Scan<2> scan = room::scan_of(walls, room::kTurned);
  const PoseBelief prior{room::kTurned, kWide};
  // All surfaces shift along x with a variance of 0.01 m^2: a residual drifts by its Jacobian's x.
  const auto shifts = [](const Surface<2>&, const Eigen::Vector3d& jacobian) { return 0.01 * jacobian[0] * jacobian[0]; };
  RegistrationParams params;
  const Registration firm = register_scan(prior, scan, surfaces, params);
  const Registration shifting = register_scan(prior, scan, surfaces, params, Excess(shifts));
  params.gamma *= 1e6;
  const Registration many = register_scan(prior, scan, surfaces, params, Excess(shifts));
  const Registration many_firm = register_scan(prior, scan, surfaces, params);
  const auto along = [](const Registration& found, Eigen::Index axis) {
    return found.belief.covariance(axis, axis);
  };
  REQUIRE(along(shifting, 0) > 2.0 * along(firm, 0));
  REQUIRE(along(many, 0) > 0.3 * along(shifting, 0));
  REQUIRE(along(many_firm, 0) < 1e-3 * along(shifting, 0));

  // A turn of the surfaces by a variance v moves the end point at p along n by v (n x p)^2.
  const auto turns = [](const Surface<2>& surface, const Eigen::Vector3d& jacobian) {
    const Eigen::Vector2d& mean = surface.mean_m;
    const double lever_m = mean.x() * surface.normal.y() - mean.y() * surface.normal.x();
    if (surface.planar) CHECK(jacobian[2] == Approx(lever_m).margin(0.3));
    return 0.0;
  };
  const Registration same = register_scan(prior, scan, surfaces, RegistrationParams{}, Excess(turns));
  REQUIRE(same.belief.covariance == firm.belief.covariance);
}

TEST_CASE("Without associations the posterior is the prior", "[estimation]") {
  Random random(4);
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  const SurfaceMap<2> surfaces = surfaces_of(walls, {room::kTurned});
  const PoseBelief prior{room::kTurned, room::random_covariance(random, 0.1)};
  const Scan<2> scan = room::scan_of(walls, room::kTurned);
  const auto require_prior = [&](const Registration& found) {
    REQUIRE(found.associations == 0);
    REQUIRE(found.residual_rms_m == 0.0);
    REQUIRE(room::position_error_m(found.belief.pose, prior.pose) == 0.0);
    REQUIRE(found.belief.pose.yaw_rad == prior.pose.yaw_rad);
    REQUIRE(found.belief.covariance == prior.covariance);
  };
  require_prior(register_scan(prior, scan, SurfaceMap<2>(), {}));
  require_prior(register_scan(prior, Scan<2>(circular_beams(90, 10.0)), surfaces, {}));
  require_prior(register_scan(prior, scan, surfaces, {}, Certainty(-1.0)));
  Scan<2> bad(circular_beams(90, 10.0));
  for (std::size_t beam = 0; beam < 90; ++beam)
    bad.set_range_m(beam, std::numeric_limits<double>::quiet_NaN());
  require_prior(register_scan(prior, bad, surfaces, {}));
}

TEST_CASE("A single wall corrects along its normal and the heading, and nothing else", "[estimation]") {
  // A wall so long that its ends are out of sight; the beams look at its middle.
  const double angle_rad = 0.3;
  const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
  const Eigen::Vector2d normal(-along.y(), along.x());
  const std::vector<room::Wall> wall{{2.0 * normal - 8.0 * along, 2.0 * normal + 8.0 * along}};
  std::vector<Pose2> poses;
  for (double x_m = -3.0; x_m <= 3.0; x_m += 0.5) poses.push_back({x_m * along.x(), x_m * along.y(), 0.0});
  const SurfaceMap<2> surfaces = surfaces_of(wall, poses);
  const Pose2 truth{0.0, 0.0, angle_rad};
  const Scan<2> scan = room::scan_of(wall, truth, planar_beams(61, 1.07, 0.0167, 10.0));

  const Eigen::Vector2d offset = 0.04 * normal + 0.05 * along;
  PoseBelief belief{moved(truth, offset.x(), offset.y(), 0.02),
                    Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal()};
  const Eigen::Matrix3d prior_covariance = belief.covariance;
  for (int correction = 0; correction < 10; ++correction) {
    belief =
        register_scan({belief.pose, prior_covariance}, scan, surfaces, RegistrationParams{}).belief;
  }
  REQUIRE(normal.dot(belief.pose.position()) == Approx(0.0).margin(1e-4));
  REQUIRE(belief.pose.yaw_rad == Approx(angle_rad).margin(1e-4));
  REQUIRE(along.dot(belief.pose.position()) == Approx(0.05).margin(1e-3));
  const Eigen::Matrix2d position = belief.covariance.topLeftCorner<2, 2>();
  REQUIRE(along.dot(position * along) == Approx(0.01).epsilon(1e-3));
  REQUIRE(normal.dot(position * normal) < 0.002);
  REQUIRE(belief.covariance(2, 2) < 0.005);
}

TEST_CASE("Registration takes a prior that is certain of a direction, or of all", "[estimation]") {
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  const SurfaceMap<2> surfaces = surfaces_of(walls, {room::kTurned});
  const Scan<2> scan = room::scan_of(walls, room::kTurned);
  const Pose2 off = moved(room::kTurned, 0.02, 0.02, 0.0);
  const Registration exact = register_scan({off, Eigen::Matrix3d::Zero()}, scan, surfaces, {});
  REQUIRE(room::position_error_m(exact.belief.pose, off) == 0.0);
  REQUIRE(exact.belief.covariance == Eigen::Matrix3d::Zero());
  const Registration partly = register_scan({off, Eigen::Vector3d(0.01, 0.0, 0.01).asDiagonal()}, scan,
                                            surfaces, RegistrationParams{});
  REQUIRE(partly.belief.pose.y_m == off.y_m);
  REQUIRE(std::abs(partly.belief.pose.x_m - room::kTurned.x_m) < 0.012);
}

TEST_CASE("Registration refuses parameters outside of their bounds", "[estimation]") {
  REQUIRE_NOTHROW(RegistrationParams{}.validate());
  using Params = RegistrationParams;
  for (const double bad :
       {0.0, -0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (double Params::*field : {&Params::gamma, &Params::across_max_m, &Params::along_max_m,
                                  &Params::point_distance_max_m, &Params::point_weight, &Params::residual_scale_m}) {
      Params params;
      params.*field = bad;
      REQUIRE_THROWS_AS(params.validate(), std::invalid_argument);
    }
  }
  Params params;
  params.iterations = 0;
  REQUIRE_THROWS_AS(params.validate(), std::invalid_argument);
  params = {};
  params.dvl.unoccupied_m2 = 0.001;
  REQUIRE_THROWS_AS(params.validate(), std::invalid_argument);
}
