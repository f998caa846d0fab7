/// Model predictive path integral control: steering along a path by the mean of many plans, the cheap ones weighing most.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/counter_random.hpp"
#include "incognita/core/error.hpp"
#include "incognita/core/parallel.hpp"
#include "incognita/geometry/pose.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/geometry/unicycle.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/planning/follow.hpp"
#include "incognita/planning/mppi_cost.hpp"
#include "incognita/planning/mppi_params.hpp"

namespace incognita {

/// The weights of samples by their costs, both without a unit: w = exp(-(S - min S) / temperature), of which the sum is 1 (Williams et al.
/// 2018). The costs must be finite, and at least one; `weights` gets as many. The sum is taken in their order.
inline void path_integral_weights(const std::vector<double>& costs, double temperature, std::vector<double>& weights) {
  const double least = *std::min_element(costs.begin(), costs.end());
  weights.resize(costs.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    weights[i] = std::exp((least - costs[i]) / temperature);
    sum += weights[i];
  }
  for (double& weight : weights) weight /= sum;
}

/// Steers a unicycle along a path, around what is in its way (Williams et al. 2018; the local planner of Seo et al., section VI-B). The plan
/// begins as the way that pure pursuit drives (Coulter 1992), the warm start, and goes on as the plan before, a step later. In each call
/// many plans with noise added to it are driven in thought; it moves by the mean of their noise, weighted by their costs. To leave the plan
/// costs nothing as such (alpha = 1 of Williams et al.), and commands are limited where they are driven, so noise beyond a limit is not
/// lost on the mean. A plain value. Not thread safe; command() uses threads of its own, and its result does not depend on their number.
class MppiController {
 public:
  /// Throws std::invalid_argument for parameters outside of their bounds.
  explicit MppiController(const MppiParams& params = {}) : params_(valid(params)), random_(params.seed), cost_(params) {
    if (params.noise_lasts_s > 0.0) lasting_share_ = std::exp(-params.step_s / params.noise_lasts_s);
    anew_share_ = std::sqrt(1.0 - lasting_share_ * lasting_share_);
  }

  /// The speeds to drive with for params().step_s; zero when the path is finished. Speed is never negative. `course` knows the path and how
  /// far along it the robot is, by advance() or command() of its own. `clearance_m` is in metres, as distance_transform_m makes it of a map,
  /// or ClearanceWindow of what is within params().reach_m() of the robot; what it does not cover is clear. Pose, path and clearance are in
  /// one frame. A prediction, not a promise: see guard_command. Throws std::invalid_argument for a pose that is not finite or more than
  /// 2^30 cells away from the lattice's origin, and for cells so small that the reach is more than 5000 of them; nothing has then changed.
  /// O(samples * horizon_steps + cells in reach + corners of the path). No allocation but for a path that is new, or cells smaller than
  /// before.
  Twist2 command(const Pose2& T_map_robot, const PathFollower& course, const Grid<float, 2>& clearance_m) {
    if (course.is_finished()) {
      require_finite_pose("MppiController::command", "the pose", T_map_robot);
      forget();
      return {};
    }
    cost_.prepare(T_map_robot, course.path(), course.progress_m(), clearance_m);
    warm_start(T_map_robot, course);
    evaluate_samples(T_map_robot);
    path_integral_weights(costs_, params_.temperature, weights_);
    move_plan();
    ++calls_;
    last_ = plan_.front();
    return last_;
  }

  /// Gives up the plan: the next begins by pure pursuit, even if the path is the same.
  void forget() {
    path_m_.clear();
    plan_.clear();
    last_ = {};
  }

  [[nodiscard]] const MppiParams& params() const { return params_; }  ///< as given

  /// The commands of the last call, the first of which it returned; none before, or when the path was finished.
  [[nodiscard]] const std::vector<Twist2>& plan() const { return plan_; }

  /// What the samples of the last call cost, without a unit; the first is the plan without noise.
  [[nodiscard]] const std::vector<double>& costs() const { return costs_; }

  /// The plan that the samples of the next call are made of, if it is for this pose and path.
  [[nodiscard]] std::vector<Twist2> warm_started(const Pose2& T_map_robot, const PathFollower& course) const {
    MppiController next = *this;
    next.warm_start(T_map_robot, course);
    return next.plan_;
  }

  /// Calls visit(step, noise) for the noise, a Twist2, that a sample of a call adds to each step of the plan; calls, samples and steps are
  /// counted from 0. The first sample has none: it is the plan itself.
  template <class Visit>
  void for_each_noise(std::uint64_t call, std::size_t sample, Visit&& visit) const {
    const auto steps = static_cast<std::uint64_t>(params_.horizon_steps);
    const std::uint64_t first = (call * static_cast<std::uint64_t>(params_.samples) + sample) * steps;
    NormalPair lasting{0.0, 0.0};
    for (std::uint64_t step = 0; step < steps; ++step) {
      if (sample != 0) {
        const NormalPair anew = random_.normal_pair(first + step);
        const double share = step == 0 ? 1.0 : anew_share_;
        lasting = {lasting_share_ * lasting.first + share * anew.first, lasting_share_ * lasting.second + share * anew.second};
      }
      visit(static_cast<std::size_t>(step),
            Twist2{params_.speed_sigma_m_per_s * lasting.first, params_.turn_rate_sigma_rad_per_s * lasting.second});
    }
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive.check("mppi", params_);
    archive(path_m_, plan_, last_, calls_);
    const bool is_finite = std::all_of(plan_.begin(), plan_.end(), [](const Twist2& command) {
      return std::isfinite(command.speed_m_per_s) && std::isfinite(command.turn_rate_rad_per_s);
    });
    const bool has_horizon = plan_.empty() || plan_.size() == static_cast<std::size_t>(params_.horizon_steps);
    archive.require(is_finite && has_horizon, "a plan has not one finite command for each step of the horizon");
  }

 private:
  static constexpr std::size_t samples_per_chunk = 32;

  [[nodiscard]] static const MppiParams& valid(const MppiParams& params) {
    params.validate();
    return params;
  }

  [[nodiscard]] static Twist2 sum_of(const Twist2& a, const Twist2& b) {
    return {a.speed_m_per_s + b.speed_m_per_s, a.turn_rate_rad_per_s + b.turn_rate_rad_per_s};
  }

  /// As the robot can be told.
  [[nodiscard]] Twist2 limited(const Twist2& twist) const {
    return {std::clamp(twist.speed_m_per_s, 0.0, params_.speed_max_m_per_s),
            std::clamp(twist.turn_rate_rad_per_s, -params_.turn_rate_max_rad_per_s, params_.turn_rate_max_rad_per_s)};
  }

  [[nodiscard]] bool is_of_path(const std::vector<Eigen::Vector2d>& points_m) const {
    return !plan_.empty() && std::equal(path_m_.begin(), path_m_.end(), points_m.begin(), points_m.end(), equal<Eigen::Vector2d>);
  }

  void warm_start(const Pose2& T_map_robot, const PathFollower& course) {
    if (is_of_path(course.path().points_m())) {
      std::move(plan_.begin() + 1, plan_.end(), plan_.begin());
      return;  // the last command is held for a step more
    }
    path_m_ = course.path().points_m();
    plan_.resize(static_cast<std::size_t>(params_.horizon_steps));
    PathFollower guide = course;
    Pose2 pose = T_map_robot;
    for (Twist2& command : plan_) {
      command = limited(guide.command(pose));
      pose = pose * unicycle_motion(command, params_.step_s);
    }
  }

  void evaluate_samples(const Pose2& T_map_robot) {
    const auto samples = static_cast<std::size_t>(params_.samples);
    noise_.resize(samples * plan_.size());
    costs_.resize(samples);
    const std::size_t chunks = (samples + samples_per_chunk - 1) / samples_per_chunk;
    for_each_index(chunks, params_.threads, [&](std::size_t chunk, int) {
      const std::size_t end = std::min(samples, (chunk + 1) * samples_per_chunk);
      for (std::size_t sample = chunk * samples_per_chunk; sample < end; ++sample) costs_[sample] = cost_of(T_map_robot, sample);
    });
  }

  [[nodiscard]] double cost_of(const Pose2& T_map_robot, std::size_t sample) {
    Twist2* const noises = noise_.data() + sample * plan_.size();
    MppiCost::Rollout rollout(T_map_robot, last_);
    for_each_noise(calls_, sample, [&](std::size_t step, const Twist2& noise) {
      noises[step] = noise;
      cost_.drive(rollout, limited(sum_of(plan_[step], noise)));
    });
    return rollout.cost;
  }

  /// By the mean of the noise; the sums are taken in the order of the samples.
  void move_plan() {
    mean_.assign(plan_.size(), Twist2{});
    const Twist2* noises = noise_.data();
    for (const double weight : weights_) {
      for (Twist2& mean : mean_) {
        mean.speed_m_per_s += weight * noises->speed_m_per_s;
        mean.turn_rate_rad_per_s += weight * noises->turn_rate_rad_per_s;
        ++noises;
      }
    }
    for (std::size_t step = 0; step < plan_.size(); ++step) {
      plan_[step] = limited(sum_of(plan_[step], mean_[step]));
    }
  }

  MppiParams params_;
  CounterRandom random_;
  double lasting_share_ = 0.0;  // of the noise from one step to the next
  double anew_share_ = 1.0;
  MppiCost cost_;
  std::vector<Eigen::Vector2d> path_m_;  // that the plan is for
  std::vector<Twist2> plan_;
  Twist2 last_;                // that was commanded
  std::uint64_t calls_ = 0;    // in which samples were drawn
  std::vector<Twist2> noise_;  // scratch, by sample and step
  std::vector<double> costs_;
  std::vector<double> weights_;
  std::vector<Twist2> mean_;   // scratch
};

}  // namespace incognita
