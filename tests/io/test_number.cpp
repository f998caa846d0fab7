#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "incognita/core/random.hpp"
#include "incognita/io/number.hpp"

using namespace incognita;

TEST_CASE("parse_number takes a whole number and nothing else") {
  CHECK(parse_number("0.05").value() == 0.05);
  CHECK(parse_number("+1.5e3").value() == 1500.0);
  CHECK(parse_number("-.5").value() == -0.5);
  CHECK(parse_number("5.").value() == 5.0);
  CHECK(std::isnan(parse_number("nan").value()));
  CHECK(std::isinf(parse_number("-inf").value()));
  for (const char* text :
       {"", " 1", "1 ", "1,5", "+-1", "++1", "+", "-", "1e", "0x10", "one", "1.0.0", "1e999"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_number(text).has_value());
  }
}

TEST_CASE("format_number gives text that parse_number takes back to the same bits") {
  CHECK(format_number(0.05) == "0.05");
  CHECK(format_number(-2.0) == "-2");
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const auto value = std::bit_cast<double>(static_cast<std::uint64_t>(random.uniform() * 0x1.0p64));
    if (std::isfinite(value)) CHECK(parse_number(format_number(value)).value() == value);
  }
  CHECK(parse_number(format_number(std::numeric_limits<double>::denorm_min())).value() > 0.0);
  CHECK(parse_number(format_number(-std::numeric_limits<double>::max())).has_value());
}
