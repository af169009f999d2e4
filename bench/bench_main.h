#pragma once

namespace swage::bench {

/// Registers what this program measures: once for each model there is.
void register_all();

}  // namespace swage::bench
