#include <bit>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/io/bytes.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

// Not every byte is a bool, and a long double has bytes that are no part of it.
static_assert(ByteNumber<char> && ByteNumber<std::int8_t> && ByteNumber<std::uint64_t> && ByteNumber<float> && ByteNumber<double>);
static_assert(!ByteNumber<bool> && !ByteNumber<const bool> && !ByteNumber<long double> && !ByteNumber<std::string>);

namespace {

template <class Write>
std::vector<int> written(Write&& write) {
  ByteWriter bytes;
  write(bytes);
  std::vector<int> values;
  for (const char byte : bytes.bytes()) values.push_back(static_cast<std::uint8_t>(byte));
  return values;
}

template <class Number>
void check_round_trip(Random& random) {
  for (int i = 0; i < 200; ++i) {
    const auto value = std::bit_cast<Number>(static_cast<detail::UnsignedOf<sizeof(Number)>>(io_test::any_bits(random)));
    ByteWriter bytes;
    bytes.number(value);
    REQUIRE(bytes.bytes().size() == sizeof(Number));
    ByteReader reader(bytes.bytes(), "file");
    const auto again = reader.number<Number>();
    REQUIRE(std::memcmp(&value, &again, sizeof(Number)) == 0);
    REQUIRE(reader.left() == 0);
  }
}

/// What `take` says of these bytes.
template <class Take>
std::string bytes_refusal(std::string_view bytes, Take&& take) {
  return refusal([&] {
    ByteReader reader(bytes, "file", 100);
    static_cast<void>(take(reader));
    return 0;
  });
}

}  // namespace

TEST_CASE("numbers are little-endian") {
  using Bytes = std::vector<int>;
  CHECK(written([](ByteWriter& b) { b.number(std::uint32_t{0x01020304}); }) == Bytes{4, 3, 2, 1});
  CHECK(written([](ByteWriter& b) { b.number(std::int16_t{-2}); }) == Bytes{0xFE, 0xFF});
  CHECK(written([](ByteWriter& b) { b.number(std::uint64_t{0x0102030405060708}); }) == Bytes{8, 7, 6, 5, 4, 3, 2, 1});
  CHECK(written([](ByteWriter& b) { b.number('A'); }) == Bytes{65});
  CHECK(written([](ByteWriter& b) { b.number(1.0F); }) == Bytes{0, 0, 0x80, 0x3F});
  CHECK(written([](ByteWriter& b) { b.number(-0.5); }) == Bytes{0, 0, 0, 0, 0, 0, 0xE0, 0xBF});
  CHECK(written([](ByteWriter& b) { b.text("ab"); }) == Bytes{2, 'a', 'b'});
}

TEST_CASE("numbers of any bits come back") {
  Random random(1);
  check_round_trip<std::int8_t>(random);
  check_round_trip<std::uint8_t>(random);
  check_round_trip<std::uint16_t>(random);
  check_round_trip<std::int32_t>(random);
  check_round_trip<std::uint64_t>(random);
  check_round_trip<float>(random);  // NaN of any kind too
  check_round_trip<double>(random);
}

TEST_CASE("many numbers are one after the other") {
  ByteWriter bytes;
  bytes.numbers(std::vector<std::uint16_t>{0x0102, 0x0304, 0xFFFE});
  bytes.numbers(std::vector<double>{});
  CHECK(bytes.bytes() == "\x02\x01\x04\x03\xFE\xFF");
  ByteReader reader(bytes.bytes(), "file");
  CHECK(reader.numbers<std::uint16_t>(2) == std::vector<std::uint16_t>{0x0102, 0x0304});
  CHECK(reader.numbers<double>(0).empty());
  CHECK_THAT(refusal([&] { return reader.numbers<std::int8_t>(3); }), Contains("at byte 4: only 2 bytes where there must be 3"));
  CHECK(reader.left() == 2);
}

TEST_CASE("a number is written over one that is there") {
  ByteWriter bytes;
  bytes.text("abc");
  bytes.number(std::uint16_t{0});
  bytes.text("d");
  bytes.number_at(4, std::uint16_t{0x4142});
  CHECK(bytes.bytes() == "\003abcBA\001d");
  bytes.clear();
  CHECK(bytes.bytes().empty());
}

TEST_CASE("varints are as short as their numbers") {
  using Bytes = std::vector<int>;
  const auto varint = [](std::uint64_t value) { return written([&](ByteWriter& b) { b.varint(value); }); };
  const auto signed_varint = [](std::int64_t value) { return written([&](ByteWriter& b) { b.signed_varint(value); }); };
  CHECK(varint(0) == Bytes{0});
  CHECK(varint(127) == Bytes{127});
  CHECK(varint(128) == Bytes{0x80, 1});
  CHECK(varint(300) == Bytes{0xAC, 2});
  CHECK(varint(~std::uint64_t{0}) == Bytes{255, 255, 255, 255, 255, 255, 255, 255, 255, 1});
  CHECK(signed_varint(0) == Bytes{0});
  CHECK(signed_varint(-1) == Bytes{1});
  CHECK(signed_varint(1) == Bytes{2});
  CHECK(signed_varint(-64) == Bytes{127});
  CHECK(signed_varint(std::numeric_limits<std::int64_t>::min()) == varint(~std::uint64_t{0}));

  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const std::uint64_t value = io_test::any_bits(random) >> random.index(64);
    ByteWriter bytes;
    bytes.varint(value);
    bytes.signed_varint(static_cast<std::int64_t>(value));
    bytes.signed_varint(-static_cast<std::int64_t>(value >> 1U));
    ByteReader reader(bytes.bytes(), "file");
    REQUIRE(reader.varint() == value);
    REQUIRE(reader.signed_varint() == static_cast<std::int64_t>(value));
    REQUIRE(reader.signed_varint() == -static_cast<std::int64_t>(value >> 1U));
  }
}

TEST_CASE("what is no such number is refused by file, byte and value") {
  using std::string;
  CHECK(bytes_refusal("abc", [](ByteReader& r) { return r.number<std::uint32_t>(); }) ==
        "file: is damaged at byte 100: only 3 bytes where there must be 4");
  CHECK_THAT(bytes_refusal("ab", [](ByteReader& r) { return r.raw(1).size() + r.number<std::uint64_t>(); }), Contains("at byte 101: only 1 bytes"));
  CHECK_THAT(bytes_refusal("\x80\x80", [](ByteReader& r) { return r.varint(); }), Contains("at byte 102: only 0 bytes"));
  CHECK_THAT(bytes_refusal(string(9, '\xFF') + "\002", [](ByteReader& r) { return r.varint(); }), Contains("more than 64 bits"));
  CHECK_THAT(bytes_refusal(string(12, '\x80'), [](ByteReader& r) { return r.varint(); }), Contains("more than 64 bits"));
  CHECK_THAT(bytes_refusal("\x0B", [](ByteReader& r) { return r.small_varint(5); }), Contains("a number of -6, which must be from -5 to 5"));
  CHECK_THAT(bytes_refusal("\x0C", [](ByteReader& r) { return r.small_varint(5); }), Contains("a number of 6"));
  CHECK_THAT(bytes_refusal("\x80\x80\x80\x80\x10", [](ByteReader& r) { return r.small_varint(); }), Contains("a number of 2147483648"));
  CHECK_THAT(bytes_refusal("\003abcdefgh", [](ByteReader& r) { return r.count(3); }), Contains("a count of 3, each of 3 bytes or more, though only 8 bytes"));
  CHECK_THAT(bytes_refusal("\003ab", [](ByteReader& r) { return r.text(); }), Contains("a count of 3") && Contains("only 2 bytes"));
  CHECK_THAT(bytes_refusal("\002", [](ByteReader& r) { return r.flag(); }), Contains("a flag of 2, which must be 0 or 1"));
  CHECK_THAT(bytes_refusal(string(8, '\xFF'), [](ByteReader& r) { return r.finite<double>("a height"); }), Contains("a height that is not finite"));
  CHECK_THAT(bytes_refusal("ab", [](ByteReader& r) { return r.require_end(), 0; }), Contains("2 bytes too many"));
  CHECK_THAT(bytes_refusal("abc", [](ByteReader& r) { return r.part(4); }), Contains("only 3 bytes where there must be 4"));
}

TEST_CASE("limits themselves are taken") {
  ByteReader reader("\x09\x0A\003abcdefghi\001\001", "file");
  CHECK(reader.small_varint(5) == -5);
  CHECK(reader.small_varint(5) == 5);
  CHECK(reader.count(3) == 3);
  CHECK(reader.raw(9) == "abcdefghi");
  CHECK(reader.flag());
  ByteReader part = reader.part(1);
  CHECK(part.place() == 13);
  CHECK(part.flag());
  part.require_end();
  reader.require_end();
}
