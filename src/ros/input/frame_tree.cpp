#include "ros/input/frame_tree.h"

#include <algorithm>
#include <vector>

namespace sweep_guard_ros {
namespace {

constexpr size_t kMaxDepth = 1000;  // frames in a loop have no end

// The frame, and what it stands on, up to the root.
std::vector<std::string> chainTo(const std::map<std::string, std::string>& parents, const std::string& frame) {
  std::vector<std::string> frames{frame};
  auto parent = parents.find(frame);
  while (parent != parents.end() && frames.size() < kMaxDepth) {
    frames.push_back(parent->second);
    parent = parents.find(parent->second);
  }
  return frames;
}

// Between two frames lies what leads up from one of them and not from the other.
std::set<std::string> framesBetween(const std::map<std::string, std::string>& parents, const std::string& target,
                                    const std::string& source) {
  std::vector<std::string> from_target = chainTo(parents, target);
  std::vector<std::string> from_source = chainTo(parents, source);
  while (!from_target.empty() && !from_source.empty() && from_target.back() == from_source.back()) {
    from_target.pop_back();
    from_source.pop_back();
  }
  std::set<std::string> frames(from_target.begin(), from_target.end());
  frames.insert(from_source.begin(), from_source.end());
  return frames;
}

}  // namespace

void FrameTree::add(const std::string& parent, const std::string& child) {
  const sweep_guard_core::Lock lock(mutex_);
  std::string& known = parents_[child];
  outdated_ = outdated_ || known != parent;
  known = parent;
}

void FrameTree::use(const std::string& user, const std::string& target, const std::set<std::string>& sources) {
  const sweep_guard_core::Lock lock(mutex_);
  uses_[user] = {target, sources};
  outdated_ = true;
}

bool FrameTree::isUsed(const std::string& child) const {
  const sweep_guard_core::Lock lock(mutex_);
  if (outdated_) findUsed();
  return std::any_of(used_.begin(), used_.end(), [&](const auto& used) { return used.second.count(child) != 0; });
}

bool FrameTree::isUsedBy(const std::string& user, const std::string& child) const {
  const sweep_guard_core::Lock lock(mutex_);
  if (outdated_) findUsed();
  const auto used = used_.find(user);
  return used != used_.end() && used->second.count(child) != 0;
}

void FrameTree::findUsed() const {
  used_.clear();
  outdated_ = false;
  for (const auto& [user, uses] : uses_) {
    for (const std::string& source : uses.sources) used_[user].merge(framesBetween(parents_, uses.target, source));
  }
}

std::set<std::string> FrameTree::between(const std::string& target, const std::string& source) const {
  const sweep_guard_core::Lock lock(mutex_);
  return framesBetween(parents_, target, source);
}

}  // namespace sweep_guard_ros
