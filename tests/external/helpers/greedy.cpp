// Wants as many bytes as it is told, and answers with "ok".
#include <cstdlib>
#include <vector>

#include "helpers/serve.h"

int main() {
  return swage::serve([](std::string_view message) -> std::string {
    const std::vector<char> bytes(std::strtoull(std::string(message).c_str(), nullptr, 10), 1);
    return bytes.back() == 1 ? "ok" : "";
  });
}
