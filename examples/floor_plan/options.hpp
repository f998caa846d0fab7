/// The command line of floor_plan.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/simulation/building_params.hpp"
#include "support/arguments.hpp"
#include "support/study_plans.hpp"

namespace floor_plan {

struct Options {
  std::string plan = "generated";
  incognita::BuildingParams building;
  std::uint64_t seed = 1;
  std::string output = "output/floor_plan";
  bool quiet = false;
};

/// Throws CLI::ParseError; one whose exit code is 0 asks for the help text.
[[nodiscard]] inline Options parse_options(CLI::App& app, int argc, char** argv) {
  Options options;
  incognita::BuildingParams& building = options.building;
  std::string size;
  std::vector<std::string> plans{"generated"};
  std::string drawn;
  for (const std::string_view name : examples::study_plan_names) {
    plans.emplace_back(name);
    drawn += (drawn.empty() ? "" : ", ") + std::string(name);
  }
  app.option_defaults()->group("Plan");
  app.add_option("--plan", options.plan, "generated, or one that was drawn: " + drawn)
      ->type_name("NAME")
      // As a plain function, or the help would have all names in one line.
      ->check([plans](std::string text) { return CLI::IsMember(plans)(text); })
      ->capture_default_str();
  app.option_defaults()->group("Generated building");
  const std::vector<CLI::Option*> of_building{
      app.add_option("--size", size, "along x and y, in metres, with the outer walls; without it, 55,25")
          ->type_name("X,Y")
          ->check(examples::refuse_empty),
      app.add_option("--seed", options.seed, "the same gives the same building")
          ->type_name("N")
          ->check(examples::refuse_bad_seed)
          ->capture_default_str(),
      app.add_option("--resolution", building.resolution_m, "side of a pixel, in metres")->type_name("M")->capture_default_str(),
      app.add_option("--radius", building.robot_radius_m, "of the robot that gets everywhere, in metres")->type_name("M")->capture_default_str(),
      app.add_option("--door", building.door_m, "width of doors, in metres; at least the robot's diameter and two pixels")
          ->type_name("M")
          ->capture_default_str(),
      app.add_option("--corridor", building.corridor_m, "width of corridors, in metres; main ones are half as wide again")
          ->type_name("M")
          ->capture_default_str(),
      app.add_option("--halls", building.hall_chance, "probability that a part of the building that may be a hall is one, 0 to 1")
          ->type_name("P")
          ->capture_default_str(),
      app.add_option("--furniture", building.furniture_share, "from 0, none, to 1, as much as there is room for")
          ->type_name("P")
          ->capture_default_str()};
  app.option_defaults()->group("Output");
  app.add_option("--output", options.output, "folder for the results")
      ->type_name("DIR")
      ->check(examples::refuse_empty)
      ->capture_default_str();
  app.add_flag("--quiet", options.quiet, "print nothing but errors");
  app.parse(argc, argv);

  if (!size.empty()) {
    const auto [x_m, y_m] = examples::parse_numbers<2>("--size", size, "X,Y with finite numbers in metres");
    building.size_m = {x_m, y_m};
  }
  building.main_corridor_m = 1.5 * building.corridor_m;
  if (options.plan != "generated") {
    for (const CLI::Option* option : of_building) {
      if (option->count() > 0) throw CLI::ValidationError(option->get_name() + " is for a generated building, not for " + options.plan);
    }
  }
  return options;
}

}  // namespace floor_plan
