/// How far a program has come, on a terminal.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>

namespace examples {

/// A function of how many are done and how many there are. What it prints is drawn over on a terminal; it prints nothing elsewhere.
[[nodiscard]] inline std::function<void(std::size_t, std::size_t)> progress_of(std::string trials) {
  return [trials = std::move(trials)](std::size_t done, std::size_t all) {
    if (isatty(STDOUT_FILENO) != 1) return;
    std::printf("\r%zu of %zu %s%s", done, all, trials.c_str(), done == all ? "\n" : "");
    std::fflush(stdout);
  };
}

}  // namespace examples
