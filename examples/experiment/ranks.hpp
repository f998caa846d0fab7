/// The processes that mpirun has started for one study; one alone without it.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

#if defined(INCOGNITA_HAS_MPI)
#include <mpi.h>
#endif

namespace experiment {

/// Texts that ranks send each other: rank 0 numbers of units, the others rows. Without Open MPI, or not started by it, there is
/// rank 0 alone, and nothing of MPI is called. Made once a process, and used by the thread that has made it.
class Ranks {
 public:
  struct Message {
    int from;
    std::string text;
  };

#if defined(INCOGNITA_HAS_MPI)
  static constexpr bool can_be_many = true;

  Ranks() : is_started_(std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr) {
    if (!is_started_) return;
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
  }
  ~Ranks() {
    if (is_started_) MPI_Finalize();
  }

  /// May wait until `to` receives it: long texts are not kept.
  void send(int to, const std::string& text) const {
    MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, to, 0, MPI_COMM_WORLD);
  }

  /// A message that has arrived, from anybody; none when there is none yet.
  [[nodiscard]] std::optional<Message> received() const {
    if (!is_started_) return std::nullopt;
    int is_there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &is_there, &status);
    if (is_there == 0) return std::nullopt;
    int size = 0;
    MPI_Get_count(&status, MPI_CHAR, &size);
    Message message{status.MPI_SOURCE, std::string(static_cast<std::size_t>(size), '\0')};
    MPI_Recv(message.text.data(), size, MPI_CHAR, status.MPI_SOURCE, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return message;
  }
#else
  static constexpr bool can_be_many = false;

  Ranks() = default;
  void send(int /*to*/, const std::string& /*text*/) const {}
  [[nodiscard]] std::optional<Message> received() const { return std::nullopt; }
#endif

  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int count() const { return count_; }

 private:
#if defined(INCOGNITA_HAS_MPI)
  bool is_started_ = false;
#endif
  int rank_ = 0;
  int count_ = 1;
};

}  // namespace experiment
