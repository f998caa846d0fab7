/// States as bytes, and back to the bit: what the archive_state of the library's values writes to and reads from.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "incognita/io/input_error.hpp"

namespace incognita {

namespace detail {

/// A column or matrix of a fixed size.
template <class T>
concept FixedMatrix = std::derived_from<T, Eigen::MatrixBase<T>> && T::SizeAtCompileTime > 0;

template <class T>
concept NumberValue = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <class T, class Archive>
concept HasState = requires(T& value, Archive& archive) { value.archive_state(archive); };

template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
inline constexpr bool is_unknown = false;

/// Whether values lie in memory as they do in a file, one after the other.
template <class T>
inline constexpr bool is_plain = std::is_arithmetic_v<T> && !std::same_as<T, bool> && std::endian::native == std::endian::little;

/// The shortest text of a number, the same in every locale.
template <NumberValue T>
[[nodiscard]] std::string number_text(T value) {
  if constexpr (std::same_as<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_enum_v<T>) {
    return number_text(static_cast<int>(value));
  } else {
    std::array<char, 32> buffer;
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
  }
}

}  // namespace detail

/// Parameters as lines "name = value", one a number, nested names joined by points: what list_fields of parameters is called with.
class ParameterLines {
 public:
  /// Takes the fields of a policy's parameters (its params()), of parameters, or of whatever else has list_fields; of a value with neither
  /// there is nothing to say.
  template <class T>
  ParameterLines(std::string name, const T& of) : prefix_(std::move(name)) {
    if constexpr (requires(ParameterLines& lines) { of.list_fields(lines); }) {
      of.list_fields(*this);
    } else if constexpr (requires { of.params(); }) {
      static_assert(requires(ParameterLines& lines) { of.params().list_fields(lines); },
                    "say what the parameters of this policy are: give them a list_fields");
      of.params().list_fields(*this);
    }
  }

  /// `names` are those of the values, separated by ", ".
  template <class... Values>
  void operator()(std::string_view names, const Values&... values) {
    (add(next_name(names), values), ...);
  }

  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }  ///< in the order in which they are listed

 private:
  /// The numbers of a value that is no parameter, such as a pose.
  struct Numbers {
    static constexpr bool is_loading = false;
    std::string text;

    template <class... Values>
    void operator()(const Values&... values) {
      ((text.append(text.empty() ? "" : " ") += text_of(values)), ...);
    }
  };

  [[nodiscard]] static std::string_view next_name(std::string_view& names) {
    const std::size_t length = std::min(names.find(", "), names.size());
    const std::string_view name = names.substr(0, length);
    names.remove_prefix(std::min(length + 2, names.size()));
    return name;
  }

  template <class T>
  void add(std::string_view name, const T& value) {
    const std::string full = prefix_ + '.' + std::string(name);
    if constexpr (detail::is_optional<T>) {
      value ? add(name, *value) : lines_.push_back(full + " = none");
    } else if constexpr (requires(ParameterLines& lines) { value.list_fields(lines); }) {
      const ParameterLines nested(full, value);
      lines_.insert(lines_.end(), nested.lines_.begin(), nested.lines_.end());
    } else {
      lines_.push_back(full + " = " + text_of(value));
    }
  }

  template <class T>
  [[nodiscard]] static std::string text_of(const T& value) {
    if constexpr (detail::NumberValue<T>) {
      return detail::number_text(value);
    } else if constexpr (std::same_as<T, std::string>) {
      return one_line(value, 1000);
    } else if constexpr (detail::FixedMatrix<T>) {
      Numbers numbers;
      for (Eigen::Index i = 0; i < value.size(); ++i) numbers(value(i));
      return numbers.text;
    } else if constexpr (detail::is_vector<T>) {
      std::string text = "[";
      for (const auto& element : value) text.append(text.size() > 1 ? "; " : "") += text_of(element);
      return text + ']';
    } else {
      Numbers numbers;
      const_cast<T&>(value).archive_state(numbers);  // which reads it
      return numbers.text;
    }
  }

  std::string prefix_;
  std::vector<std::string> lines_;
};

/// Writes states: numbers as they are in memory, little-endian; vectors after their length, in 8 bytes; optional values after a byte
/// that says whether they are there. A value of another kind must have
///   `template <class Archive> void archive_state(Archive& archive);`
/// which names its members to the archive, in an order that stays, and serves for reading too. What archives offer it:
///   archive(a, b, c)                  each of them, one after the other
///   archive.each(vector)              the elements of a vector whose length is known to both sides
///   archive.check(name, parameters)   writes nothing; a reader refuses other parameters, see ParameterLines
///   Archive::is_loading, archive.require(holds, what), archive.claim(count, bytes)   for readers, see StateReader
class StateWriter {
 public:
  static constexpr bool is_loading = false;  ///< values are written

  /// Writes each of them, one after the other.
  template <class... Values>
  void operator()(const Values&... values) {
    (write(values), ...);
  }

  /// Writes the elements without their number.
  template <class T>
  void each(const std::vector<T>& values) {
    if constexpr (detail::is_plain<T>) {
      bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    } else {
      for (const T& value : values) write(value);
    }
  }

  /// Notes the parameters of a value.
  template <class T>
  void check(const char* name, const T& of) {
    const ParameterLines named(name, of);
    for (const std::string& line : named.lines()) parameters_ += line + '\n';
  }

  static void require(bool /*holds*/, const char* /*what*/) {}  ///< never throws: what is there holds

  [[nodiscard]] const std::string& bytes() const { return bytes_; }  ///< written so far
  /// The lines of what check was called with.
  [[nodiscard]] const std::string& parameters() const { return parameters_; }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (detail::HasState<T, StateWriter>) {
      const_cast<T&>(value).archive_state(*this);  // which reads it
    } else if constexpr (std::same_as<T, bool>) {
      bytes_.push_back(value ? '\1' : '\0');
    } else if constexpr (std::is_enum_v<T>) {
      write(static_cast<std::int32_t>(value));
    } else if constexpr (std::is_arithmetic_v<T>) {
      std::array<char, sizeof(T)> bytes;
      std::memcpy(bytes.data(), &value, sizeof(T));
      if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
      bytes_.append(bytes.data(), bytes.size());
    } else if constexpr (detail::FixedMatrix<T>) {
      for (Eigen::Index i = 0; i < value.size(); ++i) write(value(i));
    } else if constexpr (detail::is_vector<T>) {
      write(std::uint64_t{value.size()});
      each(value);
    } else if constexpr (detail::is_optional<T>) {
      write(value.has_value());
      if (value) write(*value);
    } else if constexpr (std::same_as<T, std::string>) {
      write(std::uint64_t{value.size()});
      bytes_ += value;
    } else if constexpr (std::same_as<T, std::mt19937_64>) {
      std::ostringstream text;
      text.imbue(std::locale::classic());
      text << value;
      write(text.str());
    } else {
      static_assert(detail::is_unknown<T>, "give this type an archive_state");
    }
  }

  std::string bytes_;
  std::string parameters_;
};

/// Reads what a StateWriter has written into values that were made with the same parameters. Throws InputError, with `source` in front:
/// for other parameters, naming the first that differs; when the bytes end too soon; and for whatever archive_state requires. A value
/// is then half read: read into a copy. Lengths are checked before memory is asked for, all of which together is at most memory_factor
/// times the bytes and memory_least_bytes.
class StateReader {
 public:
  static constexpr bool is_loading = true;                       ///< values are read
  static constexpr std::size_t memory_factor = 16;               ///< see above
  static constexpr std::size_t memory_least_bytes = 1U << 20U;  ///< likewise

  /// The bytes and the parameters' lines must outlive the reader.
  StateReader(std::string_view bytes, std::string_view parameters, std::string source)
      : unread_(bytes), parameters_(parameters), source_(std::move(source)), memory_left_(memory_factor * bytes.size() + memory_least_bytes) {}

  /// Reads each of them, one after the other. Throws InputError.
  template <class... Values>
  void operator()(Values&... values) {
    (read(values), ...);
  }

  /// Reads the elements of a vector that has its size already. Throws InputError.
  template <class T>
  void each(std::vector<T>& values) {
    if constexpr (detail::is_plain<T>) {
      const std::string_view bytes = take(values.size() * sizeof(T));
      if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    } else {
      for (T& value : values) read(value);
    }
  }

  /// Throws InputError when a parameter of a value is not the one that was noted.
  template <class T>
  void check(const char* name, const T& of) {
    const ParameterLines named(name, of);
    for (const std::string& line : named.lines()) {
      const std::size_t length = std::min(parameters_.find('\n'), parameters_.size());
      const std::string_view saved = parameters_.substr(0, length);
      parameters_.remove_prefix(std::min(length + 1, parameters_.size()));
      if (saved == line) continue;
      throw InputError(source_, "was saved with " + shown(saved) + ", which here is " + shown(line));
    }
  }

  /// Throws InputError "...: is not valid: `what`" unless `holds`.
  void require(bool holds, const char* what) const {
    if (!holds) throw InputError(source_, std::string("is not valid: ") + what);
  }

  /// Asks for the memory of `count` things of so many bytes. Throws InputError when there is not so much.
  void claim(std::uint64_t count, std::size_t bytes_each) {
    require(count <= memory_left_ / bytes_each, "more is said to be in it than can be");
    memory_left_ -= static_cast<std::size_t>(count) * bytes_each;
  }

  /// Throws InputError unless all was read.
  void require_end() const {
    require(unread_.empty(), "there is more in it than its state");
    if (!parameters_.empty()) throw InputError(source_, "was saved with " + shown(parameters_) + ", which is not here");
  }

 private:
  [[nodiscard]] std::string_view take(std::size_t count) {
    require(count <= unread_.size(), "it ends within its state");
    const std::string_view taken = unread_.substr(0, count);
    unread_.remove_prefix(count);
    return taken;
  }

  template <class T>
  void read(T& value) {
    if constexpr (detail::HasState<T, StateReader>) {
      value.archive_state(*this);
    } else if constexpr (std::same_as<T, bool>) {
      const char byte = take(1)[0];
      require(byte == '\0' || byte == '\1', "a truth value is neither");
      value = byte == '\1';
    } else if constexpr (std::is_enum_v<T>) {
      std::int32_t number = 0;
      read(number);
      // The library's enumerations count from 0; which number is none, only to_string can say.
      require(number >= 0 && number < 32, "an enumerator is not there");
      value = static_cast<T>(number);
    } else if constexpr (std::is_arithmetic_v<T>) {
      std::array<char, sizeof(T)> bytes;
      std::memcpy(bytes.data(), take(sizeof(T)).data(), sizeof(T));
      if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
      std::memcpy(&value, bytes.data(), sizeof(T));
    } else if constexpr (detail::FixedMatrix<T>) {
      for (Eigen::Index i = 0; i < value.size(); ++i) read(value(i));
    } else if constexpr (detail::is_vector<T>) {
      using Element = typename T::value_type;
      const std::size_t count = length();
      claim(count, sizeof(Element));
      value.clear();
      value.resize(count);
      each(value);
    } else if constexpr (detail::is_optional<T>) {
      bool is_there = false;
      read(is_there);
      value.reset();
      if (is_there) read(value.emplace());
    } else if constexpr (std::same_as<T, std::string>) {
      const std::size_t count = length();
      claim(count, 1);
      value = take(count);
    } else if constexpr (std::same_as<T, std::mt19937_64>) {
      std::string text;
      read(text);
      std::istringstream stream(text);
      stream.imbue(std::locale::classic());
      stream >> value;
      require(!stream.fail(), "the state of a random generator is none");
    } else {
      static_assert(detail::is_unknown<T>, "give this type an archive_state");
    }
  }

  /// Nothing takes less than a byte.
  [[nodiscard]] std::size_t length() {
    std::uint64_t count = 0;
    read(count);
    require(count <= unread_.size(), "it ends within its state");
    return static_cast<std::size_t>(count);
  }

  std::string_view unread_;
  std::string_view parameters_;
  std::string source_;
  std::size_t memory_left_;
};

}  // namespace incognita
