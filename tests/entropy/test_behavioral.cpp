#include <numbers>
#include <vector>

#include "incognita/entropy/behavioral.hpp"
#include "reference.hpp"

using incognita::Behavioral;

namespace {

/// (17) as printed, for moderate arguments.
double literal_entropy_nats(double alpha, const std::vector<double>& probabilities) {
  const double beta = std::exp((1.0 - alpha) * std::log(std::log(static_cast<double>(probabilities.size()))));
  double sum_nats = 0.0;
  for (const double p : probabilities) {
    const double weight = std::exp(-beta * std::pow(-std::log(p), alpha));
    sum_nats -= weight * std::log(weight);
  }
  return sum_nats;
}

}  // namespace

TEST_CASE("Behavioral equals (17) to 1e-12, next to alpha = 1 too", "[entropy]") {
  reference::require_rows<Behavioral>(std::array<reference::Row, 11>{{
      {0.2,
       {0.17495525085431673, 0.34323817613871563, 0.58865739113978217, 0.68773223809882323,
        0.69314718055994531, 0.402223704126356}},
      {0.5,
       {6.8703128673610197e-9, 0.055016990787302208, 0.37608365932086458, 0.66884095701122122,
        0.69314718055994531, 0.14100159516305325}},
      {1 - 1e-6,
       {6.9507382774477376e-298, 2.8633760420223105e-11, 0.0560018904550716, 0.61086444945189809,
        0.69314718055994531, 1.4816053312746282e-5}},
      {1 - 1e-9,
       {6.9177881837085736e-298, 2.8631023855104119e-11, 0.056001534710946777, 0.61086430220229051,
        0.69314718055994531, 1.4815510601606366e-5}},
      {1.0,
       {6.9177552789821372e-298, 2.8631021115928048e-11, 0.056001534354847341, 0.61086430205489345,
        0.69314718055994531, 1.4815510058361382e-5}},
      {1 + 1e-9,
       {6.9177223744084984e-298, 2.8631018376751928e-11, 0.056001533998747868, 0.61086430190749638,
        0.69314718055994531, 1.4815509515116355e-5}},
      {1 + 1e-6,
       {6.884928731532152e-298, 2.8628282068173658e-11, 0.056001178256182009, 0.61086415465776715,
        0.69314718055994531, 1.4814966822764974e-5}},
      {1.9999,
       {0.0, 1.4466338450048969e-24, 0.00014576600233689872, 0.4111207900793712, 0.69314718055994531,
        1.4446380710816284e-12}},
      {2.0,
       {0.0, 1.442695040890406e-24, 0.00014570431235732013, 0.41109693793787958, 0.69314718055994531,
        1.4426964836662168e-12}},
      {3.0,
       {0.0, 2.0813689810087297e-36, 2.1129532339243289e-6, 0.18201457483828049, 0.69314718055994531,
        2.0813721032422755e-18}},
      {50.0,
       {0.0, 0.0, 8.1017931856265823e-93, 2.5893007161085428e-15, 0.69314718055994531,
        6.3032316298022713e-293}},
  }});
}

TEST_CASE("Behavioral keeps the laws", "[entropy]") { reference::require_laws<Behavioral>(); }

TEST_CASE("Behavioral at its edges", "[entropy]") { reference::require_edges<Behavioral>(); }

TEST_CASE("Behavioral of a cell is non-increasing in alpha", "[entropy]") {
  reference::require_non_increasing_in_parameter<Behavioral>();
}

TEST_CASE("Behavioral is ln 2 at p = 1/2 to the bit", "[entropy]") {
  for (const double alpha : reference::kParameters) REQUIRE(Behavioral(alpha)(0.5) == std::numbers::ln2);
}

TEST_CASE("Behavioral is finite for any alpha", "[entropy]") {
  for (const double alpha : {1e-300, 1e-3, 1e3, 1e300}) {
    for (const double p : {0.0, 5e-324, 1e-12, 0.3, 0.5, 1.0 - 1e-16, 1.0}) {
      const double entropy_nats = Behavioral(alpha)(p);
      CAPTURE(alpha, p, entropy_nats);
      REQUIRE(entropy_nats >= 0.0);
      REQUIRE(entropy_nats <= std::numbers::ln2 * (1.0 + 1e-12));
    }
  }
}

TEST_CASE("Behavioral of a probability vector equals (17)", "[entropy]") {
  incognita::Random random(19);
  for (int draw = 0; draw < 200; ++draw) {
    std::vector<double> probabilities(2 + random.index(9));
    double sum = 0.0;
    for (double& p : probabilities) sum += p = random.uniform(0.01, 1.0);
    for (double& p : probabilities) p /= sum;
    const double alpha = random.uniform(0.1, 4.0);
    REQUIRE(Behavioral(alpha)(probabilities) ==
            Approx(literal_entropy_nats(alpha, probabilities)).epsilon(1e-10));
  }
}

TEST_CASE("Behavioral of a probability vector agrees with the cell, with Shannon and with ln L",
          "[entropy]") {
  for (const double alpha : reference::kParameters) {
    for (const double p : {0.0, 0.01, 0.25, 0.5, 1.0}) {
      REQUIRE(Behavioral(alpha)(std::vector<double>{p, 1.0 - p}) ==
              Approx(Behavioral(alpha)(p)).epsilon(1e-12).margin(1e-300));
    }
    REQUIRE(Behavioral(alpha)(std::vector<double>(5, 0.2)) == Approx(std::log(5.0)).epsilon(1e-12));
    REQUIRE(Behavioral(alpha)(std::vector<double>{0.0, 1.0, 0.0}) == 0.0);
  }
  const double shannon_nats = -(0.5 * std::log(0.5) + 0.3 * std::log(0.3) + 0.2 * std::log(0.2));
  REQUIRE(Behavioral{}(std::vector<double>{0.5, 0.3, 0.2}) == Approx(shannon_nats).epsilon(1e-14));
}

TEST_CASE("Behavioral entropy can exceed ln L for more than two outcomes", "[entropy]") {
  // Nine equal outcomes and an impossible tenth. By hand: x = ln 10 (ln 9 / ln 10)^5 = 1.8222, and 9 x e^-x
  // = 2.652.
  std::vector<double> probabilities(10, 1.0 / 9.0);
  probabilities[9] = 0.0;
  const double entropy_nats = Behavioral(5.0)(probabilities);
  REQUIRE(entropy_nats == Approx(2.652).epsilon(1e-3));
  REQUIRE(entropy_nats > 1.15 * std::log(10.0));
}

TEST_CASE("Behavioral refuses what is no probability vector", "[entropy]") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Behavioral measure(2.0);
  for (const std::vector<double>& bad :
       {std::vector<double>{}, {1.0}, {0.5, 0.6}, {0.5, 0.5 - 1e-8}, {1.5, -0.5}, {kNan, 0.5}}) {
    REQUIRE_THROWS_AS(measure(bad), std::invalid_argument);
  }
  REQUIRE_NOTHROW(measure(std::vector<double>{0.5, 0.5 - 1e-10}));
  REQUIRE_THROWS_WITH(measure(std::vector<double>{0.5, 0.6}),
                      "Behavioral: the sum of the probabilities is 1.1, but must be 1 within 1e-9");
}
