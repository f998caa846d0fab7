/// Fig. 7 of Seo et al.: candidate paths out of a half-known map, ranked by their Behavioral information
/// gain.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "coupling/csv.hpp"
#include "coupling/scene.hpp"
#include "incognita/entropy/log_odds_table.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/exploration/information_gain.hpp"

namespace coupling {

/// A known corridor with three doors to the right, behind which nothing is known.
[[nodiscard]] inline Scene half_known_scene() {
  return Scene({{-1.0, -3.0}, {27.0, 25.0}}, {{{4.0, 0.0}, {4.2, 20.0}},
                                              {{4.0, 0.0}, {8.0, 0.2}},
                                              {{4.0, 19.8}, {8.0, 20.0}},
                                              {{8.0, 0.0}, {8.2, 2.0}},
                                              {{8.0, 4.0}, {8.2, 8.0}},
                                              {{8.0, 10.0}, {8.2, 16.0}},
                                              {{8.0, 18.0}, {8.2, 20.0}}});
}

constexpr double kCandidateLength_m = 14.0;

/// A path, what it is predicted to tell, and how the pose's belief is predicted to fare on it.
struct RankedPath {
  std::string name;
  std::vector<Eigen::Vector2d> path_m;
  double gain_nats = 0.0;                           ///< BIG, (18)
  double gain_exact_pose_nats = 0.0;                ///< the same if the robot always knew its pose
  std::vector<incognita::PoseBelief> beliefs = {};  ///< after each predicted scan
};

/// Hands a filter's predictions through and keeps them. `exact_pose` tells what decisions would be without
/// the coupling.
struct Prediction {
  const incognita::DvlEkf& filter;
  incognita::PoseBelief start;
  std::vector<incognita::PoseBelief>& beliefs;
  bool exact_pose;

  [[nodiscard]] const incognita::PoseBelief& belief() const { return start; }
  [[nodiscard]] incognita::PoseBelief imagine_motion(const incognita::PoseBelief& belief,
                                                     const incognita::Pose2& increment,
                                                     double duration_s) const {
    return filter.imagine_motion(belief, increment, duration_s);
  }
  [[nodiscard]] incognita::PoseBelief imagine_scan(const incognita::PoseBelief& belief,
                                                   std::span<const incognita::RayObservation> hits,
                                                   std::size_t beam_count, double scan_count) const {
    beliefs.push_back(filter.imagine_scan(belief, hits, beam_count, scan_count));
    if (exact_pose) beliefs.back().covariance.setZero();
    return beliefs.back();
  }
};

struct Ranking {
  Scene scene;
  Map map;
  std::vector<RankedPath> paths;  ///< the largest gain first
};

[[nodiscard]] inline Ranking rank_candidates(const incognita::EntropyTable& entropy) {
  Scene scene = half_known_scene();
  Map map = empty_map(scene);
  survey(scene, {6.0, 1.0}, {6.0, 19.0}, map);

  using Path = std::vector<Eigen::Vector2d>;
  const Eigen::Vector2d start(6.0, 9.0);
  // All equally long, so that none wins by its length.
  std::vector<RankedPath> paths;
  const auto add = [&](std::string name, Path path_m) {
    paths.push_back({.name = std::move(name), .path_m = std::move(path_m)});
  };
  add("straight into the unknown", {start, {20.0, 9.0}});
  add("aslant into the unknown", {start, {9.5, 9.0}, {16.924621, 16.424621}});
  add("along the unknown side of the wall", {start, {10.5, 9.0}, {10.5, 18.5}});
  add("to the far door, then in", {start, {6.0, 17.0}, {12.0, 17.0}});
  add("to the near door, then in", {start, {6.0, 3.0}, {14.0, 3.0}});
  add("known corridor only", {start, {6.0, 16.0}, {6.0, 9.0}});

  const incognita::DvlEkf filter;
  const incognita::PoseBelief start_belief{{start.x(), start.y(), 0.0},
                                           Eigen::Vector3d(0.0025, 0.0025, 0.0001).asDiagonal()};
  const incognita::GainParams params{.range_max_m = kRange_m};
  incognita::GainWorkspace<incognita::TBayes> workspace(params);
  for (RankedPath& path : paths) {
    std::vector<incognita::PoseBelief> unused;
    path.gain_nats = incognita::information_gain(
        map, entropy, Prediction{filter, start_belief, path.beliefs, false}, path.path_m, params, workspace);
    path.gain_exact_pose_nats = incognita::information_gain(
        map, entropy, Prediction{filter, {start_belief.pose, Eigen::Matrix3d::Zero()}, unused, true},
        path.path_m, params, workspace);
  }
  std::stable_sort(paths.begin(), paths.end(),
                   [](const RankedPath& a, const RankedPath& b) { return a.gain_nats > b.gain_nats; });
  return {std::move(scene), std::move(map), std::move(paths)};
}

}  // namespace coupling
