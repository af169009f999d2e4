// Crashes, having said where.
#include <csignal>
#include <cstdio>

int main() {
  std::fputs("first line\nin the middle of it\n", stderr);
  return std::raise(SIGSEGV);
}
