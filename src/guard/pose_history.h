#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sweep_guard/common/sample_buffer.h"
#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/guard/frame_motion.h"
#include "sweep_guard/guard/pose_with_frames.h"

namespace sweep_guard_core {

/// The poses of the tool T and of a frame M in the fixed frame W at one moment.
struct PoseSample {
  std::uint64_t number;  ///< ascends, see PoseHistories
  Time stamp;
  Eigen::Isometry3d X_WT;
  Eigen::Isometry3d X_WM;
  double deviation_bound = 0.0;  ///< of the motion since the previous sample, see BodyPose
  bool anew = false;             ///< there is no motion from the previous sample, see PlacedAnew
  bool left_out = false;         ///< the frame went straight past poses since the previous sample
};

/// Where a point of the tool is at some poses, seen from a frame M, and how far the tool is from the chords between them.
struct PoseBounds {
  Eigen::AlignedBox3d point_M;  ///< holds the point at each pose [m]
  /// Bound [m] on the deviation of the point and of a tool point, between two poses, from a straight line at constant speed;
  /// rounding included.
  double deviation = 0.0;
};

/// Keeps the poses of tool and frame that may have to be swept again. Only a detector that keeps failing needs as many as
/// SampleBuffer holds: twice the number of poses that are swept at once.
class PoseHistory {
 public:
  static constexpr size_t kMaxSize = SampleBuffer<PoseSample>::kMaxSize;

  /// @param sample  numbers ascend; stamps do not decrease
  void add(const PoseSample& sample) { all_.add(sample); }
  void forgetFirst() { all_.forgetFirst(); }  ///< must not be called on the last pose

  size_t size() const { return all_.size(); }
  const PoseSample& operator[](size_t i) const { return all_[i]; }
  const PoseSample& newest() const { return all_.newest(); }

  /// Returns the index of the last pose with this number or a lower one; 0 if there is none.
  size_t lastUpTo(std::uint64_t number) const;
  /// Returns the index of the last pose with this stamp or an earlier one; 0 if there is none.
  size_t lastUpTo(Time stamp) const;

  /// Returns the index of the last pose up to `last` that the tool has moved to from pose `first`, without being placed anew.
  size_t endOfMotion(size_t first, size_t last) const;

  /// Returns the fraction of the time from pose `from` to `end` that has passed at pose `i`: 0 before `from`, and 1 if no
  /// time passes.
  /// @param end  not before the newest pose
  double share(size_t from, size_t i, Time end) const;

  /// Computes the path of the tool in M from pose `first` to pose `last`, which is not beyond endOfMotion().
  /// @param tool_radius   largest distance of a tool point from the origin of T [m], >= 0
  /// @param[out] path_M   overwritten
  void path_M(size_t first, size_t last, double tool_radius, Path& path_M) const;

  /// Bounds that path without its angles, which take most of its time.
  /// @param point_T      of which the box is [m]
  /// @param tool_radius  largest distance of a tool point, or of `point_T`, from the origin of T [m], >= 0
  PoseBounds bounds_M(size_t first, size_t last, const Eigen::Vector3d& point_T, double tool_radius) const;

 private:
  SampleBuffer<PoseSample> all_;
};

/// Replaces the poses of a body by fewer ones, and bounds how far the body was meanwhile from where they say.
class SparseMotion {
 public:
  /// @param radius  largest distance of a point of the body from the origin of its frame [m], >= 0
  explicit SparseMotion(double radius) : radius_(radius) {}

  /// Adds the newest pose; stamps do not decrease.
  void add(Time stamp, const BodyPose& pose);

  /// Returns the newest pose with the bound for the motion since the pose returned before; 0 if there is none. There must be
  /// a pose (asserted).
  BodyPose take();

  void clear() { path_W_.clear(); }  ///< forgets all poses

 private:
  double radius_;
  Time first_;
  Path path_W_;  // since the pose returned before
  double deviation_bound_ = 0.0;
};

/// Joins the measured poses of a body of the tool with those of a frame that moves on its own into poses of both at the same
/// times: at the stamps of either, up to the older of both newest stamps.
class JoinedMotion {
 public:
  /// Adds the newest pose of the body; stamps do not decrease. Of more than 8192 that wait, it goes straight past the oldest.
  /// @param anew  the body did not move here
  /// @returns false if it goes past one
  bool add(Time stamp, const BodyPose& body, bool anew = false) {
    return body_.add({0, stamp, body.X_WB, Eigen::Isometry3d::Identity(), body.deviation_bound, anew});
  }

  /// Computes the samples since the last call. The first is at the first time at which both are known.
  /// @param[out] samples  overwritten; deviation bounds are those of body and frame together. Without numbers
  void join(const FrameMotion& frame, std::vector<PoseSample>& samples);

 private:
  bool begin(const FrameMotion& frame, std::vector<PoseSample>& samples);
  PoseSample at(Time time, const FramePose& next) const;

  SampleBuffer<PoseSample> body_;   // X_WM is not set; once begun, the first is the newest not after the last sample
  std::optional<FramePose> frame_;  // the same of the frame; empty: not begun
};

}  // namespace sweep_guard_core
