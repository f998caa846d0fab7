/// What the whole test program allocates by new. Eigen's own allocations do not come by it, but fixed sizes have none.
#pragma once

#include <cstddef>

namespace incognita::test {

[[nodiscard]] std::size_t allocation_count();
[[nodiscard]] std::size_t allocated_bytes();  ///< what was freed since included

}  // namespace incognita::test
