// Chains of vertices that stay straight.
#include "scanner.h"
#include "swage/handles.h"

namespace swage {

std::vector<std::vector<int>> read_straight_chains(const std::filesystem::path& path, int vertex_count) {
  const Input input = slurp(path);
  require_text(input);
  Scanner scan(input, text_begin(input));
  std::vector<std::vector<int>> chains;
  for (; !scan.at_end(); scan.skip_line()) {
    std::vector<int> chain;
    while (!scan.at_line_end()) {
      const size_t begin = scan.at();
      const long long vertex = scan.integer("a vertex number");
      if (vertex < 0 || vertex >= vertex_count) {
        refuse(input, begin,
               "vertex " + std::to_string(vertex) + " is not there: they run from 0 to " +
                   std::to_string(vertex_count - 1) + "; is it a chain of another mesh?");
      }
      if (!chain.empty() && chain.back() == vertex) {
        refuse(input, begin, "vertex " + std::to_string(vertex) + " comes twice in a row; keep one");
      }
      chain.push_back(static_cast<int>(vertex));
    }
    if (!chain.empty()) chains.push_back(std::move(chain));
  }
  return chains;
}

}  // namespace swage
