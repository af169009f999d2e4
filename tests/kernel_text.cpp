// Prints what a device's compiler gets: kernel_text STEM single|double lanes|alone host|apart
#include <cstdio>
#include <string>

#include "kernel_source.h"

int main(int count, char** arguments) {
  if (count != 5) return 2;
  const std::string stem = arguments[1];
  swage::Arithmetic arithmetic;
  if (std::string(arguments[2]) == "single") arithmetic.precision = swage::Precision::single;
  if (std::string(arguments[3]) == "lanes") arithmetic.lanes = swage::lanes_of(stem);
  arithmetic.host_doubles = std::string(arguments[4]) == "host";
  std::fputs(swage::program_source(stem, arithmetic).c_str(), stdout);
  return 0;
}
