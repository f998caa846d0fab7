/// Numbers as text, the same in every locale.
#pragma once

#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace incognita {

/// The number, of any unit, that the whole of `text` spells, a sign included; nothing when it spells none or one that a
/// double cannot hold. "nan" and "inf" are numbers here: check std::isfinite where they are not welcome.
[[nodiscard]] inline std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The shortest text of a number, of any unit, that parse_number takes back to the same double.
[[nodiscard]] inline std::string format_number(double value) {
  std::array<char, 32> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

}  // namespace incognita
