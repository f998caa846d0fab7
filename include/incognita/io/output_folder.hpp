/// Folders for results: whether one can be written is known before the work starts, not after.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "incognita/io/input_error.hpp"

namespace incognita {

namespace detail {

/// Creates `folder` and the folders above it that are missing; returns those that it created, outermost
/// first. When one fails, those before it are removed again and InputError names the cause.
inline std::vector<std::filesystem::path> create_missing_folders(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const auto fail = [&folder](const std::string& cause) {
    throw InputError(folder, "cannot be used as an output folder: " + cause);
  };
  if (folder.empty()) fail("its name is empty");
  std::error_code error;
  fs::path place = fs::absolute(folder, error);
  if (error) fail(error.message());
  if (!place.has_filename()) place = place.parent_path();

  std::vector<fs::path> missing;
  for (; !place.empty(); place = place.parent_path()) {
    const fs::file_status status = fs::status(place, error);
    if (fs::is_directory(status)) break;
    if (fs::exists(status)) fail(place.string() + " is not a folder");
    if (status.type() != fs::file_type::not_found) fail(error.message());
    if (fs::is_symlink(fs::symlink_status(place, error))) fail(place.string() + " is a link to nothing");
    missing.insert(missing.begin(), place);
    if (place == place.parent_path()) break;
  }

  std::vector<fs::path> created;
  for (const fs::path& next : missing) {
    if (fs::create_directory(next, error)) {
      created.push_back(next);
    } else if (error) {
      const std::string cause = error.message();
      while (!created.empty()) {
        fs::remove(created.back(), error);
        created.pop_back();
      }
      fail(cause);
    }
  }
  return created;
}

}  // namespace detail

/// Throws InputError unless files can be written into `folder`, or into it once it and the folders above it
/// are made. It tries, because permissions alone do not tell: whatever it makes it removes again before it
/// returns or throws.
inline void check_output_folder(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const std::vector<fs::path> created = detail::create_missing_folders(folder);
  std::error_code error;
  fs::path probe;
  std::FILE* file = nullptr;
  for (int attempt = 0; file == nullptr && attempt < 100; ++attempt) {
    probe = folder / (".incognita-probe" + std::to_string(attempt));
    file = std::fopen(probe.c_str(), "wbx");
  }
  if (file != nullptr) {
    std::fclose(file);
    fs::remove(probe, error);
  }
  for (auto place = created.rbegin(); place != created.rend(); ++place) fs::remove(*place, error);
  if (file == nullptr)
    throw InputError(folder, "cannot be used as an output folder: no file can be written there");
}

/// Makes `folder` and the folders above it where they are missing. Throws InputError; nothing new is then
/// left behind.
inline void create_output_folder(const std::filesystem::path& folder) {
  static_cast<void>(detail::create_missing_folders(folder));
}

}  // namespace incognita
