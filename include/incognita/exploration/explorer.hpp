/// The loop of an exploring robot: estimate, map, decide where to go, and how to drive there.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/entropy/behavioral.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/estimation/slam.hpp"
#include "incognita/exploration/candidate_search.hpp"
#include "incognita/exploration/decision_reason.hpp"
#include "incognita/exploration/explorer_params.hpp"
#include "incognita/exploration/frontier_view.hpp"
#include "incognita/exploration/set_aside.hpp"
#include "incognita/exploration/stop_reason.hpp"
#include "incognita/exploration/strategy.hpp"
#include "incognita/frontier/frontier.hpp"
#include "incognita/frontier/frontier_layer.hpp"
#include "incognita/frontier/uncertainty_frontier.hpp"
#include "incognita/grid/traversal.hpp"
#include "incognita/map/learned_cells.hpp"
#include "incognita/planning/closed_cells.hpp"
#include "incognita/planning/collision_guard.hpp"
#include "incognita/planning/follow.hpp"
#include "incognita/planning/path.hpp"
#include "incognita/planning/retreat.hpp"

namespace incognita {

/// What was decided, between what and why.
struct Decision {
  double time_s = 0.0;                 ///< since the start
  std::vector<Candidate> candidates;   ///< highest utility first
  std::optional<StopReason> stopped;   ///< set when there is nothing to drive to any more
  DecisionReason reason = DecisionReason::no_goal;  ///< why it was decided anew

  /// The candidate to drive to; null when there is none.
  [[nodiscard]] const Candidate* chosen() const {
    return stopped || candidates.empty() ? nullptr : &candidates.front();
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(time_s, candidates, stopped, reason);
  }
};

/// Composes a map, an entropy and an estimator into an exploring robot (Seo et al., Algorithm 1). In a loop: move with each
/// odometry increment, observe with each scan, decide, and drive by command() or by any other means to goal(). The frame is
/// the robot's start pose. A goal is kept until it is reached, seen enough of, or blocked, so the robot never swings
/// between two goals while the map stays the same; a goal that fails or tells nothing is set aside until the map around
/// it changes. It explores from the beginning on; start, pause, stop and return_to_start may be called at any moment.
/// Not thread safe; decide() uses threads of its own.
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
        learned_(slam_.map().lattice()),
        closed_(slam_.map().lattice(), params.area),
        search_(slam_.map().lattice()),
        set_aside_(params.set_aside),
        chosen_(params.set_aside),
        retreats_(params.set_aside),
        shut_passages_(params.set_aside),
        reached_(slam_.map().grid().box()) {
    params_.validate();
    if (params_.uncertainty && !DispersionPolicy<Cell>) {
      throw std::invalid_argument("Explorer: uncertainty is set, but needs a map whose cells know their dispersion");
    }
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
    if (correction().relocated) doubt_way();
    if (!correction().trusted) return last_scan_.scan;
    if (last_scan_.is_redrawn) {
      rebuild_layers();
      retrace();
    } else {
      occupancy_.follow(map());
      learned_.follow(occupancy_);
      closed_.grow_to_include(occupancy_.grid().box());
      frontier_.follow(occupancy_, closed_bits());
    }
    reached_ = enclosing_box(reached_, cells_in_reach(map().lattice(), scan, belief().pose, map().hit_push_m()));
    extend_trail(belief().pose.position());
    return last_scan_.scan;
  }

  /// Decides where to go if there is reason to; cheap when there is none. Returns whether it was decided anew.
  bool decide() {
    if (decision_.stopped || is_paused_) return false;
    if (position_sigma_m(belief().covariance) > params_.position_sigma_max_m) return end(StopReason::lost);
    if (time_s_ - found_s_ > params_.lost_max_s) return end(StopReason::lost);
    if (!correction().trusted) return false;
    if (!is_returning_ && time_s_ >= params_.duration_max_s) return end(StopReason::out_of_time);
    if (trail_.empty() || !filter().is_ready()) return false;
    // Some cells take several scans to become free: a map without floor says that it is new, unless it stays so.
    if (!knows_floor() && time_s_ < params_.lost_max_s) return false;
    if (is_returning_) return head_for_the_start();
    const std::optional<DecisionReason> reason = decision_.chosen() == nullptr ? DecisionReason::no_goal : done_goal();
    return reason && choose(*reason);
  }

  /// Goes on with what a pause has interrupted; else explores, anew where it had ended or was on its way back: goals that were
  /// given up are then tried again. duration_max_s goes on counting, so that out_of_time is final.
  void start() {
    if (is_paused_) {
      is_paused_ = false;
      goal_since_s_ += time_s_ - paused_s_;
      unblocked_s_ = time_s_;
      // It may have been moved, and has yet to find out where.
      found_s_ = time_s_;
      doubt_way();
    } else if (decision_.stopped || is_returning_) {
      drop_goal();
      is_returning_ = false;
      for (SetAsidePlaces* places : {&set_aside_, &retreats_, &shut_passages_}) *places = SetAsidePlaces(params_.set_aside);
      found_s_ = time_s_;
    }
  }

  /// Stands still and decides nothing until start() is called. Scans go on to correct the pose and the map. Nothing happens after
  /// an end.
  void pause() {
    if (is_paused_ || decision_.stopped) return;
    is_paused_ = true;
    paused_s_ = time_s_;
  }

  /// Ends what it is at, for StopReason::stopped. An end that is there already stays.
  void stop() {
    is_paused_ = false;
    if (!decision_.stopped) end(StopReason::stopped);
  }

  /// Gives up exploring, or an end, and drives to where the robot started, the map's origin: stopped() is then not set until it is
  /// there (returned; to follow.goal_tolerance_m, or to travel.escape_radius_m where the belief has no room for its body any nearer),
  /// cannot get there in time (nothing_reachable), or is lost. Meanwhile decision() has one candidate, the way back, of no frontier.
  /// duration_max_s does not count on the way.
  void return_to_start() {
    is_paused_ = false;
    is_returning_ = true;
    found_s_ = time_s_;
    drop_goal();
  }

  [[nodiscard]] bool is_paused() const { return is_paused_; }  ///< see pause()
  /// Whether it is on its way back to the start; no more when that has ended.
  [[nodiscard]] bool is_returning() const { return is_returning_; }

  /// The speeds that follow the chosen path, slowed down before what `scan`, the latest, shows. Zero without a goal and in a pause.
  [[nodiscard]] Twist2 command(const Scan<2>& scan) {
    return guarded(scan, [&](const Pose2& pose) { return follower_.command(pose, scan, params_.guard); });
  }

  /// The same with another controller at the wheel, such as MppiController: steer(T_map_robot, scan, follower) returns the Twist2 that is
  /// wanted; the const PathFollower& knows the path and how far along it the robot is. It is asked only while there is a path to drive:
  /// neither at its end nor in a retreat. Throws std::invalid_argument for a twist that is not finite, and what steer throws; then only the
  /// progress along the path, and a retreat that is over, have been noted.
  template <class Steer>
  [[nodiscard]] Twist2 command(const Scan<2>& scan, Steer&& steer) {
    return guarded(scan, [&](const Pose2& pose) {
      follower_.advance(pose);
      if (follower_.is_finished()) return Twist2{};
      const Twist2 wanted = steer(pose, scan, std::as_const(follower_));
      require(std::isfinite(wanted.speed_m_per_s), "Explorer::command", "the wanted speed_m_per_s", wanted.speed_m_per_s, "finite");
      require(std::isfinite(wanted.turn_rate_rad_per_s), "Explorer::command", "the wanted turn_rate_rad_per_s", wanted.turn_rate_rad_per_s,
              "finite");
      return wanted;
    });
  }

  /// The frontiers of the map as it is now, of the allowed area; the uncertainty frontiers among them are those of the last decision.
  /// O(n log n) for n cells of them. The candidates of the last decision are in decision().
  [[nodiscard]] std::vector<Frontier<2>> frontiers() const {
    return cluster_frontier(map().lattice(), frontier_cells(), params_.frontier);
  }

  /// Where to go, in the map's frame; none before the first decision and after the last.
  [[nodiscard]] std::optional<Eigen::Vector2d> goal() const {
    const Candidate* chosen = decision_.chosen();
    return chosen == nullptr ? std::nullopt : std::optional<Eigen::Vector2d>(chosen->goal_m());
  }

  /// Why it has ended, when it has.
  [[nodiscard]] const std::optional<StopReason>& stopped() const { return decision_.stopped; }
  [[nodiscard]] const Decision& decision() const { return decision_; }  ///< the last one
  [[nodiscard]] const MapType& map() const { return slam_.map(); }  ///< in the frame of the start
  [[nodiscard]] const Filter& filter() const { return slam_.filter(); }  ///< that locates the robot
  [[nodiscard]] const PoseBelief& belief() const { return slam_.belief(); }  ///< T_map_robot and its covariance
  [[nodiscard]] const SlamReport& last_scan() const { return last_scan_; }  ///< what became of it
  [[nodiscard]] const CorrectionReport& correction() const { return last_scan_.correction; }  ///< by the last scan
  /// The cells that params().area closes; those of the map's box at least are asked of.
  [[nodiscard]] const ClosedCells<2>& closed() const { return closed_; }
  /// What is free, occupied and unknown in the map, with the explorer's thresholds.
  [[nodiscard]] const OccupancyLayer<2>& occupancy() const { return occupancy_; }
  [[nodiscard]] const EntropyTable& entropy() const { return entropy_; }  ///< what gains are measured by
  [[nodiscard]] const ExplorerParams& params() const { return params_; }  ///< as given
  [[nodiscard]] double time_s() const { return time_s_; }  ///< the sum of all moves' durations

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws. Everything that goes on from one call to the next is in the state; the rest is
  /// made again from it.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive.check("explorer", params_);
    archive.check("entropy", entropy_);
    archive(slam_);
    occupancy_.archive_state(archive, map());
    archive(learned_, closed_, search_, set_aside_, chosen_, retreats_, shut_passages_, last_scan_, decision_);
    bool retreats = retreat_.has_value();
    archive(retreats);
    if constexpr (Archive::is_loading) {
      closed_.grow_to_include(occupancy_.grid().box());
      frontier_.rebuild(occupancy_, closed_bits());
      follower_ = PathFollower({}, params_.follow);
      retreat_.reset();
      if (retreats) retreat_.emplace(belief().pose, Scan<2>(BeamPattern<2>{}), params_.guard, params_.retreat);
    }
    if (retreats) archive(*retreat_);
    archive(follower_, reached_, trail_, failed_, must_decide_, path_was_clear_, uncertain_, knows_floor_, is_paused_, is_returning_,
            paused_s_, goal_since_s_, way_max_m_, asked_s_, learned_then_, time_s_, found_s_, unblocked_s_);
    if constexpr (Archive::is_loading) archive.require(lies_in_map(), "a cell, a place or a path lies far outside of the map");
  }

 private:
  using Cell = typename MapType::CellType;

  /// wanted_at(T_map_robot), as far as the guard allows it; when that is nothing for long, or a retreat has begun, the way out.
  template <class Wanted>
  [[nodiscard]] Twist2 guarded(const Scan<2>& scan, Wanted&& wanted_at) {
    if (decision_.chosen() == nullptr || is_paused_ || correction().lost) return {};
    const Pose2& pose = belief().pose;
    if (retreat_) {
      if (!retreat_->is_over(pose)) return retreat_->command(pose, scan);
      retreat_.reset();
      must_decide_ = true;
      learn_from_retreat();
    }
    const Twist2 wanted = wanted_at(pose);
    const Twist2 allowed = guard_command(wanted, scan, params_.guard);
    const bool blocked = wanted.speed_m_per_s > 0.0 && allowed.speed_m_per_s == 0.0;
    if (!blocked) {
      unblocked_s_ = time_s_;
    } else if (time_s_ - unblocked_s_ > params_.blocked_max_s && may_retreat()) {
      retreat_.emplace(pose, scan, params_.guard, params_.retreat);
    }
    return allowed;
  }

  /// Whether all that was decided is where the map is, or not far from there: what is done with it costs as much as it is long.
  [[nodiscard]] bool lies_in_map() const {
    const IndexBox<2> box = map().grid().box().padded(1000);
    const auto holds_cells = [&](const std::vector<Index<2>>& cells) {
      return std::all_of(cells.begin(), cells.end(), [&](const Index<2>& cell) { return box.contains(cell); });
    };
    const auto holds_path = [&](const Polyline& path) {
      return std::all_of(path.points_m().begin(), path.points_m().end(), [&](const Eigen::Vector2d& point_m) {
        const Eigen::Vector2d cells = map().lattice().to_cells(point_m);
        return box.lower[0] <= cells[0] && cells[0] <= box.upper[0] && box.lower[1] <= cells[1] && cells[1] <= box.upper[1];
      });
    };
    return holds_cells(trail_) && holds_cells(uncertain_) && (reached_.empty() || box.contains(reached_)) &&
           holds_path(follower_.path()) && (decision_.chosen() == nullptr || !follower_.path().empty()) &&
           std::all_of(decision_.candidates.begin(), decision_.candidates.end(), [&](const Candidate& candidate) {
             return holds_cells(candidate.frontier) && box.contains(candidate.viewpoint) && holds_path(candidate.path);
           });
  }

  void rebuild_layers() {
    occupancy_.rebuild(map());
    learned_.follow(occupancy_);
    closed_.grow_to_include(occupancy_.grid().box());
    frontier_.rebuild(occupancy_, closed_bits());
  }

  [[nodiscard]] bool is_frontier(const Index<2>& cell) const {
    return frontier_.contains(cell) || std::binary_search(uncertain_.begin(), uncertain_.end(), cell, is_stored_before<2>);
  }

  /// Of both kinds, in storage order.
  [[nodiscard]] std::vector<Index<2>> frontier_cells() const {
    std::vector<Index<2>> cells = frontier_.cells();
    if (uncertain_.empty()) return cells;
    for (const Index<2>& cell : uncertain_) {
      if (!frontier_.contains(cell)) cells.push_back(cell);
    }
    std::sort(cells.begin(), cells.end(), is_stored_before<2>);
    return cells;
  }

  /// O(cells of the map).
  void find_uncertain() {
    if constexpr (DispersionPolicy<Cell>) {
      if (!params_.uncertainty) return;
      uncertain_ = detect_uncertainty_frontier(map(), params_.thresholds, *params_.uncertainty);
      std::erase_if(uncertain_, [&](const Index<2>& cell) {
        return occupancy_.grid().value(cell) != Occupancy::free || (!closed_.none() && closed_.bits().get(cell));
      });
    }
  }

  [[nodiscard]] bool knows_floor() {
    const auto& tiles = occupancy_.free().tiles().values();
    knows_floor_ = knows_floor_ || std::any_of(tiles.begin(), tiles.end(), [](CellBits::Word free) { return free != 0; });
    return knows_floor_;
  }

  /// A retreat knows only what the scan shows, so not beside what is not allowed.
  [[nodiscard]] bool may_retreat() const {
    const Index<2> cell = map().lattice().index_of(belief().pose.position());
    const double room_m = params_.travel.clearance_hard_m() + params_.retreat.distance_m;
    return closed_.none() || static_cast<double>(closed_.clearance_m(cell)) >= room_m;
  }

  void extend_trail(const Eigen::Vector2d& to) {
    const Eigen::Vector2d from = trail_.empty() ? to : map().lattice().center_m(trail_.back());
    traverse<2>(map().lattice(), from, to, [&](const Index<2>& cell) {
      if (trail_.empty() || !equal(trail_.back(), cell)) trail_.push_back(cell);
    });
  }

  /// The robot is not where it was believed to be, so its way leads elsewhere.
  void doubt_way() {
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
      doubt_way();
    }
  }

  bool end(StopReason reason) {
    is_returning_ = false;
    decision_ = {time_s_, {}, reason, DecisionReason::ended};
    return true;
  }

  void drop_goal() {
    decision_ = {time_s_, {}, std::nullopt, DecisionReason::no_goal};
    follower_ = PathFollower();
    retreat_.reset();
    failed_.reset();
    must_decide_ = false;
  }

  /// A second retreat from the same passage, or on the way to the same goal where there is none, means that the robot does not get
  /// through. Passages, not goals: there may be dozens of goals behind one. A further one, from a passage that is shut, is the goal's.
  void learn_from_retreat() {
    const OccupancyGrid<2>& occupancy = occupancy_.grid();
    const std::optional<Eigen::Vector2d> passage_m = passage_ahead_m();
    const Eigen::Vector2d place_m = passage_m.value_or(decision_.chosen()->frontier_m);
    if (!retreats_.contains(place_m, occupancy)) {
      retreats_.add(place_m, occupancy);
    } else if (passage_m && !shut_passages_.contains(place_m, occupancy)) {
      shut_passages_.add(place_m, occupancy);
    } else {
      failed_ = decision_.chosen()->frontier_m;
    }
  }

  /// Where the path ahead leads through cells that may be too narrow; none where it has room.
  [[nodiscard]] std::optional<Eigen::Vector2d> passage_ahead_m() const {
    const double end_m = follower_.progress_m() + params_.follow.lookahead_m;
    for (double along_m = follower_.progress_m(); along_m < end_m; along_m += 0.5 * map().resolution_m()) {
      const Eigen::Vector2d place_m = follower_.path().point_at(along_m);
      if (!search_.ways().is_roomy(map().lattice().index_of(place_m))) return place_m;
    }
    return std::nullopt;
  }

  void set_out() {
    goal_since_s_ = time_s_;
    way_max_m_ = 0.0;
  }

  void drive_to(std::vector<Candidate> candidates, DecisionReason reason) {
    decision_ = {time_s_, std::move(candidates), std::nullopt, reason};
    way_max_m_ = std::max(way_max_m_, decision_.chosen()->path.length_m());
    follower_ = PathFollower(decision_.chosen()->path.points_m(), params_.follow);
    // Where the robot has been it may go though the belief has a wall there: deciding anew would change nothing.
    path_was_clear_ = !path_is_blocked();
  }

  /// By command() or by other means.
  [[nodiscard]] bool has_arrived() const {
    const Eigen::Vector2d& goal_m = decision_.chosen()->goal_m();
    return follower_.is_finished() || distance(belief().pose.position(), goal_m) <= params_.follow.goal_tolerance_m;
  }

  /// Whether something has come in the way since it was last asked.
  [[nodiscard]] bool path_was_closed() {
    const bool was_clear = std::exchange(path_was_clear_, !path_is_blocked());
    return was_clear && !path_was_clear_;
  }

  bool head_for_the_start() {
    const Eigen::Vector2d start_m(0.0, 0.0);
    DecisionReason reason = DecisionReason::no_goal;
    if (decision_.chosen() != nullptr) {
      if (is_overdue()) return end(StopReason::nothing_reachable);
      if (!must_decide_ && has_arrived()) return end(StopReason::returned);
      reason = std::exchange(must_decide_, false) ? DecisionReason::way_in_doubt : DecisionReason::path_closed;
      if (reason == DecisionReason::path_closed && !path_was_closed()) return false;
    } else {
      set_out();
    }
    failed_.reset();
    if (distance(belief().pose.position(), start_m) <= params_.follow.goal_tolerance_m) return end(StopReason::returned);
    search_ways();
    const std::optional<Index<2>> cell = search_.nearest_reached(start_m, params_.travel.escape_radius_m);
    if (!cell) return end(StopReason::nothing_reachable);
    std::vector<Eigen::Vector2d> path_m = search_.path_to(*cell).points_m();
    if (equal(*cell, map().lattice().index_of(start_m))) path_m.back() = start_m;
    Candidate back;
    back.viewpoint = *cell;
    back.path = Polyline(std::move(path_m));
    back.navigation_cost = static_cast<double>(search_.ways().cost_m(*cell));
    drive_to({back}, reason);
    return true;
  }

  /// Why the chosen goal is done with, if it is; marks it to be set aside where it failed.
  [[nodiscard]] std::optional<DecisionReason> done_goal() {
    const Candidate& goal = *decision_.chosen();
    if (std::exchange(must_decide_, false)) return DecisionReason::way_in_doubt;
    // Arrived, what is still to be seen may be what lay behind; only if the map there has not changed, the goal tells nothing.
    const bool is_in_vain = has_arrived() && chosen_.contains(goal.frontier_m, occupancy_.grid()) && is_informative(goal);
    if (is_in_vain || is_overdue()) {
      failed_ = goal.frontier_m;
      return is_in_vain ? DecisionReason::in_vain : DecisionReason::overdue;
    }
    if (has_arrived()) return DecisionReason::arrived;
    if (path_was_closed()) return DecisionReason::path_closed;
    if (params_.strategy == Strategy::persistent || time_s_ < asked_s_ + params_.decision_interval_s) return std::nullopt;
    // No switch without anything learned: planning anew could only swing. What is not worth going to is not worth a switch either.
    const bool is_online = params_.strategy == Strategy::online;
    const double learned_min = is_online ? std::max(1.0, params_.gain_min_cells) : 1.0;
    if (static_cast<double>(learned_.count() - learned_then_) < learned_min) return std::nullopt;
    note_what_is_known();
    if (is_online) return DecisionReason::learned;
    return is_informative(goal) ? std::nullopt : std::optional(DecisionReason::seen_enough);
  }

  void note_what_is_known() {
    asked_s_ = time_s_;
    learned_then_ = learned_.count();
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
      if (is_frontier(cell)) left.push_back(cell);
    }
    const auto is_enough = [&](const std::vector<Index<2>>& cells) {
      return incognita::is_informative(goal.viewpoint, cells, visibility(), params_.information_min_m2);
    };
    return is_enough(left) || is_enough(frontier_cells());
  }

  /// A drive may take three times as long as at full speed, and time to turn: by the longest way since it set out, as ways that are
  /// planned anew become shorter while the time passes.
  [[nodiscard]] bool is_overdue() const {
    return time_s_ > goal_since_s_ + 20.0 + 3.0 * way_max_m_ / params_.follow.speed_max_m_per_s;
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

  bool choose(DecisionReason reason) {
    reserve_reach();
    note_what_is_known();
    const OccupancyGrid<2>& occupancy = occupancy_.grid();
    if (failed_) set_aside_.add(*failed_, occupancy);
    failed_.reset();
    find_uncertain();
    const std::vector<Frontier<2>> frontiers = this->frontiers();
    if (frontiers.empty()) {
      const bool is_outside = !closed_.none() && closed_.bits().get(map().lattice().index_of(belief().pose.position()));
      return end(is_outside ? StopReason::nothing_reachable : StopReason::complete);
    }

    search_ways();
    std::vector<FrontierView> views =
        find_views(frontiers, [&](const Index<2>& cell) { return is_frontier(cell); },
                   [&](const Index<2>& cell) { return search_.ways().reaches(cell); }, visibility(),
                   params_.information_min_m2, viewpoints_);
    if (views.empty()) return end(StopReason::nothing_reachable);
    const std::size_t least_cells = least_cells_above(params_.information_min_m2, map().resolution_m());
    std::erase_if(views, [&](const FrontierView& view) {
      const Eigen::Vector2d frontier_m = map().lattice().center_m(frontiers[view.region].representative);
      return view.seen_cells < least_cells || set_aside_.contains(frontier_m, occupancy);
    });
    std::vector<Candidate> candidates = search_.candidates(std::move(views), frontiers, map(), entropy_, filter(), params_);
    if (candidates.empty()) return end(StopReason::nothing_informative);
    const Candidate* const before = decision_.chosen();
    const bool is_same_goal =
        before != nullptr && distance(before->frontier_m, candidates.front().frontier_m) <= params_.set_aside.radius_m;
    if (!is_same_goal) set_out();
    chosen_ = SetAsidePlaces(params_.set_aside);
    chosen_.add(candidates.front().frontier_m, occupancy);
    drive_to(std::move(candidates), reason);
    return true;
  }

  void search_ways() {
    search_.search_ways(occupancy_.grid(), trail_, closed_, shut_passages_, belief().pose.position(), params_.travel);
  }

  [[nodiscard]] const CellBits* closed_bits() const { return closed_.none() ? nullptr : &closed_.bits(); }

  /// Prediction must not grow the map: every pose of a path lies in the map's box already, its beams within range of it.
  void reserve_reach() {
    const IndexBox<2>& box = reached_;
    const Box<Eigen::Vector2d> reached_m{map().lattice().center_m(box.lower), map().lattice().center_m(box.upper)};
    const double margin_m = map().hit_push_m() + 2.0 * map().resolution_m() + params_.travel.escape_radius_m;
    slam_.reserve(reached_m.padded(params_.gain.range_max_m + margin_m));
  }

  ExplorerParams params_;
  Slam<MapType, Filter> slam_;
  EntropyTable entropy_;
  OccupancyLayer<2> occupancy_;
  FrontierLayer<2> frontier_;
  LearnedCells<2> learned_;
  ClosedCells<2> closed_;
  CandidateSearch<Cell> search_;
  ViewpointSearch viewpoints_;
  SetAsidePlaces set_aside_;      // goals
  SetAsidePlaces chosen_;         // the goal of the last decision, to see whether the map around it changes
  SetAsidePlaces retreats_;       // passages and goals that there was a retreat from
  SetAsidePlaces shut_passages_;  // that the robot did not get through
  SlamReport last_scan_;
  Decision decision_;
  PathFollower follower_;
  IndexBox<2> reached_;  // the cells that scans have reached, those of the map given at the start included
  std::vector<Index<2>> trail_;  // the cells that the robot's centre has passed, each a face neighbour of the last
  std::optional<Eigen::Vector2d> failed_;
  std::optional<Retreat> retreat_;
  bool must_decide_ = false;
  bool path_was_clear_ = true;  // when last asked
  std::vector<Index<2>> uncertain_;  // cells of uncertainty frontiers at the last decision, in storage order
  bool knows_floor_ = false;  // of any free cell, ever
  bool is_paused_ = false;
  bool is_returning_ = false;
  double paused_s_ = 0.0;       // when it was paused
  double goal_since_s_ = 0.0;   // when the chosen frontier was chosen first, or the way back was taken
  double way_max_m_ = 0.0;      // the longest of the ways planned to it since
  double asked_s_ = 0.0;        // when the goal was last asked whether it serves
  std::size_t learned_then_ = 0;         // how many cells were then
  double time_s_ = 0.0;
  double found_s_ = 0.0;      // when the filter was last not lost
  double unblocked_s_ = 0.0;  // when the guard last let the robot drive
};

}  // namespace incognita
