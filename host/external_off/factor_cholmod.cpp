// Stands in for host/external/factor_cholmod.cpp where the build leaves it out.
#include "factor.h"
#include "swage/error.h"

namespace swage {
namespace {

[[noreturn]] void refuse(const char* function) {
  throw Unavailable(std::string(function) + ": this build has no CHOLMOD; configure with -DSWAGE_CHOLMOD=ON");
}

}  // namespace

bool has_cholmod() { return false; }

std::unique_ptr<Factor> supernodal_factor() { refuse("supernodal_factor"); }

std::vector<int> nested_dissection(const SparseMatrix&) { refuse("nested_dissection"); }

}  // namespace swage
