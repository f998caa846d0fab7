#include <catch2/catch.hpp>
#include <cstddef>
#include <optional>
#include <vector>

#include "incognita/estimation/relocation.hpp"

using namespace incognita;

namespace {

constexpr std::size_t judged_min = 12;

ScanFit fit_at(double x_m, std::size_t agreeing, std::size_t contradicting, double residual_m) {
  ScanFit fit;
  fit.registration.belief.pose = {x_m, 0.0, 0.0};
  fit.registration.associations = 200;
  fit.registration.residual_rms_m = residual_m;
  fit.consistency = {agreeing, contradicting};
  return fit;
}

/// What `relocation` makes of a scan with these fits, one a candidate.
std::optional<ScanFit> better(const Relocation& relocation, const ScanFit& current, bool is_contradicted,
                              const std::vector<ScanFit>& fits) {
  std::vector<SearchCandidate> candidates(fits.size());
  for (std::size_t i = 0; i < fits.size(); ++i) candidates[i].pose.x_m = static_cast<double>(i);
  ScanFit fit = current;
  const bool is_found =
      relocation.improve(fit, candidates, is_contradicted, judged_min, [&](const SearchCandidate& candidate) {
        return fits[static_cast<std::size_t>(candidate.pose.x_m)];
      });
  if (!is_found) CHECK(fit.registration.belief.pose.x_m == current.registration.belief.pose.x_m);
  return is_found ? std::optional<ScanFit>(fit) : std::nullopt;
}

/// Has seen many scans of which 90 % of the judged beams agreed, with residuals of 0.01 m.
Relocation used() {
  Relocation relocation;
  for (int scan = 0; scan < 500; ++scan) relocation.add_usual(fit_at(0.0, 90, 10, 0.01), judged_min);
  return relocation;
}

}  // namespace

TEST_CASE("What is unusual follows from what was usual", "[estimation]") {
  const Relocation relocation = used();
  CHECK(relocation.is_unusual({70, 30}, judged_min));
  CHECK_FALSE(relocation.is_unusual({80, 20}, judged_min));
  CHECK_FALSE(relocation.is_unusual({5, 6}, judged_min));
  // Scans that say little of the map change nothing.
  Relocation same = relocation;
  for (int scan = 0; scan < 500; ++scan) same.add_usual(fit_at(0.0, 1, 10, 0.5), judged_min);
  CHECK_FALSE(same.is_unusual({80, 20}, judged_min));
  CHECK(same.is_unusual({70, 30}, judged_min));
}

TEST_CASE("A robot is believed elsewhere only where its scan fits clearly better", "[estimation]") {
  const Relocation relocation = used();
  const ScanFit current = fit_at(0.0, 70, 30, 0.03);
  const auto found = better(relocation, current, false, {fit_at(0.5, 50, 50, 0.01), fit_at(1.0, 95, 5, 0.01)});
  REQUIRE(found);
  CHECK(found->registration.belief.pose.x_m == 1.0);

  CHECK_FALSE(better(relocation, current, false, {}));
  CHECK_FALSE(better(relocation, current, false, {fit_at(1.0, 80, 20, 0.01)}));  // not as good as is usual
  CHECK_FALSE(better(relocation, fit_at(0.0, 86, 14, 0.01), false, {fit_at(1.0, 95, 5, 0.01)}));  // by a margin
  CHECK_FALSE(better(relocation, current, false, {fit_at(1.0, 10, 0, 0.01)}));   // of hardly any beams
  CHECK_FALSE(better(relocation, current, false, {fit_at(1.0, 95, 5, 0.05)}));   // with larger residuals
  CHECK_FALSE(better(relocation, fit_at(0.0, 70, 30, 0.009), false, {fit_at(1.0, 95, 5, 0.019)}));
}

TEST_CASE("Of two places that are as good as each other none is taken", "[estimation]") {
  const Relocation relocation = used();
  const ScanFit current = fit_at(0.0, 70, 30, 0.03);
  CHECK_FALSE(better(relocation, current, false, {fit_at(1.0, 95, 5, 0.01), fit_at(-1.0, 93, 7, 0.01)}));
  CHECK(better(relocation, current, false, {fit_at(1.0, 95, 5, 0.01), fit_at(1.1, 93, 7, 0.01)}));  // one place
}

TEST_CASE("A contradicted place is left for one that is less than usual", "[estimation]") {
  const Relocation relocation = used();
  const ScanFit current = fit_at(0.0, 40, 60, 0.03);
  CHECK(better(relocation, current, true, {fit_at(1.0, 85, 15, 0.01)}));
  CHECK_FALSE(better(relocation, current, false, {fit_at(1.0, 85, 15, 0.01)}));
  CHECK_FALSE(better(relocation, current, true, {fit_at(1.0, 75, 25, 0.01)}));
}

namespace {

/// The scans in a row with these shares of 100 beams that pass before another place is looked for; 0: none of a hundred.
int scans_until_search(double period_s, std::size_t agreeing, bool is_contradicted, bool for_unusual_scans) {
  Relocation relocation = used();
  for (int scan = 0; scan < 20; ++scan) {
    relocation.elapse(period_s);
    relocation.judge({90, 10}, false, judged_min);
    CHECK_FALSE(relocation.must_search(for_unusual_scans));
  }
  for (int scan = 1; scan <= 100; ++scan) {
    relocation.elapse(period_s);
    relocation.judge({agreeing, 100 - agreeing}, is_contradicted, judged_min);
    if (relocation.must_search(for_unusual_scans)) return scan;
  }
  return 0;
}

}  // namespace

TEST_CASE("Another place is looked for when scans have been doubtful or unusual for a while", "[estimation]") {
  CHECK(scans_until_search(0.1, 30, true, true) == 5);
  CHECK(scans_until_search(0.1, 70, false, true) == 3);
  CHECK(scans_until_search(0.1, 70, false, false) == 0);
  CHECK(scans_until_search(0.1, 90, false, true) == 0);
  CHECK(scans_until_search(0.025, 30, true, true) == 5);
  CHECK(scans_until_search(0.025, 70, false, true) == 3);
  // A slow scanner, or logs with seconds between scans, need not wait for as many.
  CHECK(scans_until_search(0.2, 30, true, true) == 3);
  CHECK(scans_until_search(0.2, 70, false, true) == 2);
  CHECK(scans_until_search(3.0, 30, true, true) == 1);
  CHECK(scans_until_search(3.0, 70, false, true) == 1);
}

TEST_CASE("Somebody who passes before the scanner starts no search", "[estimation]") {
  Relocation relocation = used();
  for (int scan = 0; scan < 200; ++scan) {
    const bool is_blocked = scan % 5 < 2;
    relocation.elapse(0.1);
    relocation.judge(is_blocked ? ScanConsistency{60, 40} : ScanConsistency{90, 10}, is_blocked, judged_min);
    REQUIRE_FALSE(relocation.must_search(true));
  }
}

TEST_CASE("A search is narrow for a slip, wide for a robot carried off, and all around now and then", "[estimation]") {
  Relocation relocation = used();
  for (int scan = 0; scan < 20; ++scan) relocation.judge({70, 30}, false, judged_min);
  REQUIRE(relocation.must_search(true));
  const SearchWindow slipped = relocation.begin_search();
  CHECK(slipped.x_m < Relocation::carried_m);
  CHECK_FALSE(relocation.must_search(true));  // not at each scan: a search is dear
  for (int scan = 1; scan <= 20; ++scan) {
    relocation.judge({30, 70}, true, judged_min);
    CAPTURE(scan);
    REQUIRE(relocation.must_search(true) == (scan >= 5));
    if (scan < 5) continue;
    const SearchWindow carried = relocation.begin_search();
    CHECK(carried.x_m == Relocation::carried_m);
    CHECK((carried.yaw_rad > 3.14) == (scan % 5 == 0));
  }
  CHECK(relocation.doubtful_scans() == 20);
  relocation.reset();
  CHECK(relocation.doubtful_scans() == 0);
  CHECK_FALSE(relocation.must_search(true));
}

TEST_CASE("Parameters of a relocation out of bounds are refused by name", "[estimation]") {
  RelocationParams params;
  params.share_margin = -0.25;
  CHECK_THROWS_WITH(Relocation(params), Catch::Contains("share_margin") && Catch::Contains("-0.25"));
  params = {};
  params.share_min = 1.5;
  CHECK_THROWS_WITH(Relocation(params), Catch::Contains("share_min") && Catch::Contains("1.5"));
}
