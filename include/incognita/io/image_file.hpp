/// Image files of any format that the library reads.
#pragma once

#include <filesystem>
#include <string>

#include "incognita/io/image.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/pgm.hpp"
#include "incognita/io/png.hpp"
#include "incognita/io/read_file.hpp"

namespace incognita {

/// Reads a PNG or a PGM file; which one, its first bytes say and not its name. Throws InputError.
[[nodiscard]] inline Image read_image(const std::filesystem::path& file) {
  const std::string content = read_file(file, image_file_size_max_bytes);
  if (is_png(content)) return decode_png(content, file);
  if (is_pgm(content)) return decode_pgm(content, file);
  throw InputError(file, "is neither a PNG nor a PGM image: its " + std::to_string(content.size()) + " bytes must start as one does");
}

}  // namespace incognita
