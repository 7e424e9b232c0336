#pragma once

#include <optional>
#include <vector>

#include "sweep_guard/common/sample_buffer.h"
#include "sweep_guard/guard/frame_motion.h"
#include "sweep_guard/guard/pose_with_frames.h"

namespace sweep_guard_core {

/// Joins the measured poses of a body of the tool with those of a frame that another guard measures into poses of both at the
/// same times: at the stamps of either, up to the older of both newest stamps.
class JoinedMotion {
 public:
  struct Sample {
    Time stamp;
    Eigen::Isometry3d X_WB;
    Eigen::Isometry3d X_WM;
    double deviation_bound;  ///< [m] of both together, since the previous sample
  };

  /// Adds the newest pose of the body; stamps do not decrease. Of more than 8192 that wait, it goes straight past the oldest.
  void add(Time stamp, const BodyPose& body) { body_.add({stamp, body}); }

  /// Computes the samples since the last call. The first is at the first time at which both are known.
  /// @param[out] samples  overwritten
  void join(const FrameMotion& frame, std::vector<Sample>& samples);

 private:
  struct Pose {
    Time stamp;
    BodyPose body;
  };

  bool begin(const FrameMotion& frame, std::vector<Sample>& samples);
  Sample at(Time time, const FramePose& next) const;

  SampleBuffer<Pose> body_;         // once begun, the first is the newest that is not after the last sample
  std::optional<FramePose> frame_;  // the same of the frame; empty: not begun
};

}  // namespace sweep_guard_core
