/// The tutorials' building with two panes of glass, and a laser that mostly looks through them.
#pragma once

#include <cstddef>
#include <utility>

#include "incognita/core/random.hpp"
#include "incognita/simulation/range_sensor.hpp"
#include "incognita/simulation/world.hpp"
#include "support/tutorial.hpp"

/// Between the corridor and the rooms above and below it.
inline const examples::Area upper_pane{{5.2, 5.55}, {7.4, 5.65}};
inline const examples::Area lower_pane{{9.2, 3.75}, {11.4, 3.85}};

/// What a laser sees behind the glass.
[[nodiscard]] inline incognita::World world_without_glass() {
  incognita::FloorPlan plan = examples::tutorial_building();
  for (const examples::Area& pane : {upper_pane, lower_pane}) examples::draw(plan, pane, incognita::FloorCell::floor);
  return incognita::World(std::move(plan));
}

/// Each beam that meets glass comes back from it with a probability of `share`, else from what is behind.
class GlassScanner {
 public:
  GlassScanner(const incognita::BeamPattern<2>& beams, double share)
      : share_(share), solid_(examples::tutorial_building()), behind_(world_without_glass()), front_({beams, 0.01}, 1), back_({beams, 0.01}, 2), scan_(beams) {}

  const incognita::Scan<2>& measure(const incognita::Pose2& T_world_sensor) {
    const incognita::Scan<2>& front = front_.measure(solid_, T_world_sensor);
    const incognita::Scan<2>& back = back_.measure(behind_, T_world_sensor);
    for (std::size_t beam = 0; beam < scan_.size(); ++beam) {
      scan_.set_range_m(beam, (random_.uniform() < share_ ? front : back).range_m(beam));
    }
    return scan_;
  }

 private:
  double share_;
  incognita::World solid_;
  incognita::World behind_;
  incognita::RangeSensor front_;
  incognita::RangeSensor back_;
  incognita::Random random_{3};
  incognita::Scan<2> scan_;
};
