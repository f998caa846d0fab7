/// Units on all threads and ranks, each given out once, to whoever is free.
#pragma once

#include <atomic>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "experiment/ranks.hpp"

namespace experiment {

/// What is done with units: run(number) gives a row, and is called from many threads; done(number, row) keeps it, one call after the other.
struct Work {
  std::vector<std::size_t> units;  ///< their numbers, in the order that they are given out in
  std::function<std::string(std::size_t)> run;
  std::function<void(std::size_t, const std::string&)> done;
};

namespace detail {

/// How long who waits for a message sleeps: MPI itself would wait at full speed, on a core that a mission could use.
inline constexpr std::chrono::milliseconds nap{2};

/// Waits until there is one.
[[nodiscard]] inline Ranks::Message next_message(const Ranks& ranks) {
  for (;;) {
    if (auto message = ranks.received()) return std::move(*message);
    std::this_thread::sleep_for(nap);
  }
}

/// Gives units out and takes rows, from any thread. After a row that could not be kept there are no more units.
class Desk {
 public:
  explicit Desk(const Work& work) : work_(work) {}

  /// The next unit's number; none when there are no more.
  [[nodiscard]] std::optional<std::size_t> next() {
    const std::lock_guard lock(mutex_);
    if (failure_ || next_ == work_.units.size()) return std::nullopt;
    return work_.units[next_++];
  }

  void take(std::size_t unit, const std::string& row) {
    const std::lock_guard lock(mutex_);
    if (failure_) return;
    try {
      work_.done(unit, row);
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  /// No more units, for this reason.
  void close(const std::string& reason) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::make_exception_ptr(std::runtime_error(reason));
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  const Work& work_;
  std::mutex mutex_;
  std::size_t next_ = 0;
  std::exception_ptr failure_;
};

/// Messages are "UNIT" or, without one, "" to a rank, and from it first who it is, and then "UNIT ROW".
[[nodiscard]] inline std::pair<std::size_t, std::string> unit_and_rest(const std::string& message) {
  std::size_t unit = 0;
  const char* const end = message.data() + message.size();
  const char* const rest = std::from_chars(message.data(), end, unit).ptr;
  return {unit, rest == end ? "" : std::string(rest + 1, end)};
}

}  // namespace detail

/// Rank 0: gives the units to its own threads and to the other ranks, until all are done; `myself` is what each of them must say that it is.
/// Throws what done() throws, and std::runtime_error for a rank that is something else, after the units that are under way.
inline void give_out(const Work& work, const Ranks& ranks, const std::string& myself, int threads) {
  detail::Desk desk(work);
  std::atomic<int> at_work = threads;
  std::vector<std::thread> workers;
  for (int n = 0; n < threads; ++n) {
    workers.emplace_back([&] {
      while (const auto unit = desk.next()) desk.take(*unit, work.run(*unit));
      --at_work;
    });
  }
  std::set<int> known;
  for (int others = ranks.count() - 1; others > 0 || at_work > 0;) {
    const auto message = ranks.received();
    if (!message) {
      std::this_thread::sleep_for(detail::nap);
      continue;
    }
    if (!known.insert(message->from).second) {
      const auto [unit, row] = detail::unit_and_rest(message->text);
      desk.take(unit, row);
    } else if (message->text != myself) {
      desk.close("rank " + std::to_string(message->from) + " cannot take part: " + message->text);
    }
    const auto unit = desk.next();
    ranks.send(message->from, unit ? std::to_string(*unit) : "");
    if (!unit) --others;
  }
  for (std::thread& worker : workers) worker.join();
  desk.rethrow();
}

/// Rank 0, where there is nothing to do: lets the others go.
inline void send_home(const Ranks& ranks) {
  for (int others = ranks.count() - 1; others > 0; --others) ranks.send(detail::next_message(ranks).from, "");
}

/// Any other rank: says who it is, and runs what rank 0 gives it, one unit at a time.
inline void work_for_rank_0(const std::string& myself, const std::function<std::string(std::size_t)>& run, const Ranks& ranks) {
  ranks.send(0, myself);
  for (;;) {
    const Ranks::Message message = detail::next_message(ranks);
    if (message.text.empty()) return;
    const std::size_t unit = detail::unit_and_rest(message.text).first;
    ranks.send(0, std::to_string(unit) + ' ' + run(unit));
  }
}

}  // namespace experiment
