#include "ros/input/frames.h"

#include <mutex>
#include <thread>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kPollPeriod = std::chrono::milliseconds(1);

// Runs a callback until it is closed. Closing waits for a running callback.
class Gate {
 public:
  explicit Gate(std::function<void()> callback) : callback_(std::move(callback)) {}
  void pass() {
    const std::lock_guard lock(mutex_);
    if (callback_) callback_();
  }
  void close() {
    const std::lock_guard lock(mutex_);
    callback_ = nullptr;
  }

 private:
  std::mutex mutex_;
  std::function<void()> callback_;
};

std::string withoutSlash(const std::string& frame) { return frame.substr(frame.find_first_not_of('/') == 1 ? 1 : 0); }

}  // namespace

Frames::Frames() : listener_(buffer_) {}

Eigen::Isometry3d Frames::lookup(const std::string& target, const std::string& source,
                                 sweep_guard_core::Time stamp) const {
  if (withoutSlash(target) == withoutSlash(source)) return Eigen::Isometry3d::Identity();
  try {
    return fromMsg(buffer_.lookupTransform(withoutSlash(target), withoutSlash(source), toMsg(stamp)).transform);
  } catch (const tf2::TransformException& error) {
    throw FrameError("no transform from '" + source + "' to '" + target + "': " + error.what());
  } catch (const sweep_guard_core::InvalidInput& error) {
    throw FrameError("transform from '" + source + "' to '" + target + "' is not rigid: " + error.what());
  }
}

Eigen::Isometry3d Frames::lookup(const std::string& target, const std::string& source, sweep_guard_core::Time stamp,
                                 sweep_guard_core::Duration wait) const {
  const auto deadline = std::chrono::steady_clock::now() + wait;
  while (true) {
    try {
      return lookup(target, source, stamp);
    } catch (const FrameError&) {
      if (std::chrono::steady_clock::now() >= deadline) throw;
    }
    std::this_thread::sleep_for(kPollPeriod);
  }
}

std::optional<sweep_guard_core::Time> Frames::newest(const std::string& target, const std::string& source) const {
  if (withoutSlash(target) == withoutSlash(source)) return sweep_guard_core::Time();
  try {
    return fromMsg(buffer_.lookupTransform(withoutSlash(target), withoutSlash(source), ros::Time(0)).header.stamp);
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

// Removing a callback from tf2 does not wait for one that is running; the gate does.
std::shared_ptr<void> Frames::onChange(std::function<void()> callback) {
  auto gate = std::make_shared<Gate>(std::move(callback));
  const auto connection = buffer_._addTransformsChangedListener([gate] { gate->pass(); });
  return std::shared_ptr<void>(nullptr, [this, gate, connection](void*) {
    buffer_._removeTransformsChangedListener(connection);
    gate->close();
  });
}

}  // namespace sweep_guard_ros
