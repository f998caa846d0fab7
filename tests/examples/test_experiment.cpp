#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "experiment/analysis.hpp"
#include "experiment/corridors.hpp"
#include "experiment/results_file.hpp"
#include "incognita/core/random.hpp"
#include "incognita/io/read_file.hpp"
#include "support/bootstrap.hpp"
#include "support/drawn_plan.hpp"

using namespace experiment;

namespace {

Study two_methods() {
  Study study;
  study.maps.resize(2);
  study.maps[0].name = "here";
  study.maps[1].name = "there";
  study.methods = {{"a", ""}, {"b", ""}};
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

TEST_CASE("the bootstrap's interval is that of the normal distribution, where values are normal") {
  CHECK(examples::bootstrapped_mean({2.5, 2.5, 2.5}).low == 2.5);
  CHECK(examples::bootstrapped_mean({2.5}).high == 2.5);
  incognita::Random random(1);
  int covered = 0;
  constexpr int trials = 60;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> values;
    double sum2 = 0.0;
    for (int n = 0; n < 40; ++n) values.push_back(random.normal(3.0, 2.0));
    const examples::MeanInterval interval = examples::bootstrapped_mean(values);
    for (const double value : values) sum2 += (value - interval.mean) * (value - interval.mean);
    const double half = 1.96 * std::sqrt(sum2 / 40.0 / 40.0);
    CHECK(interval.low == Approx(interval.mean - half).margin(0.08 * half));
    CHECK(interval.high == Approx(interval.mean + half).margin(0.08 * half));
    covered += interval.low <= 3.0 && 3.0 <= interval.high ? 1 : 0;
  }
  CHECK(covered >= 51);
}

TEST_CASE("claims are judged by differences on the same starts and seeds") {
  const Study study = two_methods();
  // What starts and seeds do is larger than what methods do.
  const auto rows = rows_of(study, [](const Unit& unit) {
    const double of_trial = 10.0 * unit.start + 3.0 * unit.seed;
    return of_trial + (unit.method == 0 ? 0.0 : unit.map == 0 ? 1.0 + 0.1 * unit.seed : 0.5 * (unit.seed - 2));
  });
  const Results results(study, rows);
  Claim claim{"a errs less", "error", "a", "b", true};
  CHECK(judge(claim, study, results, 0).verdict == Verdict::holds);
  CHECK(judge(claim, study, results, 0).pairs == 6);
  CHECK(judge(claim, study, results, 0).difference.mean == Approx(-1.2));
  CHECK(judge(claim, study, results, 1).verdict == Verdict::undecided);
  CHECK(judge(claim, study, results, std::nullopt).pairs == 12);
  claim.is_less = false;
  CHECK(judge(claim, study, results, 0).verdict == Verdict::does_not_hold);
  CHECK(judge(claim, study, Results(study, {rows[0], rows[1], rows[4], rows[5]}), 0).verdict == Verdict::undecided);
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

TEST_CASE("a corridor is four times as long as wide, between doors") {
  using namespace incognita;
  FloorPlan plan = examples::walled_floor(30.0, 12.0);
  examples::draw_wall(plan, examples::Along::x, 5.0, 0.0, 30.0, {5.0, 15.0, 25.0});
  examples::draw_wall(plan, examples::Along::x, 7.2, 0.0, 30.0, {4.0, 22.0});
  examples::draw_wall(plan, examples::Along::y, 10.0, 0.0, 5.0, {});
  examples::draw_wall(plan, examples::Along::y, 20.0, 0.0, 5.0, {});
  examples::draw_wall(plan, examples::Along::y, 14.0, 7.2, 12.0, {});
  const Grid<FloorUse, 2> uses = floor_uses(plan, 1.2);
  const auto use_at = [&](double x_m, double y_m) { return uses.value(uses.lattice().index_of(Eigen::Vector2d(x_m, y_m))); };
  for (const double x_m : {0.3, 12.0, 29.7}) CHECK(use_at(x_m, 6.1) == FloorUse::corridor);
  CHECK(use_at(12.0, 5.2) == FloorUse::corridor);  // beside its wall
  for (const auto& [x_m, y_m] : {std::pair(5.0, 2.0), {15.0, 0.3}, {29.7, 4.7}, {3.0, 9.0}, {22.0, 11.0}}) CHECK(use_at(x_m, y_m) == FloorUse::room);
  CHECK(use_at(10.0, 2.0) == FloorUse::none);  // a wall
  std::size_t none = 0;
  for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) none += plan[cell] == FloorCell::floor && uses[cell] == FloorUse::none ? 1 : 0;
  CHECK(none == 0);
}
