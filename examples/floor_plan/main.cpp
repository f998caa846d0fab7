// Writes a floor plan, generated or drawn, as a map that kth_explorer and ROS map_server read.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

#include "floor_plan/options.hpp"
#include "incognita/core/random.hpp"
#include "incognita/io/image.hpp"
#include "incognita/io/map_server.hpp"
#include "incognita/simulation/building.hpp"
#include "support/drawing.hpp"
#include "support/output_folder.hpp"
#include "support/program.hpp"

namespace floor_plan {
namespace {

using incognita::FloorCell;
using incognita::FloorPlan;

constexpr examples::Color furniture_color{0.62, 0.47, 0.3};
constexpr examples::Color wall_color{0.1, 0.1, 0.1};
constexpr examples::Color solid_color{0.78, 0.81, 0.85};

[[nodiscard]] float probability_of(FloorCell cell) {
  if (cell == FloorCell::floor) return 0.0F;
  return cell == FloorCell::wall ? 1.0F : incognita::unknown_probability;
}

[[nodiscard]] examples::Color color_of(FloorCell cell) {
  if (cell == FloorCell::floor) return {1.0, 1.0, 1.0};
  return cell == FloorCell::wall ? wall_color : solid_color;
}

[[nodiscard]] examples::Drawing drawn(const FloorPlan& plan) {
  examples::Drawing drawing({{0.0, 0.0}, plan.box().extent().cast<double>() * plan.resolution_m()}, 1200, 1248.0);
  drawing.raster(plan, {}, color_of);
  return drawing;
}

/// The picture of a building, whose furniture is told from its walls.
void write_picture(const std::filesystem::path& file, const FloorPlan& plan, const incognita::BuildingLayout& layout) {
  examples::Drawing drawing = drawn(plan);
  incognita::Grid<std::uint8_t, 2> is_furniture(plan.lattice(), plan.box(), std::uint8_t{0});
  for (const incognita::BuildingRoom& room : layout.rooms) {
    for (const incognita::IndexBox<2>& obstacle : room.obstacles) {
      for (int y = obstacle.lower.y(); y < obstacle.upper.y(); ++y) {
        for (int x = obstacle.lower.x(); x < obstacle.upper.x(); ++x) is_furniture.set({x, y}, 1);
      }
    }
  }
  drawing.raster(is_furniture, {}, [](std::uint8_t is) { return is != 0 ? furniture_color : examples::transparent; });
  using examples::Swatch;
  drawing.legend({{"wall", wall_color, Swatch::area}, {"furniture and columns", furniture_color, Swatch::area}});
  drawing.write_png(file);
}

void write_picture(const std::filesystem::path& file, const FloorPlan& plan) {
  examples::Drawing drawing = drawn(plan);
  using examples::Swatch;
  drawing.legend({{"wall or obstacle", wall_color, Swatch::area}, {"rock", solid_color, Swatch::area}});
  drawing.write_png(file);
}

void run(const Options& options) {
  const bool is_generated = options.plan == "generated";
  if (is_generated) {
    options.building.validate();
    // Before the memory of a plan is asked for that no file can hold.
    const auto pixels = [&](double length_m) { return std::llround(length_m / options.building.resolution_m); };
    const incognita::Point<2>& size_m = options.building.size_m;
    incognita::require_image_size(std::filesystem::path(options.output) / "plan.png", pixels(size_m.x()), pixels(size_m.y()));
  }
  examples::OutputFolder output(options.output, {"plan.yaml", "plan.png", "overview.png"});
  std::string what = options.plan;
  const auto write_map = [&](const FloorPlan& plan) { incognita::write_map_server(output.staged("plan.yaml"), plan, probability_of); };
  if (is_generated) {
    incognita::Random random(options.seed);
    const incognita::BuildingLayout layout = incognita::lay_out_building(options.building, random);
    const FloorPlan plan = incognita::draw_layout(layout);
    write_map(plan);
    write_picture(output.staged("overview.png"), plan, layout);
    what = std::to_string(layout.rooms.size()) + " rooms and " + std::to_string(layout.corridors.size()) + " corridors";
  } else {
    const FloorPlan plan = examples::study_plan(options.plan);
    write_map(plan);
    write_picture(output.staged("overview.png"), plan);
  }
  output.publish();
  if (options.quiet) return;
  std::printf("%s\nTo explore it: examples/run --map %s\n", what.c_str(), (output.path() / "plan.yaml").string().c_str());
}

}  // namespace
}  // namespace floor_plan

int main(int argc, char** argv) {
  CLI::App app(
      "Writes a floor plan as plan.yaml and plan.png, a map of ROS map_server, and overview.png, a picture of it with a scale: an office "
      "building of any size from a seed, or one of five plans drawn after those of Seo et al., section VI-C, for a robot of radius 0.4 m.");
  return examples::run_program("floor_plan", app, [&] { floor_plan::run(floor_plan::parse_options(app, argc, argv)); });
}
