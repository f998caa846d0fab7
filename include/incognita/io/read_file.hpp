/// A whole file in memory, within a bound.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "incognita/io/input_error.hpp"

namespace incognita {

/// The bytes of a regular file. Throws InputError when it is missing, no regular file (a folder, a device),
/// unreadable or larger than `size_max_bytes`; nothing is allocated for a file that is too large.
[[nodiscard]] inline std::string read_file(const std::filesystem::path& path, std::size_t size_max_bytes) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw InputError(path, "there is no such file");
  if (status.type() == std::filesystem::file_type::none) throw InputError(path, error.message());
  if (std::filesystem::is_directory(status)) throw InputError(path, "is a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) throw InputError(path, "is not a regular file");
  const std::uintmax_t size_bytes = std::filesystem::file_size(path, error);
  if (error) throw InputError(path, error.message());
  if (size_bytes > size_max_bytes) {
    throw InputError(path, "has " + std::to_string(size_bytes) + " bytes, but must have at most " +
                               std::to_string(size_max_bytes));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, "cannot be opened for reading");
  std::string content(static_cast<std::size_t>(size_bytes), '\0');
  file.read(content.data(), static_cast<std::streamsize>(content.size()));
  if (static_cast<std::size_t>(file.gcount()) != content.size())
    throw InputError(path, "cannot be read to its end");
  return content;
}

}  // namespace incognita
