#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "incognita/io/output_folder.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

std::string check_refusal(const std::filesystem::path& path) {
  return refusal([&] {
    check_output_folder(path);
    return 0;
  });
}

std::string create_refusal(const std::filesystem::path& path) {
  return refusal([&] {
    create_output_folder(path);
    return 0;
  });
}

}  // namespace

TEST_CASE("the check makes nothing, the creation all of it") {
  const io_test::TemporaryFolder folder;
  for (const char* name : {"new", "new/", "a/b/c", "./d/../e"}) {
    CAPTURE(name);
    check_output_folder(folder / name);
    CHECK(folder.names().empty());
  }
  check_output_folder(folder.path());
  CHECK(folder.names().empty());

  create_output_folder(folder / "a/b/c/");
  CHECK(folder.names() == std::vector<std::string>{"a", "a/b", "a/b/c"});
  create_output_folder(folder / "a/b/c");
  check_output_folder(folder / "a/b/c");
  CHECK(folder.names().size() == 3);
}

TEST_CASE("a folder named relative to the working folder") {
  const io_test::TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  check_output_folder("out");
  CHECK(folder.names().empty());
  create_output_folder("out");
  check_output_folder(".");
  std::filesystem::current_path(before);
  CHECK(folder.names() == std::vector<std::string>{"out"});
}

TEST_CASE("folders that cannot be written are refused and leave nothing behind") {
  const io_test::TemporaryFolder folder;
  const auto file = folder.with("file.txt", "x");
  std::filesystem::create_symlink(folder / "nowhere", folder / "link");
  const std::vector<std::filesystem::path> bad{"",
                                               file,
                                               file / "below",
                                               file / "far/below",
                                               "/dev/null",
                                               "/dev/null/x",
                                               "/proc/x",
                                               "/proc/x/y",
                                               folder / "link",
                                               folder / ("a/b/" + std::string(300, 'x'))};
  for (const auto& path : bad) {
    CAPTURE(path);
    CHECK_THAT(check_refusal(path), Contains("output folder"));
    CHECK_THAT(create_refusal(path), Contains("output folder"));
  }
  CHECK_THAT(check_refusal(file / "below"), Contains("file.txt is not a folder"));
  CHECK(folder.names() == std::vector<std::string>{"file.txt", "link"});
  // Existing folders in which even root can make no file.
  CHECK_THAT(check_refusal("/proc"), Contains("output folder"));
  if (geteuid() != 0) {
    std::filesystem::create_directory(folder / "locked");
    std::filesystem::permissions(folder / "locked", std::filesystem::perms::owner_read);
    CHECK_THAT(check_refusal(folder / "locked"), Contains("output folder"));
    std::filesystem::permissions(folder / "locked", std::filesystem::perms::owner_all);
  }
}

TEST_CASE("a link to a folder is a folder") {
  const io_test::TemporaryFolder folder;
  create_output_folder(folder / "real");
  std::filesystem::create_symlink(folder / "real", folder / "link");
  check_output_folder(folder / "link");
  create_output_folder(folder / "link/deeper");
  CHECK(std::filesystem::is_directory(folder / "real/deeper"));
}
