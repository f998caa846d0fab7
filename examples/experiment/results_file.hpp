/// The rows of a study, one line of JSON a finished unit, in a file that only grows.
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incognita/io/read_file.hpp"
#include "support/output_folder.hpp"

namespace experiment {

/// A file descriptor that is closed in the end.
class Descriptor {
 public:
  /// As open(2), -1 included.
  Descriptor(const std::filesystem::path& file, int flags) : descriptor_(::open(file.c_str(), flags | O_CLOEXEC, 0644)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  [[nodiscard]] int get() const { return descriptor_; }

 private:
  int descriptor_;
};

/// Locks a study's folder against other processes; the lock ends with the process, however it ends.
class FolderLock {
 public:
  /// Throws OutputError when another process has it.
  explicit FolderLock(const std::filesystem::path& folder) : file_(folder / "lock", O_RDWR | O_CREAT) {
    if (file_.get() < 0) throw examples::OutputError("cannot write to " + folder.string() + ": " + std::strerror(errno));
    if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) {
      throw examples::OutputError(folder.string() + " is in use: another process writes a study there");
    }
  }

 private:
  Descriptor file_;
};

/// Appends lines to a file, each of them on the disk before append() returns. A line that was cut off, by a kill or a full disk, is taken off
/// when the file is opened again.
class ResultsFile {
 public:
  /// Throws OutputError when the file cannot be written.
  explicit ResultsFile(std::filesystem::path file) : path_(std::move(file)), file_(path_, O_RDWR | O_CREAT | O_APPEND) {
    if (file_.get() < 0) fail();
    const std::string content = incognita::read_file(path_, std::numeric_limits<std::size_t>::max());
    size_ = static_cast<off_t>(content.rfind('\n') + 1);  // npos + 1 is 0
    if (static_cast<std::size_t>(size_) < content.size() && ::ftruncate(file_.get(), size_) != 0) fail();
    for (std::string_view unread(content.data(), static_cast<std::size_t>(size_)); !unread.empty();) {
      const std::size_t end = unread.find('\n');
      lines_.emplace_back(unread.substr(0, end));
      unread.remove_prefix(end + 1);
    }
  }

  /// Those that were there when it was opened.
  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }

  /// Throws OutputError when the disk does not take all of it; the file is then as it was.
  void append(std::string line) {
    line += '\n';
    for (std::size_t written = 0; written < line.size();) {
      const ssize_t count = ::write(file_.get(), line.data() + written, line.size() - written);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) {
        const int cause = errno;
        if (::ftruncate(file_.get(), size_) != 0) errno = cause;
        errno = cause;
        fail();
      }
      written += static_cast<std::size_t>(count);
    }
    if (::fdatasync(file_.get()) != 0) fail();
    size_ += static_cast<off_t>(line.size());
  }

 private:
  [[noreturn]] void fail() const { throw examples::OutputError("cannot write " + path_.string() + ": " + std::strerror(errno)); }

  std::filesystem::path path_;
  Descriptor file_;
  off_t size_ = 0;
  std::vector<std::string> lines_;
};

}  // namespace experiment
