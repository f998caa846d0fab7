/// Missions in files: an explorer stops today and goes on tomorrow. docs/mission_file.md says what the bytes are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "incognita/io/atomic_file.hpp"
#include "incognita/io/checksum.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/read_file.hpp"
#include "incognita/io/state_archive.hpp"

namespace incognita {

/// A larger file is refused.
inline constexpr std::size_t mission_file_size_max_bytes = std::size_t{4} << 30U;

namespace detail {

/// As PNG's: it shows at once what a transfer of text has done to it.
inline constexpr std::string_view mission_magic{"\x89IGM\r\n\x1a\n", 8};
inline constexpr std::uint32_t mission_version = 1;

template <class Number>
void append_number(std::string& bytes, Number number) {
  for (std::size_t byte = 0; byte < sizeof(Number); ++byte) bytes.push_back(static_cast<char>(number >> (8 * byte)));
}

template <class Number>
[[nodiscard]] Number number_at(std::string_view bytes, std::size_t place) {
  Number number = 0;
  for (std::size_t byte = 0; byte < sizeof(Number); ++byte) {
    number |= static_cast<Number>(static_cast<Number>(static_cast<unsigned char>(bytes[place + byte])) << (8 * byte));
  }
  return number;
}

/// What is in a file, still as bytes.
struct MissionSections {
  std::string_view parameters;
  std::string_view state;
  std::string_view application;
};

[[nodiscard]] inline MissionSections split_mission(std::string_view content, const std::filesystem::path& file) {
  constexpr std::size_t head = 12;
  constexpr std::size_t tail = 4;
  if (!content.starts_with(mission_magic)) throw InputError(file, "is not a mission file");
  if (content.size() < head + tail) throw InputError(file, "is not valid: it ends within its head");
  const auto version = number_at<std::uint32_t>(content, mission_magic.size());
  if (version > mission_version) {
    throw InputError(file, "is a mission of version " + std::to_string(version) + ", but this library reads up to version " +
                               std::to_string(mission_version));
  }
  if (checksum(content.substr(0, content.size() - tail)) != number_at<std::uint32_t>(content, content.size() - tail)) {
    throw InputError(file, "is damaged: its checksum is not that of its content");
  }
  if (version == 0) throw InputError(file, "is not valid: its version is 0, but must be at least 1");
  std::string_view unread = content.substr(head, content.size() - head - tail);
  const auto next = [&] {
    if (unread.size() < 8) throw InputError(file, "is not valid: it has not all of its sections");
    const auto length = number_at<std::uint64_t>(unread, 0);
    unread.remove_prefix(8);
    if (length > unread.size()) {
      throw InputError(file, "is not valid: a section has " + std::to_string(length) + " bytes, but must have at most the " +
                                 std::to_string(unread.size()) + " that are left");
    }
    const std::string_view section = unread.substr(0, static_cast<std::size_t>(length));
    unread.remove_prefix(section.size());
    return section;
  };
  MissionSections sections;
  for (std::string_view* section : {&sections.parameters, &sections.state, &sections.application}) *section = next();
  if (!unread.empty()) throw InputError(file, "is not valid: there is more in it than its sections");
  return sections;
}

}  // namespace detail

/// The content of a mission file: the state of an Explorer, or of any other value with archive_state, and bytes of the application's own.
/// Equal states give equal bytes. O(bytes).
template <class Mission>
[[nodiscard]] std::string encode_mission(const Mission& mission, std::string_view application = {}) {
  StateWriter writer;
  writer(mission);
  std::string content(detail::mission_magic);
  detail::append_number(content, detail::mission_version);
  for (const std::string_view section : {std::string_view(writer.parameters()), std::string_view(writer.bytes()), application}) {
    detail::append_number(content, std::uint64_t{section.size()});
    content += section;
  }
  detail::append_number(content, checksum(content));
  return content;
}

/// Makes `mission` the one that `content`, a whole mission file, holds, and returns the application's bytes. `file` is only named in
/// errors. `mission` must have been made with the same types and parameters; of an Explorer the number of threads and the
/// duration may be others. Throws InputError when the checksum is not that of the content, when the content is malformed, or of a later
/// version, and when a parameter differs, which is then named; `mission` is then unchanged. Memory: a copy of `mission`, and at most
/// StateReader::memory_factor times the content. O(bytes).
template <class Mission>
std::string decode_mission(std::string_view content, const std::filesystem::path& file, Mission& mission) {
  const detail::MissionSections sections = detail::split_mission(content, file);
  StateReader reader(sections.state, sections.parameters, file.string());
  Mission loaded = mission;
  try {
    reader(loaded);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(file, std::string("is not valid: ") + error.what());
  }
  reader.require_end();
  std::string application(sections.application);
  mission = std::move(loaded);
  return application;
}

/// Writes a mission to a file, which replaces one that is there only when complete; see encode_mission. Throws InputError.
template <class Mission>
void save_mission(const std::filesystem::path& file, const Mission& mission, std::string_view application = {}) {
  write_file_atomically(file, encode_mission(mission, application));
}

/// Reads a mission from a file; see decode_mission. Throws InputError.
template <class Mission>
std::string load_mission(const std::filesystem::path& file, Mission& mission) {
  return decode_mission(read_file(file, mission_file_size_max_bytes), file, mission);
}

}  // namespace incognita
