#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/io/belief_numpy.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/prior.hpp"
#include "support.hpp"

using namespace incognita;

TEST_CASE("A belief as arrays: each value lies where the frame says") {
  const io_test::TemporaryFolder folder;
  Random random(5);
  MapParams params;
  params.resolution_m = 0.25;
  Grid<float, 2> given(Lattice<2>(0.25), {Index<2>(-9, 2), Index<2>(4, 30)}, 0.0F);
  for (float& value : given.values()) value = random.uniform() < 0.4 ? 0.0F : static_cast<float>(random.uniform(-9.0, 9.0));
  given.set({-9, 2}, 1.0F);
  given.set({3, 29}, -1.0F);
  const Map<LogOdds> map(given, params);
  write_belief_numpy(folder / "belief", map);
  CHECK(folder.names() == std::vector<std::string>{"belief_frame.json", "belief_log_odds.npy", "belief_probability.npy"});

  const auto frame = nlohmann::json::parse(io_test::content_of(folder / "belief_frame.json"));
  const NpyArray<float> log_odds = read_npy<float>(folder / "belief_log_odds.npy");
  const NpyArray<float> probability = read_npy<float>(folder / "belief_probability.npy");
  const auto shape = frame.at("shape").get<std::vector<std::size_t>>();
  REQUIRE(shape == std::vector<std::size_t>{28, 13});
  REQUIRE(log_odds.shape == shape);
  REQUIRE(probability.shape == shape);
  const double resolution_m = frame.at("resolution_m");
  CHECK(resolution_m == 0.25);
  for (std::size_t row = 0; row < shape[0]; ++row) {
    for (std::size_t column = 0; column < shape[1]; ++column) {
      // The middle of the cell, by the frame alone.
      const double x_m = frame.at("origin_m")[0].get<double>() +
                         (frame.at("first_cell")[0].get<double>() + static_cast<double>(column) + 0.5) * resolution_m;
      const double y_m = frame.at("origin_m")[1].get<double>() +
                         (frame.at("first_cell")[1].get<double>() + static_cast<double>(row) + 0.5) * resolution_m;
      const float expected = map.log_odds(map.lattice().index_of({x_m, y_m}));
      REQUIRE(log_odds.values[row * shape[1] + column] == expected);
      REQUIRE(probability.values[row * shape[1] + column] ==
              Approx(1.0 - 1.0 / (1.0 + std::exp(static_cast<double>(expected)))).margin(1e-7));
    }
  }
  CHECK(frame.at("unknown").at("log_odds") == 0.0);
  CHECK(frame.at("unknown").at("probability") == 0.5);
}

TEST_CASE("A belief as arrays: one that says nothing, and one that cannot be written") {
  const io_test::TemporaryFolder folder;
  write_belief_numpy(folder / "a", Map<LogOdds>());
  CHECK(read_npy<float>(folder / "a_log_odds.npy").shape == std::vector<std::size_t>{0, 0});
  CHECK_THAT(io_test::refusal([] {
               write_belief_numpy("/proc/none/a", Map<LogOdds>());
               return 0;
             }),
             Catch::Contains("cannot be written"));
}
