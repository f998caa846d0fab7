/// A log, mapped scan by scan.
#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "incognita/estimation/slam.hpp"
#include "incognita/geometry/box.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/number.hpp"
#include "incognita/io/robot_log.hpp"
#include "incognita/io/tum.hpp"
#include "incognita/loops/loop_closure.hpp"
#include "incognita/map/map.hpp"

namespace log_mapping {

/// The estimator for logs of real robots, whose scans often lie half a metre and some seconds apart. Odometry
/// errs by 0.1 m and 0.1 rad from one to the next, so registration starts far off and takes more iterations;
/// a real wall, with its door frames and furniture, is known to a few centimetres and bends within a
/// decimetre.
[[nodiscard]] inline incognita::LoopClosingDvlEkf::Params log_filter_params() {
  incognita::LoopClosingDvlEkf::Params params;
  params.noise = {0.0632, 0.0632};
  params.registration.iterations = 8;
  params.registration.gamma = 200.0;
  params.registration.residual_scale_m = 0.02;
  params.surfaces.flatness = 0.1;  // real walls have frames, radiators and shelves
  // Furniture, glass and people, and a map of few scans: a scan at the right place may contradict half of it.
  params.consistency.share_min = 0.25;
  params.searches_each_scan = true;
  // Three sigmas and more of what wheels do in half a metre, and farther than registration reaches.
  params.search_window = {0.3, 0.3, 0.21};
  return params;
}

/// What mapping a log leaves. Trajectories are the robot's, in the map's frame.
struct MappingRecord {
  std::vector<incognita::TimedPose2> estimated;
  std::vector<incognita::TimedPose2> odometry;  ///< from the same start
  std::size_t lost_scans = 0;
  double distance_m = 0.0;   ///< by odometry
  double wall_time_s = 0.0;  ///< of estimation and mapping, without files
};

using LogSlam = incognita::Slam<incognita::Map<>, incognita::LoopClosingDvlEkf>;

/// Maps a log by odometry and scans alone. `slam` starts at the first scan, its belief at the laser's
/// pose in the map's frame; `file` is named in errors. Throws incognita::InputError when odometry leads so
/// far away that the map would not fit into memory.
[[nodiscard]] inline MappingRecord map_log(const incognita::RobotLog& log, const std::filesystem::path& file,
                                           LogSlam& slam) {
  using namespace incognita;
  constexpr double cells_max = 1 << 26;
  const Pose2 T_laser_robot = log.T_robot_laser.inverse();
  const Pose2 T_map_odom = slam.belief().pose * T_laser_robot * log.scans.front().T_odom_robot.inverse();
  MappingRecord record;
  Scan<2> scan(log.beams);
  Pose2 T_odom_laser = log.scans.front().T_odom_robot * log.T_robot_laser;
  double time_s = log.scans.front().time_s;
  Box<Point<2>> reach_m{slam.belief().pose.position(), slam.belief().pose.position()};
  const auto begin = std::chrono::steady_clock::now();
  for (const LogScan& entry : log.scans) {
    for (std::size_t beam = 0; beam < scan.size(); ++beam) scan.set_range_m(beam, entry.ranges_m[beam]);
    const Pose2 T_odom_next = entry.T_odom_robot * log.T_robot_laser;
    const Pose2 increment = T_odom_laser.inverse() * T_odom_next;
    const double duration_s = entry.time_s - time_s;
    slam.move(increment, duration_s);
    const Point<2> margin_m = Point<2>::Constant(scan.range_max_m());
    reach_m.stretch_to(slam.belief().pose.position() - margin_m);
    reach_m.stretch_to(slam.belief().pose.position() + margin_m);
    if (!(reach_m.extent().prod() <= cells_max * slam.map().resolution_m() * slam.map().resolution_m())) {
      throw InputError(file, "at time " + format_number(entry.time_s) + " the scans span " +
                                 format_number(std::round(reach_m.extent().x())) + " x " +
                                 format_number(std::round(reach_m.extent().y())) + " m, which is more than " +
                                 format_number(cells_max) + " cells of the map");
    }
    if (slam.observe(scan).correction.lost) ++record.lost_scans;
    record.distance_m += norm(increment.position());
    record.estimated.push_back({entry.time_s, slam.belief().pose * T_laser_robot});
    record.odometry.push_back({entry.time_s, T_map_odom * entry.T_odom_robot});
    T_odom_laser = T_odom_next;
    time_s = entry.time_s;
  }
  record.wall_time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return record;
}

}  // namespace log_mapping
