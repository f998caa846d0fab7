/// The loop of an exploring robot: estimate, map, decide where to go, and how to drive there.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "incognita/entropy/behavioral.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/estimation/slam.hpp"
#include "incognita/exploration/candidate.hpp"
#include "incognita/exploration/set_aside.hpp"
#include "incognita/exploration/stop_reason.hpp"
#include "incognita/frontier/frontier.hpp"
#include "incognita/frontier/frontier_layer.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/grid/traversal.hpp"
#include "incognita/planning/collision_guard.hpp"
#include "incognita/planning/follow.hpp"
#include "incognita/planning/retreat.hpp"

namespace incognita {

/// What candidates are ranked by.
enum class Ranking {
  gain,           ///< the information gain alone, (16) and (18) of Seo et al.
  gain_per_metre  ///< gain / (path length + travel_offset_m): what is near comes first
};

/// Parameters of an Explorer.
struct ExplorerParams {
  OccupancyThresholds thresholds;
  FrontierParams frontier;
  TravelParams travel;
  FollowParams follow;
  CollisionGuardParams guard;
  RetreatParams retreat;
  GainParams gain;
  SetAsideParams set_aside;
  Ranking ranking = Ranking::gain_per_metre;
  double travel_offset_m = 2.0;            ///< >= 0
  int candidates_max = 40;                 ///< so many are compared, the cheapest to reach that are worth going, >= 1
  double viewpoint_radius_m = 1.5;         ///< how near to a frontier the robot must be able to get
  double gain_min_cells = 7.0;             ///< not worth going for less than the entropy of so many unknown cells
  double decision_interval_s = 1.0;        ///< a goal that still leads somewhere is not reconsidered sooner
  double blocked_max_s = 1.0;              ///< standing before an obstacle for longer, the robot retreats from it
  double sought_known_share = 0.7;         ///< decide anew when this share of what a goal should show is known
  double position_sigma_max_m = 1.0;       ///< lost beyond
  double lost_max_s = 10.0;                ///< lost when the filter has been lost for longer; the robot stands meanwhile
  double duration_max_s = std::numeric_limits<double>::infinity();  ///< out of time beyond
  int threads = 0;                         ///< for the evaluation of candidates; 0: OpenMP's own number

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    thresholds.validate();
    frontier.validate();
    travel.validate();
    follow.validate();
    guard.validate();
    retreat.validate();
    gain.validate();
    set_aside.validate();
    require_non_negative("ExplorerParams", "travel_offset_m", travel_offset_m);
    require(candidates_max >= 1, "ExplorerParams", "candidates_max", candidates_max, ">= 1");
    require_positive("ExplorerParams", "viewpoint_radius_m", viewpoint_radius_m);
    require_non_negative("ExplorerParams", "gain_min_cells", gain_min_cells);
    require_non_negative("ExplorerParams", "decision_interval_s", decision_interval_s);
    require_positive("ExplorerParams", "blocked_max_s", blocked_max_s);
    require(sought_known_share > 0.0 && sought_known_share <= 1.0, "ExplorerParams", "sought_known_share",
            sought_known_share, "in (0, 1]");
    require_positive("ExplorerParams", "position_sigma_max_m", position_sigma_max_m);
    require_positive("ExplorerParams", "lost_max_s", lost_max_s);
    require(duration_max_s > 0.0, "ExplorerParams", "duration_max_s", duration_max_s, "> 0");
    require(threads >= 0, "ExplorerParams", "threads", threads, ">= 0");
  }
};

/// What was decided and between what.
struct Decision {
  double time_s = 0.0;                 ///< since the start
  std::vector<Candidate> candidates;   ///< highest utility first
  std::optional<StopReason> stopped;   ///< set when the exploration has ended

  /// The candidate to drive to; null when there is none.
  [[nodiscard]] const Candidate* chosen() const {
    return stopped || candidates.empty() ? nullptr : &candidates.front();
  }
};

/// Composes a map, an entropy and an estimator into an exploring robot (Seo et al., Algorithm 1). In a loop: move with each
/// odometry increment, observe with each scan, decide, and drive by command() or by any other means to goal(). The frame is
/// the robot's start pose. A goal is kept until it is reached, seen enough of, or blocked, so the robot never swings
/// between two goals while the map stays the same; a goal that fails or tells nothing is set aside until the map around
/// it changes. Not thread safe; decide() uses threads of its own.
template <class MapType = Map<TBayes>, EntropyMeasure Entropy = Behavioral, Estimator<MapType> Filter = DvlEkf>
class Explorer {
 public:
  /// Throws std::invalid_argument for parameters outside of their bounds.
  explicit Explorer(const ExplorerParams& params = {}, MapType map = MapType{}, const Entropy& entropy = Entropy{},
                    Filter filter = Filter{})
      : params_(params),
        slam_(std::move(filter), std::move(map)),
        entropy_(entropy),
        occupancy_(slam_.map().lattice(), params.thresholds),
        frontier_(slam_.map().lattice(), params.frontier),
        clearance_m_(slam_.map().lattice(), {}, std::numeric_limits<float>::infinity()),
        travel_costs_(slam_.map().lattice()),
        set_aside_(params.set_aside),
        reached_(slam_.map().grid().box()) {
    params_.validate();
    rebuild_layers();
  }

  /// The robot has moved by `increment`, in its own frame, within duration_s. Throws std::invalid_argument unless the
  /// increment is finite and the duration finite and >= 0; nothing has then changed.
  void move(const Pose2& increment, double duration_s) {
    slam_.move(increment, duration_s);
    time_s_ += duration_s;
  }

  /// A scan was taken: corrects the pose by the map, then the map by the scan, see Slam::observe; correction() says what came
  /// of it.
  ScanReport observe(const Scan<2>& scan) {
    last_scan_ = slam_.observe(scan);
    if (!correction().lost) found_s_ = time_s_;
    if (correction().relocated) start_anew();
    if (!correction().trusted) return last_scan_.scan;
    if (last_scan_.is_redrawn) {
      rebuild_layers();
      retrace();
    } else {
      occupancy_.follow(map());
      frontier_.follow(occupancy_);
    }
    reached_ = enclosing_box(reached_, cells_in_reach(map().lattice(), scan, belief().pose, map().hit_push_m()));
    extend_trail(belief().pose.position());
    return last_scan_.scan;
  }

  /// Decides where to go if there is reason to; cheap when there is none. Returns whether it was decided anew.
  bool decide() {
    if (decision_.stopped) return false;
    if (position_sigma_m(belief().covariance) > params_.position_sigma_max_m) return stop(StopReason::lost);
    if (time_s_ - found_s_ > params_.lost_max_s) return stop(StopReason::lost);
    if (!correction().trusted) return false;
    if (time_s_ >= params_.duration_max_s) return stop(StopReason::out_of_time);
    if (trail_.empty() || !filter().is_ready()) return false;
    if (decision_.chosen() != nullptr && !goal_is_done()) return false;
    return choose();
  }

  /// The speeds that follow the chosen path, slowed down before what `scan`, the latest, shows. Zero without a goal.
  [[nodiscard]] Twist2 command(const Scan<2>& scan) {
    if (decision_.chosen() == nullptr || correction().lost) return {};
    const Pose2& pose = belief().pose;
    if (retreat_) {
      if (!retreat_->is_over(pose)) return retreat_->command(pose, scan);
      retreat_.reset();
      must_decide_ = true;
      // A second retreat on the way to one goal means that its way is too tight.
      const Eigen::Vector2d& goal_m = decision_.chosen()->frontier_m;
      if (retreated_on_way_to_ && distance(*retreated_on_way_to_, goal_m) <= params_.set_aside.radius_m) {
        failed_ = goal_m;
      }
      retreated_on_way_to_ = goal_m;
    }
    const Twist2 wanted = follower_.command(pose);
    const Twist2 allowed = guard_command(wanted, scan, params_.guard);
    const bool blocked = wanted.speed_m_per_s > 0.0 && allowed.speed_m_per_s == 0.0;
    if (!blocked) {
      unblocked_s_ = time_s_;
    } else if (time_s_ - unblocked_s_ > params_.blocked_max_s) {
      retreat_.emplace(pose, scan, params_.guard, params_.retreat);
    }
    return allowed;
  }

  /// Where to go, in the map's frame; none before the first decision and after the last.
  [[nodiscard]] std::optional<Eigen::Vector2d> goal() const {
    const Candidate* chosen = decision_.chosen();
    return chosen == nullptr ? std::nullopt : std::optional<Eigen::Vector2d>(chosen->goal_m());
  }

  [[nodiscard]] const std::optional<StopReason>& stopped() const { return decision_.stopped; }
  [[nodiscard]] const Decision& decision() const { return decision_; }
  [[nodiscard]] const MapType& map() const { return slam_.map(); }
  [[nodiscard]] const Filter& filter() const { return slam_.filter(); }
  [[nodiscard]] const PoseBelief& belief() const { return slam_.belief(); }
  [[nodiscard]] const SlamReport& last_scan() const { return last_scan_; }  ///< what became of it
  [[nodiscard]] const CorrectionReport& correction() const { return last_scan_.correction; }
  /// What is free, occupied and unknown in the map, with the explorer's thresholds.
  [[nodiscard]] const OccupancyLayer<2>& occupancy() const { return occupancy_; }
  [[nodiscard]] const EntropyTable& entropy() const { return entropy_; }
  [[nodiscard]] const ExplorerParams& params() const { return params_; }
  [[nodiscard]] double time_s() const { return time_s_; }

 private:
  using Cell = typename MapType::CellType;

  void rebuild_layers() {
    occupancy_.rebuild(map());
    frontier_.rebuild(occupancy_);
  }

  void extend_trail(const Eigen::Vector2d& to) {
    const Eigen::Vector2d from = trail_.empty() ? to : map().lattice().center_m(trail_.back());
    traverse<2>(map().lattice(), from, to, [&](const Index<2>& cell) {
      if (trail_.empty() || !equal(trail_.back(), cell)) trail_.push_back(cell);
    });
  }

  /// The robot is not where it was believed to be.
  void start_anew() {
    retreat_.reset();
    must_decide_ = true;
  }

  /// The map was drawn again, so the trail must be, and what was decided may not hold in it.
  void retrace() {
    if constexpr (RedrawsMaps<Filter>) {
      trail_.clear();
      const Filter& filter = slam_.filter();
      filter.loops().kept().for_each_pose(filter.drift(), [&](const Pose2& pose) { extend_trail(pose.position()); });
      reached_ = enclosing_box(reached_, map().grid().box());
      start_anew();
    }
  }

  bool stop(StopReason reason) {
    decision_ = {time_s_, {}, reason};
    return true;
  }

  /// Whether the chosen goal has served; marks it to be set aside where it failed.
  [[nodiscard]] bool goal_is_done() {
    const Candidate& goal = *decision_.chosen();
    if (std::exchange(must_decide_, false)) return true;
    if (follower_.is_finished() || time_s_ > decision_.time_s + patience_s(goal)) {
      failed_ = goal.frontier_m;
      return true;
    }
    if (path_is_blocked()) return true;
    if (time_s_ < decision_.time_s + params_.decision_interval_s) return false;
    const auto is_known = [&](const Index<2>& index) {
      return params_.thresholds.classify(map().log_odds(index)) != Occupancy::unknown;
    };
    const auto known = std::count_if(goal.sought.begin(), goal.sought.end(), is_known);
    return static_cast<double>(known) >= params_.sought_known_share * static_cast<double>(goal.sought.size());
  }

  /// How long a drive may take: three times as long as at full speed, and time to turn.
  [[nodiscard]] double patience_s(const Candidate& goal) const {
    return 20.0 + 3.0 * goal.path.length_m() / params_.follow.speed_max_m_per_s;
  }

  /// Whether a cell became occupied in the way of the rest of the path.
  [[nodiscard]] bool path_is_blocked() const {
    const auto is_occupied = [&](const Index<2>& index) {
      return params_.thresholds.classify(map().log_odds(index)) == Occupancy::occupied;
    };
    // Paths run between cell centres, so half a cell less than what the planner keeps is still clear.
    const double radius_m = params_.travel.clearance_hard_m() - 0.5 * map().resolution_m();
    return !path_is_clear(follower_.path(), map().lattice(), radius_m, is_occupied, follower_.progress_m());
  }

  bool choose() {
    reserve_reach();
    const OccupancyGrid<2>& occupancy = occupancy_.grid();
    if (failed_) set_aside_.add(*failed_, occupancy);
    failed_.reset();
    const std::vector<Frontier<2>> frontiers = cluster_frontier(map().lattice(), frontier_.cells(), params_.frontier);
    if (frontiers.empty()) return stop(StopReason::complete);

    std::vector<Reachable> reachable = find_reachable(occupancy, frontiers);
    if (reachable.empty()) return stop(StopReason::nothing_reachable);
    std::erase_if(reachable, [&](const Reachable& r) { return set_aside_.contains(frontier_m(r), occupancy); });
    std::vector<Candidate> candidates = first_informative(reachable, occupancy);
    if (candidates.empty()) return stop(StopReason::nothing_informative);
    for (Candidate& candidate : candidates) candidate.utility = utility(candidate);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.utility > b.utility; });
    decision_ = {time_s_, std::move(candidates), std::nullopt};
    follower_ = PathFollower(decision_.chosen()->path.points_m(), params_.follow);
    return true;
  }

  /// Prediction must not grow the map: every pose of a path lies in the map's box already, its beams within range of it.
  void reserve_reach() {
    const IndexBox<2>& box = reached_;
    const Box<Eigen::Vector2d> reached_m{map().lattice().center_m(box.lower), map().lattice().center_m(box.upper)};
    const double margin_m = map().hit_push_m() + 2.0 * map().resolution_m() + params_.travel.escape_radius_m;
    slam_.reserve(reached_m.padded(params_.gain.range_max_m + margin_m));
  }

  /// A frontier that can be seen from a place that can be reached.
  struct Reachable {
    const Frontier<2>* frontier;
    Index<2> viewpoint;
    float cost_m;
  };

  [[nodiscard]] Eigen::Vector2d frontier_m(const Reachable& reachable) const {
    return map().lattice().center_m(reachable.frontier->representative);
  }

  /// Those of the frontiers, cheapest to reach first; travel_costs_ then has the ways there.
  [[nodiscard]] std::vector<Reachable> find_reachable(const OccupancyGrid<2>& occupancy,
                                                      const std::vector<Frontier<2>>& frontiers) {
    distance_transform_m(occupancy, [](Occupancy cell) { return cell == Occupancy::occupied; }, clearance_m_);
    // Where the robot has been its body fits, however tight the belief draws the place: no door closes behind it.
    for (const Index<2>& cell : trail_) {
      if (!clearance_m_.contains(cell)) continue;
      float& clearance = clearance_m_[clearance_m_.offset_of(cell)];
      clearance = std::max(clearance, static_cast<float>(params_.travel.clearance_hard_m()));
    }
    travel_costs_.restart(occupancy, clearance_m_, belief().pose.position(), params_.travel);
    std::vector<Reachable> found;
    for (const Frontier<2>& frontier : frontiers) {
      const auto viewpoint =
          find_viewpoint(occupancy, travel_costs_, frontier.representative, params_.viewpoint_radius_m);
      if (viewpoint) found.push_back({&frontier, *viewpoint, travel_costs_.cost_m(*viewpoint)});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Reachable& a, const Reachable& b) { return a.cost_m < b.cost_m; });
    return found;
  }

  [[nodiscard]] Candidate candidate_for(const Reachable& reachable, const OccupancyGrid<2>& occupancy) const {
    Candidate candidate;
    candidate.frontier_m = frontier_m(reachable);
    candidate.sought = unknown_beside(occupancy, *reachable.frontier);
    candidate.path = Polyline(shorten_path(travel_costs_, find_path(travel_costs_, reachable.viewpoint)));
    return candidate;
  }

  /// The informative ones of the first candidates_max; when there are none, of the next, and so on.
  [[nodiscard]] std::vector<Candidate> first_informative(const std::vector<Reachable>& reachable,
                                                         const OccupancyGrid<2>& occupancy) {
    const double gain_min_nats = params_.gain_min_cells * entropy_(0.0F);
    std::vector<Candidate> informative;
    std::size_t next = 0;
    while (informative.empty() && next < reachable.size()) {
      const std::size_t end = std::min(reachable.size(), next + static_cast<std::size_t>(params_.candidates_max));
      for (; next < end; ++next) informative.push_back(candidate_for(reachable[next], occupancy));
      evaluate_candidates(map(), entropy_, filter(), informative, params_.gain, params_.threads, candidate_scratch_);
      std::erase_if(informative, [&](const Candidate& c) { return c.gain_nats < gain_min_nats; });
    }
    return informative;
  }

  [[nodiscard]] double utility(const Candidate& candidate) const {
    return params_.ranking == Ranking::gain
               ? candidate.gain_nats
               : candidate.gain_nats / (candidate.path.length_m() + params_.travel_offset_m);
  }

  ExplorerParams params_;
  Slam<MapType, Filter> slam_;
  EntropyTable entropy_;
  OccupancyLayer<2> occupancy_;
  FrontierLayer<2> frontier_;
  Grid<float, 2> clearance_m_;    // scratch of a decision, as the next
  TravelCostField travel_costs_;
  SetAsidePlaces set_aside_;
  SlamReport last_scan_;
  Decision decision_;
  PathFollower follower_;
  IndexBox<2> reached_;  // the cells that scans have reached, those of the map given at the start included
  std::vector<Index<2>> trail_;  // the cells that the robot's centre has passed, each a face neighbour of the last
  CandidateScratch<Cell> candidate_scratch_;
  std::optional<Eigen::Vector2d> failed_;
  std::optional<Retreat> retreat_;
  std::optional<Eigen::Vector2d> retreated_on_way_to_;  // the frontier that the last retreat was on the way to
  bool must_decide_ = false;
  double time_s_ = 0.0;
  double found_s_ = 0.0;      // when the filter was last not lost
  double unblocked_s_ = 0.0;  // when the guard last let the robot drive
};

}  // namespace incognita
