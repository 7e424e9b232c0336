#pragma once

#include <atomic>
#include <map>
#include <string>

#include "common/guarded_by.h"

namespace sweep_guard_ros {

/// Keeps why the newest transform to a frame was refused, until a good one comes: of 1000 frames at most. A refusal of yet another
/// frame is kept for good, and returned to all who ask: that frame may count for them. Any thread.
class RefusedTransforms {
 public:
  /// @param text  frame, publisher, and what is wrong
  void add(const std::string& child, const std::string& text) {
    const sweep_guard_core::Lock lock(mutex_);
    any_ = true;
    if (texts_.size() < kMaxFrames || texts_.count(child) != 0) {
      texts_[child] = text;
    } else if (others_.empty()) {
      others_ =
          "transforms to more than 1000 frames were refused, and which of them count is not known until a restart; the "
          "first after these was: " +
          text;
    }
  }

  void accepted(const std::string& child) {
    if (!any_) return;
    const sweep_guard_core::Lock lock(mutex_);
    texts_.erase(child);
    any_ = !texts_.empty() || !others_.empty();
  }

  /// Returns the text of one of these frames, the first by name, or that there were too many; empty: there is none.
  template <typename Counts>
  std::string find(const Counts& counts) const {
    if (!any_) return {};
    const sweep_guard_core::Lock lock(mutex_);
    for (const auto& [child, text] : texts_) {
      if (counts(child)) return text;
    }
    return others_;
  }

 private:
  static constexpr size_t kMaxFrames = 1000;  // names may be made up

  mutable sweep_guard_core::Mutex mutex_;
  std::map<std::string, std::string> texts_ GUARDED_BY(mutex_);  // by child
  std::string others_ GUARDED_BY(mutex_);
  std::atomic<bool> any_ = false;
};

}  // namespace sweep_guard_ros
