#include <atomic>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/core/parallel.hpp"

using namespace incognita;

TEST_CASE("A loop calls each index once, with a worker in range", "[core]") {
  for (const int threads : {0, 1, 2, 4}) {
    const int workers = worker_count(threads);
    REQUIRE(workers >= 1);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{1000}}) {
      std::vector<int> calls(count, 0);
      std::atomic<int> bad_workers{0};
      for_each_index(count, threads, [&](std::size_t index, int worker) {
        ++calls[index];
        if (worker < 0 || worker >= workers) ++bad_workers;
      });
      REQUIRE(calls == std::vector<int>(count, 1));
      REQUIRE(bad_workers == 0);
    }
  }
}

TEST_CASE("Two bodies never share a worker at the same time", "[core]") {
  for (const int threads : {2, 4}) {
    std::vector<std::atomic<int>> busy(static_cast<std::size_t>(worker_count(threads)));
    std::atomic<int> clashes{0};
    for_each_index(2000, threads, [&](std::size_t, int worker) {
      auto& mine = busy[static_cast<std::size_t>(worker)];
      if (mine.fetch_add(1) != 0) ++clashes;
      mine.fetch_sub(1);
    });
    REQUIRE(clashes == 0);
  }
}

TEST_CASE("Of several exceptions the one of the lowest index comes out", "[core]") {
  for (const int threads : {1, 2, 4}) {
    try {
      for_each_index(200, threads, [](std::size_t index, int) {
        if (index % 50 == 17) throw std::runtime_error(std::to_string(index));
      });
      FAIL("no exception came out");
    } catch (const std::runtime_error& error) {
      REQUIRE(std::string(error.what()) == "17");
    }
    std::atomic<int> calls{0};
    for_each_index(10, threads, [&](std::size_t, int) { ++calls; });
    REQUIRE(calls == 10);
  }
}
