/// Writes a map as PNG and YAML, and reads it back.
#include <fstream>
#include <incognita/grid/floor_plan.hpp>
#include <incognita/io.hpp>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  incognita::ProbabilityGrid map(incognita::Lattice<2>(0.5),
                                 {incognita::Index<2>(0, 0), incognita::Index<2>(4, 3)}, 0.0F);
  map[5] = 1.0F;
  incognita::write_map_server("map.yaml", map);
  const incognita::ProbabilityGrid read = incognita::read_map_server("map.yaml");
  const bool is_equal = read.values() == map.values() && read.resolution_m() == map.resolution_m();

  std::ofstream figures(argv[1]);
  figures << read.size() << " cells, " << (is_equal ? "equal" : "different") << '\n';
  return figures.good() && is_equal ? 0 : 1;
}
