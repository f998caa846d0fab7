#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "incognita/io/input_error.hpp"

using namespace incognita;

static_assert(std::is_base_of_v<std::runtime_error, InputError>);

TEST_CASE("an InputError is one line, whatever the file and the library say") {
  CHECK(std::string(InputError("a.yaml", "is empty").what()) == "a.yaml: is empty");
  CHECK(std::string(InputError(std::filesystem::path("a\nb"), "x\r\ny\tz\x7F").what()) == "a b: x  y z ");
  const std::string long_message = InputError("a", std::string(5000, 'x')).what();
  CHECK(long_message.size() == 3 + 1000 + 3);
}

TEST_CASE("a line is cut between characters, never within one") {
  CHECK(one_line("abcdef", 4) == "abcd...");
  CHECK(one_line("abcd", 4) == "abcd");
  CHECK(one_line("ab\xC3\xB6"
                 "d",
                 3) == "ab...");
  CHECK(one_line("ab\xC3\xB6"
                 "d",
                 4) == "ab\xC3\xB6...");
  CHECK(one_line("\x80\x80\x80\x80", 2) == "...");
  CHECK(shown("x\ny") == "\"x y\"");
}
