#include <catch2/catch.hpp>

#include <malloc.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "../exploration/small_office.hpp"
#include "incognita/core/random.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/io/kth_xml.hpp"
#include "incognita/io/mission_file.hpp"
#include "incognita/loops/loop_closure.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/simulation/start.hpp"
#include "kth_explorer/embedded_floor_plan.hpp"
#include "support.hpp"

namespace incognita {
namespace {

using io_test::content_of;
using io_test::refusal;
using io_test::TemporaryFolder;

/// A robot that drives by its explorer; both go on from where they are.
template <class ExplorerType>
struct Drive {
  Simulator simulator = test::office_simulator(0.9, 21, 90);
  ExplorerType explorer;
  Twist2 command;

  explicit Drive(ExplorerType of) : explorer(std::move(of)) {}

  /// Steps until the simulator's time is `until_s`, and returns the poses believed and the goals after each scan.
  std::vector<double> go_on(double until_s) {
    std::vector<double> seen;
    if (simulator.steps() == 0) look(seen);
    while (!explorer.stopped() && simulator.time_s() < until_s - 1e-9) {
      explorer.move(simulator.step(command), 0.02);
      if (simulator.scan_is_new()) look(seen);
    }
    return seen;
  }

  void look(std::vector<double>& seen) {
    explorer.observe(simulator.scan());
    explorer.decide();
    command = explorer.command(simulator.scan());
    const Pose2& pose = explorer.belief().pose;
    const Eigen::Vector2d goal_m = explorer.goal().value_or(Eigen::Vector2d(0.0, 0.0));
    seen.insert(seen.end(), {pose.x_m, pose.y_m, pose.yaw_rad, goal_m[0], goal_m[1], command.speed_m_per_s});
  }
};

template <class Cell, class Filter>
Explorer<Map<Cell>, Behavioral, Filter> small_explorer(double resolution_m = 0.1) {
  ExplorerParams params;
  params.gain.beams = 30;
  params.threads = 1;
  MapParams map;
  map.resolution_m = resolution_m;
  return Explorer<Map<Cell>, Behavioral, Filter>(params, Map<Cell>(map));
}

/// A mission whose file is small: few beams, large cells.
struct SmallMission {
  using ExplorerType = Explorer<Map<TBayes>, Behavioral, LoopClosingDvlEkf>;

  static ExplorerType fresh() {
    LoopClosingDvlEkf::Params filter;
    filter.start_scans_held = 2;
    filter.surfaces.cell_m = 0.4;
    filter.drift.scans_per_piece = 2;
    ExplorerParams params;
    params.gain.beams = 12;
    params.gain.range_max_m = 4.0;
    params.threads = 1;
    MapParams map;
    map.resolution_m = 0.5;
    return ExplorerType(params, Map<TBayes>(map), {}, LoopClosingDvlEkf(filter));
  }

  static ExplorerType driven() {
    SimulatorParams simulated;
    simulated.sensor.beams = circular_beams(24, 4.0);
    Simulator simulator(World(test::two_rooms(0.9)), test::left_start(), simulated, 3);
    ExplorerType explorer = fresh();
    Twist2 command;
    for (int step = 0; step < 100; ++step) {
      explorer.move(simulator.step(command), 0.02);
      if (!simulator.scan_is_new()) continue;
      explorer.observe(simulator.scan());
      explorer.decide();
      command = explorer.command(simulator.scan());
    }
    return explorer;
  }
};

/// Of all that was allocated; 0 where nobody counts it.
std::size_t bytes_in_use() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#else
  return 0;
#endif
}

/// Without Catch's help, which would print megabytes of both.
bool are_same(const std::string& a, const std::string& b) { return a == b; }

/// The same content with the checksum that belongs to it.
std::string with_checksum(std::string content) {
  content.resize(content.size() - 4);
  detail::append_number(content, checksum(content));
  return content;
}

}  // namespace

/// What a state holds beyond what its file says.
template <class ExplorerType>
void check_same_layers(const ExplorerType& a, const ExplorerType& b) {
  const auto& of_a = a.map().layers();
  const auto& of_b = b.map().layers();
  CHECK(of_a.heeding.tiles().box() == of_b.heeding.tiles().box());
  CHECK(of_a.heeding.tiles().values() == of_b.heeding.tiles().values());
  CHECK(of_a.blocked.tiles().values() == of_b.blocked.tiles().values());
  CHECK(of_a.written.tiles().values() == of_b.written.tiles().values());
  CHECK(of_a.changed.tiles().values() == of_b.changed.tiles().values());
  CHECK(a.occupancy().grid().box() == b.occupancy().grid().box());
  CHECK(a.occupancy().grid().values() == b.occupancy().grid().values());
  const auto frontiers_of = [](const ExplorerType& explorer) {
    std::vector<std::vector<std::pair<int, int>>> all;
    for (const Frontier<2>& frontier : explorer.frontiers()) {
      auto& cells = all.emplace_back();
      for (const Index<2>& cell : frontier.cells) cells.emplace_back(cell[0], cell[1]);
    }
    return all;
  };
  CHECK(frontiers_of(a) == frontiers_of(b));
}

TEMPLATE_PRODUCT_TEST_CASE("a mission goes on from its file as if it had never stopped", "[io]", std::tuple,
                           ((TBayes, DvlEkf), (TBayes, LoopClosingDvlEkf), (LogOdds, LoopClosingDvlEkf), (Dispersion, DeadReckoning))) {
  using Cell = std::tuple_element_t<0, TestType>;
  using Filter = std::tuple_element_t<1, TestType>;
  const TemporaryFolder folder;
  Drive whole(small_explorer<Cell, Filter>());
  (void)whole.go_on(2.5);
  REQUIRE(whole.explorer.goal());
  CHECK(!whole.explorer.frontiers().empty());
  save_mission(folder / "m.mission", whole.explorer, "mine");
  const std::string saved = content_of(folder / "m.mission");
  Drive resumed = whole;
  resumed.explorer = small_explorer<Cell, Filter>();
  CHECK(!are_same(encode_mission(resumed.explorer, "mine"), saved));
  CHECK(load_mission(folder / "m.mission", resumed.explorer) == "mine");
  REQUIRE(are_same(encode_mission(resumed.explorer, "mine"), saved));
  check_same_layers(resumed.explorer, whole.explorer);

  const std::vector<double> expected = whole.go_on(4.0);
  CHECK(expected.size() == 15 * 6);
  CHECK(resumed.go_on(4.0) == expected);
  CHECK(are_same(encode_mission(resumed.explorer), encode_mission(whole.explorer)));
  check_same_layers(resumed.explorer, whole.explorer);
  CHECK(folder.names() == std::vector<std::string>{"m.mission"});
}

TEST_CASE("a mission may be saved after any scan, whatever it is at", "[io]") {
  const auto fresh = [] { return small_explorer<TBayes, LoopClosingDvlEkf>(0.25); };
  Drive whole(fresh());
  Drive resumed = whole;
  const auto both = [&](auto&& call) {
    call(whole.explorer);
    call(resumed.explorer);
  };
  for (int scan = 1; scan <= 120 && !whole.explorer.stopped(); ++scan) {
    if (scan == 30) both([](auto& explorer) { explorer.pause(); });
    if (scan == 40) both([](auto& explorer) { explorer.start(); });
    if (scan == 60) both([](auto& explorer) { explorer.return_to_start(); });
    CAPTURE(scan);
    REQUIRE(resumed.go_on(0.1 * scan) == whole.go_on(0.1 * scan));
    const std::string saved = encode_mission(whole.explorer);
    REQUIRE(are_same(encode_mission(resumed.explorer), saved));
    resumed.explorer = fresh();
    (void)decode_mission(saved, "m", resumed.explorer);
    REQUIRE(resumed.explorer.is_paused() == (scan >= 30 && scan < 40));
  }
  CHECK(whole.explorer.stopped() == StopReason::returned);
  CHECK(resumed.explorer.stopped() == StopReason::returned);
}

TEST_CASE("a retreat goes on", "[io]") {
  Drive whole(small_explorer<TBayes, LoopClosingDvlEkf>());
  (void)whole.go_on(2.5);
  REQUIRE(whole.explorer.goal());
  // Something stands before the robot.
  Scan<2> blocked(circular_beams(90, 10.0));
  for (std::size_t beam = 0; beam < 90; ++beam) blocked.set_range_m(beam, beam < 20 || beam > 70 ? 0.21 : 3.0);
  const auto wait = [&](auto& explorer) {
    explorer.move({}, 0.1);
    return explorer.command(blocked);
  };
  Twist2 command;
  for (int i = 0; i < 15; ++i) command = wait(whole.explorer);
  REQUIRE(std::abs(command.turn_rate_rad_per_s) == RetreatParams{}.turn_rate_rad_per_s);
  auto resumed = small_explorer<TBayes, LoopClosingDvlEkf>();
  (void)decode_mission(encode_mission(whole.explorer), "m", resumed);
  for (int i = 0; i < 3; ++i) {
    const Twist2 of_whole = wait(whole.explorer);
    const Twist2 of_resumed = wait(resumed);
    CHECK(of_resumed.speed_m_per_s == of_whole.speed_m_per_s);
    CHECK(of_resumed.turn_rate_rad_per_s == of_whole.turn_rate_rad_per_s);
  }
  CHECK(are_same(encode_mission(resumed), encode_mission(whole.explorer)));
}

TEST_CASE("a map that was given at the start is in the file", "[io]") {
  Map<> given;
  (void)given.update(Scan<2>(circular_beams(90, 3.0), std::vector<double>(90, 2.0)), {}, Eigen::Matrix3d::Zero());
  const auto with = [&](Map<> map) { return Explorer<Map<>, Behavioral, LoopClosingDvlEkf>({}, std::move(map)); };
  const auto saved = with(given);
  auto loaded = with(Map<>());
  (void)decode_mission(encode_mission(saved), "m", loaded);
  CHECK(are_same(encode_mission(loaded), encode_mission(saved)));
  CHECK(loaded.map().log_odds(Index<2>(20, 0)) == given.log_odds(Index<2>(20, 0)));
  CHECK(loaded.map().log_odds(Index<2>(5, 0)) < 0.0F);
}

TEST_CASE("a mission is only loaded into what it was saved from", "[io]") {
  const std::string saved = encode_mission(SmallMission::fresh());
  const auto refused = [&](auto explorer, const std::string& there, const std::string& here) {
    const std::string before = encode_mission(explorer);
    const std::string message = refusal([&] { return decode_mission(saved, "a.mission", explorer); });
    CAPTURE(message);
    CHECK(message == "a.mission: was saved with \"" + there + "\", which here is \"" + here + "\"");
    CHECK(are_same(encode_mission(explorer), before));
  };
  // The parameters of SmallMission::fresh().
  ExplorerParams params;
  params.gain.beams = 12;
  params.gain.range_max_m = 4.0;
  params.threads = 1;
  MapParams map;
  map.resolution_m = 0.5;
  LoopClosingDvlEkf::Params filter;
  filter.start_scans_held = 2;
  filter.surfaces.cell_m = 0.4;
  filter.drift.scans_per_piece = 2;
  const auto explorer = [&] { return SmallMission::ExplorerType(params, Map<>(map), {}, LoopClosingDvlEkf(filter)); };
  SECTION("threads and duration may be others") {
    params.threads = 2;
    params.duration_max_s = 7.0;
    auto other = explorer();
    (void)decode_mission(saved, "a.mission", other);
    CHECK(are_same(encode_mission(other), saved));
    CHECK(other.params().threads == 2);
  }
  SECTION("the explorer's") {
    params.follow.speed_max_m_per_s = 0.5;
    refused(explorer(), "explorer.follow.speed_max_m_per_s = 1", "explorer.follow.speed_max_m_per_s = 0.5");
  }
  SECTION("an area") {
    params.area.bounds = {{-20.0, -20.0}, {20.0, -20.0}, {20.0, 20.0}};
    refused(explorer(), "explorer.area.bounds = []", "explorer.area.bounds = [-20 -20; 20 -20; 20 20]");
  }
  SECTION("the resolution") {
    map.resolution_m = 0.25;
    refused(explorer(), "map.resolution_m = 0.5", "map.resolution_m = 0.25");
  }
  SECTION("the cells'") {
    refused(SmallMission::ExplorerType(params, Map<>(map, TBayes(TBayes::literal_params())), {}, LoopClosingDvlEkf(filter)),
            "cells.rule = 0", "cells.rule = 1");
  }
  SECTION("other cells") {
    refused(Explorer<Map<LogOdds>, Behavioral, LoopClosingDvlEkf>(params, Map<LogOdds>(map), {}, LoopClosingDvlEkf(filter)),
            "cells.rule = 0", "cells.hit = 0.85");
  }
  SECTION("the filter's") {
    filter.compass.segments.points_min = 8;
    refused(explorer(), "filter.compass.segments.points_min = 6", "filter.compass.segments.points_min = 8");
  }
  SECTION("another filter") {
    refused(Explorer<Map<>, Behavioral, DeadReckoning>(params, Map<>(map)), "filter.start = 0 0 0 1e-06 0 0 0 1e-06 0 0 0 1e-06",
            "filter.noise.position_m_per_sqrt_s = 0.00707");
  }
  SECTION("another entropy") {
    Explorer<Map<>, Shannon, LoopClosingDvlEkf> other(params, Map<>(map), {}, LoopClosingDvlEkf(filter));
    (void)decode_mission(saved, "a.mission", other);  // of which behavioral entropy with its default is one
    Explorer<Map<>, Behavioral, LoopClosingDvlEkf> sharper(params, Map<>(map), Behavioral{0.5}, LoopClosingDvlEkf(filter));
    const std::string message = refusal([&] { return decode_mission(saved, "a.mission", sharper); });
    CHECK(message.find("\"entropy.nats_at_1 = ") != std::string::npos);
  }
}

TEST_CASE("a damaged mission is refused, and the explorer stays as it is", "[io]") {
  const std::string saved = encode_mission(SmallMission::driven(), "the application's");
  SmallMission::ExplorerType explorer = SmallMission::fresh();
  const std::string before = encode_mission(explorer);
  const auto read = [&](const std::string& content) { return decode_mission(content, "a.mission", explorer); };

  CHECK(io_test::refused_when_spoilt(saved, 10000, [&](const std::string& content) {
          // Some changes change nothing.
          if (content == saved) throw InputError("a.mission", "is as it was");
          return read(content);
        }) == 10000);
  for (std::size_t length = 0; length < saved.size(); length += 1 + length / 50) {
    CAPTURE(length);
    REQUIRE(!refusal([&] { return read(saved.substr(0, length)); }).empty());
  }
  CHECK(are_same(encode_mission(explorer), before));

  const auto with = [&](std::size_t place, char byte) {
    std::string content = saved;
    content[place] = byte;
    return content;
  };
  CHECK(refusal([&] { return read(""); }) == "a.mission: is not a mission file");
  CHECK(refusal([&] { return read(with(0, 'x')); }) == "a.mission: is not a mission file");
  CHECK(refusal([&] { return read(with(8, 2)); }) == "a.mission: is a mission of version 2, but this library reads up to version 1");
  CHECK(refusal([&] { return read(with_checksum(with(11, 1))); }) ==
        "a.mission: is a mission of version 16777217, but this library reads up to version 1");
  CHECK(refusal([&] { return read(with_checksum(with(8, 0))); }) == "a.mission: is not valid: its version is 0, but must be at least 1");
  CHECK(refusal([&] { return read(with(saved.size() / 2, static_cast<char>(saved[saved.size() / 2] + 1))); }) ==
        "a.mission: is damaged: its checksum is not that of its content");
  CHECK(refusal([&] { return read(saved + '\0'); }) == "a.mission: is damaged: its checksum is not that of its content");
  CHECK(refusal([&] { return read(with_checksum(saved + '\0')); }) ==
        "a.mission: is not valid: there is more in it than its sections");
  const TemporaryFolder folder;
  CHECK(refusal([&] { return load_mission(folder / "absent", explorer); }).find("no such file") != std::string::npos);

  CHECK(read(saved) == "the application's");
  CHECK(are_same(encode_mission(explorer, "the application's"), saved));
}

TEST_CASE("a forged mission is refused or read, within its memory, and never crashes", "[io]") {
  const std::string saved = encode_mission(SmallMission::driven());
  const SmallMission::ExplorerType fresh = SmallMission::fresh();
  const std::size_t head = 20 + static_cast<std::size_t>(detail::number_at<std::uint64_t>(saved, 12));  // its state's length is there
  Scan<2> scan(circular_beams(24, 4.0));
  Random random(11);
  int read = 0;
  constexpr int times = 1500;
  for (int i = 0; i < times; ++i) {
    std::string forged = saved;
    for (std::uint64_t changes = 1 + random.index(3); changes > 0; --changes) {
      const std::size_t place = head + static_cast<std::size_t>(random.index(forged.size() - head - 4));
      // Lengths and places, large and negative, rather than any byte.
      const std::array<std::uint64_t, 6> wild{0, 1, 0x7FFFFFFF, 0xFFFFFFFF, 0x0000FFFFFFFFFFFF, random.index(1U << 30U)};
      const std::uint64_t value = wild[random.index(wild.size())];
      const std::size_t bytes = std::min<std::size_t>(random.index(2) == 0 ? 1 : 8, forged.size() - 4 - place);
      std::memcpy(forged.data() + place, &value, bytes);
    }
    SmallMission::ExplorerType explorer = fresh;
    const std::size_t before = bytes_in_use();
    const bool is_refused = !refusal([&] { return decode_mission(with_checksum(forged), "a.mission", explorer); }).empty();
    REQUIRE(bytes_in_use() <= before + StateReader::memory_factor * forged.size() + StateReader::memory_least_bytes);
    if (is_refused) continue;
    ++read;
    // What was read can be gone on with, as far as it makes sense.
    try {
      for (int step = 0; step < 2; ++step) {
        explorer.move({0.01, 0.0, 0.0}, 0.1);
        explorer.observe(scan);
        explorer.decide();
        (void)explorer.command(scan);
      }
    } catch (const std::exception&) {
    }
  }
  CHECK(read > times / 20);
  CHECK(read < times);
}

TEST_CASE("a mission asks for no more memory than its bytes can fill", "[io]") {
  // A grid of 2^31 - 1 cells, whose box alone is in the file.
  std::string bytes;
  for (const std::uint32_t corner : {0U, 0U, 2147483647U, 1U}) detail::append_number(bytes, corner);
  Grid<double, 2> grid(Lattice<2>(0.1));
  StateReader reader(bytes, "", "a.mission");
  CHECK(refusal([&] { archive_box(reader, grid); return 0; }) == "a.mission: is not valid: a grid reaches too far");
  bytes.clear();
  for (const std::uint32_t corner : {0U, 0U, 1U << 20U, 1U << 10U}) detail::append_number(bytes, corner);
  StateReader large(bytes, "", "a.mission");
  CHECK(refusal([&] { archive_box(large, grid); return 0; }) == "a.mission: is not valid: more is said to be in it than can be");
  CHECK(grid.size() == 0);
  // A length of 2^60 numbers.
  bytes.clear();
  detail::append_number(bytes, std::uint64_t{1} << 60U);
  std::vector<double> numbers{1.0};
  StateReader endless(bytes, "", "a.mission");
  CHECK(refusal([&] { endless(numbers); return 0; }) == "a.mission: is not valid: it ends within its state");
  CHECK(numbers.size() == 1);
  // Many things that take a byte in the file and many in memory: together they stay below what is granted.
  bytes.clear();
  const std::uint64_t count = 1U << 20U;
  detail::append_number(bytes, count);
  bytes.append(count, '\0');
  std::vector<std::optional<Eigen::Vector3d>> optionals;
  StateReader wasteful(bytes, "", "a.mission");
  CHECK(sizeof(optionals[0]) > StateReader::memory_factor + 1);
  CHECK(refusal([&] { wasteful(optionals); return 0; }) == "a.mission: is not valid: more is said to be in it than can be");
}

TEST_CASE("a mission of minutes goes on from its file as if it had never stopped", "[io][.long]") {
  World world(read_kth_xml_text(examples::embedded_floor_plan_xml, "embedded floor plan"));
  Random random(2);
  const Pose2 start = random_start(world, 0.2, random);
  using ExplorerType = Explorer<Map<>, Behavioral, LoopClosingDvlEkf>;
  Drive whole{ExplorerType()};
  whole.simulator = Simulator(std::move(world), start, {}, 2);
  for (const double until_s : {60.0, 150.5, 333.34}) {
    (void)whole.go_on(until_s);
    Drive resumed = whole;
    resumed.explorer = ExplorerType();
    (void)decode_mission(encode_mission(whole.explorer), "m", resumed.explorer);
    const std::vector<double> expected = whole.go_on(until_s + 30.0);
    CHECK(expected.size() == 300 * 6);
    CHECK(resumed.go_on(until_s + 30.0) == expected);
    CHECK(are_same(encode_mission(resumed.explorer), encode_mission(whole.explorer)));
    check_same_layers(resumed.explorer, whole.explorer);
  }
}

}  // namespace incognita
