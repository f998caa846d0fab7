/// Checks of command line arguments that CLI11 does not have.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "incognita/io/number.hpp"

namespace examples {

/// A CLI11 check: an empty text is most likely a variable that is not set.
[[nodiscard]] inline std::string refuse_empty(const std::string& text) {
  return text.empty() ? "is empty" : "";
}

/// A CLI11 check: CLI11 itself wraps -1 around and clamps what is too large.
[[nodiscard]] inline std::string refuse_bad_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole ? "" : "\"" + text + "\" is not a whole number in 0..2^64-1";
}

/// The options of programs that run many trials: how many side by side, where results go, and whether anything is printed. `trials` is
/// what trials are called.
inline void add_trial_options(CLI::App& app, const std::string& trials, int& threads, std::string& output, bool& quiet) {
  app.add_option("--threads", threads, "how many " + trials + " run side by side, up to 1024; 0: as many as OpenMP takes")
      ->type_name("N")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option("--output", output, "folder for the results")
      ->type_name("DIR")
      ->check(refuse_empty)
      ->capture_default_str();
  app.add_flag("--quiet", quiet, "print nothing but errors");
}

/// The numbers of a text that separates them by commas. `form` says what they are, as "X,Y with finite
/// numbers in metres". Throws CLI::ValidationError unless there are Count of them and all are finite.
template <std::size_t Count>
[[nodiscard]] std::array<double, Count> parse_numbers(const std::string& option, const std::string& text,
                                                      const std::string& form) {
  std::array<double, Count> numbers{};
  std::string_view unread = text;
  for (std::size_t i = 0; i < Count; ++i) {
    const bool last = i + 1 == Count;
    const std::size_t comma = last ? unread.size() : unread.find(',');
    const std::optional<double> number = incognita::parse_number(unread.substr(0, comma));
    if (comma == std::string_view::npos || !number || !std::isfinite(*number)) {
      throw CLI::ValidationError(option + ": \"" + text + "\" is not of the form " + form);
    }
    numbers[i] = *number;
    if (!last) unread.remove_prefix(comma + 1);
  }
  return numbers;
}

}  // namespace examples
