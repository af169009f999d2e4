#include "peak_memory.h"

#include <fstream>
#include <string>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace swage::bench {

void reset_peak_memory() {
#ifdef __GLIBC__
  malloc_trim(0);  // What was freed but not given back would count.
#endif
  std::ofstream("/proc/self/clear_refs") << 5;
}

double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kibibytes = 0;
    if (word == "VmHWM:" && status >> kibibytes) return kibibytes * 1024 / 1e6;
  }
  return 0;
}

}  // namespace swage::bench
