/// Tables as CSV files.
#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

#include "support/output_folder.hpp"

namespace examples {

/// Writes the header line, then what write_rows(stream) writes. Throws OutputError when the disk refuses.
template <class WriteRows>
void write_csv(const std::filesystem::path& path, const std::string& header, WriteRows&& write_rows) {
  std::ofstream file(path);
  file.precision(9);
  file << header << '\n';
  write_rows(static_cast<std::ostream&>(file));
  file.close();
  if (!file) throw OutputError("cannot write " + path.filename().string());
}

}  // namespace examples
