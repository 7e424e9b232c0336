#include "sweep_guard/ros/frames.h"

#include <thread>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kPollEvery = std::chrono::milliseconds(1);

std::string withoutSlash(const std::string& frame) { return frame.substr(frame.find_first_not_of('/') == 1 ? 1 : 0); }

}  // namespace

Frames::Frames() : listener_(buffer_) {}

Eigen::Isometry3d Frames::lookup(const std::string& target, const std::string& source, sweep_guard::Time stamp) const {
  if (withoutSlash(target) == withoutSlash(source)) return Eigen::Isometry3d::Identity();
  try {
    return fromMsg(buffer_.lookupTransform(withoutSlash(target), withoutSlash(source), toMsg(stamp)).transform);
  } catch (const tf2::TransformException& error) {
    throw FrameError("no transform from '" + source + "' to '" + target + "': " + error.what());
  } catch (const sweep_guard::InvalidInput& error) {
    throw FrameError("transform from '" + source + "' to '" + target + "' is not rigid: " + error.what());
  }
}

Eigen::Isometry3d Frames::lookup(const std::string& target, const std::string& source, sweep_guard::Time stamp,
                                 sweep_guard::Duration wait) const {
  const auto deadline = std::chrono::steady_clock::now() + wait;
  while (true) {
    try {
      return lookup(target, source, stamp);
    } catch (const FrameError&) {
      if (std::chrono::steady_clock::now() >= deadline) throw;
    }
    std::this_thread::sleep_for(kPollEvery);
  }
}

}  // namespace sweep_guard_ros
