// The most memory that this process held.
#pragma once

namespace swage::bench {

/// Counts anew from what is held now. Does nothing where the system does not permit it: the peak then is that of the
/// whole process so far.
void reset_peak_memory();
/// In MB (1e6 bytes), code and libraries included; 0 where the system does not tell.
double peak_memory();

}  // namespace swage::bench
