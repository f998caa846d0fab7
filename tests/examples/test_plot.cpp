#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "plot/bands.hpp"
#include "plot/csv_table.hpp"
#include "plot/groups.hpp"
#include "plot/run_folder.hpp"

namespace plot {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("A curve is read between its samples and nowhere else", "[plot]") {
  const std::vector<double> x{1.0, 2.0, 2.0, 4.0, 5.0};
  const std::vector<double> y{10.0, 20.0, 30.0, 50.0, nan};
  const Curve curve{&x, &y};
  CHECK(std::isnan(value_at(curve, 0.999)));
  CHECK(value_at(curve, 1.0) == 10.0);
  CHECK(value_at(curve, 1.5) == 15.0);
  CHECK(value_at(curve, 2.0) == 30.0);  // the last of what the robot saw while it stood
  CHECK(value_at(curve, 3.0) == 40.0);
  CHECK(value_at(curve, 4.0) == 50.0);
  CHECK(std::isnan(value_at(curve, 4.5)));
  CHECK(std::isnan(value_at(curve, 5.1)));
  const std::vector<double> none;
  CHECK(std::isnan(value_at({&none, &none}, 0.0)));
}

TEST_CASE("A band holds what the sorted values of its curves say", "[plot]") {
  incognita::Random random(7);
  for (const std::size_t count : {1U, 2U, 3U, 4U, 7U}) {
    std::vector<std::vector<double>> xs(count);
    std::vector<std::vector<double>> ys(count);
    std::vector<Curve> curves;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t length = 5 + random.index(6);
      for (std::size_t k = 1; k <= length; ++k) {
        xs[i].push_back(static_cast<double>(k));
        ys[i].push_back(random.uniform(0.0, 1.0));
      }
      curves.push_back({&xs[i], &ys[i]});
    }
    const Band band = band_of(curves, 1.0);
    std::size_t longest = 0;
    for (const auto& x : xs) longest = std::max(longest, x.size());
    REQUIRE(band.at.size() == longest);
    for (std::size_t k = 0; k < longest; ++k) {
      CHECK(band.at[k] == static_cast<double>(k + 1));
      std::vector<double> values;
      for (const auto& y : ys) {
        if (k < y.size()) values.push_back(y[k]);
      }
      std::sort(values.begin(), values.end());
      CHECK(band.runs[k] == values.size());
      const std::size_t half = values.size() / 2;
      CHECK(band.median[k] == Approx(values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half])));
      if (count < 4) {
        CHECK(band.low[k] == values.front());
        CHECK(band.high[k] == values.back());
      } else {
        CHECK(band.low[k] <= band.median[k]);
        CHECK(band.low[k] >= values.front());
        CHECK(band.high[k] >= band.median[k]);
        CHECK(band.high[k] <= values.back());
        if (values.size() == 5) {
          CHECK(band.low[k] == Approx(values[1]));
          CHECK(band.high[k] == Approx(values[3]));
        }
      }
    }
  }
}

TEST_CASE("A band reaches to where its longest curve ends, between steps too", "[plot]") {
  const std::vector<double> x{0.5, 2.5};
  const std::vector<double> y{1.0, 3.0};
  const Band band = band_of({{&x, &y}}, 1.0);
  CHECK(band.at == std::vector<double>{0.5, 1.0, 2.0, 2.5});
  CHECK(band.median == std::vector<double>{1.0, 1.5, 2.5, 3.0});
  const std::vector<double> nothing{nan, nan};
  CHECK(band_of({{&x, &nothing}}, 1.0).at.empty());
  CHECK(band_of({}, 1.0).at.empty());
}

TEST_CASE("Runs are grouped by the parameters that differ", "[plot]") {
  const auto run = [](const std::string& text) {
    Run made;
    made.metrics = parse_metrics(text, "metrics.json");
    return made;
  };
  std::vector<Run> runs{run(R"({"seed": 1, "alpha": 0.2, "cells": "tbayes", "duration_s": 1, "scans": 5})"),
                        run(R"({"seed": 2, "alpha": 0.2, "cells": "tbayes", "duration_s": 2, "scans": 6})"),
                        run(R"({"seed": 1, "alpha": null, "cells": "log-odds", "duration_s": 3, "scans": 7})")};
  const std::vector<Group> groups = grouped(runs, {});
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].label == "alpha=0.2, cells=tbayes");
  CHECK(groups[0].runs.size() == 2);
  CHECK(groups[1].label == "alpha=none, cells=log-odds");
  CHECK(groups[1].title() == "alpha=none, cells=log-odds (1 run)");
  CHECK(grouped(runs, {"seed"}).size() == 2);
  CHECK(grouped(runs, {"scans"}).size() == 3);
  runs.pop_back();
  REQUIRE(grouped(runs, {}).size() == 1);
  CHECK(grouped(runs, {}).front().label == "all");
}

TEST_CASE("A table takes other columns, empty values and line ends of either kind", "[plot]") {
  const std::vector<Column> columns = parse_csv("a,word,b\r\n1,x,2\r\n,y,-3e-2\n", "t.csv", {"b", "a"});
  REQUIRE(columns.size() == 2);
  CHECK(columns[0] == Column{2.0, -0.03});
  CHECK(columns[1][0] == 1.0);
  CHECK(std::isnan(columns[1][1]));
  CHECK_THROWS_WITH(parse_csv("a,b\n1,2\n3\n", "t.csv", {"a"}), "t.csv: line 3 is \"3\" with 1 values, but must have 2 as line 1");
  CHECK_THROWS_WITH(parse_csv("a,b\n1,2\n\n", "t.csv", {"a"}), Catch::Contains("line 3"));
}

}  // namespace
}  // namespace plot
