/// An explorer that drives a robot in simulation.
#pragma once

#include <cmath>
#include <cstddef>

#include "incognita/geometry/twist2.hpp"
#include "incognita/simulation/simulator.hpp"

namespace examples {

/// Drives on by `explorer` in `simulator` with a command that is held until the next scan; otherwise as drive.
template <class Explorer, class OnScan, class OnStep>
void drive_on(Explorer& explorer, incognita::Simulator& simulator, incognita::Twist2& command, double duration_s, OnScan&& on_scan,
              OnStep&& on_step) {
  // Steps are counted, so that the end does not depend on how a time is rounded.
  constexpr double step_s = 0.02;
  const auto steps_max = static_cast<std::size_t>(std::ceil(duration_s / step_s - 1e-9));
  while (!explorer.stopped() && simulator.steps() < steps_max) {
    explorer.move(simulator.step(command), step_s);
    if (simulator.scan_is_new()) {
      on_scan();
      command = explorer.command(simulator.scan());
    }
    on_step();
  }
}

/// Drives by `explorer` in `simulator`, which takes 50 steps a second, until the explorer stops or the simulator's time is duration_s.
/// on_scan(), called at every new scan, the one at the start included, must let the explorer observe it and decide;
/// on_step() is called after each step.
template <class Explorer, class OnScan, class OnStep>
void drive(Explorer& explorer, incognita::Simulator& simulator, double duration_s, OnScan&& on_scan, OnStep&& on_step) {
  if (simulator.steps() == 0) on_scan();
  incognita::Twist2 command = explorer.command(simulator.scan());
  drive_on(explorer, simulator, command, duration_s, on_scan, on_step);
}

}  // namespace examples
