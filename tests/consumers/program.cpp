/// What the consumers run.
#include <incognita/incognita.hpp>

#include <fstream>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::ofstream figures(argv[1]);
  figures << INCOGNITA_VERSION_MAJOR << '.' << INCOGNITA_VERSION_MINOR << '.' << INCOGNITA_VERSION_PATCH << '\n';
  return figures.good() ? 0 : 1;
}
