/// The localisation update of Seo et al., Lemma 4.1, in its ray form.
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/estimation/information.hpp"
#include "incognita/estimation/pose_belief.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/sensor/dvl.hpp"

namespace incognita {

/// One hit cell seen along one beam.
struct RayObservation {
  Eigen::Vector2d direction;  ///< unit vector from the sensor to the cell's centre, in the map's frame
  double residual_m;          ///< z - h(x, m); not used by a covariance alone
  double probability;         ///< of the cell being occupied, before this scan
};

/// What gamma is divided by, so that a scan does not count as so many independent measurements.
enum class Tempering {
  hits,  ///< N_h, the number of hit cells: Seo et al., (11). One hit beam alone carries gamma's full weight.
  beams  ///< the number of beams: where little is seen, little is learned
};

/// Parameters of the ray form.
struct RayUpdateParams {
  DvlVariances dvl;                                            ///< R_o and R_u
  double gamma = 1.2;                                          ///< > 0
  Tempering tempering = Tempering::hits;                       ///< what gamma is divided by
  MixtureVariance mixture = MixtureVariance::squared_weights;  ///< how R_x is mixed

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    dvl.validate();
    require_positive("RayUpdateParams", "gamma", gamma);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("dvl, gamma, tempering, mixture", dvl, gamma, tempering, mixture);
  }
};

/// The tempered sum of (11) over the hits of a scan of beam_count beams. h = ||x - chi||, so H = (-direction, 0): the
/// heading is corrected only through its covariance with the position.
[[nodiscard]] inline Information ray_information(std::span<const RayObservation> hits, std::size_t beam_count,
                                                 const RayUpdateParams& params) {
  Information information;
  if (hits.empty()) return information;
  const std::size_t divisor = params.tempering == Tempering::hits ? hits.size() : beam_count;
  const double tempered = params.gamma / static_cast<double>(divisor);
  for (const RayObservation& hit : hits) {
    const double variance_m2 = measurement_variance_m2(params.dvl, hit.probability, params.mixture);
    information.add({-hit.direction[0], -hit.direction[1], 0.0}, hit.residual_m, tempered / variance_m2);
  }
  return information;
}

/// (11a) and (11b), read with h(mu_bar, m) where the paper prints h(x_t, m). Without hits the posterior is the prior.
[[nodiscard]] inline PoseBelief ray_update(const PoseBelief& prior, std::span<const RayObservation> hits,
                                           std::size_t beam_count, const RayUpdateParams& params) {
  const Information information = ray_information(hits, beam_count, params);
  PoseBelief posterior;
  posterior.covariance = updated_covariance(prior.covariance, information.matrix);
  const Eigen::Vector3d correction = product(posterior.covariance, information.vector);
  posterior.pose = {prior.pose.x_m + correction[0], prior.pose.y_m + correction[1],
                    wrap_angle_rad(prior.pose.yaw_rad + correction[2])};
  return posterior;
}

}  // namespace incognita
