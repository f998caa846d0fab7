#include <catch2/catch.hpp>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incognita/io/text_lines.hpp"

using namespace incognita;

namespace {

std::vector<std::pair<std::size_t, std::string>> lines_of(std::string_view text) {
  std::vector<std::pair<std::size_t, std::string>> lines;
  detail::for_each_line(text,
                        [&](std::size_t number, std::string_view line) { lines.emplace_back(number, line); });
  return lines;
}

}  // namespace

TEST_CASE("text lines: words between white space") {
  std::string_view line = " \tone two\r";
  CHECK(detail::take_word(line) == "one");
  CHECK(detail::take_word(line) == "two");
  CHECK(detail::take_word(line).empty());
  CHECK(detail::take_word(line).empty());
}

TEST_CASE("text lines: empty lines and comments are counted, not visited") {
  using Lines = std::vector<std::pair<std::size_t, std::string>>;
  CHECK(lines_of("").empty());
  CHECK(lines_of("\n \r\n\t# x\n").empty());
  CHECK(lines_of("a\n\n  b #\n#c\nd") == Lines{{1, "a"}, {3, "b #"}, {5, "d"}});
}
