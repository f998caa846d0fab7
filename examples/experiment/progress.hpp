/// How far a study has come: units done, how fast, how long it will take, and what has failed.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>

namespace experiment {

/// On a terminal one line that is drawn over, elsewhere one a minute; failures on lines of their own.
class Progress {
 public:
  /// `done` and, of these, `failed` are those of before.
  Progress(std::size_t done, std::size_t failed, std::size_t all, bool quiet) : before_(done), done_(done), all_(all), quiet_(quiet), failed_(failed) {}

  void unit_done(const std::string& unit, const std::string& failure) {
    ++done_;
    if (!failure.empty()) ++failed_;
    if (quiet_) return;
    if (!failure.empty()) std::printf("%s%s failed: %s\n", is_terminal() ? "\r\033[K" : "", unit.c_str(), failure.c_str());
    const Clock::time_point now = Clock::now();
    const bool is_last = done_ == all_;
    if (!is_terminal() && !is_last && now - shown_ < std::chrono::minutes(1)) return;
    shown_ = now;
    const double minutes = std::chrono::duration<double>(now - begin_).count() / 60.0;
    const double per_minute = static_cast<double>(done_ - before_) / (minutes > 0.0 ? minutes : 1.0);
    const double left_minutes = static_cast<double>(all_ - done_) / per_minute;
    std::printf("%s%zu of %zu units, %.3g a minute, %.1f minutes left, %zu failed%s", is_terminal() ? "\r\033[K" : "", done_, all_, per_minute,
                left_minutes, failed_, is_terminal() && !is_last ? "" : "\n");
    std::fflush(stdout);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static bool is_terminal() { return isatty(STDOUT_FILENO) == 1; }

  std::size_t before_;
  std::size_t done_;
  std::size_t all_;
  bool quiet_;
  std::size_t failed_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point shown_ = begin_;
};

}  // namespace experiment
