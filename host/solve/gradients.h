// How conjugate gradients ended.
#pragma once

namespace swage {

struct Gradients {
  int iterations = 0;
  bool converged = false;
};

}  // namespace swage
