#include "process.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <latch>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

#include "failure.h"

namespace swage::cli {
namespace {

void fill_closed_streams() {
  // Not to be written to: what is printed there is to fail as it would.
  int descriptor = 0;
  while (descriptor >= 0 && descriptor <= STDERR_FILENO) descriptor = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (descriptor >= 0) close(descriptor);
}

/// A destructor, or a library in C++, that runs out of memory.
[[noreturn]] void tell_and_end() {
  try {
    if (std::current_exception()) throw;
  } catch (const std::bad_alloc&) {
    for (const char* part : {"swage: error: ", kOutOfMemory, "\n"}) {
      if (::write(STDERR_FILENO, part, std::strlen(part)) < 0) break;
    }
    _exit(exit_failed);
  } catch (...) {
  }
  std::abort();
}

}  // namespace

void prepare_process() {
  fill_closed_streams();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(tell_and_end);
}

int startable_threads(int wanted) {
  std::latch end(1);
  std::vector<std::thread> threads;
  try {
    threads.reserve(static_cast<size_t>(wanted));
    while (static_cast<int>(threads.size()) + 1 < wanted) threads.emplace_back([&] { end.wait(); });
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  end.count_down();
  for (std::thread& thread : threads) thread.join();
  return 1 + static_cast<int>(threads.size());
}

}  // namespace swage::cli
