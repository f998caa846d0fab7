/// A scan registered to the surfaces of a map: Gauss-Newton in information form, heading included.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/estimation/information.hpp"
#include "incognita/estimation/pose_belief.hpp"
#include "incognita/estimation/surface_map.hpp"
#include "incognita/sensor/dvl.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// Parameters of register_scan.
struct RegistrationParams {
  DvlVariances dvl{0.01, 9.0};                                 ///< R_o and R_u
  MixtureVariance mixture = MixtureVariance::squared_weights;  ///< how R_x is mixed
  /// The weight of a whole scan, in beams of variance R_x; > 0. With R_o = (0.1 m)^2, 480 of them weigh as much as five
  /// ranges with a noise of 0.01 m: the errors of a scan's beams against a map are far from independent.
  double gamma = 480.0;
  int iterations = 2;              ///< >= 1
  double across_max_m = 0.3;       ///< a line (plane) is associated within this distance across ...
  double along_max_m = 0.25;       ///< ... and this distance along it
  double point_distance_max_m = 0.15;  ///< a point is, within this distance
  double point_weight = 0.5;       ///< of a point against a line
  double along_weight = 0.05;      ///< of the squared distance along a line, against that across it, in the choice of one
  /// Residuals beyond this count less and less (Cauchy's weights): the edges of walls act as outliers, and a kernel that
  /// never lets go of them, as Huber's, lets the map drift twice as fast. About the noise of a range.
  double residual_scale_m = 0.01;

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    dvl.validate();
    require_positive("RegistrationParams", "gamma", gamma);
    require(iterations >= 1, "RegistrationParams", "iterations", iterations, ">= 1");
    require_positive("RegistrationParams", "across_max_m", across_max_m);
    require_positive("RegistrationParams", "along_max_m", along_max_m);
    require_positive("RegistrationParams", "point_distance_max_m", point_distance_max_m);
    require_positive("RegistrationParams", "point_weight", point_weight);
    require_non_negative("RegistrationParams", "along_weight", along_weight);
    require_positive("RegistrationParams", "residual_scale_m", residual_scale_m);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields(
        "dvl, mixture, gamma, iterations, across_max_m, along_max_m, point_distance_max_m, point_weight, along_weight, "
        "residual_scale_m",
        dvl, mixture, gamma, iterations, across_max_m, along_max_m, point_distance_max_m, point_weight, along_weight, residual_scale_m);
  }
};

/// What register_scan found.
struct Registration {
  PoseBelief belief;                   ///< after the scan, in the map's frame
  std::size_t hits = 0;                ///< beams that ended on something
  std::size_t associations = 0;        ///< N_h: those with a surface, in the last iteration
  double residual_rms_m = 0.0;         ///< of those beams, in the last iteration
};

/// Where the residual of one beam points. The residual of a line is signed along its normal; a point has one along each
/// axis.
struct SurfaceMatch {
  const Surface<2>* surface = nullptr;  ///< the one that the beam is matched with
  bool is_line = false;                 ///< planar; else its mean is a point
  Eigen::Vector2d offset_m{0.0, 0.0};   ///< from the surface's mean to the end point

  /// Signed for lines.
  [[nodiscard]] double residual_m() const { return is_line ? dot(surface->normal, offset_m) : norm(offset_m); }
};

/// What is believed of surfaces beyond what was measured of them: here, that they are walls where they were measured.
struct CertainSurfaces {
  /// Whether a beam may be associated with it at all.
  [[nodiscard]] bool admits(const Surface<2>& /*surface*/) const { return true; }

  /// That something is there, in [0, 1]; < 0 leaves the surface out.
  [[nodiscard]] double occupied_probability(const Surface<2>& /*surface*/) const { return 1.0; }

  /// The variance that the surface itself has along a residual, beyond others; `jacobian` is the residual's derivative by a
  /// twist of the surface about the map's origin.
  [[nodiscard]] double excess_variance_m2(const Surface<2>& /*surface*/, const Eigen::Vector3d& /*jacobian*/) const {
    return 0.0;
  }

  /// How far from where it was measured the surface is thought to be, at a point beside it.
  [[nodiscard]] Eigen::Vector2d shift_m(const Surface<2>& /*surface*/, const Eigen::Vector2d& /*at_m*/) const {
    return {0.0, 0.0};
  }
};

/// The best surface for an end point seen along `direction`, both in the map's frame: the line with the smallest
/// r^2 + along_weight t^2 (r across, t along it), else the nearest point of the same side.
template <class SurfaceBelief = CertainSurfaces>
[[nodiscard]] SurfaceMatch match_surface(const SurfaceMap<2>& surfaces, const Eigen::Vector2d& end_point_m,
                                         const Eigen::Vector2d& direction, const RegistrationParams& params,
                                         const SurfaceBelief& belief = {}) {
  SurfaceMatch line{nullptr, true, {}};
  SurfaceMatch point{nullptr, false, {}};
  double line_cost_m2 = std::numeric_limits<double>::infinity();
  double point_cost_m2 = params.point_distance_max_m * params.point_distance_max_m;
  surfaces.for_each_near(end_point_m, [&](const Surface<2>& surface) {
    if (!surface.faces(direction) || !belief.admits(surface)) return;
    const Eigen::Vector2d offset_m =
        difference(difference(end_point_m, surface.mean_m), belief.shift_m(surface, end_point_m));
    const double distance_m2 = dot(offset_m, offset_m);
    if (surface.planar) {
      const double across_m = dot(surface.normal, offset_m);
      const double along_m2 = distance_m2 - across_m * across_m;
      const double cost_m2 = across_m * across_m + params.along_weight * along_m2;
      if (std::abs(across_m) <= params.across_max_m && along_m2 <= params.along_max_m * params.along_max_m &&
          cost_m2 < line_cost_m2) {
        line_cost_m2 = cost_m2;
        line.surface = &surface;
        line.offset_m = offset_m;
      }
    }
    if (distance_m2 < point_cost_m2) {
      point_cost_m2 = distance_m2;
      point.surface = &surface;
      point.offset_m = offset_m;
    }
  });
  return line.surface != nullptr ? line : point;
}

/// The derivative of an end point in the map's frame by (x, y, yaw), projected on `axis`; `rotated_m` is the way to it from
/// the robot (by a twist: from the origin).
[[nodiscard]] inline Eigen::Vector3d end_point_jacobian(const Eigen::Vector2d& axis, const Eigen::Vector2d& rotated_m) {
  return {axis[0], axis[1], axis[1] * rotated_m[0] - axis[0] * rotated_m[1]};
}

/// Cauchy's weight of a residual.
[[nodiscard]] inline double robust_weight(double residual_m, const RegistrationParams& params) {
  const double scaled_residual = residual_m / params.residual_scale_m;
  return 1.0 / (1.0 + scaled_residual * scaled_residual);
}

/// Adds what a match says of the motion that end_point_jacobian is the derivative by; weight(axis) is that of its residual
/// along an axis.
template <class Weight>
inline void add_match(Information& information, const SurfaceMatch& match, const Eigen::Vector2d& rotated_m,
                      double point_weight, const Weight& weight) {
  if (match.is_line) {
    const Eigen::Vector2d& normal = match.surface->normal;
    information.add(end_point_jacobian(normal, rotated_m), -match.residual_m(), weight(normal));
    return;
  }
  for (const Eigen::Vector2d& axis : {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.0, 1.0)}) {
    information.add(end_point_jacobian(axis, rotated_m), -dot(axis, match.offset_m), point_weight * weight(axis));
  }
}

/// The Gauss-Newton step counted from the prior, which needs no inverse of the prior's covariance. A template, so that its
/// Eigen expression costs only those who register. `tempered` is the weight of the information.
template <class Matrix, class Vector>
[[nodiscard]] Vector gauss_newton_step(const Matrix& posterior, const Matrix& information, const Vector& gradient,
                                       const Vector& from_prior, double tempered) {
  return posterior * (tempered * (information * from_prior + gradient));
}

/// Minimises the prior's Mahalanobis distance plus the tempered, robust distances of the end points to their surfaces,
///   sum_k w_k r_k^2 / (N_h (R_x / gamma + E_k)),
/// with R_x of Seo et al., (10), from the belief's occupied_probability. E_k, its excess_variance_m2, is not tempered by
/// gamma: beams do not average an error that their surfaces share.
/// The paper allows for such a registration in the estimation step (section IV-B, property 4); points on lines are the
/// reading's answer to residuals that snap to a lattice. Without associations the posterior is the prior.
/// O(beams * iterations); no allocation; safe to call from many threads.
template <class SurfaceBelief = CertainSurfaces>
[[nodiscard]] Registration register_scan(const PoseBelief& prior, const Scan<2>& scan, const SurfaceMap<2>& surfaces,
                                         const RegistrationParams& params, const SurfaceBelief& belief = {}) {
  Registration result{prior, 0, 0, 0.0};
  for (int iteration = 0; iteration < params.iterations; ++iteration) {
    const Eigen::Matrix2d rotation = result.belief.pose.rotation();
    const Eigen::Vector2d origin = result.belief.pose.position();
    Information information;
    std::size_t hits = 0;
    std::size_t associations = 0;
    double squares_m2 = 0.0;
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (scan.reading(beam) != Reading::hit) continue;
      ++hits;
      const Eigen::Vector2d direction = product(rotation, scan.direction(beam));
      const Eigen::Vector2d rotated_m = scaled(direction, scan.range_m(beam));
      const Eigen::Vector2d end_point_m = sum(origin, rotated_m);
      const SurfaceMatch match = match_surface(surfaces, end_point_m, direction, params, belief);
      if (match.surface == nullptr) continue;
      const double probability = belief.occupied_probability(*match.surface);
      if (probability < 0.0) continue;
      const double variance_m2 = measurement_variance_m2(params.dvl, probability, params.mixture);
      const double residual_m = match.residual_m();
      const double robust = robust_weight(residual_m, params);
      ++associations;
      squares_m2 += residual_m * residual_m;
      add_match(information, match, rotated_m, params.point_weight, [&](const Eigen::Vector2d& axis) {
        const double excess_m2 = belief.excess_variance_m2(*match.surface, end_point_jacobian(axis, end_point_m));
        return robust / (variance_m2 + params.gamma * excess_m2);
      });
    }
    result.hits = hits;
    if (associations == 0) return {prior, hits, 0, 0.0};
    const double tempered = params.gamma / static_cast<double>(associations);
    const Eigen::Vector3d from_prior(result.belief.pose.x_m - prior.pose.x_m, result.belief.pose.y_m - prior.pose.y_m,
                                     angle_between_rad(prior.pose.yaw_rad, result.belief.pose.yaw_rad));
    Eigen::Matrix3d tempered_information;
    for (int i = 0; i < 9; ++i) tempered_information(i) = tempered * information.matrix(i);
    result.belief.covariance = updated_covariance(prior.covariance, tempered_information);
    const Eigen::Vector3d step =
        gauss_newton_step(result.belief.covariance, information.matrix, information.vector, from_prior, tempered);
    result.belief.pose = {prior.pose.x_m + step[0], prior.pose.y_m + step[1],
                          wrap_angle_rad(prior.pose.yaw_rad + step[2])};
    result.associations = associations;
    result.residual_rms_m = std::sqrt(squares_m2 / static_cast<double>(associations));
  }
  return result;
}

}  // namespace incognita
