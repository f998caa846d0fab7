/// What a run leaves to be looked at: poses, scans, changed cells, decisions and metrics over time.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/cell_bits.hpp"
#include "incognita/grid/floor_plan.hpp"
#include "incognita/io/floor_plan_runs.hpp"

namespace incognita {

/// Throws std::invalid_argument for a cell that recordings do not reach.
inline void require_recordable(const char* where, const char* field, int cell) {
  require(cell >= -recorded_cell_max && cell <= recorded_cell_max, where, field, cell, "within 2^28 of 0");
}

/// What does not change in a run. All poses and places of a recording are in the map's frame, in metres and radians.
struct RecordingSetup {
  static constexpr int level_max = 127;     ///< levels of cells go from minus this to this

  std::string parameters_json = "{}";       ///< all parameters of the run by name, an object of JSON
  double resolution_m = 0.1;                ///< of the belief, whose lattice starts at the origin
  double log_odds_step = 0.5;               ///< what levels of cells are multiples of, in nats
  double free_below = -1.0;                 ///< cells with log-odds below are free
  double occupied_above = 1.0;              ///< cells with log-odds above are occupied
  double robot_radius_m = 0.2;              ///< of the disc that stands for it, in metres
  double range_max_m = 10.0;                ///< of the scans, in metres
  std::vector<float> beam_angles_rad;       ///< of the scans, in the robot's frame
  std::vector<std::string> metric_names;    ///< of the numbers in each frame, with their units
  std::optional<FloorPlan> plan;            ///< the true walls, where they are known
  Pose2 T_map_plan;                         ///< where the plan's frame is

  /// Throws std::invalid_argument for values outside of their bounds. The JSON is not looked at.
  void validate() const {
    constexpr const char* where = "RecordingSetup";
    require_positive(where, "resolution_m", resolution_m);
    require_positive(where, "log_odds_step", log_odds_step);
    // Beyond the highest level no cell would be occupied, below the lowest none free.
    const double most = level_max * log_odds_step;
    require(free_below < 0.0 && free_below > -most, where, "free_below", free_below, "< 0 and > -127 log_odds_step");
    require(occupied_above > 0.0 && occupied_above < most, where, "occupied_above", occupied_above, "> 0 and < 127 log_odds_step");
    require_non_negative(where, "robot_radius_m", robot_radius_m);
    require_positive(where, "range_max_m", range_max_m);
    for (const float angle_rad : beam_angles_rad) require(std::isfinite(angle_rad), where, "beam_angles_rad", angle_rad, "finite");
    if (!T_map_plan.is_finite()) throw std::invalid_argument("RecordingSetup: T_map_plan is not finite");
    if (!plan) return;
    for (int axis = 0; axis < 2; ++axis) {
      for (const int bound : {plan->box().lower[axis], plan->box().upper[axis]}) require_recordable(where, "plan's box", bound);
    }
  }
};

/// The cells of one tile whose level has changed, the lowest bit first.
struct RecordedTile {
  Index<2> tile = zero<Index<2>>();  ///< its index, see CellBits
  CellBits::Word cells = 0;          ///< one bit each, not 0
  std::size_t first_level = 0;       ///< of these cells, in the frame's levels; one a cell follows
};

/// One moment of a run, and what has changed since the one before.
struct RecordedFrame {
  static constexpr std::uint16_t range_units = 65000;    ///< scans count in units of range_max_m / this, which means that nothing was met
  static constexpr std::uint16_t range_invalid = 65535;  ///< the reading was ignored

  double time_s = 0.0;                                       ///< since the run began, in seconds
  Pose2 pose;                                                ///< as estimated
  Pose2::Covariance covariance = Pose2::Covariance::Zero();  ///< of x, y and yaw; its lower triangle is kept
  std::optional<Pose2> truth;                                ///< where the pose is known
  bool is_trusted = true;                                    ///< the scan was written into the map
  bool is_lost = false;                                      ///< too many scans in a row were not to be trusted
  bool is_redrawn = false;                                   ///< the whole map was drawn anew since the frame before
  std::vector<std::uint16_t> ranges;                         ///< the scan, none or one a beam
  std::vector<double> metrics;                               ///< one a name of the setup; NaN where there is none
  std::vector<RecordedTile> tiles;                           ///< that have changed since the frame before
  std::vector<std::int8_t> levels;                           ///< log-odds by log_odds_step, rounded away from 0

  /// Throws std::invalid_argument for what is not finite, for other numbers of ranges and metrics than beams and names of the setup, and for
  /// tiles and levels that do not belong together. O(tiles).
  void validate(std::size_t beams, std::size_t names) const {
    constexpr const char* where = "RecordedFrame";
    require(std::isfinite(time_s), where, "time_s", time_s, "finite");
    if (!pose.is_finite() || (truth && !truth->is_finite())) throw std::invalid_argument("RecordedFrame: a pose is not finite");
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column <= row; ++column) {
        require(std::isfinite(covariance(row, column)), where, "covariance", covariance(row, column), "finite");
      }
    }
    require(ranges.empty() || ranges.size() == beams, where, "number of ranges", static_cast<double>(ranges.size()), "0 or that of the beams");
    require(metrics.size() == names, where, "number of metrics", static_cast<double>(metrics.size()), "that of their names");
    std::size_t cells = 0;
    for (const RecordedTile& tile : tiles) {
      for (int axis = 0; axis < 2; ++axis) {
        require(tile.tile[axis] >= -tile_max && tile.tile[axis] <= tile_max, where, "index of a tile", tile.tile[axis], "within 2^25 of 0");
      }
      if (tile.cells == 0) throw std::invalid_argument("RecordedFrame: a tile has no cells");
      require(tile.first_level == cells, where, "first level of a tile", static_cast<double>(tile.first_level), "the number of cells before it");
      cells += static_cast<std::size_t>(std::popcount(tile.cells));
    }
    require(levels.size() == cells, where, "number of levels", static_cast<double>(levels.size()), "that of the cells of all tiles");
  }

  /// Tiles have indices from minus this to this.
  static constexpr int tile_max = recorded_cell_max / CellBits::tile_side;
};

/// Calls visit(cell, level) for each cell whose level has changed in a frame. Levels start at 0; those of all frames up to one, each put in the
/// place of the one before, are the belief at its time.
template <class Visit>
void for_each_changed_cell(const RecordedFrame& frame, Visit&& visit) {
  for (const RecordedTile& tile : frame.tiles) {
    std::size_t level = tile.first_level;
    for (CellBits::Word left = tile.cells; left != 0; left &= left - 1U) {
      visit(CellBits::cell_of(tile.tile, std::countr_zero(left)), frame.levels[level++]);
    }
  }
}

/// A way to go and see, as it was judged.
struct RecordedCandidate {
  std::array<float, 2> frontier_m{};               ///< a cell of the frontier, near its middle
  std::vector<std::array<float, 2>> path_m;        ///< from the robot to the viewpoint
  float gain_nats = 0.0F;                          ///< BIG
  float information = 0.0F;                        ///< what the frontier is measured by, in the unit of the FrontierInformation
  float navigation_cost = 0.0F;                    ///< of getting there, in metres, or 1 (NavigationCost::uniform)
  float utility = 0.0F;                            ///< information per cost, in their units' ratio
};

/// What was decided, between what and why.
struct RecordedDecision {
  double time_s = 0.0;                             ///< since the run began, in seconds
  std::string reason;                              ///< why it was decided anew: a name of DecisionReason
  std::string stop_reason;                         ///< a name of StopReason, empty while it goes on
  std::vector<RecordedCandidate> candidates;       ///< highest utility first, the one that was chosen
  std::vector<Index<2>> frontier;                  ///< cells of all frontiers

  /// Throws std::invalid_argument for times and places that are not finite, and cells too far away. O(points and cells).
  void validate() const {
    constexpr const char* where = "RecordedDecision";
    require(std::isfinite(time_s), where, "time_s", time_s, "finite");
    const auto require_place = [&](const std::array<float, 2>& place_m) {
      for (const float value_m : place_m) require(std::isfinite(value_m), where, "a place", value_m, "finite");
    };
    for (const RecordedCandidate& candidate : candidates) {
      require_place(candidate.frontier_m);
      for (const std::array<float, 2>& point_m : candidate.path_m) require_place(point_m);
    }
    for (const Index<2>& cell : frontier) {
      for (int axis = 0; axis < 2; ++axis) require_recordable(where, "index of a cell", cell[axis]);
    }
  }
};

/// How a run ended.
struct RecordedEnd {
  std::string stop_reason;                         ///< a name of StopReason
  std::string metrics_json = "{}";                 ///< final metrics by name, an object of JSON
};

/// A run as it was recorded, or as much of it as there is.
struct Recording {
  RecordingSetup setup;                            ///< of the whole run
  std::vector<RecordedFrame> frames;               ///< in the order of time
  std::vector<RecordedDecision> decisions;         ///< in the order of time
  std::optional<RecordedEnd> end;                  ///< none when the run was cut short
  std::size_t torn_bytes = 0;                      ///< at the end, of a record that is not whole
};

}  // namespace incognita
