/// What a run leaves to be looked at: poses, scans, changed cells, decisions and metrics over time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/cell_bits.hpp"
#include "incognita/grid/floor_plan.hpp"

namespace incognita {

/// What does not change in a run. All poses and places of a recording are in the map's frame, in metres and radians.
struct RecordingSetup {
  std::string parameters_json = "{}";       ///< all parameters of the run by name, an object of JSON
  double resolution_m = 0.1;                ///< of the belief, whose lattice starts at the origin
  double log_odds_step = 0.5;               ///< what levels of cells are multiples of, in nats
  double free_below = -1.0;                 ///< cells with log-odds below are free
  double occupied_above = 1.0;              ///< cells with log-odds above are occupied
  double robot_radius_m = 0.2;
  double range_max_m = 10.0;
  std::vector<float> beam_angles_rad;       ///< of the scans, in the robot's frame
  std::vector<std::string> metric_names;    ///< of the numbers in each frame, with their units
  std::optional<FloorPlan> plan;            ///< the true walls, where they are known
  Pose2 T_map_plan;                         ///< where the plan's frame is
};

/// The cells of one tile whose level has changed, the lowest bit first.
struct RecordedTile {
  Index<2> tile = zero<Index<2>>();
  CellBits::Word cells = 0;
  std::size_t first_level = 0;  ///< of these cells, in the frame's levels; one a cell follows
};

/// One moment of a run, and what has changed since the one before.
struct RecordedFrame {
  /// Scans count in units of range_max_m / this.
  static constexpr std::uint16_t range_units = 65000;
  static constexpr std::uint16_t range_invalid = 65535;

  double time_s = 0.0;
  Pose2 pose;                                                            ///< as estimated
  Pose2::Covariance covariance = Pose2::Covariance::Zero();              ///< of x, y and yaw
  std::optional<Pose2> truth;                                            ///< where the pose is known
  bool is_trusted = true;                                                ///< the scan was written into the map
  bool is_lost = false;
  bool is_redrawn = false;                                               ///< the whole map was drawn anew before this scan
  std::vector<std::uint16_t> ranges;                                     ///< the scan, none or one a beam; range_units is nothing met
  std::vector<double> metrics;                                           ///< one a name of the setup; NaN where there is none
  std::vector<RecordedTile> tiles;
  std::vector<std::int8_t> levels;                                       ///< log-odds by log_odds_step, rounded away from 0
};

/// A way to go and see, as it was judged.
struct RecordedCandidate {
  std::array<float, 2> frontier_m{};               ///< a cell of the frontier, near its middle
  std::vector<std::array<float, 2>> path_m;        ///< from the robot to the viewpoint
  float gain_nats = 0.0F;                          ///< BIG
  float information = 0.0F;
  float navigation_cost = 0.0F;
  float utility = 0.0F;
};

/// What was decided, between what and why.
struct RecordedDecision {
  double time_s = 0.0;
  std::string reason;                              ///< why it was decided anew
  std::string stop_reason;                         ///< empty while it goes on
  std::vector<RecordedCandidate> candidates;       ///< highest utility first, the one that was chosen
  std::vector<Index<2>> frontier;                  ///< cells of all frontiers
};

/// How a run ended.
struct RecordedEnd {
  std::string stop_reason;
  std::string metrics_json = "{}";                 ///< final metrics by name, an object of JSON
};

/// A run as it was recorded, or as much of it as there is.
struct Recording {
  RecordingSetup setup;
  std::vector<RecordedFrame> frames;               ///< in the order of time
  std::vector<RecordedDecision> decisions;         ///< in the order of time
  std::optional<RecordedEnd> end;                  ///< none when the run was cut short
  std::size_t torn_bytes = 0;                      ///< at the end, of a record that is not whole
};

}  // namespace incognita
