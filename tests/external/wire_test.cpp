#include "helpers/wire.h"

#include <gtest/gtest.h>

#include <limits>

namespace swage {
namespace {

const std::vector<double> kNumbers{1.5, -0.0, 1e300};
const std::vector<std::int32_t> kIndices{7, -1, 2, 3};

std::string message() { return wire::Writer().add(kNumbers).add(kIndices).take(); }

/// All of it, or Malformed.
void read(std::string_view text) {
  wire::Reader reader(text);
  EXPECT_EQ(reader.read<double>(3), kNumbers);
  EXPECT_EQ(reader.read<std::int32_t>(2), kIndices);
  reader.finish();
}

TEST(Wire, ReadsWhatWasWritten) {
  read(message());
  const std::string empty = wire::Writer().add(std::vector<double>()).take();
  EXPECT_TRUE(wire::Reader(empty).read<double>(3).empty());
}

TEST(Wire, RefusesEveryCutAndEveryAddition) {
  const std::string whole = message();
  for (size_t length = 0; length < whole.size(); ++length) {
    EXPECT_THROW(read(std::string_view(whole).substr(0, length)), wire::Malformed) << length;
  }
  EXPECT_THROW(read(whole + '\0'), wire::Malformed);
  EXPECT_THROW(read('x' + whole), wire::Malformed);
}

TEST(Wire, RefusesAbsurdCounts) {
  for (const std::int64_t count :
       {std::int64_t{-1}, std::int64_t{4}, std::int64_t{1} << 61, std::numeric_limits<std::int64_t>::min(),
        std::numeric_limits<std::int64_t>::max()}) {
    std::string text(wire::kMark);
    text.append(reinterpret_cast<const char*>(&count), sizeof count).append(24, 'x');
    EXPECT_THROW(wire::Reader(text).read<double>(), wire::Malformed) << count;
  }
}

TEST(Wire, RefusesHalfARow) {
  const std::string text = wire::Writer().add(kIndices).take();
  EXPECT_THROW(wire::Reader(text).read<std::int32_t>(3), wire::Malformed);
}

}  // namespace
}  // namespace swage
