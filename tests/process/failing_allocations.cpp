// Preloaded into the program. Of its allocations of FAIL_SIZE bytes and more, the FAIL_AT-th and all after it fail;
// where there is no FAIL_AT, their number is told at the end. Those of libgomp, which ends the program where one fails,
// do not.
#include <link.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

long number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? 0 : std::atol(text);
}

long first_that_fails, least_size;
std::uintptr_t libgomp_begin, libgomp_end;
std::atomic<long> count{0};

int find_libgomp(dl_phdr_info* library, std::size_t, void*) {
  if (std::strstr(library->dlpi_name, "/libgomp.so") == nullptr) return 0;
  libgomp_begin = library->dlpi_addr;
  for (int i = 0; i < library->dlpi_phnum; ++i) {
    const auto& part = library->dlpi_phdr[i];
    if (part.p_type == PT_LOAD) libgomp_end = libgomp_begin + part.p_vaddr + part.p_memsz;
  }
  return 1;
}

__attribute__((constructor)) void read_environment() {
  first_that_fails = number_in("FAIL_AT");
  least_size = number_in("FAIL_SIZE");
  dl_iterate_phdr(find_libgomp, nullptr);
}

__attribute__((destructor)) void tell() {
  if (first_that_fails == 0 && least_size > 0) std::fprintf(stderr, "allocations: %ld\n", count.load());
}

bool fails(std::size_t size, const void* caller) {
  if (least_size == 0 || static_cast<long>(size) < least_size) return false;
  const auto place = reinterpret_cast<std::uintptr_t>(caller);
  if (place >= libgomp_begin && place < libgomp_end) return false;
  const long number = ++count;
  if (first_that_fails == 0 || number < first_that_fails) return false;
  errno = ENOMEM;
  return true;
}

}  // namespace

#define FAILS(size) fails(size, __builtin_return_address(0))

extern "C" {

void* malloc(std::size_t size) { return FAILS(size) ? nullptr : __libc_malloc(size); }

void* calloc(std::size_t many, std::size_t size) { return FAILS(many * size) ? nullptr : __libc_calloc(many, size); }

void* realloc(void* old, std::size_t size) { return FAILS(size) ? nullptr : __libc_realloc(old, size); }

void* memalign(std::size_t alignment, std::size_t size) {
  return FAILS(size) ? nullptr : __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return FAILS(size) ? nullptr : __libc_memalign(alignment, size);
}

int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  void* const memory = FAILS(size) ? nullptr : __libc_memalign(alignment, size);
  if (memory == nullptr) return ENOMEM;
  *result = memory;
  return 0;
}

}  // extern "C"
