#include "ros/input/foreign_joints.h"

#include <algorithm>

#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kMaxRemembered = 64;
constexpr size_t kMaxShown = 8;

}  // namespace

void ForeignJoints::note(const JointNames& own, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (names_.size() < kMaxRemembered && !own.isOwn(name)) names_.insert(name);
  }
}

std::string ForeignJoints::text(const std::vector<std::string>& missing) const {
  const auto resembles = [&](const std::string& name) {
    const auto contained = [&](const std::string& part) { return name.find(part) != std::string::npos; };
    return std::any_of(missing.begin(), missing.end(), contained);
  };
  std::vector<std::string> names(names_.begin(), names_.end());
  std::stable_partition(names.begin(), names.end(), resembles);
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), kMaxShown); ++i)
    text += (i == 0 ? "" : ", ") + sweep_guard_core::printable(names[i]);
  return text + (names.size() > kMaxShown ? ", ..." : "");
}

}  // namespace sweep_guard_ros
