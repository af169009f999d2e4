// One line on the terminal that tells how far a solve is.
#pragma once

#include <chrono>
#include <cstddef>

#include "swage/report.h"

namespace swage::cli {

/// Draws on stderr, and only where that is a terminal and `wanted` is set. Its line is gone when it is destroyed.
class ProgressBar {
 public:
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);

 private:
  bool drawn_on_;
  std::size_t width_ = 0;  ///< Characters of the longest line drawn.
  std::chrono::steady_clock::time_point next_;
};

}  // namespace swage::cli
