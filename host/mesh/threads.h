// How many threads share out a loop.
#pragma once

#ifdef _OPENMP
#include <omp.h>
#endif

namespace swage {

/// Results must not depend on it.
inline int most_threads() {
#ifdef _OPENMP
  return omp_get_max_threads();
#else
  return 1;
#endif
}

}  // namespace swage
