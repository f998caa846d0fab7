/// Everything that a study can say about how one mission is run.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace experiment {

/// The defaults are the library's. Lengths of standard deviations where a parameter of the library is a variance.
struct Settings {
  std::string cells = "t-bayes";        ///< of the map that the filter reads
  std::string rule = "robust";          ///< of t-bayes
  int hits_max = 3;                     ///< N_max of t-bayes
  double cell_occupied_m = 0.39;        ///< the root of R_o, of t-bayes
  double cell_unoccupied_m = 3.0;       ///< the root of R_u
  bool hits_win = true;                 ///< of log-odds
  std::string decision_cells = "same";  ///< of the map that frontiers and gains are of

  std::string filter = "coupled";      ///< decoupled, dead-reckoning, or none for a pose that is known
  std::string form = "registration";   ///< of corrections
  double gamma = 480.0;                ///< of registration, or of the ray form
  double filter_occupied_m = 0.1;      ///< the root of R_o
  double filter_unoccupied_m = 3.0;    ///< the root of R_u
  std::string imagined_tempering = "beams";  ///< what imagined scans are divided by; hits is (11)
  bool doubts_scans = true;            ///< leaves out scans that contradict the map, and looks where else they fit
  bool compass = true;                 ///< headings from walls
  double heading_sigma_rad = 0.0;      ///< of a heading that is measured at each scan; 0: none is

  std::string entropy = "behavioral";
  double alpha = 1.0;
  std::string information = "big";
  std::string navigation = "geodesic";
  std::string strategy = "last-mile";
  std::string controller = "follower";
  int candidates_max = 40;
  double gain_pose_spacing_m = 1.0;
  int gain_beams = 60;

  double duration_s = 1800.0;
  double resolution_m = 0.1;
  double range_max_m = 10.0;
  double range_sigma_m = 0.01;
  int beams = 360;
  double robot_radius_m = 0.2;
  double speed_max_m_per_s = 1.0;
  double odometry_speed_sigma_m_per_s = 0.05;
  double odometry_turn_rate_sigma_rad_per_s = 0.02;
  double position_sigma_max_m = 1.0;  ///< lost beyond
};

/// One setting: its name in a study, where it is kept, and what it may be.
struct Field {
  /// Numbers from low to high.
  struct Bounds {
    double low;
    double high;
  };

  std::string_view name;
  std::variant<double Settings::*, int Settings::*, bool Settings::*, std::string Settings::*> member;
  Bounds bounds{};                              ///< of numbers
  std::array<std::string_view, 5> words{};      ///< of texts; those that are empty are none
};

/// In the order of a report.
[[nodiscard]] inline std::span<const Field> fields() {
  constexpr double tiny = 1e-9;
  static const std::array all{
      Field{"cells", &Settings::cells, {}, {"t-bayes", "log-odds"}},
      Field{"rule", &Settings::rule, {}, {"robust", "literal"}},
      Field{"hits_max", &Settings::hits_max, {1, 255}},
      Field{"cell_occupied_m", &Settings::cell_occupied_m, {1e-6, 100}},
      Field{"cell_unoccupied_m", &Settings::cell_unoccupied_m, {1e-6, 1000}},
      Field{"hits_win", &Settings::hits_win},
      Field{"decision_cells", &Settings::decision_cells, {}, {"same", "log-odds", "t-bayes-exact-pose"}},
      Field{"filter", &Settings::filter, {}, {"coupled", "decoupled", "dead-reckoning", "none"}},
      Field{"form", &Settings::form, {}, {"registration", "ray"}},
      Field{"gamma", &Settings::gamma, {tiny, 1e9}},
      Field{"filter_occupied_m", &Settings::filter_occupied_m, {1e-6, 100}},
      Field{"filter_unoccupied_m", &Settings::filter_unoccupied_m, {1e-6, 1000}},
      Field{"imagined_tempering", &Settings::imagined_tempering, {}, {"beams", "hits"}},
      Field{"doubts_scans", &Settings::doubts_scans},
      Field{"compass", &Settings::compass},
      Field{"heading_sigma_rad", &Settings::heading_sigma_rad, {0, 1}},
      Field{"entropy", &Settings::entropy, {}, {"behavioral", "shannon", "renyi", "tsallis"}},
      Field{"alpha", &Settings::alpha, {tiny, 100}},
      Field{"information", &Settings::information, {}, {"big", "log-big", "uniform", "size", "entropy"}},
      Field{"navigation", &Settings::navigation, {}, {"geodesic", "euclidean", "uniform"}},
      Field{"strategy", &Settings::strategy, {}, {"last-mile", "persistent", "online"}},
      Field{"controller", &Settings::controller, {}, {"follower", "mppi"}},
      Field{"candidates_max", &Settings::candidates_max, {1, 100000}},
      Field{"gain_pose_spacing_m", &Settings::gain_pose_spacing_m, {0.01, 100}},
      Field{"gain_beams", &Settings::gain_beams, {1, 3600}},
      Field{"duration_s", &Settings::duration_s, {0.1, 1e6}},
      Field{"resolution_m", &Settings::resolution_m, {0.01, 2}},
      Field{"range_max_m", &Settings::range_max_m, {0.5, 200}},
      Field{"range_sigma_m", &Settings::range_sigma_m, {0, 10}},
      Field{"beams", &Settings::beams, {1, 7200}},
      Field{"robot_radius_m", &Settings::robot_radius_m, {0.01, 10}},
      Field{"speed_max_m_per_s", &Settings::speed_max_m_per_s, {0.01, 20}},
      Field{"odometry_speed_sigma_m_per_s", &Settings::odometry_speed_sigma_m_per_s, {0, 10}},
      Field{"odometry_turn_rate_sigma_rad_per_s", &Settings::odometry_turn_rate_sigma_rad_per_s, {0, 10}},
      Field{"position_sigma_max_m", &Settings::position_sigma_max_m, {tiny, 1e9}}};
  return all;
}

/// The field of a name; null when none has it.
[[nodiscard]] inline const Field* find_field(std::string_view name) {
  for (const Field& field : fields()) {
    if (field.name == name) return &field;
  }
  return nullptr;
}

}  // namespace experiment
