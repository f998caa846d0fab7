/// The loop of an exploring robot: estimate, map, decide where to go, and how to drive there.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "incognita/entropy/behavioral.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/estimation/slam.hpp"
#include "incognita/exploration/candidate.hpp"
#include "incognita/exploration/frontier_information.hpp"
#include "incognita/exploration/frontier_view.hpp"
#include "incognita/exploration/set_aside.hpp"
#include "incognita/exploration/stop_reason.hpp"
#include "incognita/exploration/strategy.hpp"
#include "incognita/frontier/frontier.hpp"
#include "incognita/frontier/frontier_layer.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/grid/traversal.hpp"
#include "incognita/planning/collision_guard.hpp"
#include "incognita/planning/follow.hpp"
#include "incognita/planning/path.hpp"
#include "incognita/planning/retreat.hpp"

namespace incognita {

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
  Strategy strategy = Strategy::last_mile;
  FrontierInformation information = FrontierInformation::big;
  NavigationCost navigation = NavigationCost::geodesic;
  double travel_offset_m = 2.0;            ///< added to costs that are ways, so that what is at hand does not always win; >= 0
  int candidates_max = 40;                 ///< so many are compared: of big the cheapest to reach that are worth going, >= 1
  double visibility_tolerance_m = 0.05;    ///< frontiers must be seen from all places this near to a viewpoint, > 0
  double information_min_m2 = 0.01;        ///< a viewpoint from where no more of the frontier is seen is not gone to, >= 0
  double gain_min_cells = 7.0;             ///< nor is one, by big, for less than the entropy of so many unknown cells
  double decision_interval_s = 1.0;        ///< a goal that still leads somewhere is not reconsidered sooner
  double blocked_max_s = 1.0;              ///< standing before an obstacle for longer, the robot retreats from it
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
    require_positive("ExplorerParams", "visibility_tolerance_m", visibility_tolerance_m);
    const double sight_m = gain.range_max_m - visibility_tolerance_m;
    require(sight_m > travel.clearance_hard_m(), "ExplorerParams", "gain.range_max_m - visibility_tolerance_m", sight_m,
            "> travel.robot_radius_m + travel.margin_m");
    require_non_negative("ExplorerParams", "information_min_m2", information_min_m2);
    require_non_negative("ExplorerParams", "gain_min_cells", gain_min_cells);
    require_non_negative("ExplorerParams", "decision_interval_s", decision_interval_s);
    require_positive("ExplorerParams", "blocked_max_s", blocked_max_s);
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
    static_cast<void>(visibility());  // refuses a range that cells as large as the map's leave nothing of
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
    has_changed_ = has_changed_ || !occupancy_.changed_tiles().empty();
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
    const Twist2 wanted = follower_.command(pose, scan, params_.guard);
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
    if (time_s_ > goal_since_s_ + patience_s(goal) || (follower_.is_finished() && is_informative(goal))) {
      failed_ = goal.frontier_m;
      return true;
    }
    if (follower_.is_finished()) return true;
    const bool was_clear = std::exchange(path_was_clear_, !path_is_blocked());
    if (was_clear && !path_was_clear_) return true;
    // No switch without a change of the map: planning anew could only swing.
    if (time_s_ < decision_.time_s + params_.decision_interval_s || !has_changed_) return false;
    switch (params_.strategy) {
      case Strategy::persistent: return false;
      case Strategy::last_mile: has_changed_ = false; return !is_informative(goal);
      case Strategy::online: return true;
    }
    return false;
  }

  [[nodiscard]] ReliableVisibility visibility() const {
    // A frontier's unknown neighbour lies one cell further than the frontier.
    const double range_m = params_.gain.range_max_m - std::numbers::sqrt2 * map().resolution_m();
    return {occupancy_.grid(), occupancy_.free(), {range_m, params_.visibility_tolerance_m}};
  }

  /// Whether enough of the frontier is still seen from a goal's viewpoint, asked of the goal's own frontier first.
  [[nodiscard]] bool is_informative(const Candidate& goal) const {
    std::vector<Index<2>> left;
    for (const Index<2>& cell : goal.frontier) {
      if (frontier_.contains(cell)) left.push_back(cell);
    }
    const auto is_enough = [&](const std::vector<Index<2>>& cells) {
      return incognita::is_informative(goal.viewpoint, cells, visibility(), params_.information_min_m2);
    };
    return is_enough(left) || is_enough(frontier_.cells());
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
    has_changed_ = false;
    const OccupancyGrid<2>& occupancy = occupancy_.grid();
    if (failed_) set_aside_.add(*failed_, occupancy);
    failed_.reset();
    const std::vector<Frontier<2>> frontiers = cluster_frontier(map().lattice(), frontier_.cells(), params_.frontier);
    if (frontiers.empty()) return stop(StopReason::complete);

    search_ways(occupancy);
    std::vector<FrontierView> views =
        find_views(frontiers, [&](const Index<2>& cell) { return frontier_.contains(cell); },
                   [&](const Index<2>& cell) { return travel_costs_.reaches(cell); }, visibility(), viewpoints_);
    if (views.empty()) return stop(StopReason::nothing_reachable);
    std::erase_if(views, [&](const FrontierView& view) {
      return view.seen_cells < least_cells_above(params_.information_min_m2, map().resolution_m()) || set_aside_.contains(frontier_m(frontiers[view.region]), occupancy);
    });
    std::vector<Candidate> candidates =
        params_.information == FrontierInformation::big ? first_informative(views, frontiers) : most_useful(views, frontiers);
    if (candidates.empty()) return stop(StopReason::nothing_informative);
    sort_by_utility(candidates);
    const Candidate* const before = decision_.chosen();
    const bool is_same_goal =
        before != nullptr && distance(before->frontier_m, candidates.front().frontier_m) <= params_.set_aside.radius_m;
    if (!is_same_goal) goal_since_s_ = time_s_;
    decision_ = {time_s_, std::move(candidates), std::nullopt};
    follower_ = PathFollower(decision_.chosen()->path.points_m(), params_.follow);
    // Where the robot has been it may go though the belief has a wall there: deciding anew would change nothing.
    path_was_clear_ = !path_is_blocked();
    return true;
  }

  /// Prediction must not grow the map: every pose of a path lies in the map's box already, its beams within range of it.
  void reserve_reach() {
    const IndexBox<2>& box = reached_;
    const Box<Eigen::Vector2d> reached_m{map().lattice().center_m(box.lower), map().lattice().center_m(box.upper)};
    const double margin_m = map().hit_push_m() + 2.0 * map().resolution_m() + params_.travel.escape_radius_m;
    slam_.reserve(reached_m.padded(params_.gain.range_max_m + margin_m));
  }

  [[nodiscard]] Eigen::Vector2d frontier_m(const Frontier<2>& frontier) const {
    return map().lattice().center_m(frontier.representative);
  }

  /// Makes travel_costs_ the field of the ways from where the robot is.
  void search_ways(const OccupancyGrid<2>& occupancy) {
    distance_transform_m(occupancy, [](Occupancy cell) { return cell == Occupancy::occupied; }, clearance_m_);
    // Where the robot has been its body fits, however tight the belief draws the place: no door closes behind it.
    for (const Index<2>& cell : trail_) {
      if (!clearance_m_.contains(cell)) continue;
      float& clearance = clearance_m_[clearance_m_.offset_of(cell)];
      clearance = std::max(clearance, static_cast<float>(params_.travel.clearance_hard_m()));
    }
    travel_costs_.restart(occupancy, clearance_m_, belief().pose.position(), params_.travel);
  }

  /// Without its path.
  [[nodiscard]] Candidate candidate_for(const FrontierView& view, const Frontier<2>& frontier) const {
    Candidate candidate;
    candidate.frontier_m = frontier_m(frontier);
    candidate.frontier = frontier.cells;
    candidate.viewpoint = view.viewpoint;
    candidate.navigation_cost = navigation_cost(params_.navigation, travel_costs_, view.viewpoint);
    switch (params_.information) {
      case FrontierInformation::uniform: candidate.information = 1.0; break;
      case FrontierInformation::size: candidate.information = frontier_size_m2(frontier.cells, map().resolution_m()); break;
      case FrontierInformation::entropy: candidate.information = frontier_entropy_nats_m2(frontier.cells, map(), entropy_); break;
      case FrontierInformation::big: break;  // told by its path
    }
    rate(candidate);
    return candidate;
  }

  void rate(Candidate& candidate) const {
    const double offset_m = params_.navigation == NavigationCost::uniform ? 0.0 : params_.travel_offset_m;
    candidate.utility = information_per_cost(candidate.information, candidate.navigation_cost + offset_m);
  }

  void add_path(Candidate& candidate) const {
    candidate.path = Polyline(shorten_path(travel_costs_, find_path(travel_costs_, candidate.viewpoint)));
  }

  static void sort_by_utility(std::vector<Candidate>& candidates) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.utility > b.utility; });
  }

  /// The candidates_max of the most information per cost.
  [[nodiscard]] std::vector<Candidate> most_useful(const std::vector<FrontierView>& views,
                                                   const std::vector<Frontier<2>>& frontiers) const {
    std::vector<Candidate> candidates;
    for (const FrontierView& view : views) candidates.push_back(candidate_for(view, frontiers[view.region]));
    sort_by_utility(candidates);
    if (candidates.size() > static_cast<std::size_t>(params_.candidates_max)) {
      candidates.erase(candidates.begin() + params_.candidates_max, candidates.end());
    }
    for (Candidate& candidate : candidates) add_path(candidate);
    return candidates;
  }

  /// Those that gain enough of the candidates_max that are cheapest to reach; when there are none, of the next, and so on.
  [[nodiscard]] std::vector<Candidate> first_informative(std::vector<FrontierView>& views, const std::vector<Frontier<2>>& frontiers) {
    std::stable_sort(views.begin(), views.end(), [&](const FrontierView& a, const FrontierView& b) {
      return travel_costs_.cost_m(a.viewpoint) < travel_costs_.cost_m(b.viewpoint);
    });
    const double gain_min_nats = params_.gain_min_cells * entropy_(0.0F);
    std::vector<Candidate> informative;
    std::size_t next = 0;
    while (informative.empty() && next < views.size()) {
      const std::size_t end = std::min(views.size(), next + static_cast<std::size_t>(params_.candidates_max));
      for (; next < end; ++next) {
        informative.push_back(candidate_for(views[next], frontiers[views[next].region]));
        add_path(informative.back());
      }
      evaluate_candidates(map(), entropy_, filter(), informative, params_.gain, params_.threads, candidate_scratch_);
      std::erase_if(informative, [&](const Candidate& c) { return c.gain_nats < gain_min_nats; });
    }
    for (Candidate& candidate : informative) {
      candidate.information = candidate.gain_nats;
      rate(candidate);
    }
    return informative;
  }

  ExplorerParams params_;
  Slam<MapType, Filter> slam_;
  EntropyTable entropy_;
  OccupancyLayer<2> occupancy_;
  FrontierLayer<2> frontier_;
  Grid<float, 2> clearance_m_;    // scratch of a decision, as the next
  TravelCostField travel_costs_;
  ViewpointSearch viewpoints_;
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
  bool path_was_clear_ = true;  // when last asked
  double goal_since_s_ = 0.0;   // when the chosen frontier was chosen first
  bool has_changed_ = false;  // the occupancy, since it was last asked for its goal
  double time_s_ = 0.0;
  double found_s_ = 0.0;      // when the filter was last not lost
  double unblocked_s_ = 0.0;  // when the guard last let the robot drive
};

}  // namespace incognita
