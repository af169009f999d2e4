// What figures depend on.
#pragma once

#include <string>

namespace swage::bench {

/// Its name as the system tells it.
std::string processor();

/// That OpenMP uses.
int threads();

}  // namespace swage::bench
