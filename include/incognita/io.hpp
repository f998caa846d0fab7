/// The door of io/: reading and writing files. It has libraries of its own (target incognita::io) and is not
/// part of incognita.hpp: the core needs Eigen alone.
///
/// - io/floor_plan.hpp: read_floor_plan, a building from a map_server or a KTH file, by the file's name
/// - io/map_server.hpp, map_metadata.hpp: read_map_server and write_map_server, maps of ROS (yaml-cpp)
/// - io/belief_map_server.hpp: write_belief_map_server, and read_prior_map_server for a map that starts from one
/// - io/octomap.hpp: write_belief_octomap, write_octomap and read_octomap, binary trees (.bt) of OctoMap
/// - io/belief_numpy.hpp, npy.hpp: write_belief_numpy; read_npy and write_npy, arrays
/// - io/belief.hpp: a belief as grids of log-odds, probabilities or occupancy
/// - io/kth_xml.hpp, kth_floor.hpp, kth_doors.hpp: read_kth_xml, floors of the KTH campus (pugixml)
/// - io/tum.hpp: read_tum and write_tum, trajectories
/// - io/robot_log_file.hpp: read_robot_log, scans with odometry, by the file's name
/// - io/intel_json.hpp, carmen_log.hpp, robot_log.hpp: read_intel_json (nlohmann/json) and read_carmen_log
/// - io/run_recorder.hpp, recording_file.hpp: RunRecorder and read_recording, runs to be looked at (zlib)
/// - io/carmen_writer.hpp: write_carmen_log
/// - io/relations.hpp: read_relations, measured relations between poses
/// - io/polygons.hpp: read_polygons, no-go areas
/// - io/png.hpp, pgm.hpp, image.hpp: read_png and write_png (libpng), read_pgm and write_pgm
/// - io/image_file.hpp: read_image, a PNG or a PGM, by its first bytes
/// - io/mission_file.hpp: save_mission and load_mission, explorers that stop and go on (zlib)
/// - io/state_archive.hpp: StateWriter and StateReader, states as bytes
/// - io/read_file.hpp, atomic_file.hpp, number.hpp, text_lines.hpp: what the formats are made of
/// - io/input_error.hpp: the one exception
///
/// Whatever is wrong with a file, missing, malformed, truncated, too large or hostile, throws InputError with
/// one line that names the file, the cause, the value and the bound. Sizes are bounded before memory is asked
/// for.
///
/// A written file appears, or takes the place of an older one, only when it is complete.
///
/// Nothing depends on the locale. All functions may be called from several threads, on different files.
/// Frames are the file's own: metres, x right, y up; row 0 of an image is the largest y, of an array the smallest.
/// docs/formats.md has every format on one page.
#pragma once

#include "incognita/io/atomic_file.hpp"
#include "incognita/io/belief.hpp"
#include "incognita/io/belief_map_server.hpp"
#include "incognita/io/belief_numpy.hpp"
#include "incognita/io/bytes.hpp"
#include "incognita/io/carmen_log.hpp"
#include "incognita/io/carmen_writer.hpp"
#include "incognita/io/checksum.hpp"
#include "incognita/io/floor_plan.hpp"
#include "incognita/io/floor_plan_runs.hpp"
#include "incognita/io/image.hpp"
#include "incognita/io/image_file.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/intel_json.hpp"
#include "incognita/io/kth_doors.hpp"
#include "incognita/io/kth_floor.hpp"
#include "incognita/io/kth_xml.hpp"
#include "incognita/io/map_metadata.hpp"
#include "incognita/io/map_server.hpp"
#include "incognita/io/mission_file.hpp"
#include "incognita/io/npy.hpp"
#include "incognita/io/number.hpp"
#include "incognita/io/octomap.hpp"
#include "incognita/io/pgm.hpp"
#include "incognita/io/png.hpp"
#include "incognita/io/polygons.hpp"
#include "incognita/io/read_file.hpp"
#include "incognita/io/recorded_levels.hpp"
#include "incognita/io/recording.hpp"
#include "incognita/io/recording_file.hpp"
#include "incognita/io/recording_records.hpp"
#include "incognita/io/relations.hpp"
#include "incognita/io/robot_log.hpp"
#include "incognita/io/robot_log_file.hpp"
#include "incognita/io/run_recorder.hpp"
#include "incognita/io/state_archive.hpp"
#include "incognita/io/text_lines.hpp"
#include "incognita/io/tum.hpp"
