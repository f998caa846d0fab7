/// Recordings as files: written record by record, so that a run that is killed leaves all that it had recorded.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "incognita/core/error.hpp"
#include "incognita/io/bytes.hpp"
#include "incognita/io/checksum.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/read_file.hpp"
#include "incognita/io/recording.hpp"
#include "incognita/io/recording_records.hpp"

namespace incognita {

/// What a recording begins with.
inline constexpr std::string_view recording_magic = "INCOGREC";
inline constexpr std::uint32_t recording_version = 1;  ///< of the format; no other is read

namespace detail {

/// Of a record, what comes before its payload: its type and the payload's size; and after: the checksum.
inline constexpr std::size_t record_head_bytes = 8;
inline constexpr std::size_t record_tail_bytes = 4;

}  // namespace detail

/// Writes a recording into a file, which is complete up to the last record at any time: each is handed over to the system in one piece before
/// write returns. Refuses what the reader would. Once a record could not be written (the disk is full), or after the end, nothing more is: what was
/// written stays readable. It does not wait for the disk. Not thread safe.
class RecordingWriter {
 public:
  /// Creates the file, or empties one that is there, and writes the setup. Throws std::invalid_argument for a bad setup, before the file is
  /// touched, and InputError when the file cannot be written.
  RecordingWriter(std::filesystem::path path, const RecordingSetup& setup)
      : path_(std::move(path)), beams_(setup.beam_angles_rad.size()), names_(setup.metric_names.size()) {
    setup.validate();
    file_.reset(std::fopen(path_.c_str(), "wb"));
    if (!file_) fail(std::strerror(errno));
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);
    for (const char letter : recording_magic) record_.number(letter);
    record_.number(recording_version);
    hand_over();
    write(RecordType::setup, [&] { put_setup(record_, setup); });
  }

  /// Throws std::invalid_argument for a frame that does not fit the setup or is earlier than the one before, and InputError when the file cannot
  /// be written. O(size of the record).
  void write(const RecordedFrame& frame) {
    frame.validate(beams_, names_);
    require(frame.time_s >= frame_s_, "RecordedFrame", "time_s", frame.time_s, "that of the one before or later");
    frame_s_ = frame.time_s;
    write(RecordType::frame, [&] { put_frame(record_, frame); });
  }

  /// Throws as it does for a frame. O(size of the record).
  void write(const RecordedDecision& decision) {
    decision.validate();
    require(decision.time_s >= decision_s_, "RecordedDecision", "time_s", decision.time_s, "that of the one before or later");
    decision_s_ = decision.time_s;
    write(RecordType::decision, [&] { put_decision(record_, decision); });
  }

  /// The last record; the file is closed. Throws InputError when it cannot be written.
  void write(const RecordedEnd& end) {
    write(RecordType::end, [&] { put_end(record_, end); });
    file_.reset();
  }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }  ///< of the file
  [[nodiscard]] std::size_t size_bytes() const { return size_bytes_; }  ///< of the file

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  template <class Put>
  void write(RecordType type, Put&& put_payload) {
    record_.clear();
    record_.number(static_cast<std::uint32_t>(type));
    record_.number(std::uint32_t{0});
    put_payload();
    const std::size_t size = record_.bytes().size() - detail::record_head_bytes;
    if (size > std::numeric_limits<std::uint32_t>::max()) fail("a record of more than 4 GiB");
    record_.number_at(4, static_cast<std::uint32_t>(size));
    record_.number(checksum(record_.bytes()));
    hand_over();
  }

  void hand_over() {
    if (!file_) fail("the recording has ended, or an earlier record could not be written");
    const std::string& bytes = record_.bytes();
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
      const int cause = errno;
      file_.reset();  // what came after a piece of a record could not be read
      fail(std::strerror(cause));
    }
    size_bytes_ += bytes.size();
  }

  [[noreturn]] void fail(const std::string& cause) const { throw InputError(path_, "cannot be written: " + cause); }

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::size_t beams_;
  std::size_t names_;
  double frame_s_ = -std::numeric_limits<double>::infinity();
  double decision_s_ = -std::numeric_limits<double>::infinity();
  std::size_t size_bytes_ = 0;
  ByteWriter record_;  // kept for its storage
};

namespace detail {

struct RecordView {
  RecordType type;
  ByteReader payload;
};

/// The record that begins at the next byte; none, and no byte taken, when it is cut off.
[[nodiscard]] inline std::optional<RecordView> take_record(ByteReader& bytes) {
  ByteReader ahead = bytes;
  if (ahead.left() < record_head_bytes) return std::nullopt;
  const auto type = ahead.number<std::uint32_t>();
  const auto size = ahead.number<std::uint32_t>();
  if (ahead.left() < std::size_t{size} + record_tail_bytes) return std::nullopt;
  const ByteReader payload = ahead.part(size);
  ByteReader whole = bytes;
  if (ahead.number<std::uint32_t>() != checksum(whole.raw(record_head_bytes + size))) bytes.fail("a record whose checksum is wrong");
  if (type < 1 || type > 4) bytes.fail("a record of type " + std::to_string(type) + ", which must be 1 to 4");
  bytes = ahead;
  return RecordView{static_cast<RecordType>(type), payload};
}

/// Adds what a record holds. Throws InputError for one that is not as it must be, and std::invalid_argument for values that are not.
inline void add_record(Recording& recording, RecordType type, ByteReader& payload) {
  switch (type) {
    case RecordType::setup:
      recording.setup = take_setup(payload);
      recording.setup.validate();
      break;
    case RecordType::frame: {
      RecordedFrame frame = take_frame(payload);
      frame.validate(recording.setup.beam_angles_rad.size(), recording.setup.metric_names.size());
      if (!recording.frames.empty() && frame.time_s < recording.frames.back().time_s) payload.fail("a frame earlier than the one before");
      recording.frames.push_back(std::move(frame));
      break;
    }
    case RecordType::decision: {
      RecordedDecision decision = take_decision(payload);
      decision.validate();
      if (!recording.decisions.empty() && decision.time_s < recording.decisions.back().time_s) payload.fail("a decision earlier than the one before");
      recording.decisions.push_back(std::move(decision));
      break;
    }
    case RecordType::end: recording.end = take_end(payload); break;
  }
  payload.require_end();
}

}  // namespace detail

/// Reads the bytes of a recording; `file` is only named in errors. A record that is cut off at the end, as a killed run may leave it, is not an
/// error: what comes before it is returned, and torn_bytes says how much was left out. (Damage that makes a record longer than what is left looks
/// the same.) Throws InputError, which names the byte, for all else that is not as docs/recording.md says. Allocates in all at most 64 times as
/// many bytes as there are, which a floor plan of a single kind comes near to, and 4 KiB.
[[nodiscard]] inline Recording parse_recording(std::string_view bytes, const std::filesystem::path& file) {
  const std::string name = file.string();
  ByteReader reader(bytes, name);
  if (bytes.substr(0, recording_magic.size()) != recording_magic.substr(0, bytes.size())) throw InputError(file, "is not a recording of a run");
  const auto require_more = [&](bool holds) {
    if (!holds) throw InputError(file, "is cut off before the end of the run's setup");
  };
  require_more(bytes.size() >= recording_magic.size() + sizeof(recording_version));
  static_cast<void>(reader.raw(recording_magic.size()));
  const auto version = reader.number<std::uint32_t>();
  if (version != recording_version) {
    throw InputError(file, "has version " + std::to_string(version) + ", but must have " + std::to_string(recording_version));
  }
  Recording recording;
  for (bool is_first = true; reader.left() > 0 && !recording.end; is_first = false) {
    const ByteReader record = reader;
    std::optional<detail::RecordView> view = detail::take_record(reader);
    if (!view) break;
    if (is_first != (view->type == RecordType::setup)) record.fail("a record out of order: the setup must come first, and once");
    try {
      detail::add_record(recording, view->type, view->payload);
    } catch (const std::invalid_argument& error) {
      record.fail(error.what());
    }
  }
  if (recording.end) reader.require_end();
  require_more(reader.place() > recording_magic.size() + sizeof(recording_version));
  recording.torn_bytes = reader.left();
  return recording;
}

/// Reads a recording of at most size_max_bytes; see parse_recording.
[[nodiscard]] inline Recording read_recording(const std::filesystem::path& file, std::size_t size_max_bytes = std::size_t{1} << 30) {
  return parse_recording(read_file(file, size_max_bytes), file);
}

}  // namespace incognita
