#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiment/analysis.hpp"
#include "experiment/corridors.hpp"
#include "experiment/results_file.hpp"
#include "experiment/study_file.hpp"
#include "experiment/work.hpp"
#include "incognita/core/random.hpp"
#include "incognita/io/read_file.hpp"
#include "support/bootstrap.hpp"
#include "support/drawn_plan.hpp"

using namespace experiment;
using incognita::Random;

namespace {

Study two_methods() {
  Study study;
  study.maps.resize(2);
  study.maps[0].name = "here";
  study.maps[1].name = "there";
  study.methods = {{"a", "", ""}, {"b", "", ""}};
  study.trials = {{"all", {1, 2}, {1, 2, 3}}};
  return study;
}

/// A row of each unit, with `error` as value(unit).
template <class Value>
std::vector<Row> rows_of(const Study& study, Value&& value) {
  std::vector<std::string> lines;
  for (const Unit& unit : study.units()) {
    lines.push_back(row_text(study, unit, "\"metrics\":{\"explored_fraction\":1,\"error\":" + std::to_string(value(unit)) + "}"));
  }
  return parsed_rows(lines, "rows");
}

}  // namespace

TEST_CASE("intervals hold the true mean in 95 of 100 cases, also of few values, and are not given for fewer than six") {
  CHECK(examples::student_t_975(5.0) == Approx(2.570582).margin(3e-4));
  CHECK(examples::student_t_975(9.0) == Approx(2.262157).margin(3e-5));
  CHECK(examples::student_t_975(1e9) == Approx(1.959964));
  CHECK_FALSE(examples::bootstrapped_mean({1.0, 2.0, 3.0, 4.0, 5.0}).interval);
  const auto equal = examples::bootstrapped_mean(std::vector<double>(6, 2.5));
  CHECK(equal.mean == 2.5);
  CHECK(equal.interval->low == 2.5);
  CHECK(equal.interval->high == 2.5);
  for (const int count : {10, 40}) {
    incognita::Random random(static_cast<std::uint64_t>(count));
    int covered = 0;
    constexpr int trials = 400;
    double width_ratio = 0.0;
    for (int trial = 0; trial < trials; ++trial) {
      std::vector<double> values;
      double sum2 = 0.0;
      for (int n = 0; n < count; ++n) values.push_back(random.normal(3.0, 2.0));
      const examples::MeanInterval mean = examples::bootstrapped_mean(values);
      for (const double value : values) sum2 += (value - mean.mean) * (value - mean.mean);
      const double of_student = 2.0 * examples::student_t_975(count - 1.0) * std::sqrt(sum2 / (count - 1.0) / count);
      width_ratio += (mean.interval->high - mean.interval->low) / of_student / trials;
      covered += mean.interval->low <= 3.0 && 3.0 <= mean.interval->high ? 1 : 0;
    }
    CAPTURE(count);
    CHECK(width_ratio == Approx(1.0).margin(0.03));
    CHECK(covered >= 0.92 * trials);
    CHECK(covered <= 0.98 * trials);
  }
}

TEST_CASE("the mean over groups counts each alike and draws again within each") {
  const std::vector<double> low(6, 1.0);
  std::vector<double> spread;
  for (int n = 0; n < 24; ++n) spread.push_back(n % 2 == 0 ? 4.0 : 6.0);
  const auto both = examples::bootstrapped_mean({low, spread});
  CHECK(both.mean == Approx(3.0));
  const auto alone = examples::bootstrapped_mean(spread);
  CHECK(both.interval->high - both.interval->low == Approx(0.5 * (alone.interval->high - alone.interval->low)).margin(0.05));
  CHECK_FALSE(examples::bootstrapped_mean({low, {1.0, 2.0}}).interval);
}

TEST_CASE("claims are judged by differences on the same starts and seeds") {
  Study study = two_methods();
  study.trials = {{"all", {1, 2, 3, 4, 5, 6}, {1}}};
  const TrialGroup& group = study.trials.front();
  // What starts do is larger than what methods do.
  const auto rows = rows_of(study, [](const Unit& unit) {
    return 10.0 * unit.start + (unit.method == 0 ? 0.0 : unit.map == 0 ? 1.0 + 0.1 * unit.start : 0.5 * (unit.start - 3.5));
  });
  const Results results(study, rows);
  Claim claim{"a errs less", "error", {0}, {1}, true, {0, 1}};
  const auto on = [&](std::size_t map) { return results.pairs(map, claim, group); };
  CHECK(judge(claim, {on(0)}).verdict == Verdict::holds);
  CHECK(judge(claim, {on(0)}).pairs == 6);
  CHECK(judge(claim, {on(0)}).difference.mean == Approx(-1.35));
  CHECK(judge(claim, {on(1)}).verdict == Verdict::undecided);
  CHECK(judge(claim, {on(0), on(1)}).pairs == 12);
  CHECK(judge(claim, {on(0), on(1)}).difference.mean == Approx(-0.675));
  CHECK(judge(claim, {on(0), {}}).verdict == Verdict::undecided);
  CHECK(judge(claim, {}).pairs == 0);
  claim.is_less = false;
  CHECK(judge(claim, {on(0)}).verdict == Verdict::opposite);
  const TrialGroup first{"first", {1, 2}, {1}};
  CHECK(results.pairs(0, claim, first).size() == 2);
  CHECK(Results(study, {rows[0], rows[1], rows[4]}).pairs(0, claim, group).size() == 1);
}

TEST_CASE("seeds from one start count as one pair") {
  const Study study = two_methods();  // two starts, three seeds
  const auto rows = rows_of(study, [](const Unit& unit) { return unit.method == 0 ? 0.0 : 1.0 * unit.start + 0.1 * unit.seed; });
  const Results results(study, rows);
  const Claim claim{"a errs less", "error", {0}, {1}, true, {0}};
  const auto pairs = results.pairs(0, claim, study.trials.front());
  REQUIRE(pairs.size() == 2);
  CHECK(Results::pairs_max(study.trials.front()) == 2);
  CHECK(pairs[1][1] == Approx(2.2));
  CHECK(Results::pairs_max({"seeds", {1}, {1, 2, 3}}) == 3);
}

TEST_CASE("how much two methods differ is judged by their mean difference, not by how much missions scatter") {
  Study study;
  study.maps.resize(1);
  study.methods = {{"a", "", ""}, {"b", "", ""}, {"c", "", ""}, {"d", "", ""}};
  study.trials = {{"all", {}, {1}}};
  for (int start = 1; start <= 30; ++start) study.trials.front().starts.push_back(start);
  const Claim claim{"a and b differ more than c and d", "error", {0, 1}, {2, 3}, false, {0}};
  CHECK(study.name_of(claim.worse) == "|c - d|");
  const auto judged = [&](double of_a, double scatter) {
    Random random(3);
    const auto rows = rows_of(study, [&](const Unit& unit) {
      return unit.method == 0 ? of_a + random.normal(0.0, scatter) : unit.method == 1 ? random.normal(0.0, scatter) : random.normal(0.0, 0.1);
    });
    return judge(claim, {Results(study, rows).pairs(0, claim, study.trials.front())});
  };
  CHECK(judged(0.0, 1.0).verdict == Verdict::undecided);
  CHECK(judged(2.0, 1.0).verdict == Verdict::holds);
  CHECK(judged(-2.0, 1.0).verdict == Verdict::holds);
  CHECK(judged(2.0, 1.0).difference.mean == Approx(2.0).margin(0.6));
}

TEST_CASE("claims of ratios are judged by logarithms") {
  Study study = two_methods();
  study.trials = {{"all", {1, 2, 3, 4, 5, 6}, {1}}};
  // In one trial of six both err a hundred times as much, which hides from a mean of differences that b errs twice as much in all others.
  const auto rows = rows_of(study, [](const Unit& unit) {
    if (unit.map == 1) return unit.method == 0 ? 0.0 : 1.0;
    if (unit.start == 1) return unit.method == 0 ? 110.0 : 100.0;
    return unit.method == 0 ? 1.0 : 2.0;
  });
  const Results results(study, rows);
  Claim claim{"a errs less", "error", {0}, {1}, true, {0, 1}};
  CHECK(judge(claim, {results.pairs(0, claim, study.trials.front())}).verdict == Verdict::undecided);
  claim.is_of_ratios = true;
  const auto logarithms = results.pairs(0, claim, study.trials.front());
  REQUIRE(logarithms.size() == 6);
  CHECK(logarithms.front()[0] - logarithms.front()[1] == Approx(std::log(1.1)));
  CHECK(logarithms.back()[0] - logarithms.back()[1] == Approx(-std::log(2.0)));
  CHECK(judge(claim, {logarithms}).verdict == Verdict::holds);
  CHECK(results.pairs(1, claim, study.trials.front()).empty());  // a ratio to nothing has no logarithm
}

TEST_CASE("what has failed is in no value, and a unit counts once") {
  const Study study = two_methods();
  auto rows = rows_of(study, [](const Unit&) { return 1.0; });
  rows[0].json = {{"failed", "lost"}};
  const Results results(study, rows);
  CHECK(results.all().size() == 24);
  CHECK(results.values(0, 0, "error").size() == 5);
  const std::string line = row_text(study, study.units().front(), failure_text("lost \"here\"\xff"));
  CHECK(parsed_rows({line}, "rows").front().has_failed());
  CHECK_THROWS_WITH(parsed_rows({line, line}, "rows"), "rows:2: is a row of a unit that has one already");
  CHECK_THROWS_WITH(parsed_rows({line.substr(0, 20)}, "rows"), Catch::StartsWith("rows:1: is not a row of results: "));
}

TEST_CASE("the last cost of a unit is its cost") {
  const Study study = two_methods();
  const auto line = [&](std::size_t unit, double wall_s) {
    std::string figures;
    for (const auto& [name, words] : cost_figures) figures += (figures.empty() ? "\"" : ",\"") + std::string(name) + "\":" + std::to_string(wall_s);
    return row_text(study, study.units()[unit], figures);
  };
  const Costs costs = parsed_costs({line(0, 1.0), line(1, 2.0), line(0, 3.0)}, "costs");
  REQUIRE(costs.size() == 2);
  CHECK(costs.at(key_of(study, study.units()[0])).at("wall_s") == 3.0);
  CHECK_THROWS_WITH(parsed_costs({line(0, 1.0), "{}"}, "costs"), Catch::StartsWith("costs:2: is not a row of costs: "));
}

TEST_CASE("a unit that fails is a row as any other, and each unit is run once by whoever is free") {
  const Study study = two_methods();
  const std::vector<Unit> units = study.units();
  Work work;
  for (std::size_t unit = 0; unit < units.size(); ++unit) work.units.push_back(unit);
  std::vector<int> runs(units.size(), 0);
  work.run = [&](std::size_t unit) {
    return result_of([&]() -> std::string {
      ++runs[unit];
      if (unit % 5 == 3) throw std::runtime_error("no way out");
      return "\"metrics\":{\"explored_fraction\":1}";
    });
  };
  std::vector<std::string> lines;
  work.done = [&](std::size_t unit, const std::string& row) { lines.push_back(row_text(study, units[unit], row)); };
  give_out(work, Ranks(), "", 4);
  CHECK(runs == std::vector<int>(units.size(), 1));
  const std::vector<Row> rows = parsed_rows(lines, "rows");
  REQUIRE(rows.size() == units.size());
  std::size_t failed = 0;
  for (const Row& row : rows) failed += row.has_failed() && row.json.at("failed") == "no way out" ? 1 : 0;
  CHECK(failed == 5);

  // A row that cannot be kept ends the work.
  int kept = 0;
  work.done = [&](std::size_t, const std::string&) {
    if (++kept == 6) throw std::runtime_error("the disk is full");
  };
  CHECK_THROWS_WITH(give_out(work, Ranks(), "", 2), "the disk is full");
  CHECK(kept == 6);
}

TEST_CASE("a line that was cut off is taken off, and rows go on behind the last whole one") {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "incognita_results.jsonl";
  std::ofstream(file) << "one\ntwo\nthr";
  {
    ResultsFile results(file);
    CHECK(results.lines() == std::vector<std::string>{"one", "two"});
    results.append("three");
  }
  CHECK(incognita::read_file(file, 1000) == "one\ntwo\nthree\n");
  std::filesystem::remove(file);
}

TEST_CASE("a corridor is narrow and long, and furniture makes none") {
  using namespace incognita;
  FloorPlan plan = examples::walled_floor(30.0, 12.0);
  examples::draw_wall(plan, examples::Along::x, 5.0, 0.0, 30.0, {5.0, 15.0, 25.0});
  examples::draw_wall(plan, examples::Along::x, 7.2, 0.0, 30.0, {4.0, 22.0});
  examples::draw_wall(plan, examples::Along::y, 10.0, 0.0, 5.0, {});
  examples::draw_wall(plan, examples::Along::y, 20.0, 0.0, 5.0, {});
  examples::draw_wall(plan, examples::Along::y, 14.0, 7.2, 12.0, {});
  for (int column = 0; column < 5; ++column) fill_area(plan, {{15.0 + 2.5 * column, 9.0}, {16.0 + 2.5 * column, 10.0}}, FloorCell::wall);
  const Grid<FloorUse, 2> uses = floor_uses(plan, 3.0);
  const auto use_at = [&](double x_m, double y_m) { return uses.value(uses.lattice().index_of(Eigen::Vector2d(x_m, y_m))); };
  for (const double x_m : {0.3, 12.0, 29.7}) CHECK(use_at(x_m, 6.1) == FloorUse::corridor);
  CHECK(use_at(12.0, 5.2) == FloorUse::corridor);  // beside its wall
  for (const auto& [x_m, y_m] : {std::pair(5.0, 2.0), {15.0, 0.3}, {29.7, 4.7}, {3.0, 9.0}, {22.0, 11.0}, {22.0, 8.5}, {14.5, 9.5}}) {
    CAPTURE(x_m, y_m);
    CHECK(use_at(x_m, y_m) == FloorUse::room);
  }
  CHECK(use_at(10.0, 2.0) == FloorUse::none);  // a wall
  std::size_t none = 0;
  for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) none += plan[cell] == FloorCell::floor && uses[cell] == FloorUse::none ? 1 : 0;
  CHECK(none == 0);
}

TEST_CASE("squares are counted as by asking each cell") {
  using namespace incognita;
  Random random(5);
  Grid<std::uint8_t, 2> ones(Lattice<2>(0.1), {Index<2>(-3, 2), Index<2>(20, 19)}, 0);
  for (Offset cell = 0; cell < static_cast<Offset>(ones.size()); ++cell) ones[cell] = random.uniform(0.0, 1.0) < 0.6 ? 1 : 0;
  for (const int shift : {0, -2, -1}) {
    const auto many = experiment::detail::squares(ones, 3, shift, [](std::int32_t count) { return count >= 5; });
    for (Offset cell = 0; cell < static_cast<Offset>(ones.size()); ++cell) {
      int count = 0;
      for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 3; ++x) {
          const Index<2> index = ones.index_at(cell) + Index<2>(x + shift, y + shift);
          count += ones.contains(index) && ones.value(index) != 0 ? 1 : 0;
        }
      }
      REQUIRE(many[cell] == (count >= 5 ? 1 : 0));
    }
  }
}

TEST_CASE("a study's methods are what they are called, whatever holds for all, and what they set themselves comes last") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "incognita_studies";
  std::filesystem::create_directories(folder);
  const std::string parts = R"(title = "Tried"
[[map]]
name = "floor"
plan = "embedded"
duration_s = 30
[[method]]
name = "A1"
[[method]]
name = "B2"
[[method]]
name = "nearest"
[[method]]
name = "further"
like = "nearest"
filter = "none"
[[trials]]
name = "starts"
starts = [1]
seeds = [1]
)";
  std::ofstream(folder / "base.toml") << parts << "[defaults]\nnavigation = \"uniform\"\nbeams = 90\nduration_s = 10\n";
  const Study study = read_study(folder / "base.toml", "");
  const auto settings = [&](std::size_t method) { return study.settings_of({0, method, 1, 1}); };
  CHECK(settings(0).filter == "dead-reckoning");
  CHECK(settings(0).cells == "log-odds");
  CHECK(settings(0).navigation == "uniform");
  CHECK(settings(0).duration_s == 30.0);
  CHECK(settings(0).beams == 90);
  CHECK(settings(1).filter == "coupled");
  CHECK(settings(1).decision_cells == "t-bayes-exact-pose");
  CHECK(settings(2).information == "uniform");
  CHECK(settings(2).navigation == "geodesic");
  CHECK(settings(3).filter == "none");
  CHECK(study.methods[3].where == (folder / "base.toml").string() + ":12");

  std::ofstream(folder / "other.toml") << "title = \"Other\"\nlike = \"base\"\n[defaults]\nbeams = 45\n";
  const Study other = read_study(folder / "other.toml", "");
  CHECK(other.title == "Other");
  CHECK(other.methods.size() == 4);
  CHECK(other.settings_of({0, 0, 1, 1}).beams == 45);
  CHECK(other.settings_of({0, 0, 1, 1}).navigation == "geodesic");
  std::ofstream(folder / "third.toml") << "like = \"other\"\n";
  CHECK_THROWS_WITH(read_study(folder / "third.toml", ""), Catch::EndsWith("third.toml:1: like names a study that is like another itself"));
  std::ofstream(folder / "third.toml") << "\nlike = \"none\"\n";
  CHECK_THROWS_WITH(read_study(folder / "third.toml", ""), Catch::EndsWith("third.toml:2: there is no study \"none\" beside this one, nor is one shipped"));
  std::filesystem::create_directories(folder / "own");
  std::ofstream(folder / "own" / "mine.toml") << "like = \"base\"\n[defaults]\nbeams = 30\n";
  CHECK(read_study(folder / "own" / "mine.toml", "", folder).settings_of({0, 0, 1, 1}).beams == 30);
  std::filesystem::remove_all(folder);
}
