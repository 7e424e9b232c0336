#include "evaluation/progress.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace sweep_guard_evaluation {
namespace {

constexpr size_t kWidth = 50;

}  // namespace

ProgressBar::ProgressBar(const std::string& title, size_t total)
    : title_(title), total_(std::max<size_t>(total, 1)), visible_(isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  if (visible_) std::cerr << "\r\033[K" << std::flush;
}

void ProgressBar::advance(size_t steps) {
  if (!visible_) return;
  const std::lock_guard lock(mutex_);
  done_ += steps;
  const size_t percent = std::min<size_t>(100 * done_ / total_, 100);
  if (percent == percent_) return;
  percent_ = percent;
  std::string bar(kWidth, '.');
  std::fill_n(bar.begin(), kWidth * percent / 100, '#');
  std::cerr << '\r' << title_ << " [" << bar << "] " << percent << " %" << std::flush;
}

}  // namespace sweep_guard_evaluation
