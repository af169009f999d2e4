// Bad input, and what is said of it.
#pragma once

#include <gmock/gmock.h>

#include <string>

#include "swage/error.h"

namespace swage::test {

template <typename Call>
void expect_refused(const Call& call, const std::string& words) {
  EXPECT_THAT(call, testing::ThrowsMessage<InvalidInput>(testing::HasSubstr(words)));
}

}  // namespace swage::test
