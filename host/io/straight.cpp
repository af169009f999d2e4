// Chains of vertices that stay straight.
#include <algorithm>
#include <string>

#include "scanner.h"
#include "swage/error.h"
#include "swage/handles.h"

namespace swage {
namespace {

std::string line_of(const std::vector<int>& chain, size_t number) {
  const bool repeats = std::adjacent_find(chain.begin(), chain.end()) != chain.end();
  if (chain.empty() || repeats || *std::min_element(chain.begin(), chain.end()) < 0) {
    throw InvalidInput("write_straight_chains: chains: chain " + std::to_string(number) +
                       " is empty, holds a negative index or visits a vertex twice in a row; mend or remove it");
  }
  std::string line;
  for (const int vertex : chain) line += std::to_string(vertex) + ' ';
  line.back() = '\n';
  return line;
}

}  // namespace

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

void write_straight_chains(const std::filesystem::path& path, const std::vector<std::vector<int>>& chains) {
  std::string text;
  for (size_t c = 0; c < chains.size(); ++c) text += line_of(chains[c], c);
  write_file(path, text);
}

}  // namespace swage
