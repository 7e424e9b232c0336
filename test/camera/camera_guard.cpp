#include "camera/camera_guard.h"

#include "guard/times.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core {

CameraGuard::CameraGuard(Tool tool, const CameraSetup& setup)
    : setup_(setup),
      tool_(std::move(tool)),
      empty_(Grid(setup.width, setup.height)),
      boxes_(tool_, pointsPerBody(1)),
      guard_(tool_, makeDetector("halfspace"), {}),
      surface_(Grid(setup.width, setup.height), setup.camera, setup.options) {}

void CameraGuard::run(double seconds, const Pose& pose_W, const See& see, const Report& report) {
  for (const size_t end = ticks_ + static_cast<size_t>(seconds * 100.0); ticks_ < end; ++ticks_) {
    const double now = 0.01 * static_cast<double>(ticks_);
    const PoseWithFrames pose = poseAt(now, pose_W);
    poses_.add(pose.stamp, pose.bodies);
    guard_.sweep(pose, shown_, report_);
    report(report_, now, newest_);
    while (static_cast<double>(images_) / setup_.rate + setup_.delay <= now) {
      take(static_cast<double>(images_) / setup_.rate, see(static_cast<double>(images_) / setup_.rate));
      guard_.sweep(pose, shown_, report_, /*arrived=*/false);
      report(report_, now, newest_);
    }
  }
}

std::optional<double> CameraGuard::seen() {
  const PredictedMotion motion = guard_.predictMotion({}, std::chrono::milliseconds(1100));
  if (motion.path.empty() || !seen_.begin(shown_, motion.from)) return {};
  seen_.place(boxes_, motion.from.bodies[0].X_WB);
  seen_.add(boxes_, motion.from.bodies[0].X_WB, motion.path);
  return seen_.share();
}

void CameraGuard::take(double seconds, const std::vector<float>& depths) {
  const double since = newest_ < 0.0 ? 0.0 : seconds - newest_;
  surface_.take(depths, setup_.X_WC, since, selfAt(atSecond(seconds)));
  const auto [points, found] = surface_.compare(depths, points_W_, setup_.self_padding);
  compared_.points += points;
  compared_.found += found;
  if (points >= 7) ++compared_images_;
  if (points >= 7 && 2 * found >= points) ++agreeing_images_;
  auto image = std::make_shared<Workpiece>(
      Workpiece{"camera", 0, atSecond(seconds), SteadyTime(fromSeconds(seconds)), "world", empty_});
  image->mesh_M.deform(surface_.places_F(), surface_.before_F(), surface_.existing());
  image->of_camera = true;
  image->updates = ++images_;
  image->free_space = surface_.freeSpace();
  newest_ = seconds;
  shown_ = {image};
}

const std::vector<SweptVolume>& CameraGuard::selfAt(Time stamp) {
  self_W_.clear();
  points_W_.clear();
  const auto around = poses_.around(stamp, Duration::zero());
  if (!around) return self_W_;
  const auto& [X_WT, deviation] = around->second[0];
  const SweepOptions options;
  for (const Motion& part_W : split(Motion{around->first[0].X_WB, X_WT, deviation}, options.max_rotation)) {
    for (const ConvexPiece& piece : tool_.pieces())
      self_W_.push_back(sweptVolume(piece.shape_T, part_W, options.volume, setup_.self_padding));
  }
  for (const ConvexPiece& piece : tool_.pieces()) {
    for (int i = 0; i < 27; ++i) {
      const Eigen::Vector3d direction(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
      if (const double axes = direction.cwiseAbs().sum(); axes != 1.0 && axes != 3.0) continue;
      points_W_.push_back(X_WT * (0.5 * (piece.shape_T.moments_T().mean + piece.shape_T.supportPoint(direction))));
    }
  }
  return self_W_;
}

PoseWithFrames CameraGuard::poseAt(double seconds, const Pose& pose_W) const {
  return {
      atSecond(seconds), SteadyTime(fromSeconds(seconds)), pose_W(seconds), {{"world", Eigen::Isometry3d::Identity()}}};
}

}  // namespace sweep_guard_core
