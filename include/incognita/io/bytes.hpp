/// Numbers as bytes, little-endian whatever the machine, for the binary files of io/.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "incognita/io/input_error.hpp"

namespace incognita {

/// A number of which every pattern of bits is a value, 8 bytes or fewer.
template <class T>
concept ByteNumber = (std::integral<T> || std::floating_point<T>) && !std::same_as<std::remove_cv_t<T>, bool> && sizeof(T) <= 8;

namespace detail {

template <std::size_t Size>
using UnsignedOf = std::conditional_t<
    Size == 1, std::uint8_t, std::conditional_t<Size == 2, std::uint16_t, std::conditional_t<Size == 4, std::uint32_t, std::uint64_t>>>;

template <ByteNumber Number>
[[nodiscard]] std::array<char, sizeof(Number)> to_little_endian(Number value) {
  const std::uint64_t bits = std::bit_cast<UnsignedOf<sizeof(Number)>>(value);
  std::array<char, sizeof(Number)> bytes;
  for (std::size_t byte = 0; byte < sizeof(Number); ++byte) bytes[byte] = static_cast<char>(static_cast<std::uint8_t>(bits >> (8 * byte)));
  return bytes;
}

/// `bytes` has sizeof(Number).
template <ByteNumber Number>
[[nodiscard]] Number from_little_endian(std::string_view bytes) {
  std::uint64_t bits = 0;
  for (std::size_t byte = 0; byte < sizeof(Number); ++byte) bits |= std::uint64_t{static_cast<std::uint8_t>(bytes[byte])} << (8 * byte);
  return std::bit_cast<Number>(static_cast<UnsignedOf<sizeof(Number)>>(bits));
}

}  // namespace detail

/// Appends numbers to a string of bytes.
class ByteWriter {
 public:
  /// As wide as its type.
  template <ByteNumber Number>
  void number(Number value) {
    const auto raw = detail::to_little_endian(value);
    bytes_.append(raw.data(), raw.size());
  }

  /// One after the other.
  template <ByteNumber Number>
  void numbers(const std::vector<Number>& values) {
    if constexpr (std::endian::native == std::endian::little) {
      bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number));
    } else {
      for (const Number value : values) number(value);
    }
  }

  /// Writes over a number that was written before, `place` bytes from the beginning.
  template <ByteNumber Number>
  void number_at(std::size_t place, Number value) {
    const auto raw = detail::to_little_endian(value);
    bytes_.replace(place, raw.size(), raw.data(), raw.size());
  }

  /// Seven bits a byte, the lowest first; the eighth says that more follow. At most 10 bytes.
  void varint(std::uint64_t value) {
    for (; value >= 0x80U; value >>= 7U) number(static_cast<std::uint8_t>(value | 0x80U));
    number(static_cast<std::uint8_t>(value));
  }

  /// A varint of 0, -1, 1, -2, ... numbered from 0.
  void signed_varint(std::int64_t value) { varint((static_cast<std::uint64_t>(value) << 1U) ^ static_cast<std::uint64_t>(value >> 63)); }

  /// Its length as a varint, then its bytes.
  void text(std::string_view text) {
    varint(text.size());
    bytes_ += text;
  }

  /// All that was written.
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

  /// Keeps its storage.
  void clear() { bytes_.clear(); }

 private:
  std::string bytes_;
};

/// Takes what ByteWriter wrote. Each call throws InputError, which names the file and the byte, where there are not enough bytes or they are not
/// such a number. It allocates nothing but the texts asked for, which are never longer than the bytes there are.
class ByteReader {
 public:
  /// The bytes must outlive it, and so must `file`, which with `first_byte`, their place in it, is only named in errors.
  ByteReader(std::string_view bytes, std::string_view file, std::size_t first_byte = 0) : bytes_(bytes), file_(file), first_byte_(first_byte) {}

  /// How many bytes were not taken yet.
  [[nodiscard]] std::size_t left() const { return bytes_.size() - place_; }

  /// Where in the file the next byte is.
  [[nodiscard]] std::size_t place() const { return first_byte_ + place_; }

  /// The next `size` bytes.
  [[nodiscard]] std::string_view raw(std::size_t size) {
    if (left() < size) fail("only " + std::to_string(left()) + " bytes where there must be " + std::to_string(size));
    const std::string_view taken = bytes_.substr(place_, size);
    place_ += size;
    return taken;
  }

  /// A reader of the next `size` bytes alone.
  [[nodiscard]] ByteReader part(std::size_t size) {
    const std::size_t first = place();
    return {raw(size), file_, first};
  }

  /// A number as wide as its type.
  template <ByteNumber Number>
  [[nodiscard]] Number number() {
    return detail::from_little_endian<Number>(raw(sizeof(Number)));
  }

  /// So many of them, one after the other.
  template <ByteNumber Number>
  [[nodiscard]] std::vector<Number> numbers(std::size_t how_many) {
    ByteReader from = part(how_many * sizeof(Number));
    std::vector<Number> values(how_many);
    for (Number& value : values) value = from.number<Number>();
    return values;
  }

  /// `what` is named in the error.
  template <std::floating_point Number>
  [[nodiscard]] Number finite(const char* what) {
    const auto value = number<Number>();
    if (!std::isfinite(value)) fail(std::string(what) + " that is not finite");
    return value;
  }

  /// Of at most 64 bits. It may be longer than it need be.
  [[nodiscard]] std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = number<std::uint8_t>();
      if (shift == 63 && byte > 1) break;
      value |= std::uint64_t{byte & 0x7FU} << shift;
      if ((byte & 0x80U) == 0) return value;
    }
    fail("a number of more than 64 bits");
  }

  /// See ByteWriter::signed_varint.
  [[nodiscard]] std::int64_t signed_varint() {
    const std::uint64_t value = varint();
    return static_cast<std::int64_t>(value >> 1U) ^ -static_cast<std::int64_t>(value & 1U);
  }

  /// A signed_varint from -limit to limit.
  [[nodiscard]] int small_varint(int limit = std::numeric_limits<int>::max()) {
    const std::int64_t value = signed_varint();
    if (value < -std::int64_t{limit} || value > limit) {
      fail("a number of " + std::to_string(value) + ", which must be from -" + std::to_string(limit) + " to " + std::to_string(limit));
    }
    return static_cast<int>(value);
  }

  /// A varint that is the number of things to come, each of at least bytes_min bytes: no more than there are bytes for.
  [[nodiscard]] std::size_t count(std::size_t bytes_min) {
    const std::uint64_t value = varint();
    if (value > left() / bytes_min) {
      fail("a count of " + std::to_string(value) + ", each of " + std::to_string(bytes_min) + " bytes or more, though only " +
           std::to_string(left()) + " bytes follow");
    }
    return static_cast<std::size_t>(value);
  }

  /// A copy of a text, whatever its bytes are.
  [[nodiscard]] std::string text() { return std::string(raw(count(1))); }

  /// A byte of 0 or 1.
  [[nodiscard]] bool flag() {
    const auto value = number<std::uint8_t>();
    if (value > 1) fail("a flag of " + std::to_string(value) + ", which must be 0 or 1");
    return value == 1;
  }

  /// Throws InputError unless all bytes were taken.
  void require_end() const {
    if (left() != 0) fail(std::to_string(left()) + " bytes too many");
  }

  /// Throws InputError "<file>: is damaged at byte <place>: <problem>".
  [[noreturn]] void fail(std::string_view problem) const {
    throw InputError(std::string(file_), "is damaged at byte " + std::to_string(place()) + ": " + std::string(problem));
  }

 private:
  std::string_view bytes_;
  std::string_view file_;
  std::size_t first_byte_;
  std::size_t place_ = 0;
};

}  // namespace incognita
