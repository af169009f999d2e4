#include "progress_bar.h"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace swage::cli {
namespace {

constexpr int kCells = 24;
constexpr std::chrono::milliseconds kBetweenDrawings{80};

std::string line(const Progress& progress) {
  const double fraction = std::clamp(progress.fraction, 0.0, 1.0);
  const auto full = static_cast<std::size_t>(std::lround(fraction * kCells));
  std::string text =
      fmt::format("{:.<{}} {:3.0f} % {}", std::string(full, '#'), kCells, 100 * fraction, progress.stage);
  if (progress.pass > 0) text += fmt::format(" {}, energy {:.6g}", progress.pass, progress.energy);
  return text;
}

}  // namespace

ProgressBar::ProgressBar(bool wanted) : drawn_on_(wanted && isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  // Blanks instead of an escape sequence: every terminal knows them.
  if (width_ > 0) fmt::print(stderr, "\r{:{}}\r", "", width_);
}

void ProgressBar::show(const Progress& progress) {
  const auto now = std::chrono::steady_clock::now();
  if (!drawn_on_ || now < next_) return;
  next_ = now + kBetweenDrawings;
  std::string text = line(progress);
  width_ = std::max(width_, text.size());
  text.resize(width_, ' ');
  fmt::print(stderr, "\r{}", text);
  std::fflush(stderr);
}

}  // namespace swage::cli
