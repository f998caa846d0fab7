/// Recordings as files: written record by record, so that a run that is killed leaves all that it had recorded.
#pragma once

#include <zlib.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "incognita/io/bytes.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/read_file.hpp"
#include "incognita/io/recording.hpp"
#include "incognita/io/recording_records.hpp"

namespace incognita {

inline constexpr std::string_view recording_magic = "INCOGREC";
inline constexpr std::uint32_t recording_version = 1;

namespace detail {

/// CRC-32 of a record's type, length and payload.
[[nodiscard]] inline std::uint32_t record_checksum(std::string_view record) {
  return static_cast<std::uint32_t>(
      crc32(crc32(0L, Z_NULL, 0), reinterpret_cast<const Bytef*>(record.data()), static_cast<uInt>(record.size())));
}

}  // namespace detail

/// Writes a recording into a new file, which is complete up to the last record at any time: each is handed over to the system in one piece before
/// write returns. Not thread safe.
class RecordingWriter {
 public:
  /// Creates the file, or empties one that is there, and writes the setup. Throws InputError when it cannot.
  RecordingWriter(std::filesystem::path path, const RecordingSetup& setup) : path_(std::move(path)), file_(std::fopen(path_.c_str(), "wb")) {
    if (!file_) fail();
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);
    ByteWriter head;
    for (const char letter : recording_magic) head.number(letter);
    head.number(recording_version);
    put(head.bytes());
    write(RecordType::setup, setup_record(setup));
  }

  /// Each throws InputError when the file cannot be written. O(size of the record).
  void write(const RecordedFrame& frame) { write(RecordType::frame, frame_record(frame)); }
  void write(const RecordedDecision& decision) { write(RecordType::decision, decision_record(decision)); }
  void write(const RecordedEnd& end) { write(RecordType::end, end_record(end)); }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::size_t size_bytes() const { return size_bytes_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void write(RecordType type, std::string_view payload) {
    if (payload.size() > std::numeric_limits<std::uint32_t>::max()) throw InputError(path_, "cannot be written: a record of more than 4 GiB");
    record_.clear();
    record_.number(static_cast<std::uint32_t>(type));
    record_.number(static_cast<std::uint32_t>(payload.size()));
    for (const char byte : payload) record_.number(byte);
    record_.number(detail::record_checksum(record_.bytes()));
    put(record_.bytes());
  }

  void put(const std::string& bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail();
    size_bytes_ += bytes.size();
  }

  [[noreturn]] void fail() const { throw InputError(path_, std::string("cannot be written: ") + std::strerror(errno)); }

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::size_t size_bytes_ = 0;
  ByteWriter record_;  // kept for its storage
};

/// Reads the bytes of a recording; `file` is only named in errors. A record that is cut off at the end, as a killed run may leave it, is not an
/// error: what comes before it is returned, and torn_bytes says how much was left out. Throws InputError, which names the byte, for all else that
/// is not as docs/recording.md says. Allocates at most 16 times the size of the bytes, and the floor plan's cells.
[[nodiscard]] inline Recording parse_recording(std::string_view bytes, const std::filesystem::path& file) {
  ByteReader reader(bytes, file.string());
  const std::size_t head = recording_magic.size() + 4;
  if (bytes.substr(0, recording_magic.size()) != recording_magic.substr(0, bytes.size())) throw InputError(file, "is not a recording of a run");
  if (bytes.size() < head) throw InputError(file, "is cut off before the setup of the run");
  for (std::size_t i = 0; i < recording_magic.size(); ++i) static_cast<void>(reader.number<char>());
  const auto version = reader.number<std::uint32_t>();
  if (version != recording_version) {
    throw InputError(file, "has version " + std::to_string(version) + ", but must have " + std::to_string(recording_version));
  }
  Recording recording;
  bool has_setup = false;
  while (reader.left() > 0 && !recording.end) {
    const std::size_t first = reader.place();
    recording.torn_bytes = reader.left();
    if (reader.left() < 12) break;
    const auto type = reader.number<std::uint32_t>();
    const auto size = reader.number<std::uint32_t>();
    if (size > reader.left() - 4) break;
    const std::string_view payload = bytes.substr(reader.place(), size);
    ByteReader rest(bytes.substr(reader.place() + size), file.string(), reader.place() + size);
    const auto checksum = rest.number<std::uint32_t>();
    if (checksum != detail::record_checksum(bytes.substr(first, 8 + std::size_t{size}))) reader.fail("a record whose checksum is wrong");
    ByteReader content(payload, file.string(), reader.place());
    if (has_setup == (type == static_cast<std::uint32_t>(RecordType::setup))) reader.fail("a record out of order: the setup comes first, and once");
    switch (static_cast<RecordType>(type)) {
      case RecordType::setup:
        recording.setup = parse_setup_record(content);
        has_setup = true;
        break;
      case RecordType::frame: {
        RecordedFrame frame = parse_frame_record(content);
        const RecordingSetup& setup = recording.setup;
        if (!frame.ranges.empty() && frame.ranges.size() != setup.beam_angles_rad.size()) reader.fail("a scan of another number of beams");
        if (frame.metrics.size() != setup.metric_names.size()) reader.fail("another number of metrics than there are names");
        if (!recording.frames.empty() && frame.time_s < recording.frames.back().time_s) reader.fail("a frame earlier than the one before");
        recording.frames.push_back(std::move(frame));
        break;
      }
      case RecordType::decision: recording.decisions.push_back(parse_decision_record(content)); break;
      case RecordType::end: recording.end = parse_end_record(content); break;
      default: reader.fail("a record of unknown type " + std::to_string(type));
    }
    reader = std::move(rest);
    recording.torn_bytes = 0;
  }
  if (!has_setup) throw InputError(file, "is cut off before the setup of the run");
  if (recording.end) reader.require_end();
  return recording;
}

/// Reads a recording of at most 1 GiB; see parse_recording.
[[nodiscard]] inline Recording read_recording(const std::filesystem::path& file) {
  return parse_recording(read_file(file, std::size_t{1} << 30), file);
}

}  // namespace incognita
