/// Compiled with the flags of the consumer that asked for no OpenMP.
#include <incognita/core/parallel.hpp>

#ifdef _OPENMP
#error "OpenMP is on although INCOGNITA_WITH_OPENMP is OFF"
#endif
