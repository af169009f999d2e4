// Answers with what it is told.
#include "helpers/serve.h"

int main() {
  return swage::serve([](std::string_view message) { return std::string(message); });
}
