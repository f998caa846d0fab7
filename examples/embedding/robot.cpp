/// A robot that stands in a corridor takes scans and decides where to go. Where it could go, and what each place is worth to it,
/// is printed, or goes to the file that the first argument names, to the last digit.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <incognita/incognita.hpp>
#include <iostream>
#include <limits>

namespace {

/// What a robot reads in the middle of a corridor of 30 x 2 m.
incognita::Scan<2> corridor_scan() {
  incognita::Scan<2> scan(incognita::circular_beams(360, 10.0));
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double range_m =
        std::min(15.0 / std::abs(scan.direction(beam).x()), 1.0 / std::abs(scan.direction(beam).y()));
    if (range_m < scan.range_max_m()) scan.set_range_m(beam, range_m);
  }
  return scan;
}

}  // namespace

int main(int argc, char** argv) {
  incognita::Explorer explorer;
  const incognita::Scan<2> scan = corridor_scan();
  bool decided = false;
  for (int count = 0; count < 50 && !decided; ++count) {
    explorer.observe(scan);
    decided = explorer.decide();
  }

  std::ofstream file;
  if (argc > 1) file.open(argv[1]);
  std::ostream& figures = argc > 1 ? file : std::cout;
  figures.precision(std::numeric_limits<double>::max_digits10);
  figures << "incognita " << INCOGNITA_VERSION_MAJOR << '.' << INCOGNITA_VERSION_MINOR << '.'
          << INCOGNITA_VERSION_PATCH << '\n';
  for (const incognita::Candidate& candidate : explorer.decision().candidates) {
    figures << candidate.goal_m().transpose() << ' ' << candidate.gain_nats << '\n';
  }
  const bool is_goal_along_the_corridor = explorer.goal() && std::abs(explorer.goal()->x()) > 2.0;
  return figures.good() && is_goal_along_the_corridor ? 0 : 1;
}
