/// What the tutorials share: a building, pictures of it, and how a program begins and ends.
#pragma once

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/floor_plan.hpp"
#include "incognita/grid/grid.hpp"
#include "support/arguments.hpp"
#include "support/belief_output.hpp"
#include "support/drawing.hpp"
#include "support/drawn_plan.hpp"
#include "support/output_folder.hpp"
#include "support/program.hpp"

namespace examples {

/// 16 x 9 m: three rooms below a corridor, two above it that a door joins, so that there is a loop to drive.
[[nodiscard]] inline incognita::FloorPlan tutorial_building() {
  incognita::FloorPlan plan = walled_floor(16.0, 9.0);
  draw_wall(plan, Along::x, 3.8, 0.0, 16.0, {2.5, 8.0, 13.0});
  draw_wall(plan, Along::x, 5.6, 0.0, 16.0, {4.0, 11.5});
  draw_wall(plan, Along::y, 5.2, 0.0, 3.8, {});
  draw_wall(plan, Along::y, 10.4, 0.0, 3.8, {});
  draw_wall(plan, Along::y, 8.0, 5.6, 9.0, {7.4});
  draw_blocks(plan, {{{0.8, 0.8}, {2.0, 1.6}},
                     {{6.8, 1.6}, {7.2, 2.0}},
                     {{9.4, 0.1}, {10.4, 1.2}},
                     {{14.2, 1.2}, {15.2, 2.6}},
                     {{1.6, 7.4}, {3.2, 8.2}},
                     {{13.6, 6.8}, {14.8, 8.0}}});
  return plan;
}

/// Paper for a picture of the building, in the building's frame.
[[nodiscard]] inline Drawing building_drawing() { return Drawing({{-0.3, -0.3}, {16.3, 9.3}}, 1000, 1048.0); }

inline constexpr Color true_wall{0.85, 0.25, 0.1, 0.55};

/// The walls as they are, over what was drawn before; T_picture_world places the plan.
inline void draw_true_walls(Drawing& drawing, const incognita::FloorPlan& plan, const incognita::Pose2& T_picture_world = {}) {
  drawing.raster(plan, T_picture_world,
                 [](incognita::FloorCell cell) { return cell == incognita::FloorCell::wall ? true_wall : transparent; });
}

/// A part of a map, in a picture of several: `view_m` of it, moved by `shift_m`, under a title.
template <class Map>
void draw_part(Drawing& drawing, const Map& map, const Area& view_m, const Eigen::Vector2d& shift_m, const std::string& title) {
  // Faces that coincide with the view's must not add cells outside of it.
  incognita::Grid<float, 2> log_odds(map.lattice(), map.lattice().cells_of(view_m.padded(-1e-6)));
  for (incognita::Offset cell = 0; cell < static_cast<incognita::Offset>(log_odds.size()); ++cell) {
    log_odds[cell] = map.log_odds(log_odds.index_at(cell));
  }
  drawing.raster(log_odds, {shift_m.x(), shift_m.y(), 0.0}, belief_color);
  const Eigen::Vector2d low = view_m.lower + shift_m;
  const Eigen::Vector2d high = view_m.upper + shift_m;
  constexpr Color ink{0.1, 0.1, 0.1};
  drawing.polyline({low, {high.x(), low.y()}, high, {low.x(), high.y()}, low}, ink, 1.0);
  drawing.text({low.x(), high.y()}, title, ink, 16.0, {4.0, 12.0});
}

/// Points of one frame in another.
[[nodiscard]] inline std::vector<Eigen::Vector2d> moved(const std::vector<Eigen::Vector2d>& points_m, const incognita::Pose2& T_to_from) {
  std::vector<Eigen::Vector2d> there_m;
  for (const Eigen::Vector2d& point_m : points_m) there_m.push_back(T_to_from * point_m);
  return there_m;
}

/// Parses the command line, which may have more options than --output, calls run(output) and says where the files are.
template <class Run>
[[nodiscard]] int run_tutorial(const std::string& name, CLI::App& app, int argc, char** argv, Run&& run) {
  return run_program(name, app, [&] {
    std::string folder = "output/" + name;
    app.add_option("--output", folder, "folder for the results")->type_name("DIR")->check(refuse_empty)->capture_default_str();
    app.parse(argc, argv);
    OutputFolder output(folder);
    run(output);
    for (const std::filesystem::path& file : output.publish()) std::printf("%s\n", file.string().c_str());
  });
}

}  // namespace examples
