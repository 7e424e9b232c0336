#include "guard/frame_motion_store.h"

#include <mutex>
#include <utility>

namespace sweep_guard_core {
namespace {

bool beginsWith(const std::string& name, const std::string& beginning) {
  return name.compare(0, beginning.size(), beginning) == 0;
}

}  // namespace

FrameMotionStore::FrameMotionStore() : motions_(std::make_shared<const FrameMotions>()) {}

void FrameMotionStore::expect(const std::string& beginning, const std::set<std::string>& frames) {
  const std::lock_guard lock(mutex_);
  for (auto frame = frames_.begin(); frame != frames_.end();)
    frame = beginsWith(*frame, beginning) ? frames_.erase(frame) : std::next(frame);
  frames_.insert(frames.begin(), frames.end());
  FrameMotions left;
  for (const auto& [frame, motion] : *motions_) {
    if (frames_.count(frame) != 0) left.emplace(frame, motion);
  }
  motions_ = std::make_shared<const FrameMotions>(std::move(left));
}

void FrameMotionStore::set(const FrameMotions& motions) {
  const std::lock_guard lock(mutex_);
  FrameMotions next = *motions_;
  for (const auto& [frame, motion] : motions) {
    if (frames_.count(frame) != 0) next[frame] = motion;
  }
  motions_ = std::make_shared<const FrameMotions>(std::move(next));
}

std::shared_ptr<const FrameMotions> FrameMotionStore::get() const {
  const std::lock_guard lock(mutex_);
  return motions_;
}

bool FrameMotionStore::expects(const std::string& frame) const {
  const std::lock_guard lock(mutex_);
  return frames_.count(frame) != 0;
}

std::shared_ptr<const FrameMotion> FrameMotionStore::find(const std::string& frame) const {
  const auto motions = get();
  const auto found = motions->find(frame);
  return found == motions->end() ? nullptr : found->second;
}

std::optional<Eigen::Isometry3d> FrameMotionStore::at(const std::string& frame, Time time) const {
  const auto motion = find(frame);
  const auto pose = motion ? motion->at(time) : std::nullopt;
  return pose ? std::optional(pose->X_WT) : std::nullopt;
}

std::optional<Eigen::Isometry3d> FrameMotionStore::newest(const std::string& frame) const {
  const auto motion = find(frame);
  return motion ? std::optional(motion->measured.back().X_WM) : std::nullopt;
}

}  // namespace sweep_guard_core
