// Fails in words. What it prints is no answer.
#include <cstdio>
#include <stdexcept>

#include "helpers/serve.h"

int main() {
  return swage::serve([](std::string_view) -> std::string {
    std::puts("chatter");
    throw std::runtime_error("triangles 3 and 7 cross");
  });
}
