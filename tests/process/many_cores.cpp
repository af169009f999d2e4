// Preloaded into the program: the machine seems to have 64 cores.
#include <dlfcn.h>
#include <sched.h>
#include <unistd.h>

#include <cstddef>

#pragma GCC visibility push(default)
extern "C" {

long sysconf(int what) noexcept {
  if (what == _SC_NPROCESSORS_CONF || what == _SC_NPROCESSORS_ONLN) return 64;
  static const auto real = reinterpret_cast<long (*)(int)>(dlsym(RTLD_NEXT, "sysconf"));
  return real(what);
}

int sched_getaffinity(pid_t, std::size_t bytes, cpu_set_t* cores) noexcept {
  CPU_ZERO_S(bytes, cores);
  for (std::size_t core = 0; core < 64; ++core) CPU_SET_S(core, bytes, cores);
  return 0;
}

}  // extern "C"
#pragma GCC visibility pop
