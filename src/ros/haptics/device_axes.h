#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "common/guarded_by.h"
#include "ros/input/frames.h"
#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_ros {

/// Keeps the axes of the device in the fixed frame for a real-time thread: they are looked up in the thread of the tf listener,
/// because the lock of tf inherits no priority, and a look-up allocates.
class DeviceAxes {
 public:
  DeviceAxes(Frames& frames, const std::string& fixed_frame, const std::string& device_frame);

  /// Returns R_WD; empty if it is not known, or older than kOldestTransform. Any thread. It allocates nothing.
  std::optional<Eigen::Matrix3d> newest(sweep_guard_core::Time now) const;

  std::string problem() const;  ///< why it is not known; empty: it is. Looks it up itself

 private:
  void lookUp();

  const Frames& frames_;
  const std::string fixed_frame_;
  const std::string device_frame_;
  mutable sweep_guard_core::Mutex mutex_;
  std::optional<sweep_guard_core::StampedValue<Eigen::Matrix3d>> newest_
      GUARDED_BY(mutex_);  // R_WD; stamp 0: it never changes
  const std::shared_ptr<void> transforms_changed_;
};

}  // namespace sweep_guard_ros
