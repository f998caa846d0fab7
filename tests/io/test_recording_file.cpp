#include <algorithm>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/io/recording_file.hpp"
#include "file_size_limit.hpp"
#include "recordings.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::bytes_of;
using io_test::payload_of;
using io_test::record;
using io_test::recording_head;
using io_test::refusal;

namespace {

std::string recording_refusal(const std::string& bytes) {
  return refusal([&] { return parse_recording(bytes, "run.incognita"); });
}

RecordedFrame frame_at(double time_s) {
  RecordedFrame frame;
  frame.time_s = time_s;
  return frame;
}

RecordedDecision decision_at(double time_s) {
  RecordedDecision decision;
  decision.time_s = time_s;
  return decision;
}

std::string setup_bytes() { return recording_head() + record(1, payload_of(put_setup, RecordingSetup{})); }

std::string frame_bytes(double time_s) { return record(2, payload_of(put_frame, frame_at(time_s))); }

}  // namespace

TEST_CASE("a recording is read as it was written, at any moment") {
  Random random(1);
  const io_test::TemporaryFolder folder;
  for (int i = 0; i < 20; ++i) {
    Recording recording = io_test::any_recording(random, 4);
    recording.end.reset();
    RecordingWriter writer(folder / "run", recording.setup);
    Recording so_far{recording.setup, {}, {}, {}, 0};
    for (const RecordedFrame& frame : recording.frames) {
      writer.write(frame);
      so_far.frames.push_back(frame);
      REQUIRE(io_test::same(read_recording(folder / "run"), so_far));
    }
    for (const RecordedDecision& decision : recording.decisions) writer.write(decision);
    so_far.decisions = recording.decisions;
    REQUIRE(io_test::same(read_recording(folder / "run"), so_far));
    so_far.end = RecordedEnd{"complete", "{\"a\": 1}"};
    writer.write(*so_far.end);
    REQUIRE(io_test::same(read_recording(writer.path()), so_far));
    REQUIRE(io_test::content_of(folder / "run") == bytes_of(so_far));
    REQUIRE(writer.size_bytes() == std::filesystem::file_size(folder / "run"));
  }
}

TEST_CASE("a recording that is cut off anywhere is what was complete") {
  Random random(2);
  Recording whole;
  while (whole.frames.size() < 3 || whole.decisions.size() < 2 || !whole.end || !whole.setup.plan) whole = io_test::any_recording(random, 3);
  const std::string bytes = bytes_of(whole);
  const std::vector<std::size_t> places = io_test::record_places(bytes);
  REQUIRE(places.size() == 1 + 1 + whole.frames.size() + whole.decisions.size() + 1);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string cut = bytes.substr(0, size);
    if (size < places[1]) {
      REQUIRE_THAT(recording_refusal(cut), Contains("run.incognita: is cut off before the end of the run's setup"));
      continue;
    }
    std::size_t records = 0;
    while (places[records + 1] <= size) ++records;
    Recording expected{whole.setup, {}, {}, {}, size - places[records]};
    for (std::size_t i = 0; i + 1 < records; ++i) {
      if (i < whole.frames.size()) {
        expected.frames.push_back(whole.frames[i]);
      } else {
        expected.decisions.push_back(whole.decisions[i - whole.frames.size()]);
      }
    }
    REQUIRE(io_test::same(parse_recording(cut, "run"), expected));
  }
  CHECK(io_test::same(parse_recording(bytes, "run"), whole));
}

TEST_CASE("a recording with any bit turned is refused, or cut off where a record seems to be longer than what is left") {
  Random random(3);
  Recording whole;
  while (whole.frames.size() != 1 || whole.decisions.size() != 1 || !whole.end) whole = io_test::any_recording(random, 1);
  const std::string bytes = bytes_of(whole);
  const std::vector<std::size_t> places = io_test::record_places(bytes);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string damaged = bytes;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    if (recording_refusal(damaged) != "") continue;
    const Recording cut = parse_recording(damaged, "run");
    REQUIRE(cut.torn_bytes > 0);
    const std::size_t first = bytes.size() - cut.torn_bytes;
    REQUIRE(std::find(places.begin(), places.end(), first) != places.end());
    REQUIRE(bit / 8 - first >= 4);
    REQUIRE(bit / 8 - first < 8);
  }
}

TEST_CASE("what is no recording, or one of another version, is refused") {
  CHECK_THAT(recording_refusal("<?xml version=\"1.0\"?>"), Contains("run.incognita: is not a recording of a run"));
  CHECK_THAT(recording_refusal("INCOGREX"), Contains("is not a recording"));
  CHECK_THAT(recording_refusal("x"), Contains("is not a recording"));
  CHECK_THAT(recording_refusal(""), Contains("is cut off before the end of the run's setup"));
  CHECK_THAT(recording_refusal(recording_head(2) + setup_bytes().substr(12)), Contains("has version 2, but must have 1"));
  CHECK_THAT(recording_refusal(recording_head(0xFFFFFFFF)), Contains("has version 4294967295, but must have 1"));
  CHECK(recording_refusal(setup_bytes()).empty());
}

TEST_CASE("records out of order, of no type, or with something left over are refused at their byte") {
  const std::string setup = setup_bytes();
  const std::string at = "is damaged at byte " + std::to_string(setup.size()) + ": ";
  CHECK_THAT(recording_refusal(recording_head() + frame_bytes(0.0)), Contains("is damaged at byte 12: a record out of order"));
  CHECK_THAT(recording_refusal(setup + setup.substr(12)), Contains(at + "a record out of order"));
  CHECK_THAT(recording_refusal(setup + record(5, "")), Contains(at + "a record of type 5, which must be 1 to 4"));
  CHECK_THAT(recording_refusal(setup + record(0, "")), Contains(at + "a record of type 0"));
  std::string wrong = setup + frame_bytes(0.0);
  wrong.back() = static_cast<char>(wrong.back() ^ 1);
  CHECK_THAT(recording_refusal(wrong), Contains(at + "a record whose checksum is wrong"));
  CHECK_THAT(recording_refusal(setup + frame_bytes(1.0) + frame_bytes(0.5)), Contains("a frame earlier than the one before"));
  CHECK(recording_refusal(setup + frame_bytes(1.0) + frame_bytes(1.0)).empty());
  const auto decision = [](double time_s) { return record(3, payload_of(put_decision, decision_at(time_s))); };
  CHECK_THAT(recording_refusal(setup + decision(1.0) + decision(0.5)), Contains("a decision earlier than the one before"));
  CHECK(recording_refusal(setup + decision(1.0) + frame_bytes(0.5) + decision(1.0)).empty());
  const std::string end = record(4, payload_of(put_end, RecordedEnd{}));
  CHECK_THAT(recording_refusal(setup + end + "a"), Contains("1 bytes too many"));
  CHECK_THAT(recording_refusal(setup + end + end), Contains("bytes too many"));
  CHECK_THAT(recording_refusal(setup + record(4, payload_of(put_end, RecordedEnd{}) + "abc")), Contains("3 bytes too many"));
}

TEST_CASE("records with values out of bounds are refused at their byte") {
  RecordingSetup bad;
  bad.range_max_m = -1.0;
  CHECK_THAT(recording_refusal(recording_head() + record(1, payload_of(put_setup, bad))),
             Contains("is damaged at byte 12: RecordingSetup: range_max_m is -1, but must be finite and > 0"));
  RecordedFrame frame;
  frame.ranges = {1};
  CHECK_THAT(recording_refusal(setup_bytes() + record(2, payload_of(put_frame, frame))), Contains("number of ranges is 1, but must be 0 or that of the beams"));
  frame.ranges.clear();
  frame.metrics = {1.0};
  CHECK_THAT(recording_refusal(setup_bytes() + record(2, payload_of(put_frame, frame))), Contains("number of metrics is 1"));
  CHECK_THAT(recording_refusal(setup_bytes() + record(3, payload_of(put_decision, decision_at(std::numeric_limits<double>::infinity())))),
             Contains("time_s is inf"));
}

TEST_CASE("a writer refuses what could not be read") {
  const io_test::TemporaryFolder folder;
  RecordingSetup bad;
  bad.resolution_m = 0.0;
  const auto kept = folder.with("kept", "as it was");
  CHECK_THROWS_AS(RecordingWriter(kept, bad), std::invalid_argument);
  CHECK(io_test::content_of(kept) == "as it was");

  RecordingWriter writer(folder / "run", RecordingSetup{});
  writer.write(frame_at(1.0));
  writer.write(decision_at(1.0));
  const std::string before = io_test::content_of(folder / "run");
  RecordedFrame frame = frame_at(2.0);
  frame.metrics = {1.0};
  CHECK_THROWS_WITH(writer.write(frame), Contains("number of metrics is 1"));
  CHECK_THROWS_WITH(writer.write(frame_at(0.5)), Contains("RecordedFrame: time_s is 0.5, but must be that of the one before or later"));
  CHECK_THROWS_WITH(writer.write(decision_at(0.5)), Contains("RecordedDecision: time_s is 0.5"));
  CHECK(io_test::content_of(folder / "run") == before);
  writer.write(RecordedEnd{});
  CHECK_THAT(refusal([&] { return writer.write(frame_at(3.0)), 0; }), Contains("run: cannot be written: the recording has ended"));
  CHECK(read_recording(folder / "run").end);
}

TEST_CASE("a recording that no longer fits on the disk stays readable, whatever is tried afterwards") {
  const io_test::TemporaryFolder folder;
  RecordingWriter writer(folder / "run", RecordingSetup{});
  writer.write(frame_at(1.0));
  const std::size_t complete = writer.size_bytes();
  {
    const io_test::FileSizeLimit limit(complete + 50);
    CHECK_THAT(refusal([&] { return writer.write(frame_at(2.0)), 0; }), Contains("run: cannot be written: File too large"));
  }
  CHECK_THAT(refusal([&] { return writer.write(frame_at(3.0)), 0; }), Contains("an earlier record could not be written"));
  CHECK(writer.size_bytes() == complete);
  const Recording recording = read_recording(folder / "run");
  CHECK(recording.frames.size() == 1);
  CHECK(recording.torn_bytes == 50);
  CHECK_FALSE(recording.end);
}

TEST_CASE("places that cannot be written, and files that are too large to be read, are refused") {
  const io_test::TemporaryFolder folder;
  const auto refused_at = [](const std::filesystem::path& path) {
    return refusal([&] { return RecordingWriter(path, RecordingSetup{}).size_bytes(); });
  };
  CHECK_THAT(refused_at(folder / "missing/run"), Contains("missing/run: cannot be written: No such file or directory"));
  CHECK_THAT(refused_at(folder.path()), Contains("cannot be written: Is a directory"));
  CHECK_THAT(refused_at("/dev/full"), Contains("/dev/full: cannot be written: No space left on device"));
  const auto file = folder.with("run", setup_bytes());
  CHECK(read_recording(file, setup_bytes().size()).frames.empty());
  CHECK_THAT(refusal([&] { return read_recording(file, 20); }), Contains("but must have at most 20"));
  CHECK_THAT(refusal([&] { return read_recording(folder / "none"); }), Contains("there is no such file"));
}
