#pragma once

#include <cstddef>
#include <vector>

namespace sweep_guard_core {

/// Keeps the newest samples of a motion. Moves them down in its memory to make room, so that nothing is allocated once it has
/// had its largest size.
template <typename Sample>
class SampleBuffer {
 public:
  /// Largest number of samples. If one more is added, the second one is dropped: the motion then passes it on a
  /// straight line.
  static constexpr size_t kMaxSize = 8192;

  /// @returns false if a sample was dropped
  bool add(const Sample& sample) {
    const bool full = size() >= kMaxSize;
    if (full) {
      all_[begin_ + 1] = all_[begin_];
      ++begin_;
    }
    if (all_.size() == all_.capacity() && begin_ >= all_.size() / 2) {
      all_.erase(all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(begin_));
      begin_ = 0;
    }
    all_.push_back(sample);
    return !full;
  }
  void forgetFirst() { ++begin_; }  ///< must not be called on the last sample
  void clear() {
    all_.clear();
    begin_ = 0;
  }

  size_t size() const { return all_.size() - begin_; }
  const Sample& operator[](size_t i) const { return all_[begin_ + i]; }
  const Sample& newest() const { return all_.back(); }
  const Sample* begin() const { return all_.data() + begin_; }
  const Sample* end() const { return all_.data() + all_.size(); }

 private:
  std::vector<Sample> all_;
  size_t begin_ = 0;
};

}  // namespace sweep_guard_core
