// Answers with how many descriptors are open beside the standard three.
#include <fcntl.h>

#include <cstdio>

int main() {
  int count = 0;
  for (int number = 3; number < 1000; ++number) count += fcntl(number, F_GETFD) >= 0 ? 1 : 0;
  while (std::getchar() != EOF) {
  }
  std::printf("%d", count);
}
