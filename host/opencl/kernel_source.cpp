#include "kernel_source.h"

#include <set>
#include <sstream>

namespace swage {
namespace {

constexpr std::string_view kInclude = "#include \"";

class Assembler {
 public:
  void add(const std::string& path, std::string_view text) {
    source_ << "#line 1 \"kernels/" << path << "\"\n";
    std::istringstream lines{std::string(text)};
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      if (!line.starts_with(kInclude)) {
        source_ << line << '\n';
        continue;
      }
      add_once(line.substr(kInclude.size(), line.rfind('"') - kInclude.size()));
      source_ << "#line " << number + 1 << " \"kernels/" << path << "\"\n";
    }
  }

  std::ostringstream& source() { return source_; }

 private:
  void add_once(const std::string& path) {
    if (included_.insert(path).second) add(path, kernel_file(path));
  }

  std::set<std::string> included_;
  std::ostringstream source_;
};

std::string types(const Arithmetic& arithmetic) {
  const bool single = arithmetic.precision == Precision::single;
  const std::string scalar = single ? "float" : "double", width = std::to_string(arithmetic.lanes);
  const std::string of_lanes = arithmetic.lanes == 1 ? "" : width;
  // Comparing vectors gives integers of the scalar's size.
  const std::string mask = arithmetic.lanes == 1 || single ? "int" : "long";
  return (single ? "" : "#pragma OPENCL EXTENSION cl_khr_fp64 : enable\n") + ("typedef " + scalar + " scalar;\n") +
         "typedef " + scalar + "4 scalar4;\n" + "typedef " + scalar + of_lanes + " lanes;\n" + "typedef " + mask +
         of_lanes + " lane_mask;\n" + "#define LANES " + width + '\n';
}

}  // namespace

std::string program_source(const std::string& stem, const Arithmetic& arithmetic) {
  return program_source(stem + ".cl", kernel_file(stem + ".cl"), arithmetic);
}

std::string program_source(const std::string& name, std::string_view text, const Arithmetic& arithmetic) {
  Assembler assembler;
  assembler.source() << types(arithmetic) << "#pragma OPENCL FP_CONTRACT OFF\n";
  assembler.add(name, text);
  return assembler.source().str();
}

}  // namespace swage
