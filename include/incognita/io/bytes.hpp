/// Numbers as bytes, little-endian whatever the machine, for the binary files of io/.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

#include "incognita/io/input_error.hpp"

namespace incognita {

namespace detail {

template <std::size_t Size>
using UnsignedOf = std::conditional_t<
    Size == 1, std::uint8_t, std::conditional_t<Size == 2, std::uint16_t, std::conditional_t<Size == 4, std::uint32_t, std::uint64_t>>>;

}  // namespace detail

/// Appends numbers to a string of bytes.
class ByteWriter {
 public:
  /// A whole number or a floating point number, as wide as its type.
  template <class Number>
    requires std::integral<Number> || std::floating_point<Number>
  void number(Number value) {
    auto bits = std::bit_cast<detail::UnsignedOf<sizeof(Number)>>(value);
    for (std::size_t byte = 0; byte < sizeof(Number); ++byte) {
      bytes_ += static_cast<char>(static_cast<std::uint8_t>(bits));
      if constexpr (sizeof(Number) > 1) bits = static_cast<decltype(bits)>(bits >> 8U);
    }
  }

  /// Seven bits a byte, the lowest first; the eighth says that more follow. At most 10 bytes.
  void varint(std::uint64_t value) {
    for (; value >= 0x80U; value >>= 7U) bytes_ += static_cast<char>(static_cast<std::uint8_t>(value | 0x80U));
    bytes_ += static_cast<char>(static_cast<std::uint8_t>(value));
  }

  /// A varint of 0, -1, 1, -2, ... numbered from 0.
  void signed_varint(std::int64_t value) { varint((static_cast<std::uint64_t>(value) << 1U) ^ static_cast<std::uint64_t>(value >> 63)); }

  /// Its length as a varint, then its bytes.
  void text(std::string_view text) {
    varint(text.size());
    bytes_ += text;
  }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

  void clear() { bytes_.clear(); }

 private:
  std::string bytes_;
};

/// Takes what ByteWriter wrote from a view of bytes, which must outlive it. Each call throws InputError, which names the file and the
/// byte, where there are not enough bytes or they are not such a number. It allocates nothing but the texts asked for, which are never longer
/// than the bytes there are.
class ByteReader {
 public:
  /// `file` and `first_byte`, the place of the bytes in it, are only named in errors.
  ByteReader(std::string_view bytes, std::string file, std::size_t first_byte = 0)
      : bytes_(bytes), file_(std::move(file)), first_byte_(first_byte) {}

  [[nodiscard]] std::size_t left() const { return bytes_.size() - place_; }

  /// Where in the file the next byte is.
  [[nodiscard]] std::size_t place() const { return first_byte_ + place_; }

  template <class Number>
    requires std::integral<Number> || std::floating_point<Number>
  [[nodiscard]] Number number() {
    using Bits = detail::UnsignedOf<sizeof(Number)>;
    const std::string_view raw = take(sizeof(Number), "a number");
    Bits bits = 0;
    for (std::size_t byte = sizeof(Number); byte-- > 0;) {
      if constexpr (sizeof(Number) > 1) bits = static_cast<Bits>(bits << 8U);
      bits = static_cast<Bits>(bits | static_cast<std::uint8_t>(raw[byte]));
    }
    return std::bit_cast<Number>(bits);
  }

  [[nodiscard]] std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = number<std::uint8_t>();
      if (shift == 63 && byte > 1) break;
      value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
      if ((byte & 0x80U) == 0) return value;
    }
    fail("a number of more than 64 bits");
  }

  [[nodiscard]] std::int64_t signed_varint() {
    const std::uint64_t value = varint();
    return static_cast<std::int64_t>(value >> 1U) ^ -static_cast<std::int64_t>(value & 1U);
  }

  /// A signed_varint that an int holds.
  [[nodiscard]] int small_varint() {
    const std::int64_t value = signed_varint();
    if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max()) fail("a number of more than 32 bits");
    return static_cast<int>(value);
  }

  /// A varint that is the number of things to come, each of at least bytes_min bytes: no more than there are bytes for.
  [[nodiscard]] std::size_t count(std::size_t bytes_min) {
    const std::uint64_t value = varint();
    if (value > left() / bytes_min) fail("a count of " + std::to_string(value) + ", but only " + std::to_string(left()) + " bytes follow");
    return static_cast<std::size_t>(value);
  }

  [[nodiscard]] std::string text() { return std::string(take(count(1), "a text")); }

  [[nodiscard]] bool flag() {
    const auto value = number<std::uint8_t>();
    if (value > 1) fail("a flag of " + std::to_string(value) + ", which must be 0 or 1");
    return value == 1;
  }

  /// Throws InputError unless all bytes were taken.
  void require_end() {
    if (left() != 0) fail(std::to_string(left()) + " bytes too many");
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(file_, "is damaged: at byte " + std::to_string(place()) + " there is " + problem);
  }

 private:
  [[nodiscard]] std::string_view take(std::size_t size, const char* what) {
    if (left() < size) fail(std::string("no room for ") + what);
    const std::string_view taken = bytes_.substr(place_, size);
    place_ += size;
    return taken;
  }

  std::string_view bytes_;
  std::string file_;
  std::size_t first_byte_;
  std::size_t place_ = 0;
};

}  // namespace incognita
