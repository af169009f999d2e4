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
  auto type = [&](const std::string& of, const std::string& name) { text << "typedef " << of << ' ' << name << ";\n"; };
  auto define = [&](const std::string& name, const auto& as) { text << "#define " << name << ' ' << as << '\n'; };
  type(scalar, "scalar");
  type(scalar + '4', "scalar4");
  type(host, "host_scalar");
  type(host + '4', "host_scalar4");
  type(scalar + lanes, "lanes");
  type(host + lanes, "wide");
  type("int" + lanes, "lane_index");
  // Comparing vectors gives integers of the scalar's size.
  type((alone || single ? "int" : "long") + lanes, "lane_mask");
  define("to_scalar4", "convert_" + scalar + '4');
  define("to_host4", "convert_" + host + '4');
  define("to_lanes", "convert_" + scalar + lanes);
  define("to_wide", "convert_" + host + lanes);
  define("HOST_IS_EXACT", host == "double" ? 1 : 0);
  define("LANES", arithmetic.lanes);
  define("GROUP", kGroup);
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
