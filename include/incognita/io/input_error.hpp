/// The one exception of io/: something outside of the program is wrong, a file as a rule.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace incognita {

/// `text` on one line that can be printed: control characters become spaces, and what goes beyond
/// `length_max` bytes is cut off, never within a UTF-8 character.
[[nodiscard]] inline std::string one_line(std::string_view text, std::size_t length_max) {
  std::string line(text.substr(0, length_max));
  if (text.size() > length_max) {
    while (!line.empty() && (static_cast<unsigned char>(text[line.size()]) & 0xC0U) == 0x80U) line.pop_back();
    line += "...";
  }
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F) c = ' ';
  }
  return line;
}

/// A value that a file gives, ready to be shown in a message.
[[nodiscard]] inline std::string shown(std::string_view value) { return '"' + one_line(value, 60) + '"'; }

/// A file cannot be read, is malformed, or a place cannot be written. what() is one line "FILE: what is
/// wrong" with the value and the bound that it breaks, whatever the file holds.
class InputError : public std::runtime_error {
 public:
  /// "<file>: <problem>", control characters made spaces, cut to a length that can be read.
  InputError(const std::filesystem::path& file, std::string_view problem)
      : InputError(file.string(), problem) {}

  /// For text that comes from no file; `source` says in a word where it comes from.
  InputError(const std::string& source, std::string_view problem)
      : std::runtime_error(one_line(source, 4096) + ": " + one_line(problem, 1000)) {}

  InputError(const char* source, std::string_view problem) : InputError(std::string(source), problem) {}  ///< the same
};

}  // namespace incognita
