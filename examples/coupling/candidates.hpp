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

#include "coupling/scene.hpp"
#include "incognita/entropy/log_odds_table.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/exploration/information_gain.hpp"
#include "incognita/planning/polyline.hpp"
#include "support/csv.hpp"

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

/// A path, what it is predicted to tell, and how the pose's belief is predicted to fare on it.
struct RankedPath {
  std::string name;
  incognita::Polyline path;
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

  const Eigen::Vector2d start(6.0, 9.0);
  std::vector<RankedPath> paths;
  const auto add = [&](std::string name, std::vector<Eigen::Vector2d> corners_m) {
    corners_m.insert(corners_m.begin(), start);
    paths.push_back({.name = std::move(name), .path = incognita::Polyline(std::move(corners_m))});
  };
  // All equally long, so that none wins by its length.
  add("straight into the unknown", {{20.0, 9.0}});
  add("aslant into the unknown", {{9.5, 9.0}, {16.9246212, 16.4246212}});
  add("along the unknown side of the wall", {{10.5, 9.0}, {10.5, 18.5}});
  add("to the far door, then in", {{6.0, 17.0}, {12.0, 17.0}});
  add("to the near door, then in", {{6.0, 3.0}, {14.0, 3.0}});
  add("known corridor only", {{4.9, 9.0}, {4.9, 1.1}, {7.1, 1.1}, {7.1, 3.9}});

  const incognita::DvlEkf filter;
  const incognita::PoseBelief start_belief{{start.x(), start.y(), 0.0},
                                           Eigen::Vector3d(0.0025, 0.0025, 0.0001).asDiagonal()};
  const incognita::GainParams params{.range_max_m = kRange_m};
  incognita::GainWorkspace<incognita::TBayes> workspace;
  for (RankedPath& path : paths) {
    std::vector<incognita::PoseBelief> unused;
    path.gain_nats = incognita::information_gain(
        map, entropy, Prediction{filter, start_belief, path.beliefs, false}, path.path, params, workspace);
    path.gain_exact_pose_nats = incognita::information_gain(
        map, entropy, Prediction{filter, {start_belief.pose, Eigen::Matrix3d::Zero()}, unused, true},
        path.path, params, workspace);
  }
  std::stable_sort(paths.begin(), paths.end(),
                   [](const RankedPath& a, const RankedPath& b) { return a.gain_nats > b.gain_nats; });
  return {std::move(scene), std::move(map), std::move(paths)};
}

inline void write_candidates(const std::filesystem::path& path, const Ranking& ranking) {
  examples::write_csv(path, "rank,path,length_m,gain_nats,gain_exact_pose_nats,final_sigma_m", [&](std::ostream& out) {
    for (std::size_t rank = 0; rank < ranking.paths.size(); ++rank) {
      const RankedPath& candidate = ranking.paths[rank];
      out << rank + 1 << ",\"" << candidate.name << "\"," << candidate.path.length_m() << ','
          << candidate.gain_nats << ',' << candidate.gain_exact_pose_nats << ','
          << incognita::position_sigma_m(candidate.beliefs.back().covariance) << '\n';
    }
  });
}

/// The ellipses along the paths.
inline void write_candidate_beliefs(const std::filesystem::path& path, const Ranking& ranking) {
  examples::write_csv(path, "rank,x_m,y_m,variance_x_m2,covariance_xy_m2,variance_y_m2,yaw_variance_rad2",
                      [&](std::ostream& out) {
                        for (std::size_t rank = 0; rank < ranking.paths.size(); ++rank) {
                          for (const incognita::PoseBelief& belief : ranking.paths[rank].beliefs) {
                            const Eigen::Matrix3d& covariance = belief.covariance;
                            out << rank + 1 << ',' << belief.pose.x_m << ',' << belief.pose.y_m << ','
                                << covariance(0, 0) << ',' << covariance(0, 1) << ',' << covariance(1, 1) << ','
                                << covariance(2, 2) << '\n';
                          }
                        }
                      });
}

}  // namespace coupling
