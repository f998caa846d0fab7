#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/exploration/explorer_params.hpp"
#include "incognita/geometry/pose3.hpp"
#include "incognita/io/state_archive.hpp"
#include "incognita/loops/loop_closure.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/map.hpp"
#include "incognita/planning/mppi_params.hpp"
#include "incognita/simulation/simulator.hpp"
#include "support.hpp"

using namespace incognita;

namespace {

/// Notes where fields lie.
struct FieldPlaces {
  std::vector<const void*> at;
  std::vector<std::size_t> sizes;
  std::vector<std::size_t> alignments;
  std::string names;

  template <class... Fields>
  void operator()(std::string_view of, const Fields&... fields) {
    names = of;
    (at.push_back(&fields), ...);
    (sizes.push_back(sizeof(Fields)), ...);
    (alignments.push_back(alignof(Fields)), ...);
  }
};

/// Whether the fields that a type lists are all that it has, in their order: each begins where the last one lets it, and the last one ends
/// the type. Bytes left out are those of members that a list leaves out on purpose.
template <class Params>
void check_lists_all(std::size_t left_out_bytes = 0) {
  const Params params{};
  FieldPlaces fields;
  params.list_fields(fields);
  CAPTURE(fields.names);
  const auto* const begin = reinterpret_cast<const char*>(&params);
  const auto aligned = [](std::size_t place, std::size_t alignment) { return (place + alignment - 1) / alignment * alignment; };
  std::size_t end = 0;
  for (std::size_t i = 0; i < fields.at.size(); ++i) {
    const auto place = static_cast<std::size_t>(static_cast<const char*>(fields.at[i]) - begin);
    CHECK(place == aligned(end, fields.alignments[i]));
    end = place + fields.sizes[i];
  }
  CHECK(aligned(end + left_out_bytes, alignof(Params)) == sizeof(Params));
  // And a name for each.
  std::size_t names = 1;
  for (std::size_t at = fields.names.find(", "); at != std::string::npos; at = fields.names.find(", ", at + 2)) ++names;
  CHECK(names == fields.at.size());
}

enum class Colour { red, green };

struct Everything {
  bool truth = false;
  std::int32_t whole = 0;
  std::uint16_t small = 0;
  std::size_t size = 0;
  float single = 0.0F;
  double real = 0.0;
  Colour colour = Colour::red;
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  std::vector<double> reals;
  std::vector<std::vector<std::uint8_t>> nested;
  std::optional<Eigen::Vector2d> maybe;
  std::optional<int> none = 3;
  std::string text;
  Random random{1};

  template <class Archive>
  void archive_state(Archive& archive) {
    archive(truth, whole, small, size, single, real, colour, matrix, reals, nested, maybe, none, text, random);
  }
};

template <class Value>
std::string bytes_of(const Value& value) {
  StateWriter writer;
  writer(value);
  return writer.bytes();
}

}  // namespace

TEST_CASE("parameters list all that they have", "[io]") {
  check_lists_all<DvlVariances>();
  check_lists_all<LineSegmentParams>();
  check_lists_all<RangeBearingNoise>();
  check_lists_all<FollowParams>();
  check_lists_all<MppiParams>(sizeof(int));  // threads, which may differ
  check_lists_all<CollisionGuardParams>();
  check_lists_all<RetreatParams>();
  check_lists_all<TravelParams>();
  check_lists_all<AllowedArea>();
  check_lists_all<UncertaintyFrontierParams>();
  check_lists_all<FrontierParams>();
  check_lists_all<OccupancyThresholds>();
  check_lists_all<MapParams>();
  check_lists_all<TBayes::Params>();
  check_lists_all<LogOdds::Params>();
  check_lists_all<Dispersion::Params>();
  check_lists_all<GainParams>();
  check_lists_all<SetAsideParams>();
  check_lists_all<ExplorerParams>(sizeof(double) + sizeof(int));  // duration_max_s and threads, which may differ
  check_lists_all<SurfaceMap<>::Params>();
  check_lists_all<MotionNoise>();
  check_lists_all<DeadReckoning::Params>();
  check_lists_all<RelocationParams>();
  check_lists_all<MapDrift::Params>();
  check_lists_all<CorrelativeSearchParams>();
  check_lists_all<ConsistencyParams>();
  check_lists_all<RayUpdateParams>();
  check_lists_all<SearchWindow>();
  check_lists_all<CompassParams>();
  check_lists_all<RegistrationParams>();
  check_lists_all<LoopClosure::Params>();
  check_lists_all<LoopClosingDvlEkf::Params>();
  check_lists_all<OdometryParams>();
  check_lists_all<RobotParams>();
}

TEST_CASE("a state comes back to the bit", "[io]") {
  Everything saved{true,
                   -7,
                   65535,
                   std::numeric_limits<std::size_t>::max(),
                   -0.0F,
                   std::numeric_limits<double>::denorm_min(),
                   Colour::green,
                   Eigen::Matrix2d::Constant(0.1),
                   {1.0, -std::numeric_limits<double>::infinity(), 3.0},
                   {{1, 2}, {}, {3}},
                   Eigen::Vector2d(0.3, -0.4),
                   std::nullopt,
                   std::string("a\0b", 3),
                   Random(5)};
  saved.matrix(1, 0) = 0.2;
  (void)saved.random.uniform();
  const std::string bytes = bytes_of(saved);
  Everything loaded;
  StateReader reader(bytes, "", "state");
  reader(loaded);
  reader.require_end();
  CHECK(bytes_of(loaded) == bytes);
  CHECK(loaded.real == saved.real);
  CHECK(std::signbit(loaded.single));
  CHECK(loaded.colour == Colour::green);
  CHECK(loaded.matrix == saved.matrix);
  CHECK(loaded.reals == saved.reals);
  CHECK(loaded.nested == saved.nested);
  CHECK(*loaded.maybe == *saved.maybe);
  CHECK(!loaded.none);
  CHECK(loaded.text == saved.text);
  CHECK(loaded.random.uniform() == saved.random.uniform());

  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 20) {
    StateReader shorter(std::string_view(bytes).substr(0, length), "", "state");
    Everything half;
    REQUIRE(io_test::refusal([&] { shorter(half); return 0; }) == "state: is not valid: it ends within its state");
  }
  const std::string longer_bytes = bytes + 'x';
  StateReader longer(longer_bytes, "", "state");
  longer(loaded);
  CHECK(io_test::refusal([&] { longer.require_end(); return 0; }) == "state: is not valid: there is more in it than its state");
}

TEST_CASE("numbers lie in a file as docs/mission_file.md says", "[io]") {
  StateWriter writer;
  writer(true, std::uint32_t{0x01020304}, 1.0, std::vector<float>{-2.0F}, std::optional<bool>(), std::string("hi"), Colour::green);
  const unsigned char expected[] = {1, 4, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0xF0, 0x3F, 1, 0, 0, 0, 0, 0, 0, 0,
                                    0, 0, 0, 0xC0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 'h', 'i', 1, 0, 0, 0};
  CHECK(writer.bytes() == std::string(reinterpret_cast<const char*>(expected), sizeof expected));
}

TEST_CASE("what cannot be a value is refused", "[io]") {
  const auto refused = [](auto value, const std::string& bytes) {
    StateReader reader(bytes, "", "state");
    return io_test::refusal([&] { reader(value); return 0; });
  };
  CHECK(refused(true, "\2") == "state: is not valid: a truth value is neither");
  CHECK(refused(Colour::red, std::string(4, '\xFF')) == "state: is not valid: an enumerator is not there");
  CHECK(refused(Random(1), bytes_of(std::string("not a generator"))) == "state: is not valid: the state of a random generator is none");
}

TEST_CASE("a map in space comes back to the bit", "[io]") {
  const auto fresh = [] { return Map<TBayes, 3>(MapParams{0.5}); };
  Map<TBayes, 3> map = fresh();
  BeamPattern<3> beams;
  beams.directions = {{1.0, 0.0, 0.0}, {0.0, 0.6, 0.8}, {0.0, 0.0, -1.0}};
  (void)map.update(Scan<3>(beams, {2.0, 3.0, 1.0}), Pose3{}, Pose3::Covariance::Zero());
  const std::string bytes = bytes_of(map);
  StateWriter writer;
  writer(map);
  StateReader reader(bytes, writer.parameters(), "map");
  Map<TBayes, 3> loaded = fresh();
  reader(loaded);
  reader.require_end();
  CHECK(loaded.grid().box() == map.grid().box());
  CHECK(loaded.log_odds(Index<3>(4, 0, 0)) == map.log_odds(Index<3>(4, 0, 0)));
  CHECK(loaded.log_odds(Index<3>(4, 0, 0)) > 0.0F);
  CHECK(bytes_of(loaded) == bytes);
}
