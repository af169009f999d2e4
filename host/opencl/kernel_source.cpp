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
  const bool single = arithmetic.precision == Precision::single, alone = arithmetic.lanes == 1;
  const std::string scalar = single ? "float" : "double", host = arithmetic.host_doubles ? "double" : scalar;
  const std::string lanes = alone ? "" : std::to_string(arithmetic.lanes);
  std::ostringstream text;
  if (scalar == "double" || host == "double") text << "#pragma OPENCL EXTENSION cl_khr_fp64 : enable\n";
  text << "typedef " << scalar << " scalar;\ntypedef " << scalar << "4 scalar4;\n"
       << "typedef " << host << " host_scalar;\ntypedef " << host << "4 host_scalar4;\n"
       << "#define to_scalar4 convert_" << scalar << "4\n#define to_host4 convert_" << host << "4\n"
       << "#define HOST_IS_EXACT " << (host == "double") << '\n'
       << "#define LANES " << arithmetic.lanes << "\n#define GROUP " << kGroup << '\n'
       << "typedef " << scalar << lanes << " lanes;\ntypedef " << host << lanes << " host_lanes;\n"
       << "#define to_lanes convert_" << scalar << lanes << "\n#define to_host_lanes convert_" << host << lanes << '\n'
       << "typedef int" << lanes
       << " lane_index;\n"
       // Comparing vectors gives integers of the scalar's size.
       << "typedef " << (alone || single ? "int" : "long") << lanes << " lane_mask;\n";
  return text.str();
}

}  // namespace

int lanes_of(std::string_view stem) { return stem == "transform" ? 8 : 16; }

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
