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

// Between two frames lies what leads up from one of them and not from the other.
void FrameTree::findUsed() const {
  used_.clear();
  outdated_ = false;
  for (const auto& [user, uses] : uses_) {
    const std::vector<std::string> from_target = chainTo(parents_, uses.target);
    for (const std::string& source : uses.sources) {
      const std::vector<std::string> from_source = chainTo(parents_, source);
      auto target_end = from_target.end();
      auto source_end = from_source.end();
      while (target_end != from_target.begin() && source_end != from_source.begin() &&
             *std::prev(target_end) == *std::prev(source_end)) {
        --target_end;
        --source_end;
      }
      used_[user].insert(from_target.begin(), target_end);
      used_[user].insert(from_source.begin(), source_end);
    }
  }
}

}  // namespace sweep_guard_ros
