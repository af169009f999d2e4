// Fills every pipe before it reads, then answers with how much it was told.
#include <cstdio>
#include <string>

int main() {
  const std::string much(1 << 20, 'x');
  std::fwrite(much.data(), 1, much.size(), stdout);
  std::fflush(stdout);
  std::fwrite(much.data(), 1, much.size(), stderr);
  size_t count = 0;
  while (std::getchar() != EOF) ++count;
  std::printf("%zu", count);
}
