#include <algorithm>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "../allocations.hpp"
#include "incognita/core/random.hpp"
#include "incognita/io/recording_file.hpp"
#include "recordings.hpp"

using namespace incognita;

namespace {

std::size_t place_in(const std::string& bytes, Random& random) { return random.index(std::max<std::size_t>(bytes.size(), 1)); }

/// Numbers that ask for much, or for what hardly fits.
std::string odd_number(Random& random) {
  ByteWriter bytes;
  switch (random.index(5)) {
    case 0: bytes.varint(io_test::any_bits(random) >> random.index(64)); break;
    case 1: bytes.varint(std::uint64_t{1} << random.index(64)); break;
    case 2: bytes.number(std::numeric_limits<double>::quiet_NaN()); break;
    case 3: bytes.number(static_cast<std::uint32_t>(io_test::any_bits(random) >> random.index(32))); break;
    default: bytes.number(std::numeric_limits<std::uint64_t>::max()); break;
  }
  return bytes.bytes();
}

void spoil(std::string& bytes, Random& random) {
  const std::size_t place = place_in(bytes, random);
  switch (random.index(7)) {
    case 0: bytes.resize(place); break;
    case 1: bytes.insert(place, bytes.substr(place_in(bytes, random), 1 + random.index(40))); break;
    case 2: bytes.erase(place, 1 + random.index(20)); break;
    case 3: {
      const std::string number = odd_number(random);
      bytes.replace(place, number.size(), number);
      break;
    }
    case 4: bytes.insert(place, odd_number(random)); break;
    case 5:
      if (!bytes.empty()) bytes[place] = static_cast<char>(bytes[place] ^ (1 << random.index(8)));
      break;
    default:
      if (!bytes.empty()) bytes[place] = static_cast<char>(random.index(256));
  }
}

/// Spoils the payload of records, whose sizes and checksums are then made right, or the file as it is.
std::string spoilt(const std::string& bytes, const std::string& other, Random& random) {
  std::string result = bytes;
  const std::uint64_t spoils = 1 + random.index(3);
  if (random.index(8) == 0) {
    for (std::uint64_t i = 0; i < spoils; ++i) spoil(result, random);
    return result;
  }
  const std::vector<std::size_t> places = io_test::record_places(bytes);
  std::vector<std::string> payloads;
  std::vector<std::uint32_t> types;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    types.push_back(static_cast<std::uint8_t>(bytes[places[i]]));
    payloads.push_back(bytes.substr(places[i] + 8, places[i + 1] - places[i] - 12));
  }
  for (std::uint64_t i = 0; i < spoils; ++i) {
    const std::size_t which = random.index(payloads.size());
    const std::uint64_t kind = random.index(40);
    if (kind == 0) types[which] = static_cast<std::uint32_t>(random.index(6));
    if (kind == 1) {  // another recording's record
      const std::vector<std::size_t> theirs = io_test::record_places(other);
      const std::size_t from = random.index(theirs.size() - 1);
      types[which] = static_cast<std::uint8_t>(other[theirs[from]]);
      payloads[which] = other.substr(theirs[from] + 8, theirs[from + 1] - theirs[from] - 12);
    }
    if (kind >= 2) spoil(payloads[which], random);
  }
  result.resize(12);
  for (std::size_t i = 0; i < payloads.size(); ++i) result += io_test::record(types[i], payloads[i]);
  return result;
}

}  // namespace

TEST_CASE("whatever is in a recording, it is read or refused, and takes no more memory than promised", "[recording]") {
  constexpr std::size_t factor = 64;
  constexpr std::size_t at_least = 4096;
  Random random(1);
  std::vector<std::string> good;
  while (good.size() < 200) good.push_back(io_test::bytes_of(io_test::any_recording(random, 2)));
  int refused = 0;
  int read = 0;
  double most = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const std::string bytes = spoilt(good[random.index(good.size())], good[random.index(good.size())], random);
    const std::size_t before = test::allocated_bytes();
    try {
      const Recording recording = parse_recording(bytes, "a file with a name that is longer than what a short string holds");
      ++read;
    } catch (const InputError&) {
      ++refused;
    }
    const std::size_t allocated = test::allocated_bytes() - before;
    if (allocated > factor * bytes.size() + at_least) FAIL(allocated << " bytes for " << bytes.size() << ", spoilt " << i);
    if (allocated > at_least) most = std::max(most, static_cast<double>(allocated - at_least) / static_cast<double>(bytes.size()));
  }
  CAPTURE(refused, read, most);
  CHECK(refused > 20000);
  CHECK(read > 10000);
}

TEST_CASE("the recordings that take the most memory for their size keep the promise too", "[recording]") {
  const auto check = [](const Recording& recording) {
    const std::string bytes = io_test::bytes_of(recording);
    const std::size_t before = test::allocated_bytes();
    static_cast<void>(parse_recording(bytes, "run"));
    const double factor = static_cast<double>(test::allocated_bytes() - before) / static_cast<double>(bytes.size());
    CAPTURE(factor, bytes.size());
    CHECK(factor <= 64.0);
    return factor;
  };
  Recording plan;
  plan.setup.plan = FloorPlan(Lattice<2>(0.1), {{0, 0}, {4000, 2000}}, FloorCell::wall);
  CHECK(check(plan) > 60.0);
  Recording names;
  names.setup.metric_names.resize(10000);
  check(names);
  Recording frames;
  frames.frames.resize(10000);
  check(frames);
  Recording decisions;
  decisions.decisions.resize(10000);
  check(decisions);
  decisions.decisions.resize(8193);  // just after the list has grown
  check(decisions);
  decisions.decisions.resize(1);
  decisions.decisions[0].candidates.resize(10000);
  check(decisions);
  decisions.decisions[0].candidates.clear();
  decisions.decisions[0].frontier.assign(10000, Index<2>(0, 0));
  check(decisions);
}
