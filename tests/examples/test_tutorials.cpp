// The messages that the pages of docs/tutorials quote are those that the library gives.
#include <catch2/catch.hpp>
#include <cmath>
#include <exception>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "incognita/entropy/behavioral.hpp"
#include "incognita/entropy/log_odds_table.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/exploration/explorer_params.hpp"
#include "incognita/exploration/information_gain.hpp"
#include "incognita/io/carmen_log.hpp"
#include "incognita/io/read_file.hpp"
#include "incognita/testing/cell_policy_laws.hpp"
#include "incognita/testing/entropy_laws.hpp"
#include "tutorial_05_cell_policy/counting.hpp"

using namespace incognita;

namespace {

std::string page(const std::string& name) {
  const auto file = std::filesystem::path(__FILE__).parent_path() / "../../docs/tutorials" / (name + ".md");
  return read_file(file, 1 << 20);
}

/// What is said when something is wrong.
template <class Wrong>
std::string said(Wrong&& wrong) {
  try {
    wrong();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing was wrong";
}

template <class Wrong>
void check_quoted(const std::string& text, Wrong&& wrong) {
  const std::string message = said(wrong);
  INFO(message);
  CHECK(text.find(message) != std::string::npos);
}

constexpr double nan_m = std::numeric_limits<double>::quiet_NaN();

/// A map and a scan to go wrong with.
const Scan<2> scan(circular_beams(8, 10.0));

}  // namespace

TEST_CASE("tutorial 1 quotes what is said of bad logs and poses") {
  const std::string text = page("01_first_map");
  check_quoted(text, [] { (void)parse_carmen_log("ODOM 0 0 0\n", "scans.log"); });
  std::string odd = "FLASER 200";
  for (int beam = 0; beam < 200; ++beam) odd += " 1.0";
  odd += " 0 0 0 0 0 0 0.0 host 0.0\n";
  check_quoted(text, [&] { (void)parse_carmen_log(odd, "scans.log"); });
  check_quoted(text, [] { Map<>().update(scan, {nan_m, 0.0, 0.0}, Eigen::Matrix3d::Zero()); });
  check_quoted(text, [] { Map<>().update(scan, {}, -Eigen::Matrix3d::Identity()); });
}

TEST_CASE("tutorial 2 quotes what is said of bad odometry and noise") {
  const std::string text = page("02_localise");
  check_quoted(text, [] { DvlEkf().predict({nan_m, 0.0, 0.0}, 0.1); });
  check_quoted(text, [] { DvlEkf().predict({}, -0.1); });
  check_quoted(text, [] {
    DvlEkf::Params params;
    params.noise.yaw_rad_per_sqrt_s = 0.0;
    DvlEkf{params};
  });
}

TEST_CASE("tutorial 3 quotes what is said of a map without room") {
  const std::string text = page("03_where_to_go");
  check_quoted(text, [] {
    Map<> map;
    map.update(scan, {}, Eigen::Matrix3d::Zero());
    GainWorkspace<TBayes> workspace;
    (void)information_gain(map, EntropyTable{Behavioral()}, DvlEkf(), Polyline({{0.0, 0.0}, {5.0, 0.0}}), GainParams{}, workspace);
  });
}

TEST_CASE("tutorial 4 quotes what is said of bad parameters") {
  const std::string text = page("04_explorer");
  check_quoted(text, [] {
    ExplorerParams params;
    params.gain.range_max_m = 0.2;
    params.validate();
  });
  check_quoted(text, [] {
    ExplorerParams params;
    params.follow.speed_max_m_per_s = 0.0;
    params.validate();
  });
}

TEST_CASE("tutorial 5 quotes what is said of a policy that breaks a law") {
  /// Forgets nothing, so it never ends.
  struct Endless : Counting {
    void pass(State& state, const Beam& beam, float residual_m, ScanStamp stamp) const {
      if (residual_m < 0.1F) return;
      Counting::pass(state, beam, residual_m, stamp);
      state.log_odds -= 1.0F;
    }
  };
  const std::string text = page("05_cell_policy");
  const LawReport report = check_cell_policy_laws(Endless());
  REQUIRE_FALSE(report.holds());
  INFO(report.text());
  CHECK(text.find(report.violations.front()) != std::string::npos);
  check_quoted(text, [] {
    Counting::Params params;
    params.prior_hits = 0.0;
    Counting{params};
  });
}

TEST_CASE("tutorial 6 quotes what is said of an entropy that breaks a law") {
  const std::string text = page("06_entropy");
  const auto never_zero = [](double p) { return 0.1 + p * (1.0 - p); };
  const LawReport report = check_entropy_laws(never_zero);
  REQUIRE_FALSE(report.holds());
  INFO(report.text());
  CHECK(text.find(report.violations.front()) != std::string::npos);
  check_quoted(text, [] { EntropyTable{[](double p) { return p * std::log(p); }}; });
}

TEST_CASE("tutorial 7 quotes what is said of bad scans") {
  const std::string text = page("07_own_robot");
  check_quoted(text, [] { Scan<2>(circular_beams(541, 10.0), std::vector<double>(540, 1.0)); });
  check_quoted(text, [] {
    BeamPattern<2> beams = circular_beams(4, 10.0);
    beams.directions[0] = {2.0, 0.0};
    Scan<2>{beams};
  });
}

TEST_CASE("tutorial 8 quotes what is said of bad values") {
  const std::string text = page("08_tuning");
  check_quoted(text, [] { Behavioral(0.0); });
  check_quoted(text, [] {
    TBayes::Params params;
    params.hits_max = 300;
    TBayes{params};
  });
  check_quoted(text, [] {
    TBayes::Params params;
    params.dvl.unoccupied_m2 = 0.1;
    TBayes{params};
  });
  check_quoted(text, [] {
    DvlEkf::Params params;
    params.registration.gamma = -1.0;
    DvlEkf{params};
  });
}
