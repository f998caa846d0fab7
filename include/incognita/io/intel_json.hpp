/// Logs in JSON: an object of scans by time, as the Intel Research Lab's is often passed on.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incognita/core/angles.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/number.hpp"
#include "incognita/io/read_file.hpp"
#include "incognita/io/robot_log.hpp"

namespace incognita {

namespace detail {

/// Takes {"map": {"<time>": {"range": [...], "x": , "y": , "theta": }}} event by event, so that nothing but
/// the scans is ever held, however deep or large the text is. Other fields of a scan may be there and hold
/// anything but objects.
class IntelJsonHandler {
 public:
  using Json = nlohmann::json;

  IntelJsonHandler(const std::filesystem::path& file, std::vector<LogScan>& scans)
      : file_(file), scans_(scans) {}

  /// A reading that is not finite: JSON has no other word for it.
  bool null() { return in_ranges_ ? reading(std::numeric_limits<double>::quiet_NaN()) : other("null"); }
  bool boolean(bool value) { return other(value ? "true" : "false"); }
  bool string(Json::string_t& value) { return other(shown(value)); }
  bool binary(Json::binary_t&) { return other("binary"); }
  bool number_integer(Json::number_integer_t value) { return number(static_cast<double>(value)); }
  bool number_unsigned(Json::number_unsigned_t value) { return number(static_cast<double>(value)); }
  bool number_float(Json::number_float_t value, const Json::string_t&) { return number(value); }

  bool start_object(std::size_t) {
    if (in_ranges_ || ignored_arrays_ > 0 || depth_ >= 3) fail("has an object too many");
    if (depth_ == 1 && key_ != "map") fail("has the object " + shown(key_) + " where \"map\" must be");
    if (++depth_ == 3) begin_scan();
    return true;
  }

  bool end_object() {
    if (depth_ == 3) end_scan();
    --depth_;
    return true;
  }

  bool key(Json::string_t& name) {
    key_ = one_line(name, 100);
    return true;
  }

  bool start_array(std::size_t) {
    if (depth_ < 3) fail("has an array where the scans must be");
    if (in_ranges_) fail("has an array among the readings");
    if (key_ != "range" || ignored_arrays_ > 0) {
      ++ignored_arrays_;
    } else {
      if (!scan_.ranges_m.empty()) fail("has two fields \"range\"");
      in_ranges_ = true;
    }
    return true;
  }

  bool end_array() {
    if (in_ranges_) {
      in_ranges_ = false;
    } else {
      --ignored_arrays_;
    }
    return true;
  }

  bool parse_error(std::size_t byte, const std::string&, const nlohmann::detail::exception& error) {
    // Numbers that a double cannot hold are errors of another kind, without a place worth telling.
    const std::string where = scans_.empty() ? "" : ", after " + std::to_string(scans_.size()) + " scans";
    if (error.id == 406) throw InputError(file_, "not valid JSON: a number is out of range" + where);
    throw InputError(file_, "not valid JSON: cut off or malformed at byte " + std::to_string(byte) + where);
  }

 private:
  static constexpr std::array<const char*, 3> pose_fields{"x", "y", "theta"};

  [[noreturn]] void fail(const std::string& what) const {
    if (depth_ < 3) throw InputError(file_, what);
    throw InputError(file_, "the scan " + shown(time_) + ' ' + what);
  }

  void begin_scan() {
    time_ = key_;
    const std::optional<double> time_s = parse_number(time_);
    if (!time_s || !std::isfinite(*time_s)) {
      throw InputError(file_, "the scan " + shown(time_) + " must be named by its time in seconds");
    }
    if (scans_.size() == log_scans_max) fail("is one more than " + std::to_string(log_scans_max));
    scan_ = {};
    scan_.time_s = *time_s;
    pose_ = {};
    if (!scans_.empty()) scan_.ranges_m.reserve(scans_.front().ranges_m.size());
  }

  void end_scan() {
    for (std::size_t i = 0; i < pose_fields.size(); ++i) {
      if (!pose_[i]) fail(std::string("lacks \"") + pose_fields[i] + '"');
    }
    if (scan_.ranges_m.empty()) fail("lacks \"range\"");
    const std::size_t expected = scans_.empty() ? scan_.ranges_m.size() : scans_.front().ranges_m.size();
    if (scan_.ranges_m.size() != expected) {
      fail("has " + std::to_string(scan_.ranges_m.size()) + " readings, but must have " +
           std::to_string(expected) + " as the first one");
    }
    scan_.T_odom_robot = {*pose_[0], *pose_[1], wrap_angle_rad(*pose_[2])};
    readings_ += expected;
    if (readings_ > log_readings_max)
      fail("makes more than " + std::to_string(log_readings_max) + " readings");
    scans_.push_back(std::move(scan_));
  }

  bool reading(double range_m) {
    if (scan_.ranges_m.size() == log_beams_max) {
      fail("has more than " + std::to_string(log_beams_max) + " readings");
    }
    scan_.ranges_m.push_back(range_m);
    return true;
  }

  bool number(double value) {
    if (depth_ < 3) return other(format_number(value));
    if (ignored_arrays_ > 0) return true;
    if (in_ranges_) return reading(value);
    for (std::size_t i = 0; i < pose_fields.size(); ++i) {
      if (key_ != pose_fields[i]) continue;
      if (!(std::abs(value) <= log_position_max_m)) {
        fail('"' + key_ + "\" is " + format_number(value) + ", but must be within " +
             format_number(log_position_max_m));
      }
      pose_[i] = value;
    }
    return true;
  }

  /// A value that is no number: welcome only in fields that are not read.
  bool other(const std::string& value) {
    const bool is_pose = key_ == pose_fields[0] || key_ == pose_fields[1] || key_ == pose_fields[2];
    if (in_ranges_) fail("has a reading " + value + ", but it must be a number");
    if (depth_ == 3 && ignored_arrays_ == 0 && (is_pose || key_ == "range")) {
      fail("has \"" + key_ + "\" " + value + ", which must be " +
           (is_pose ? "a number" : "an array of numbers"));
    }
    if (depth_ < 3 && (depth_ != 1 || key_ == "map")) fail("has " + value + " where an object must be");
    return true;
  }

  const std::filesystem::path& file_;
  std::vector<LogScan>& scans_;
  LogScan scan_;
  std::array<std::optional<double>, 3> pose_{};
  std::string key_;
  std::string time_;
  int depth_ = 0;           // of objects; 3 within a scan
  int ignored_arrays_ = 0;  // open arrays of fields that are not read
  bool in_ranges_ = false;
  std::size_t readings_ = 0;
};

}  // namespace detail

/// The log that the text of a JSON file holds: {"map": {"<unix time>": {"range": [...], "x": , "y": ,
/// "theta": }}}, in metres and radians, all scans with as many readings; the pose is odometry or, in a
/// corrected file, the correction. `file` is only named in errors. Throws InputError, and
/// std::invalid_argument for bad parameters. Memory is that of the scans, whatever else is in the text.
[[nodiscard]] inline RobotLog parse_intel_json(std::string_view text, const std::filesystem::path& file,
                                               const RobotLogParams& params = {}) {
  params.validate();
  std::vector<LogScan> scans;
  detail::IntelJsonHandler handler(file, scans);
  nlohmann::json::sax_parse(text.begin(), text.end(), &handler);
  return detail::finish_log(std::move(scans), params, std::nullopt, {}, file);
}

/// Reads a JSON log of at most 256 MiB; see parse_intel_json.
[[nodiscard]] inline RobotLog read_intel_json(const std::filesystem::path& file,
                                              const RobotLogParams& params = {}) {
  return parse_intel_json(read_file(file, std::size_t{1} << 28), file, params);
}

}  // namespace incognita
