/// A folder for the files of a run, in which files appear only when all of them are complete.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace examples {

/// The folder cannot be written; one line that says why.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Write files to staged(name), a hidden place within the folder, then publish() moves them all to their names.
/// Without publish, the destructor leaves everything as it was: no files but those of growing(), and no folders that were not
/// there before. Nothing is created until the first staged() or growing(), so what stops a run before its end leaves nothing else behind.
class OutputFolder {
 public:
  /// Throws OutputError when the folder cannot be created or written, or one of `files` in it is a folder.
  explicit OutputFolder(std::filesystem::path folder, const std::vector<std::string>& files = {})
      : folder_(std::move(folder)) {
    if (folder_.empty()) throw OutputError("the output folder has no name");
    staging_ = folder_ / (".incomplete-" + std::to_string(getpid()));
    for (const std::string& file : files) require_no_folder(folder_ / file);
    create(staging_);
    is_staging_ = true;
    undo();
  }

  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  ~OutputFolder() { undo(); }

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

  /// Where to write the file that will be path() / name. Throws OutputError when the folder cannot be created.
  [[nodiscard]] std::filesystem::path staged(const std::string& name) {
    if (!is_staging_) create(staging_);
    is_staging_ = true;
    return staging_ / name;
  }

  /// Where to write a file that is of use before it is complete: in the folder itself, as NAME.partial. There it stays when there is no
  /// publish(), which gives it its name. Throws OutputError when the folder cannot be created.
  [[nodiscard]] std::filesystem::path growing(const std::string& name) {
    create(folder_);
    growing_.push_back(name);
    return partial(name);
  }

  /// Moves the staged files to their names and returns their paths, sorted. Throws OutputError when one
  /// cannot be moved.
  std::vector<std::filesystem::path> publish() {
    std::vector<std::filesystem::path> files;
    if (is_staging_) {
      for (const auto& entry : std::filesystem::directory_iterator(staging_)) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& file : files) require_no_folder(folder_ / file.filename());
    for (const std::string& name : growing_) require_no_folder(folder_ / name);
    for (std::filesystem::path& file : files) file = moved(file, folder_ / file.filename());
    for (const std::string& name : growing_) files.push_back(moved(partial(name), folder_ / name));
    std::sort(files.begin(), files.end());
    growing_.clear();
    created_.clear();
    std::error_code error;
    std::filesystem::remove(staging_, error);
    is_staging_ = false;
    return files;
  }

 private:
  static void require_no_folder(const std::filesystem::path& target) {
    std::error_code ignored;
    if (std::filesystem::is_directory(target, ignored)) {
      throw OutputError("cannot write " + target.string() + ": it is a folder");
    }
  }

  [[nodiscard]] std::filesystem::path partial(const std::string& name) const { return folder_ / (name + ".partial"); }

  static std::filesystem::path moved(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::error_code error;
    std::filesystem::rename(from, to, error);
    if (error) throw OutputError("cannot write " + to.string() + ": " + error.message());
    return to;
  }

  /// Creates a folder and those it is in.
  void create(const std::filesystem::path& folder) {
    std::filesystem::path existing = std::filesystem::absolute(folder).lexically_normal();
    std::error_code error;
    std::vector<std::filesystem::path> missing;
    while (!std::filesystem::exists(existing, error) && !error) {
      missing.push_back(existing);
      existing = existing.parent_path();
    }
    created_.insert(created_.begin(), missing.begin(), missing.end());
    std::filesystem::create_directories(folder, error);
    if (error) {
      undo();
      throw OutputError("cannot write to " + folder_.string() + ": " + error.message());
    }
  }

  /// Folders that are not empty stay.
  void undo() noexcept {
    std::error_code ignored;
    if (std::exchange(is_staging_, false)) std::filesystem::remove_all(staging_, ignored);
    for (const std::filesystem::path& folder : created_) std::filesystem::remove(folder, ignored);
    created_.clear();
  }

  std::filesystem::path folder_;
  std::filesystem::path staging_;
  std::vector<std::filesystem::path> created_;  // the deepest first
  std::vector<std::string> growing_;
  bool is_staging_ = false;
};

}  // namespace examples
