// Answers without end.
#include <cstdio>
#include <string>

int main() {
  const std::string much(1 << 16, 'x');
  while (std::fwrite(much.data(), 1, much.size(), stdout) > 0) {
  }
}
