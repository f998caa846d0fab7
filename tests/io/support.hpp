/// What the tests of io/ share: folders that vanish, errors looked at closely, files spoilt on purpose.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/io/input_error.hpp"

namespace io_test {

/// A new folder, removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "incognita-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder can be made");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Writes a file into the folder and returns its path.
  [[nodiscard]] std::filesystem::path with(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

  /// The names of all that is in the folder, sorted.
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path_)) {
      names.push_back(entry.path().lexically_relative(path_).string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::filesystem::path path_;
};

inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The message of the InputError that `read` throws, empty when it throws none. Fails the test when the
/// message is not one line; any other exception goes through and fails the test too.
template <class Read>
std::string refusal(Read&& read) {
  try {
    static_cast<void>(read());
  } catch (const incognita::InputError& error) {
    const std::string message = error.what();
    const bool is_one_line = !message.empty() && std::none_of(message.begin(), message.end(), [](char c) {
      return static_cast<unsigned char>(c) < 0x20U;
    });
    if (!is_one_line) FAIL("not one line: " << message);
    return message;
  }
  return "";
}

/// 64 bits, each as likely set as not.
inline std::uint64_t any_bits(incognita::Random& random) {
  constexpr std::uint64_t half = std::uint64_t{1} << 32U;
  return random.index(half) << 32U | random.index(half);
}

/// Reads `good` with a few bytes changed, cut out or repeated, many times over. Each must be read or refused;
/// the sanitizers see what cannot be seen here. Returns how many were refused.
template <class Read>
int refused_when_spoilt(const std::string& good, int times, Read&& read) {
  incognita::Random random(7);
  const auto place = [&](const std::string& text) {
    return static_cast<std::ptrdiff_t>(random.index(std::max<std::size_t>(text.size(), 1)));
  };
  int refused = 0;
  for (int i = 0; i < times; ++i) {
    std::string spoilt = good;
    for (std::uint64_t changes = 1 + random.index(3); changes > 0; --changes) {
      const std::uint64_t kind = random.index(8);
      if (kind == 0) {
        spoilt.resize(static_cast<std::size_t>(place(spoilt)));
      } else if (kind == 1) {
        const std::string piece =
            spoilt.substr(static_cast<std::size_t>(place(spoilt)), 1 + random.index(40));
        spoilt.insert(static_cast<std::size_t>(place(spoilt)), piece);
      } else if (!spoilt.empty()) {
        spoilt[static_cast<std::size_t>(place(spoilt))] = static_cast<char>(random.index(256));
      }
    }
    if (!refusal([&] { return read(spoilt); }).empty()) ++refused;
  }
  return refused;
}

}  // namespace io_test
