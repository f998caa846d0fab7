/// Text files whose lines hold words between white space.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace incognita::detail {

/// Takes the next word off `line`; empty at its end.
[[nodiscard]] inline std::string_view take_word(std::string_view& line) {
  constexpr std::string_view space = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(space), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(space));
  line.remove_prefix(word.size());
  return word;
}

/// Calls visit(line_number, line), from 1, for each line that is neither empty nor a comment that starts with
/// #.
template <class Visit>
void for_each_line(std::string_view text, Visit&& visit) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::size_t start = line.find_first_not_of(" \t\r");
    if (start != std::string_view::npos && line[start] != '#') visit(number, line.substr(start));
  }
}

}  // namespace incognita::detail
