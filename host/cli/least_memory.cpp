#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>

#include "failure.h"

namespace {

/// With less OpenBLAS waits for ever as it is loaded or unloaded, and OpenCL's drivers abort.
constexpr size_t kLeastMemory = size_t{320} << 20;

void refuse_little_memory(int /*argc*/, char** /*argv*/, char** /*environment*/) {
  void* room = mmap(nullptr, kLeastMemory, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room != MAP_FAILED) {
    munmap(room, kLeastMemory);
    return;
  }
  constexpr char kTold[] =
      "swage: error: out of memory: less than 320 MiB can be had; raise the limit (ulimit -v, -d)\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kTold, sizeof(kTold) - 1);
  _exit(swage::cli::exit_failed);
}

/// Runs before the constructors of all libraries; main does not.
[[gnu::section(".preinit_array"), gnu::used]] void (*const kFirst)(int, char**, char**) = refuse_little_memory;

}  // namespace
