// What OpenBLAS and OpenCL's drivers do badly where memory is limited, as they are loaded: seen to before that.
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <climits>
#include <cstddef>
#include <string_view>
#include <vector>

#include "failure.h"

namespace {

/// With less OpenBLAS waits for ever as it is loaded or unloaded, and OpenCL's drivers abort.
constexpr size_t kLeastMemory = size_t{320} << 20;

void refuse_little_memory() {
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

bool is_memory_limited() {
  for (const auto kind : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (getrlimit(kind, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) return true;
  }
  return false;
}

/// OpenBLAS begins a thread for each core, and ends the program where there is no room for so many. We call it from
/// one. It goes by the environment that the program began with: the program begins again.
void have_one_blas_thread(char** argv, char** environment) {
  constexpr std::string_view kThreads = "OPENBLAS_NUM_THREADS=";
  char one[] = "OPENBLAS_NUM_THREADS=1";
  std::vector<char*> with_it = {one};
  for (; *environment != nullptr; ++environment) {
    if (std::string_view(*environment).starts_with(kThreads)) return;
    with_it.push_back(*environment);
  }
  with_it.push_back(nullptr);
  std::array<char, PATH_MAX> program{};
  if (readlink("/proc/self/exe", program.data(), program.size() - 1) > 0) execve(program.data(), argv, with_it.data());
}

void before_libraries(int /*argc*/, char** argv, char** environment) {
  refuse_little_memory();
  if (is_memory_limited()) have_one_blas_thread(argv, environment);
}

/// Runs before the constructors of all libraries; main does not.
[[gnu::section(".preinit_array"), gnu::used]] void (*const kFirst)(int, char**, char**) = before_libraries;

}  // namespace
