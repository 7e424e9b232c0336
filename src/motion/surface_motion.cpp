#include "motion/surface_motion.h"

#include <algorithm>
#include <limits>

#include "guard/rigid_shape.h"

namespace sweep_guard_core {
namespace {

constexpr double kFloatRounding = 0x1p-22;  // of differences in float32, and of the corners of their boxes
constexpr double kMinInterval = 0.001;      // [s]; stamps that are nearer, or that went back, give no speed

// A snapshot without a stamp is from before time went back.
double intervalBetween(const Workpiece& before, const Workpiece& now) {
  const bool stamped = before.stamp != Time() && now.stamp > before.stamp;
  return std::max(kMinInterval, toSeconds(stamped ? now.stamp - before.stamp : now.received - before.received));
}

}  // namespace

void SurfaceMotion::update(const std::shared_ptr<const Workpiece>& workpiece, const Eigen::Isometry3d& X_WM, Time stamp,
                           const std::optional<Vector6d>& velocity_W) {
  const bool known = workpiece_ && workpiece_->frame == workpiece->frame;
  if (velocity_W) {
    moveFrame(X_WM, *velocity_W);
  } else if (known) {
    moveFrame(X_WM, stamp);
  }
  X_WM_ = X_WM;
  stamp_ = stamp;
  if (workpiece_ == workpiece) return;
  if (known && !workpiece->of_camera && sameTriangles(workpiece_->mesh_M, workpiece->mesh_M)) {
    deform(*workpiece_, *workpiece);
  } else {
    deforms_ = false;
  }
  workpiece_ = workpiece;
}

void SurfaceMotion::moveFrame(const Eigen::Isometry3d& X_WM, Time stamp) {
  const double interval = std::max(kMinInterval, toSeconds(stamp - stamp_));
  frame_moves_ = X_WM.matrix() != X_WM_.matrix();
  if (!frame_moves_) return;
  const Eigen::Isometry3d before_M = X_WM.inverse() * X_WM_;
  turning_M_ = (Eigen::Matrix3d::Identity() - before_M.linear()) / interval;
  translation_M_ = -before_M.translation() / interval;
}

void SurfaceMotion::moveFrame(const Eigen::Isometry3d& X_WM, const Vector6d& velocity_W) {
  frame_moves_ = !velocity_W.isZero(0.0);
  const Eigen::Matrix3d R_MW = X_WM.linear().transpose();
  const Eigen::Vector3d turning_M = R_MW * velocity_W.tail<3>();
  translation_M_ = R_MW * velocity_W.head<3>();
  turning_M_ << 0.0, -turning_M.z(), turning_M.y(), turning_M.z(), 0.0, -turning_M.x(), -turning_M.y(), turning_M.x(),
      0.0;
}

// Meshes that share their triangles keep their vertices at the same places.
void SurfaceMotion::deform(const Workpiece& before, const Workpiece& now) {
  const TriangleMesh& from_M = before.mesh_M;
  const TriangleMesh& to_M = now.mesh_M;
  interval_ = intervalBetween(before, now);
  differences_M_.resize(to_M.places().size());
  if (&from_M.triangles() == &to_M.triangles() && from_M.origin() == to_M.origin()) {
    std::transform(to_M.places().begin(), to_M.places().end(), from_M.places().begin(), differences_M_.begin(),
                   [](float to, float from) { return to - from; });
  } else {
    const auto& places = to_M.order().vertex_places;
    for (size_t i = 0; i < to_M.vertexCount(); ++i) {
      const size_t place = places.empty() ? i : places[i];
      Eigen::Map<Eigen::Vector3f>(differences_M_.data() + 3 * place) =
          (to_M.vertex(i) - from_M.vertex(i)).cast<float>();
    }
  }
  difference_blocks_.measure(differences_M_);
  displacements_.assign(difference_blocks_);
  deforms_ = !difference_blocks_.bounds().min().isZero(0.0) || !difference_blocks_.bounds().max().isZero(0.0);
}

double SurfaceMotion::frameSpeed(const Eigen::Vector3d& n_M, const CenteredBox& box_M) const {
  if (!frame_moves_) return 0.0;
  const Eigen::Vector3d gradient = turning_M_.transpose() * n_M;
  return n_M.dot(translation_M_) + gradient.dot(workpiece_->mesh_M.origin() + box_M.center) +
         gradient.cwiseAbs().dot(box_M.half);
}

double SurfaceMotion::deformingSpeed(const Eigen::Vector3d& n_M, const CenteredBox& displacement_M) const {
  const Eigen::Vector3d farthest = displacement_M.center.cwiseAbs() + displacement_M.half;
  const double along = n_M.dot(displacement_M.center) + n_M.cwiseAbs().dot(displacement_M.half);
  return (along + kFloatRounding * farthest.sum()) / interval_;
}

double SurfaceMotion::alongNormal(const Eigen::Vector3d& n_M, const Triangle& triangle) const {
  const TriangleMesh& mesh_M = workpiece_->mesh_M;
  const auto& places = mesh_M.order().vertex_places;
  double speed = -std::numeric_limits<double>::infinity();
  for (const std::uint32_t vertex : triangle) {
    const Eigen::Vector3f at = mesh_M.offset(vertex).cast<float>();
    double one = frameSpeed(n_M, CenteredBox(Eigen::AlignedBox3f(at)));
    if (deforms_) {
      const size_t place = places.empty() ? vertex : places[vertex];
      const Eigen::Vector3f moved = Eigen::Map<const Eigen::Vector3f>(differences_M_.data() + 3 * place);
      one += deformingSpeed(n_M, CenteredBox(Eigen::AlignedBox3f(moved)));
    }
    speed = std::max(speed, one);
  }
  return speed;
}

double SurfaceMotion::fastest(const CenteredBox& box_M) const {
  double speed = 0.0;
  if (deforms_) {
    const CenteredBox displacement_M(displacements_.of(workpiece_->mesh_M.order()));
    speed += (1.0 + kFloatRounding) * (displacement_M.center.cwiseAbs() + displacement_M.half).norm() / interval_;
  }
  if (!frame_moves_) return speed;
  const Eigen::Vector3d middle_M = workpiece_->mesh_M.origin() + box_M.center;
  return speed + (turning_M_ * middle_M + translation_M_).norm() + (turning_M_.cwiseAbs() * box_M.half).norm();
}

}  // namespace sweep_guard_core
