#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "incognita/io/read_file.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

TEST_CASE("read_file gives every byte of a file") {
  const io_test::TemporaryFolder folder;
  std::string content;
  for (int i = 0; i < 1000; ++i) content += static_cast<char>(i % 256);
  CHECK(read_file(folder.with("bytes", content), 1000) == content);
  CHECK(read_file(folder.with("empty", ""), 0).empty());
}

TEST_CASE("read_file refuses what is no readable file of a fitting size") {
  const io_test::TemporaryFolder folder;
  const auto file = folder.with("file", "12345");
  CHECK_THAT(refusal([&] { return read_file(file, 4); }), Contains("has 5 bytes") && Contains("at most 4"));
  CHECK_THAT(refusal([&] { return read_file(folder / "missing", 9); }), Contains("there is no such file"));
  CHECK_THAT(refusal([&] { return read_file(folder.path(), 9); }), Contains("is a folder"));
  CHECK_THAT(refusal([&] { return read_file(file / "below", 9); }), Contains("below"));
  CHECK_THAT(refusal([] { return read_file("/dev/zero", 9); }), Contains("not a regular file"));
  CHECK_THAT(refusal([] { return read_file(std::string(300, 'x'), 9); }), Contains("too long"));
  CHECK_THAT(refusal([] { return read_file("", 9); }), Contains("no such file"));
  if (geteuid() != 0) {
    std::filesystem::permissions(file, std::filesystem::perms::none);
    CHECK_THAT(refusal([&] { return read_file(file, 9); }), Contains("cannot be opened"));
  }
}
