// The smallest use of the library: a robot's own odometry and scans go in, a goal comes out.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "incognita/exploration.hpp"

// A stand-in for a robot's driver: it stands in the middle of a room of 8 x 6 m with a door of 1 m to the east.
double measured_range_m(const Eigen::Vector2d& direction) {
  const double to_side_m = 4.0 / std::abs(direction.x());
  const double to_front_m = 3.0 / std::abs(direction.y());
  const bool through_door = direction.x() > 0.0 && to_side_m * std::abs(direction.y()) < 0.5;
  return through_door ? 10.0 : std::min({to_side_m, to_front_m, 10.0});
}

int main() {
  incognita::Explorer explorer;  // Map<TBayes>, Behavioral entropy, DvlEkf: each can be another
  incognita::Scan<2> scan(incognita::circular_beams(360, 10.0));
  for (int step = 0; step < 30 && !explorer.goal(); ++step) {
    explorer.move({.x_m = 0.0, .y_m = 0.0, .yaw_rad = 0.0}, 0.1);  // odometry since the last step, which took 0.1 s
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      scan.set_range_m(beam, measured_range_m(scan.direction(beam)));
    }
    explorer.observe(scan);
    explorer.decide();
  }
  if (!explorer.goal()) return EXIT_FAILURE;
  std::cout << "Drive to x = " << explorer.goal()->x() << " m, y = " << explorer.goal()->y() << " m\n";
}
