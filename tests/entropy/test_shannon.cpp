#include <numbers>

#include "incognita/entropy/shannon.hpp"
#include "reference.hpp"

using incognita::Shannon;

TEST_CASE("Shannon equals -p ln p - (1-p) ln(1-p) to 1e-12", "[entropy]") {
  constexpr std::array<double, 6> kExpected_nats = {6.9177552789821372e-298, 2.8631021115928048e-11,
                                                    0.056001534354847341,    0.61086430205489345,
                                                    0.69314718055994531,     1.4815510058361382e-5};
  for (std::size_t i = 0; i < kExpected_nats.size(); ++i) {
    reference::require_close(Shannon{}(reference::kProbabilities[i]), kExpected_nats[i]);
  }
}

TEST_CASE("Shannon keeps the laws and is exact at 0, 1/2 and 1", "[entropy]") {
  const incognita::LawReport report = incognita::check_entropy_laws(Shannon{});
  INFO(report.text());
  REQUIRE(report.holds());
  REQUIRE(Shannon{}(0.0) == 0.0);
  REQUIRE(Shannon{}(1.0) == 0.0);
  REQUIRE(Shannon{}(0.5) == std::numbers::ln2);
}

TEST_CASE("Shannon is NaN outside [0, 1]", "[entropy]") {
  for (const double p : {-1e-300, 1.0 + 1e-15, std::numeric_limits<double>::quiet_NaN()}) {
    REQUIRE(std::isnan(Shannon{}(p)));
  }
}
