/// Loops over threads. The only header that names OpenMP: without it every loop runs on the calling thread.
#pragma once

#include <cstddef>
#include <exception>

#if defined(_OPENMP)
#include <omp.h>
#endif

namespace incognita {

/// The number of threads a loop uses when asked for 0: OpenMP's own limit (OMP_NUM_THREADS), or 1 without OpenMP.
[[nodiscard]] inline int default_thread_count() {
#if defined(_OPENMP)
  return omp_get_max_threads();
#else
  return 1;
#endif
}

/// How many workers `for_each_index` will use for `threads` asked (0: the default): at least 1, and 1 without OpenMP.
[[nodiscard]] inline int worker_count(int threads) {
#if defined(_OPENMP)
  return threads > 0 ? threads : default_thread_count();
#else
  static_cast<void>(threads);
  return 1;
#endif
}

/// Calls body(index, worker) once for each index in [0, count), worker in [0, worker_count(threads)). The order and
/// the worker of an index are free, so a body writes only to what belongs to its index (results) or its worker
/// (scratch). Where bodies throw, the exception of the lowest index is thrown again here.
template <class Body>
void for_each_index(std::size_t count, int threads, Body&& body) {
  const int workers = worker_count(threads);
  if (workers == 1 || count < 2) {
    for (std::size_t index = 0; index < count; ++index) body(index, 0);
    return;
  }
#if defined(_OPENMP)
  std::exception_ptr failure;
  std::size_t failed_index = count;
#pragma omp parallel for schedule(dynamic, 1) num_threads(workers)
  for (std::size_t index = 0; index < count; ++index) {
    try {
      body(index, omp_get_thread_num());
    } catch (...) {
#pragma omp critical(incognita_for_each_index)
      if (index < failed_index) {
        failed_index = index;
        failure = std::current_exception();
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
#endif
}

}  // namespace incognita
