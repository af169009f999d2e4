// Results as they once were.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "cases.h"
#include "places.h"

namespace swage::test {
namespace {

const char* const kRenew = "SWAGE_RENEW_GOLDEN";

std::filesystem::path path_of(const Case& of) { return std::filesystem::path(SWAGE_GOLDEN) / (of.name + ".txt"); }

#ifdef NDEBUG
const char* const kBuild = "Release";
#else
const char* const kBuild = "Debug";
#endif

void write(const Case& of, const Positions& rows) {
  std::string text = "# Made by stable_tests: " + of.name + " of tests/stable/cases.cpp, reference backend; GCC " +
                     __VERSION__ + ", " + kBuild + ". " + kRenew + "=1 makes it anew.\n";
  for (const auto& row : rows.rowwise()) {
    char line[100];
    std::snprintf(line, sizeof line, "%a %a %a\n", row[0], row[1], row[2]);
    text += line;
  }
  write_text(path_of(of), text);
}

Positions read(const Case& of) {
  std::istringstream text(read_text(path_of(of)));
  std::string line, number;
  std::getline(text, line);
  std::vector<double> numbers;
  while (text >> number) numbers.push_back(std::strtod(number.c_str(), nullptr));
  return Eigen::Map<const Positions>(numbers.data(), static_cast<Eigen::Index>(numbers.size() / 3), 3);
}

class Golden : public testing::TestWithParam<Case> {};

/// To 1e-9 D, not to the last digit: compilers order sums differently, and machines have other mathematical functions
/// and linear algebra.
TEST_P(Golden, IsAsItWas) {
  const Case& of = GetParam();
  const Positions now = of.solved();
  const char* const renew = std::getenv(kRenew);
  if (renew != nullptr && std::string(renew) == "1") {
    write(of, now);
    GTEST_SKIP() << path_of(of) << " is made anew";
  }
  ASSERT_TRUE(std::filesystem::exists(path_of(of))) << path_of(of) << ": " << kRenew << "=1 makes it";
  const Positions before = read(of);
  ASSERT_EQ(before.rows(), now.rows());
  const double off = apart(of, before, now);
  EXPECT_LE(off, of.golden) << "D from " << path_of(of) << "; where that is meant, " << kRenew << "=1 makes it anew";
}

std::vector<Case> kept() {
  std::vector<Case> all;
  for (const Case& of : cases()) {
    if (of.golden > 0) all.push_back(of);
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Of, Golden, testing::ValuesIn(kept()), name_of);

}  // namespace
}  // namespace swage::test
