#include "ros/input/tf_chain.h"

#include <cstddef>

namespace sweep_guard_ros {
namespace {

constexpr size_t kMaxDepth = 1000;  // as tf2: a loop has no end

bool isAbove(const std::string& frame, std::string below, const tf2::BufferCore& buffer) {
  size_t depth = 0;
  while (below != frame && depth < kMaxDepth && buffer._getParent(below, ros::Time(), below)) ++depth;
  return below == frame;
}

}  // namespace

// Up to the frame that both have in common: what is above both moves neither against the other.
bool liesBetween(const std::string& frame, const std::string& target, const std::string& source,
                 const tf2::BufferCore& buffer) {
  return isAbove(frame, target, buffer) != isAbove(frame, source, buffer);
}

}  // namespace sweep_guard_ros
