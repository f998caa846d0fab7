/// How well the estimator holds: errors, covariances and costs over floors, noise, beams, with and without
/// compass, and what becomes of a robot that is not where it thinks. Writes a report in Markdown to the
/// standard output; all but its costs is the same for the same arguments, whatever the number of threads.
#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/buildings.hpp"
#include "accuracy/drive.hpp"
#include "accuracy/localisation.hpp"
#include "accuracy/report.hpp"
#include "accuracy/wrong_places.hpp"
#include "incognita/core/parallel.hpp"
#include "incognita/io/floor_plan.hpp"
#include "incognita/io/kth_xml.hpp"
#include "kth_explorer/embedded_floor_plan.hpp"
#include "support/program.hpp"

namespace {

using accuracy::Mission;

constexpr double rough_turn_rad = 0.35;
constexpr double mishap_interval_s = 50.0;
constexpr std::uint64_t mishap_seed = 1;
constexpr std::uint64_t start_attempts = 10;
constexpr std::uint64_t seed_stride = 1000;
constexpr double mission_min_s = 60.0;

struct Options {
  std::vector<std::string> floors;
  std::string rough_floor;
  int seeds = 5;
  int missions = 1;
  double duration_s = 1600.0;
  std::vector<std::size_t> beams{360, 180, 90};
  int threads = 0;
};

struct Building {
  std::string name;
  incognita::World world;
  std::vector<Mission> missions;
};

/// Runs body(index) for each index and counts on stderr.
template <class Body>
void run_all(const char* what, std::size_t count, int threads, const Body& body) {
  incognita::for_each_index(count, threads, [&](std::size_t index, int) {
    body(index);
    std::cerr << what << ' ' + std::to_string(index + 1) + " of " + std::to_string(count) + " is done\n";
  });
}

void add_file(std::vector<Building>& buildings, const std::string& file, double turn_rad) {
  if (!std::filesystem::exists(file)) {
    std::cerr << "accuracy: " << file << " is missing and left out\n";
    return;
  }
  const std::string name = std::filesystem::path(file).stem().string();
  incognita::FloorPlan plan = incognita::read_floor_plan(file);
  if (turn_rad == 0.0) {
    buildings.push_back({name, incognita::World(std::move(plan)), {}});
  } else {
    buildings.push_back({name + ", turned", incognita::World(accuracy::turned_plan(plan, turn_rad)), {}});
  }
}

/// Each building gets as many missions as asked, the seeds from 1 on.
void explore_all(std::vector<Building>& buildings, int missions, const Options& options) {
  const auto each = static_cast<std::size_t>(missions);
  for (Building& building : buildings) building.missions.resize(each);
  run_all("mission", buildings.size() * each, options.threads, [&](std::size_t index) {
    Building& building = buildings[index / each];
    Mission& mission = building.missions[index % each];
    // A start in a closed room ends soon, so another is drawn.
    for (std::uint64_t attempt = 0; attempt < start_attempts && mission.duration_s < mission_min_s;
         ++attempt) {
      mission =
          accuracy::explore(building.world, index % each + 1 + attempt * seed_stride, options.duration_s);
    }
  });
}

/// What the estimator is told to use.
struct Mode {
  bool uses_compass;
  bool closes_loops;
  bool has_people;
};

[[nodiscard]] std::vector<accuracy::ReplayGroup> replay_all(const std::vector<Building>& buildings,
                                                            const std::vector<std::size_t>& beam_counts,
                                                            const std::vector<Mode>& modes, const Options& options) {
  const auto seeds = static_cast<std::size_t>(options.seeds);
  std::vector<accuracy::ReplayGroup> groups;
  std::vector<const Building*> building_of_group;
  for (const Building& building : buildings) {
    for (const std::size_t beams : beam_counts) {
      for (const Mode& mode : modes) {
        groups.push_back({building.name, beams, mode.uses_compass, mode.closes_loops, mode.has_people,
                          std::vector<accuracy::Replay>(seeds)});
        building_of_group.push_back(&building);
      }
    }
  }
  run_all("replay", groups.size() * seeds, options.threads, [&](std::size_t index) {
    accuracy::ReplayGroup& group = groups[index / seeds];
    const Building& building = *building_of_group[index / seeds];
    group.replays[index % seeds] = accuracy::replay(building.world, building.missions.front(),
                                                    {index % seeds + 1, group.beams, group.uses_compass, group.closes_loops,
                                                     group.has_people});
  });
  return groups;
}

void report(const Options& options) {
  std::vector<Building> floors;
  for (const std::string& file : options.floors) add_file(floors, file, 0.0);
  floors.push_back({"embedded",
                    incognita::World(incognita::read_kth_xml_text(examples::embedded_floor_plan_xml,
                                                                  "embedded floor plan")),
                    {}});
  std::vector<Building> rough;
  add_file(rough, options.rough_floor, rough_turn_rad);
  std::vector<Building> drawn;
  drawn.push_back({"round", incognita::World(accuracy::round_building()), {}});
  drawn.push_back({"oblique", incognita::World(accuracy::oblique_building()), {}});

  std::printf("# Accuracy\n\n%d seeds, missions of %.0f s at most.\n", options.seeds, options.duration_s);
  explore_all(floors, options.missions, options);
  explore_all(rough, 1, options);
  explore_all(drawn, 1, options);
  accuracy::print_missions_header();
  for (const auto* buildings : {&floors, &rough, &drawn}) {
    for (const Building& building : *buildings) accuracy::print_missions(building.name, building.missions);
  }

  std::printf(
      "\n## Replayed missions\n\nThe estimator alone, with other noise, in a frame at a random angle.\n\n");
  std::fflush(stdout);
  const std::vector<Mode> modes{{true, true, false}, {true, false, false}, {false, true, false}, {false, false, false}};
  accuracy::print_replays(replay_all(floors, options.beams, modes, options));

  std::printf(
      "\n## People\n\nThe same drives, 360 beams, compass and loops, while %d discs of %.2f m walk through the building at "
      "%.0f m/s. Wrongly occupied: of the known cells further than 0.2 m from anything.\n\n",
      accuracy::People::count, accuracy::People::radius_m, accuracy::People::speed_m_per_s);
  std::fflush(stdout);
  accuracy::print_people(replay_all(floors, {360}, {{true, true, false}}, options),
                         replay_all(floors, {360}, {{true, true, true}}, options));

  accuracy::print_wrong_places_header(mishap_interval_s);
  std::fflush(stdout);
  std::vector<accuracy::OutcomesByMishap> outcomes(floors.size());
  run_all("floor of mishaps", floors.size(), options.threads, [&](std::size_t index) {
    outcomes[index] = accuracy::try_mishaps(floors[index].world, floors[index].missions.front(), mishap_seed,
                                            mishap_interval_s);
  });
  for (std::size_t i = 0; i < floors.size(); ++i) accuracy::print_wrong_places(floors[i].name, outcomes[i]);

  if (!rough.empty()) {
    std::printf(
        "\n## Rough walls\n\nA floor plan turned by %.2f rad in its own raster: walls are staircases.\n\n",
        rough_turn_rad);
    std::fflush(stdout);
    const auto groups = replay_all(rough, {360}, modes, options);
    accuracy::print_replays(groups);
    accuracy::print_compass(groups);
  }
  std::printf(
      "\n## Round and oblique\n\nA circular building, and one of two grids at 30 degrees to each other.\n\n");
  std::fflush(stdout);
  const auto groups = replay_all(drawn, {360}, modes, options);
  accuracy::print_replays(groups);
  accuracy::print_compass(groups);
}

[[nodiscard]] Options parse_options(CLI::App& app, int argc, char** argv) {
  Options options;
  const std::string folder = INCOGNITA_DATA_DIR "/kth/";
  for (const char* name : {"50052753", "50052751", "50052749", "50010535_PLAN1", "50015848"}) {
    options.floors.push_back(folder + name + ".yaml");
  }
  options.rough_floor = folder + "50010535_PLAN1.yaml";
  app.add_option("floors", options.floors, "Floor plans: .yaml or .xml. The embedded one is always added");
  app.add_option("--rough", options.rough_floor, "The floor plan that is turned in its raster")
      ->capture_default_str();
  app.add_option("--seeds", options.seeds, "Replays of each mission")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--missions", options.missions, "Missions on each floor, of which the first is replayed")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--duration", options.duration_s, "Of a mission at most, in seconds")
      ->check(CLI::Range(10.0, 1e5))
      ->capture_default_str();
  app.add_option("--beams", options.beams, "Beams of a scan, as in 360,180,90")
      ->delimiter(',')
      ->check(CLI::Range(8, 100000))
      ->capture_default_str();
  app.add_option("--threads", options.threads,
                 "Runs at once; 0: OpenMP's own number. Costs are honest with 1")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.parse(argc, argv);
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Reports in Markdown how well the estimator holds in simulated buildings.");
  return examples::run_program("accuracy", app, [&] { report(parse_options(app, argc, argv)); });
}
