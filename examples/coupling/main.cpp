/// Draws the toy cases of Figs. 5 to 7 of Seo et al.: how an uncertain pose weakens map updates, how the
/// pose's covariance grows out of known surroundings, and candidate paths ranked by their Behavioral
/// information gain.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "coupling/candidate_map.hpp"
#include "coupling/candidates.hpp"
#include "coupling/drive.hpp"
#include "coupling/drive_maps.hpp"
#include "coupling/update_maps.hpp"
#include "coupling/update_strength.hpp"
#include "incognita/entropy/behavioral.hpp"
#include "support/output_folder.hpp"
#include "support/program.hpp"

namespace {

void print(const std::vector<coupling::UpdateStrength>& strengths) {
  std::cout << "Probability of a cell of an unknown map\n"
            << "  pose sigma   hit by 1, 2, 3 scans    passed by 1, at 0.5, 1.5, 2.5, 4.5 m before the hit\n"
            << std::fixed;
  for (const double sigma_m : {0.0, 0.1, 0.3, 1.0, 2.0, 3.0}) {
    const coupling::UpdateStrength strength = coupling::measure_update_strength(sigma_m);
    std::cout << std::setprecision(1) << std::setw(10) << sigma_m << " m" << std::setprecision(3);
    for (const double l : strength.hit_log_odds) {
      std::cout << std::setw(7) << incognita::probability_of_log_odds(l);
    }
    std::cout << "    ";
    for (const double l : strength.passed_log_odds) {
      std::cout << std::setw(7) << incognita::probability_of_log_odds(l);
    }
    std::cout << '\n';
  }
  if (const std::optional<double> sigma_m = coupling::sigma_of_sign_change_m(strengths)) {
    std::cout << "  A first hit lowers the cell from " << std::setprecision(2) << *sigma_m << " m on.\n";
  }
}

void print(const std::vector<coupling::Drive>& drives) {
  std::cout << "\nTrace of the position's covariance, from before the edge of the known map to "
            << std::setprecision(0) << coupling::kDriveTo_m << " m past it\n"
            << "  surroundings          scans a metre     at first    grown   x 3 after   x 10 after\n";
  const auto distance = [](const std::optional<double>& distance_m) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(1);
    distance_m ? text << *distance_m << " m" : text << "-";
    return text.str();
  };
  for (const coupling::Drive& drive : drives) {
    std::cout << "  " << std::left << std::setw(22) << name_of(drive.surroundings) << std::right
              << std::setw(13) << drive.scans_per_m << std::setprecision(3) << std::setw(10)
              << drive.initial_trace_m2() << " m2" << std::setprecision(2) << std::setw(9) << drive.growth()
              << std::setw(12) << distance(drive.distance_of_growth_m(3.0)) << std::setw(13)
              << distance(drive.distance_of_growth_m(10.0)) << '\n';
  }
}

void print(const coupling::Ranking& ranking, double alpha) {
  std::cout
      << "\nPaths of " << ranking.paths.front().path.length_m() << " m by Behavioral information gain, alpha "
      << std::defaultfloat << alpha << std::fixed << "\n"
      << "  path                                  gain (nats)   with an exact pose   sigma at the end\n";
  for (const coupling::RankedPath& path : ranking.paths) {
    std::cout << "  " << std::left << std::setw(38) << path.name << std::right << std::setprecision(1)
              << std::setw(11) << path.gain_nats << std::setw(21) << path.gain_exact_pose_nats
              << std::setprecision(2) << std::setw(17)
              << incognita::position_sigma_m(path.beliefs.back().covariance) << " m\n";
  }
}

void run(const incognita::Behavioral& entropy, const std::filesystem::path& folder) {
  const std::vector<coupling::UpdateStrength> strengths = coupling::measure_update_strengths();
  const std::vector<coupling::Drive> drives = coupling::all_drives();
  const coupling::Ranking ranking = coupling::rank_candidates(incognita::EntropyTable(entropy));

  examples::OutputFolder output(folder);
  coupling::write_update_strengths(output.staged("updates.csv"), strengths);
  coupling::draw_update_strengths(output.staged("updates.png"), strengths);
  coupling::draw_update_maps(output.staged("update_maps.png"));
  coupling::write_drives(output.staged("drives.csv"), drives);
  coupling::draw_drives(output.staged("drives.png"), drives);
  coupling::draw_drive_maps(output.staged("drive_maps.png"), drives);
  coupling::write_candidates(output.staged("candidates.csv"), ranking);
  coupling::write_candidate_beliefs(output.staged("candidate_beliefs.csv"), ranking);
  coupling::draw_candidates(output.staged("candidates.png"), ranking, entropy.alpha());

  print(strengths);
  print(drives);
  print(ranking, entropy.alpha());
  std::cout << '\n';
  for (const std::filesystem::path& file : output.publish()) std::cout << file.string() << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder = "output/coupling";
  double alpha = 1.0;
  CLI::App app(
      "Draws toy cases of coupled localisation and mapping: how an uncertain pose weakens map updates, how "
      "its "
      "covariance grows out of known surroundings, and candidate paths ranked by Behavioral information "
      "gain.");
  app.add_option("--output", folder, "folder for the pictures (PNG) and their numbers (CSV)")
      ->type_name("DIR")
      ->capture_default_str();
  app.add_option("--alpha", alpha, "Behavioral entropy's alpha, > 0; 1 is Shannon")
      ->type_name("A")
      ->capture_default_str();
  return examples::run_program("coupling", app, [&] {
    app.parse(argc, argv);
    run(incognita::Behavioral(alpha), folder);
  });
}
