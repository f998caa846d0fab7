/// Writing a file so that nobody ever sees half of it.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include "incognita/io/input_error.hpp"

namespace incognita {

/// Writes `content` to `path`: to a new file beside it first, which then takes its place in one step. When
/// anything fails, InputError is thrown, a file that was there is unchanged and nothing else is left behind.
/// It does not wait for the disk: after a power cut the file may be the old one. Refuses to replace anything
/// but a regular file.
inline void write_file_atomically(const std::filesystem::path& path, std::string_view content) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw InputError(path, "cannot be written: it exists and is not a regular file");
  }

  // "x" creates a file or fails, so that no other file of that name, another writer's perhaps, is touched.
  std::filesystem::path partial;
  std::FILE* opened = nullptr;
  for (int attempt = 0; opened == nullptr && attempt < 100; ++attempt) {
    partial = path;
    partial += ".partial" + std::to_string(attempt);
    errno = 0;
    opened = std::fopen(partial.c_str(), "wbx");
    if (opened == nullptr && errno != EEXIST) break;
  }
  if (opened == nullptr) throw InputError(path, std::string("cannot be written: ") + std::strerror(errno));

  const bool written = std::fwrite(content.data(), 1, content.size(), opened) == content.size();
  const int write_errno = errno;
  const bool closed = std::fclose(opened) == 0;
  const int close_errno = errno;
  if (written && closed) std::filesystem::rename(partial, path, error);
  if (!written || !closed || error) {
    const std::string cause = error ? error.message() : std::strerror(written ? close_errno : write_errno);
    std::filesystem::remove(partial, error);
    throw InputError(path, "cannot be written: " + cause);
  }
}

}  // namespace incognita
