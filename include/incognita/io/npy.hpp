/// Arrays of NumPy: files .npy of version 1.0, little-endian, in C order.
#pragma once

#include <array>
#include <bit>
#include <cctype>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/io/atomic_file.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/read_file.hpp"

namespace incognita {

/// The numbers that arrays hold: float32, float64, uint8 and int32 in NumPy.
template <class Number>
concept NpyNumber = std::same_as<Number, float> || std::same_as<Number, double> ||
                    std::same_as<Number, std::uint8_t> || std::same_as<Number, std::int32_t>;

/// An array with the last index fastest: the value at (i, j) of shape (rows, columns) is
/// values[i * columns + j].
template <NpyNumber Number>
struct NpyArray {
  std::vector<std::size_t> shape;  ///< how many there are along each axis
  std::vector<Number> values;      ///< in C's order
};

/// No array file is larger than this.
inline constexpr std::size_t npy_file_size_max_bytes = std::size_t{1} << 32;

namespace detail {

template <class Number>
inline constexpr std::string_view npy_descr = "<f4";
template <>
inline constexpr std::string_view npy_descr<double> = "<f8";
template <>
inline constexpr std::string_view npy_descr<std::uint8_t> = "|u1";
template <>
inline constexpr std::string_view npy_descr<std::int32_t> = "<i4";

inline constexpr std::string_view npy_magic{"\x93NUMPY\x01\x00", 8};

/// Copies numbers between the file's little-endian bytes and this machine's.
template <class Number>
void copy_little_endian(void* to, const void* from, std::size_t count) {
  if (count == 0) return;
  if constexpr (std::endian::native == std::endian::little || sizeof(Number) == 1) {
    std::memcpy(to, from, count * sizeof(Number));
  } else {
    const auto* source = static_cast<const unsigned char*>(from);
    auto* target = static_cast<unsigned char*>(to);
    for (std::size_t i = 0; i < count * sizeof(Number); ++i) {
      target[i] = source[i - i % sizeof(Number) + (sizeof(Number) - 1 - i % sizeof(Number))];
    }
  }
}

/// How many values a shape has; nothing when a size_t cannot hold their bytes.
[[nodiscard]] inline std::optional<std::size_t> npy_count(const std::vector<std::size_t>& shape,
                                                          std::size_t value_bytes) {
  std::size_t count = 1;
  for (const std::size_t side : shape) {
    if (side == 0) return 0;
  }
  for (const std::size_t side : shape) {
    if (side > std::numeric_limits<std::size_t>::max() / value_bytes / count) return std::nullopt;
    count *= side;
  }
  return count;
}

/// Reads the Python dictionary of a header: the three keys, each once, in any order.
class NpyHeader {
 public:
  NpyHeader(std::string_view text, const std::filesystem::path& file) : unread_(text), file_(file) {
    expect('{');
    while (!take('}')) {
      const std::string key = quoted();
      expect(':');
      if (key == "descr" && !descr_) {
        descr_ = quoted();
      } else if (key == "fortran_order" && !fortran_order_) {
        fortran_order_ = boolean();
      } else if (key == "shape" && !shape_) {
        shape_ = tuple();
      } else {
        fail("the header has a key " + shown(key) + " that is not awaited");
      }
      if (!take(',')) {
        expect('}');
        break;
      }
    }
    skip_space();
    if (!unread_.empty()) fail("the header goes on after its dictionary: " + shown(unread_));
    if (!descr_ || !fortran_order_ || !shape_) {
      fail("the header lacks one of descr, fortran_order and shape");
    }
  }

  [[nodiscard]] const std::string& descr() const { return *descr_; }
  [[nodiscard]] bool fortran_order() const { return *fortran_order_; }
  [[nodiscard]] const std::vector<std::size_t>& shape() const { return *shape_; }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file_, "not a valid .npy: " + what);
  }

  void skip_space() {
    while (!unread_.empty() && std::isspace(static_cast<unsigned char>(unread_[0])) != 0) {
      unread_.remove_prefix(1);
    }
  }

  [[nodiscard]] bool take(char awaited) {
    skip_space();
    if (unread_.empty() || unread_[0] != awaited) return false;
    unread_.remove_prefix(1);
    return true;
  }

  void expect(char awaited) {
    if (!take(awaited)) {
      fail(std::string("the header has ") + shown(unread_) + " where a " + awaited + " is awaited");
    }
  }

  [[nodiscard]] std::string quoted() {
    skip_space();
    const char quote = unread_.empty() ? '\0' : unread_[0];
    const std::size_t end =
        quote == '\'' || quote == '"' ? unread_.find(quote, 1) : std::string_view::npos;
    if (end == std::string_view::npos) {
      fail("the header has " + shown(unread_) + " where a text in quotes is awaited");
    }
    std::string text(unread_.substr(1, end - 1));
    unread_.remove_prefix(end + 1);
    return text;
  }

  [[nodiscard]] bool boolean() {
    skip_space();
    for (const std::string_view word : {"True", "False"}) {
      if (!unread_.starts_with(word)) continue;
      unread_.remove_prefix(word.size());
      return word == "True";
    }
    fail("fortran_order is neither True nor False: " + shown(unread_));
  }

  [[nodiscard]] std::vector<std::size_t> tuple() {
    expect('(');
    std::vector<std::size_t> sides;
    bool ends_in_comma = true;
    while (!take(')')) {
      if (!ends_in_comma) fail("the shape has no comma between two sides: " + shown(unread_));
      sides.push_back(side());
      if (sides.size() > 32) fail("the shape has more than 32 sides");
      ends_in_comma = take(',');
    }
    if (sides.size() == 1 && !ends_in_comma) fail("the shape is no tuple: one side without a comma");
    return sides;
  }

  [[nodiscard]] std::size_t side() {
    skip_space();
    std::size_t value = 0;
    std::size_t digits = 0;
    for (; digits < unread_.size() && unread_[digits] >= '0' && unread_[digits] <= '9'; ++digits) {
      if (digits == 18) fail("a side of the shape has more than 18 digits");
      value = value * 10 + static_cast<std::size_t>(unread_[digits] - '0');
    }
    if (digits == 0) fail("a side of the shape is not a whole number: " + shown(unread_));
    unread_.remove_prefix(digits);
    return value;
  }

  std::string_view unread_;
  const std::filesystem::path& file_;
  std::optional<std::string> descr_;
  std::optional<bool> fortran_order_;
  std::optional<std::vector<std::size_t>> shape_;
};

}  // namespace detail

/// The bytes of a .npy file. Throws std::invalid_argument unless the shape, of 32 sides at most, has as many
/// values as are given.
template <NpyNumber Number>
[[nodiscard]] std::string encode_npy(const NpyArray<Number>& array) {
  if (array.shape.size() > 32) throw std::invalid_argument("encode_npy: the shape has more than 32 sides");
  const std::optional<std::size_t> count = detail::npy_count(array.shape, sizeof(Number));
  if (count != array.values.size()) {
    throw std::invalid_argument("encode_npy: " + std::to_string(array.values.size()) +
                                " values are not what the shape asks for");
  }
  std::string shape = "(";
  for (std::size_t i = 0; i < array.shape.size(); ++i) {
    if (i > 0) shape += ' ';
    shape += std::to_string(array.shape[i]);
    if (i + 1 < array.shape.size() || i == 0) shape += ',';
  }
  shape += ')';
  std::string header = "{'descr': '" + std::string(detail::npy_descr<Number>) +
                       "', 'fortran_order': False, 'shape': " + shape + ", }";
  // The data begins at a multiple of 64 bytes: the magic, two bytes of length, the header and a line end.
  const std::size_t unpadded = detail::npy_magic.size() + 2 + header.size() + 1;
  header.append((64 - unpadded % 64) % 64, ' ');
  header += '\n';

  std::string content(detail::npy_magic);
  content += static_cast<char>(header.size() & 0xFFU);
  content += static_cast<char>(header.size() >> 8U);
  content += header;
  const std::size_t data = content.size();
  content.resize(data + array.values.size() * sizeof(Number));
  detail::copy_little_endian<Number>(content.data() + data, array.values.data(), array.values.size());
  return content;
}

/// The array that `content`, a whole .npy file, holds. `file` is only named in errors. Throws InputError,
/// before memory is asked for, unless it is of version 1.0, in C order, of exactly this type of number
/// (little-endian) and as large as its shape says.
template <NpyNumber Number>
[[nodiscard]] NpyArray<Number> decode_npy(std::string_view content, const std::filesystem::path& file) {
  const auto fail = [&file](const std::string& what) {
    throw InputError(file, "not a valid .npy: " + what);
  };
  const std::size_t prefix_bytes = detail::npy_magic.size() + 2;
  if (!content.starts_with(detail::npy_magic.substr(0, 6))) fail("it must start with \\x93NUMPY");
  if (content.size() < prefix_bytes) fail("it ends before its header");
  const auto byte = [content](std::size_t i) { return std::size_t{static_cast<unsigned char>(content[i])}; };
  if (byte(6) != 1 || byte(7) != 0) {
    fail("it is of version " + std::to_string(byte(6)) + '.' + std::to_string(byte(7)) + ", but must be of 1.0");
  }
  const std::size_t header_bytes = byte(8) + 256 * byte(9);
  if (content.size() - prefix_bytes < header_bytes) {
    fail("its header has " + std::to_string(header_bytes) + " bytes, but " +
         std::to_string(content.size() - prefix_bytes) + " follow");
  }
  const detail::NpyHeader header(content.substr(prefix_bytes, header_bytes), file);
  if (header.fortran_order()) fail("it is in Fortran order, but must be in C order");
  if (header.descr() != detail::npy_descr<Number>) {
    fail("its numbers are " + shown(header.descr()) + ", but must be " + shown(detail::npy_descr<Number>));
  }
  const std::string_view data = content.substr(prefix_bytes + header_bytes);
  const std::optional<std::size_t> count = detail::npy_count(header.shape(), sizeof(Number));
  if (!count || data.size() != *count * sizeof(Number)) {
    fail("its shape asks for " + (count ? std::to_string(*count * sizeof(Number)) : "far too many") +
         " bytes of data, but " + std::to_string(data.size()) + " follow the header");
  }
  NpyArray<Number> array{header.shape(), std::vector<Number>(*count)};
  detail::copy_little_endian<Number>(array.values.data(), data.data(), *count);
  return array;
}

/// Reads a .npy file of at most 4 GiB; see decode_npy. Throws InputError.
template <NpyNumber Number>
[[nodiscard]] NpyArray<Number> read_npy(const std::filesystem::path& file) {
  return decode_npy<Number>(read_file(file, npy_file_size_max_bytes), file);
}

/// Writes a .npy file, which replaces one that is there only when complete. Throws InputError, and
/// std::invalid_argument as encode_npy does.
template <NpyNumber Number>
void write_npy(const std::filesystem::path& file, const NpyArray<Number>& array) {
  write_file_atomically(file, encode_npy(array));
}

}  // namespace incognita
