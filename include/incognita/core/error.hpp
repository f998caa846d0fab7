/// Bad values are refused with one sentence: where, which field, its value, the bound it breaks.
#pragma once

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace incognita {

/// Throws std::invalid_argument "<where>: <field> is <value>, but must be <bound>".
[[noreturn]] inline void throw_invalid(std::string_view where, std::string_view field, std::string_view value, std::string_view bound) {
  std::string message(where);
  for (const std::string_view part : {std::string_view(": "), field, std::string_view(" is "), value, std::string_view(", but must be "), bound}) {
    message += part;
  }
  throw std::invalid_argument(message);
}

/// Throws likewise. The value is in the unit that the field's name says.
[[noreturn]] inline void throw_invalid(std::string_view where, std::string_view field, double value, std::string_view bound) {
  std::ostringstream text;
  text << value;
  throw_invalid(where, field, text.str(), bound);
}

namespace detail {

/// Not a template, so that programs that name many types in messages do not pay for each.
[[nodiscard]] inline std::string element_text(bool is_first, double value) {
  std::ostringstream text;
  text << (is_first ? "(" : ", ") << value;
  return text.str();
}

}  // namespace detail

/// "(1, 2)", of a point, an index or an array, for messages.
template <class Values>
[[nodiscard]] std::string tuple_text(const Values& values) {
  std::string text;
  for (decltype(values.size()) i = 0; i < values.size(); ++i) text += detail::element_text(i == 0, static_cast<double>(values[i]));
  return text + ')';
}

/// Throws as throw_invalid does unless `holds`; the value may be of any unit. NaN fails every comparison, so write the condition that
/// must hold.
inline void require(bool holds, std::string_view where, std::string_view field, double value,
                    std::string_view bound) {
  if (!holds) throw_invalid(where, field, value, bound);
}

/// Throws as throw_invalid does unless a value, of any unit, is finite and > 0.
inline void require_positive(std::string_view where, std::string_view field, double value) {
  require(std::isfinite(value) && value > 0.0, where, field, value, "finite and > 0");
}

/// Throws as throw_invalid does unless a value, of any unit, is finite and >= 0.
inline void require_non_negative(std::string_view where, std::string_view field, double value) {
  require(std::isfinite(value) && value >= 0.0, where, field, value, "finite and >= 0");
}

}  // namespace incognita
