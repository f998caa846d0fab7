// Runs studies: every map with every method from every start with every seed, on all cores or on the ranks of mpirun, and says which of a
// paper's claims hold.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "experiment/arena.hpp"
#include "experiment/identity.hpp"
#include "experiment/options.hpp"
#include "experiment/progress.hpp"
#include "experiment/ranks.hpp"
#include "experiment/report.hpp"
#include "experiment/results_file.hpp"
#include "experiment/rows.hpp"
#include "experiment/study_file.hpp"
#include "experiment/trial.hpp"
#include "experiment/work.hpp"
#include "incognita/core/parallel.hpp"
#include "incognita/io/atomic_file.hpp"
#include "incognita/io/checksum.hpp"
#include "support/program.hpp"

namespace experiment {
namespace {

/// A study with all that its units need.
struct ReadyStudy {
  Study study;
  std::vector<Arena> arenas;
  std::vector<Unit> units;

  explicit ReadyStudy(const Options& options) : study(read_study(study_file(options.study, INCOGNITA_STUDIES_DIR), options.data, INCOGNITA_STUDIES_DIR)) {
    for (const StudyMap& map : study.maps) arenas.emplace_back(map);
    units = study.units();
    require_possible_units();
  }

  /// What every rank must have alike: the settings, the maps and the units.
  [[nodiscard]] std::string fingerprint() const {
    std::string all = identity_json(study, arenas).dump();
    for (const Unit& unit : units) all += study.name_of(unit) + '\n';
    return "study " + std::to_string(incognita::checksum(all));
  }

  /// Throws InputError, naming the line of the method, where a mission could not even begin.
  void require_possible_units() const {
    std::set<std::pair<std::size_t, double>> tried;
    for (std::size_t map = 0; map < study.maps.size(); ++map) {
      for (std::size_t method = 0; method < study.methods.size(); ++method) {
        const Settings& settings = study.settings_of({map, method, 1, 1});
        try {
          require_possible(settings);
          if (tried.emplace(map, settings.robot_radius_m).second) static_cast<void>(start_of_trial(arenas[map], settings, 1));
        } catch (const std::exception& problem) {
          throw incognita::InputError(study.methods[method].where,
                                      study.methods[method].name + " on " + study.maps[map].name + ": " + problem.what());
        }
      }
    }
  }

  /// Two lines: the result, and what it took.
  [[nodiscard]] std::string run(std::size_t number) const {
    const Unit& unit = units[number];
    const TrialText text = run_trial(arenas[unit.map], study.settings_of(unit), unit.start, unit.seed);
    return text.result + '\n' + text.cost;
  }
};

/// The folder of a study: its results so far, and the lock.
struct StudyFolder {
  std::filesystem::path path;
  std::optional<FolderLock> lock;
  std::optional<ResultsFile> results_file;
  std::optional<ResultsFile> costs_file;  ///< of the same units, and of some that were cut off before their row
  std::vector<Row> rows;
  Costs costs;

  StudyFolder(const Options& options, const ReadyStudy& ready) : path(options.output) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw examples::OutputError("cannot write to " + path.string() + ": " + error.message());
    lock.emplace(path);
    const std::filesystem::path results_path = path / "results.jsonl";
    const std::filesystem::path costs_path = path / "costs.jsonl";
    const std::filesystem::path identity_file = path / "study.json";
    const bool is_there = std::filesystem::exists(results_path, error) && std::filesystem::file_size(results_path, error) > 0;
    if (is_there && !options.resumes && !options.reports) {
      throw examples::OutputError(path.string() + " has results already: --resume goes on with them, or take another folder");
    }
    nlohmann::json identity = identity_json(ready.study, ready.arenas);
    if (is_there) {
      const nlohmann::json before = read_identity(identity_file);
      require_same(before, identity, identity_file);
      // What was there and is not asked for now stays known.
      nlohmann::json both = before;
      both.merge_patch(identity);
      identity = std::move(both);
    }
    results_file.emplace(results_path);
    costs_file.emplace(costs_path);
    rows = parsed_rows(results_file->lines(), results_path.string());
    costs = parsed_costs(costs_file->lines(), costs_path.string());
    incognita::write_file_atomically(identity_file, identity.dump(1) + "\n");
  }
};

void run_units(const Options& options, const ReadyStudy& ready, StudyFolder& folder, const Ranks& ranks) {
  std::set<UnitKey> done;
  std::size_t failed = 0;
  for (const Row& row : folder.rows) {
    done.insert(row.key);
    failed += row.has_failed() ? 1 : 0;
  }
  Work work;
  for (std::size_t number = 0; number < ready.units.size(); ++number) {
    if (!done.contains(key_of(ready.study, ready.units[number]))) work.units.push_back(number);
  }
  Progress progress(ready.units.size() - work.units.size(), failed, ready.units.size(), options.quiet);
  work.run = [&](std::size_t number) { return result_of([&] { return ready.run(number); }); };
  work.done = [&](std::size_t number, const std::string& result) {
    const Unit& unit = ready.units[number];
    const std::size_t end = std::min(result.find('\n'), result.size());
    const std::string text = row_text(ready.study, unit, result.substr(0, end));
    if (end < result.size()) {
      const std::string cost = row_text(ready.study, unit, result.substr(end + 1));
      folder.costs_file->append(cost);
      for (auto& [key, figures] : parsed_costs({cost}, "a new row")) folder.costs.insert_or_assign(key, figures);
    }
    folder.results_file->append(text);
    folder.rows.push_back(parsed_rows({text}, "a new row").front());
    const Row& row = folder.rows.back();
    progress.unit_done(ready.study.name_of(unit), row.has_failed() ? row.json["failed"].get<std::string>() : "");
  };
  // Under mpirun, each rank takes one unit at a time: who wants more starts more ranks.
  const int threads = options.threads > 0 ? options.threads : ranks.count() > 1 ? 1 : incognita::worker_count(0);
  give_out(work, ranks, ready.fingerprint(), threads);
}

/// Rank 0, and whoever is alone.
void lead(const Options& options, const Ranks& ranks) {
  std::optional<ReadyStudy> ready;
  std::optional<StudyFolder> folder;
  try {
    examples::require_gnuplot();  // what would fail in the end fails now
    ready.emplace(options);
    folder.emplace(options, *ready);
  } catch (...) {
    send_home(ranks);
    throw;
  }
  if (options.reports) {
    send_home(ranks);
  } else {
    run_units(options, *ready, *folder, ranks);
  }
  write_report(ready->study, ready->arenas, folder->rows, folder->costs, folder->path);
  if (!options.quiet) std::printf("The report is %s\n", (folder->path / "report.md").string().c_str());
}

/// Any other rank. What is wrong with the study is said by rank 0; what is wrong here alone, is said to it.
void follow(const Options& options, const Ranks& ranks) {
  std::optional<ReadyStudy> ready;
  std::string myself;
  try {
    ready.emplace(options);
    myself = ready->fingerprint();
  } catch (const std::exception& problem) {
    myself = problem.what();
  }
  work_for_rank_0(myself, [&](std::size_t number) { return result_of([&] { return ready->run(number); }); }, ranks);
}

void run(const Options& options, const Ranks& ranks) { ranks.rank() == 0 ? lead(options, ranks) : follow(options, ranks); }

}  // namespace
}  // namespace experiment

int main(int argc, char** argv) {
  const experiment::Ranks ranks;
  const std::string on = experiment::Ranks::can_be_many ? "on all cores or, by\nmpirun, on many machines" : "on all cores";
  CLI::App app("Runs every map of a study with every method from every start with every seed, " + on +
               ". Writes\nresults.jsonl, a row a mission, costs.jsonl, and report.md with its pictures.");
  return examples::run_program("experiment", app, [&] { experiment::run(experiment::parse_options(app, argc, argv), ranks); });
}
