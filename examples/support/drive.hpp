/// An explorer that drives a robot in simulation.
#pragma once

#include <cmath>
#include <cstddef>

#include "incognita/geometry/twist2.hpp"
#include "incognita/sensor/scan.hpp"
#include "incognita/simulation/simulator.hpp"

namespace examples {

/// What the explorer itself says to drive by a scan, the latest.
struct OwnCommand {
  template <class Explorer>
  [[nodiscard]] incognita::Twist2 operator()(Explorer& explorer, const incognita::Scan<2>& scan) const {
    return explorer.command(scan);
  }
};

/// Drives on by `explorer` in `simulator` with a command that is held until the next scan, when command_of(explorer, scan) gives another;
/// otherwise as drive.
template <class Explorer, class OnScan, class OnStep, class CommandOf = OwnCommand>
void drive_on(Explorer& explorer, incognita::Simulator& simulator, incognita::Twist2& command, double duration_s, OnScan&& on_scan,
              OnStep&& on_step, CommandOf&& command_of = {}) {
  // Steps are counted, so that the end does not depend on how a time is rounded.
  constexpr double step_s = 0.02;
  const auto steps_max = static_cast<std::size_t>(std::ceil(duration_s / step_s - 1e-9));
  while (!explorer.stopped() && simulator.steps() < steps_max) {
    explorer.move(simulator.step(command), step_s);
    if (simulator.scan_is_new()) {
      on_scan();
      command = command_of(explorer, simulator.scan());
    }
    on_step();
  }
}

/// Drives by `explorer` in `simulator`, which takes 50 steps a second, until the explorer stops or the simulator's time is duration_s.
/// on_scan(), called at every new scan, the one at the start included, must let the explorer observe it and decide;
/// on_step() is called after each step. command_of(explorer, scan) is what the robot is told, the explorer's own command unless it is given.
template <class Explorer, class OnScan, class OnStep, class CommandOf = OwnCommand>
void drive(Explorer& explorer, incognita::Simulator& simulator, double duration_s, OnScan&& on_scan, OnStep&& on_step,
           CommandOf&& command_of = {}) {
  if (simulator.steps() == 0) on_scan();
  incognita::Twist2 command = command_of(explorer, simulator.scan());
  drive_on(explorer, simulator, command, duration_s, on_scan, on_step, command_of);
}

}  // namespace examples
