#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/metrics/stamps.hpp"

using namespace incognita;

TEST_CASE("stamps: the nearest, as by looking at all") {
  Random random(1);
  for (int round = 0; round < 300; ++round) {
    std::vector<double> times_s;
    for (std::size_t i = random.index(6); i > 0; --i) times_s.push_back(static_cast<double>(random.index(8)));
    std::sort(times_s.begin(), times_s.end());
    const double time_s = 0.25 * static_cast<double>(random.index(40)) - 1.0;
    const double tolerance_s = 0.25 * static_cast<double>(random.index(6));
    std::optional<std::size_t> expected;
    for (std::size_t i = 0; i < times_s.size(); ++i) {
      const double apart_s = std::abs(times_s[i] - time_s);
      if (apart_s <= tolerance_s && (!expected || apart_s < std::abs(times_s[*expected] - time_s)))
        expected = i;
    }
    CAPTURE(times_s, time_s, tolerance_s);
    CHECK(find_stamp(times_s, time_s, tolerance_s) == expected);
  }
}

TEST_CASE("stamps: times that fall are refused") {
  CHECK_NOTHROW(require_ascending("x", std::vector<double>{1.0, 1.0, 2.0}));
  CHECK_THROWS_WITH(require_ascending("x", std::vector<double>{2.0, 1.0}),
                    "x: times_s[1] is 1, but must be in ascending order, >= 2.000000 before it");
}
