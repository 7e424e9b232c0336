#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "camera/depth_surface.h"
#include "guard/recent_poses.h"
#include "guard/seen_share.h"
#include "sweep_guard/guard/guard.h"

namespace sweep_guard_core {

/// How images come, and what is known of them.
struct CameraSetup {
  Pinhole camera;
  std::uint32_t width = 640, height = 480;
  Eigen::Isometry3d X_WC;  ///< where the camera is taken to be [m]
  DepthOptions options = {0.2, 1.5, {0.005, 0.003}};
  double self_padding = 0.03;  ///< [m]
  double rate = 30.0;          ///< [Hz]
  double delay = 0.033;        ///< [s]
};

/// A guard with a depth camera, without ROS: poses at 100 Hz, images as in the camera input.
class CameraGuard {
 public:
  /// Returns what the camera sees, z of each pixel [m]; valid until the next call.
  using See = std::function<const std::vector<float>&(double seconds)>;
  using Pose = std::function<Eigen::Isometry3d(double seconds)>;  ///< of the tool
  /// Receives each report, its time, and when the newest image that it knows was taken [s]; < 0: none.
  using Report = std::function<void(const SweepReport& report, double seconds, double image)>;

  CameraGuard(Tool tool, const CameraSetup& setup);

  /// Runs from where the last call has ended.
  void run(double seconds, const Pose& pose_W, const See& see, const Report& report);

  /// Returns how much of the predicted path the camera sees, see Prediction::seen; empty: no motion is known.
  std::optional<double> seen();

  const DepthSurface& surface() const { return surface_; }
  const Workpieces& shown() const { return shown_; }
  size_t images() const { return images_; }
  /// Of all images, see DepthSurface::compare().
  const DepthSurface::Expected& compared() const { return compared_; }
  /// Images in which points of the tool were to be seen, and of these, how many show at least half.
  size_t comparedImages() const { return compared_images_; }
  size_t agreeingImages() const { return agreeing_images_; }

 private:
  void take(double seconds, const std::vector<float>& depths);
  const std::vector<SweptVolume>& selfAt(Time stamp);
  PoseWithFrames poseAt(double seconds, const Pose& pose_W) const;

  const CameraSetup setup_;
  const Tool tool_;
  const TriangleMesh empty_;
  const BodyBoxes boxes_;
  Guard guard_;
  SeenShare seen_;
  DepthSurface surface_;
  RecentPoses poses_;
  Workpieces shown_;
  std::vector<SweptVolume> self_W_;
  std::vector<Eigen::Vector3d> points_W_;
  SweepReport report_;
  size_t ticks_ = 0;
  size_t images_ = 0;
  double newest_ = -1.0;  // image [s]
  DepthSurface::Expected compared_;
  size_t compared_images_ = 0;
  size_t agreeing_images_ = 0;
};

}  // namespace sweep_guard_core
