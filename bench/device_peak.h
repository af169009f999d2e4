// What a device's arithmetic can do.
#pragma once

#include "kernel.h"

namespace swage::bench {

/// Products and sums a second in the context's precision, each counted: the best of a few runs, measured once.
double peak_flops(const Queue& queue);

}  // namespace swage::bench
