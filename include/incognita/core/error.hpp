/// Bad values are refused with one sentence: where, which field, its value, the bound it breaks.
#pragma once

#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace incognita {

/// Throws std::invalid_argument "<where>: <field> is <value>, but must be <bound>". The value is a number in the unit that the field's
/// name says, or text.
template <class Value>
[[noreturn]] void throw_invalid(std::string_view where, std::string_view field, const Value& value, std::string_view bound) {
  std::ostringstream message;
  message << where << ": " << field << " is " << value << ", but must be " << bound;
  throw std::invalid_argument(message.str());
}

/// "(1, 2)", of a point, an index or an array, for messages.
template <class Values>
[[nodiscard]] std::string tuple_text(const Values& values) {
  std::ostringstream text;
  for (std::size_t i = 0; i < static_cast<std::size_t>(values.size()); ++i) {
    text << (i == 0 ? "(" : ", ") << values[static_cast<decltype(values.size())>(i)];
  }
  return text.str() + ')';
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
