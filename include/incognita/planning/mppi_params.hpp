/// What an MppiController is made with.
#pragma once

#include <cmath>
#include <cstdint>

#include "incognita/core/error.hpp"

namespace incognita {

/// What the robot can do, how plans are sampled, and what makes one better than another. Costs have no unit; the weights say what a metre, a
/// second or a deviation costs. A plan holds each of its commands for step_s, and is made anew that often.
struct MppiParams {
  int horizon_steps = 25;                  ///< commands in a plan, in 1..1000
  double step_s = 0.1;                     ///< how long each is held, > 0: from one call of command() to the next
  int samples = 256;                       ///< plans that are compared in each call, in 2..100000
  double speed_sigma_m_per_s = 0.3;        ///< of the noise that a sample adds to each speed of the plan, >= 0
  double turn_rate_sigma_rad_per_s = 0.4;  ///< likewise to each turn rate
  double noise_lasts_s = 0.5;              ///< the noise's correlation falls to 1 / e within this time, >= 0; what jumps from step to step leads nowhere
  double temperature = 0.3;                ///< > 0, the factor lambda: samples whose costs differ by this much weigh e times as much as each other
  double speed_max_m_per_s = 1.0;          ///< > 0; it never drives backwards
  double turn_rate_max_rad_per_s = 1.0;    ///< > 0, either way
  double deceleration_m_per_s2 = 1.0;      ///< how hard it brakes before the path's end
  double robot_radius_m = 0.2;             ///< > 0
  double margin_m = 0.15;                  ///< beyond the radius, in which obstacles cost the more the nearer they are, > 0
  double aim_m = 0.4;                      ///< the heading that it likes leads to the place so far ahead on the path, > 0
  double way_left_weight = 4.0;            ///< the factor of the metres that are left to drive, along the path and to it, a second, >= 0
  double deviation_weight = 4.0;           ///< the factor of squared metres beside the path, a second, >= 0
  double heading_weight = 1.0;             ///< the factor of 1 - cos(heading off the place ahead), a second, >= 0
  double speed_weight = 0.5;               ///< the factor of squared m/s off the wanted speed, a second, >= 0
  double smoothness_weight = 0.05;         ///< the factor of squared m/s and squared rad/s from each command to the next, >= 0
  double obstacle_weight = 4.0;            ///< the factor of the squared share of the margin that an obstacle takes, a second, >= 0
  double collision_weight = 100.0;         ///< the factor of a second within the radius of an obstacle, and twice that at its centre, >= 0
  std::uint64_t seed = 1;                  ///< of the noise
  int threads = 1;                         ///< for the samples, 0: OpenMP's own number; the plan does not depend on it. A call takes less than a busy core may keep it waiting

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require(horizon_steps >= 1 && horizon_steps <= 1000, "MppiParams", "horizon_steps", horizon_steps, "in 1..1000");
    require_positive("MppiParams", "step_s", step_s);
    require(samples >= 2 && samples <= 100000, "MppiParams", "samples", samples, "in 2..100000");
    require_non_negative("MppiParams", "speed_sigma_m_per_s", speed_sigma_m_per_s);
    require_non_negative("MppiParams", "turn_rate_sigma_rad_per_s", turn_rate_sigma_rad_per_s);
    require_non_negative("MppiParams", "noise_lasts_s", noise_lasts_s);
    require_positive("MppiParams", "temperature", temperature);
    require_positive("MppiParams", "speed_max_m_per_s", speed_max_m_per_s);
    require_positive("MppiParams", "turn_rate_max_rad_per_s", turn_rate_max_rad_per_s);
    require_positive("MppiParams", "deceleration_m_per_s2", deceleration_m_per_s2);
    require_positive("MppiParams", "robot_radius_m", robot_radius_m);
    require_positive("MppiParams", "margin_m", margin_m);
    require_positive("MppiParams", "aim_m", aim_m);
    require_non_negative("MppiParams", "way_left_weight", way_left_weight);
    require_non_negative("MppiParams", "deviation_weight", deviation_weight);
    require_non_negative("MppiParams", "heading_weight", heading_weight);
    require_non_negative("MppiParams", "speed_weight", speed_weight);
    require_non_negative("MppiParams", "smoothness_weight", smoothness_weight);
    require_non_negative("MppiParams", "obstacle_weight", obstacle_weight);
    require_non_negative("MppiParams", "collision_weight", collision_weight);
    require(threads >= 0, "MppiParams", "threads", threads, ">= 0");
    const double reach = reach_m();
    require(std::isfinite(reach) && reach <= 1000.0, "MppiParams", "horizon_steps * step_s * speed_max_m_per_s", reach, "<= 1000");
  }

  /// How far from the robot a plan may lead at most.
  [[nodiscard]] double reach_m() const { return horizon_steps * step_s * speed_max_m_per_s; }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields(
        "horizon_steps, step_s, samples, speed_sigma_m_per_s, turn_rate_sigma_rad_per_s, noise_lasts_s, temperature, speed_max_m_per_s, "
        "turn_rate_max_rad_per_s, deceleration_m_per_s2, robot_radius_m, margin_m, aim_m, way_left_weight, deviation_weight, heading_weight, "
        "speed_weight, smoothness_weight, obstacle_weight, collision_weight, seed",
        horizon_steps, step_s, samples, speed_sigma_m_per_s, turn_rate_sigma_rad_per_s, noise_lasts_s, temperature, speed_max_m_per_s,
        turn_rate_max_rad_per_s, deceleration_m_per_s2, robot_radius_m, margin_m, aim_m, way_left_weight, deviation_weight, heading_weight,
        speed_weight, smoothness_weight, obstacle_weight, collision_weight, seed);
  }
};

}  // namespace incognita
