#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "incognita/io/atomic_file.hpp"
#include "file_size_limit.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::content_of;
using io_test::refusal;

namespace {

std::string write_refusal(const std::filesystem::path& path, const std::string& content) {
  return refusal([&] {
    write_file_atomically(path, content);
    return 0;
  });
}

}  // namespace

TEST_CASE("a file is written, then replaced, and nothing else is left") {
  const io_test::TemporaryFolder folder;
  const std::string bytes("a\0b\r\n", 5);
  write_file_atomically(folder / "file", bytes);
  CHECK(content_of(folder / "file") == bytes);
  write_file_atomically(folder / "file", "");
  CHECK(content_of(folder / "file").empty());
  CHECK(folder.names() == std::vector<std::string>{"file"});
}

TEST_CASE("a write that fails half way leaves the old file and nothing else") {
  const io_test::TemporaryFolder folder;
  const auto file = folder.with("file", "old");
  std::string message;
  {
    const io_test::FileSizeLimit limit(1000);
    message = write_refusal(file, std::string(100000, 'x'));
  }
  CHECK_THAT(message, Contains("cannot be written: File too large"));
  CHECK(content_of(file) == "old");
  CHECK(folder.names() == std::vector<std::string>{"file"});
}

TEST_CASE("another writer's partial file is not touched") {
  const io_test::TemporaryFolder folder;
  const auto partial = folder.with("file.partial0", "theirs");
  write_file_atomically(folder / "file", "ours");
  CHECK(content_of(partial) == "theirs");
  CHECK(content_of(folder / "file") == "ours");
  CHECK(folder.names().size() == 2);
}

TEST_CASE("places that cannot be written are refused") {
  const io_test::TemporaryFolder folder;
  CHECK_THAT(write_refusal(folder.path(), "x"), Contains("not a regular file"));
  CHECK_THAT(write_refusal("/dev/null", "x"), Contains("not a regular file"));
  CHECK_THAT(write_refusal(folder / "missing/file", "x"), Contains("No such file"));
  CHECK_THAT(write_refusal(folder.with("file", "") / "below", "x"), Contains("Not a directory"));
  CHECK_THAT(write_refusal("/proc/incognita", "x"), Contains("cannot be written"));
  CHECK_THAT(write_refusal("", "x"), Contains("cannot be written"));
}
