#include "ros/camera/self_volumes.h"

#include <algorithm>
#include <utility>

#include "sweep_guard/common/error.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_ros {

using sweep_guard_core::Motion;

namespace {

// Halfway to the surface in fourteen directions.
void addPointsWithin(const sweep_guard_core::ConvexShape& shape_T, const Eigen::Isometry3d& X_WT,
                     std::vector<Eigen::Vector3d>& points_W) {
  const Eigen::Vector3d& mean = shape_T.moments_T().mean;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (const int axes = x * x + y * y + z * z; axes != 1 && axes != 3) continue;
        points_W.push_back(X_WT * (0.5 * (mean + shape_T.supportPoint(Eigen::Vector3d(x, y, z)))));
      }
    }
  }
}

}  // namespace

const std::vector<sweep_guard_core::SweptVolume>& SelfVolumes::at(sweep_guard_core::Time stamp, double padding) {
  volumes_W_.clear();
  points_W_.clear();
  unplaced_.clear();
  const auto parameters = parameters_.get();
  const auto end = std::chrono::steady_clock::now() + parameters->limits.pose_timeout;
  addTool(*parameters, stamp, padding);
  if (parameters->robot_links) addLinks(*parameters, stamp, padding, end);
  return volumes_W_;
}

void SelfVolumes::addTool(const Parameters& parameters, sweep_guard_core::Time stamp, double padding) {
  const std::vector<sweep_guard_core::Tool>& bodies = *parameters.bodies;
  const auto around = poses_.around(stamp, parameters.limits.pose_timeout);
  if (!around)
    throw sweep_guard_core::Error("the tool in the picture is not known: there is no pose of it at the image's stamp");
  if (around->first.size() != bodies.size() || around->second.size() != bodies.size())
    throw sweep_guard_core::Error("the tool in the picture is not known: it is being exchanged");
  for (size_t i = 0; i < bodies.size(); ++i) {
    const auto& [X_WB, deviation] = around->second[i];
    add(bodies[i].pieces(), Motion{around->first[i].X_WB, X_WB, deviation}, parameters, padding);
    for (const sweep_guard_core::ConvexPiece& piece : bodies[i].pieces())
      addPointsWithin(piece.shape_T, X_WB, points_W_);
  }
}

void SelfVolumes::addLinks(const Parameters& parameters, sweep_guard_core::Time stamp, double padding,
                           sweep_guard_core::SteadyTime end) {
  for (const auto& [link, pieces] : *parameters.robot_links) {
    auto X_WL = frames_.find(parameters.fixed_frame, link, stamp);
    if (!X_WL && known_.count(link) != 0) {
      const auto left = std::max(sweep_guard_core::Duration::zero(),
                                 sweep_guard_core::Duration(end - std::chrono::steady_clock::now()));
      X_WL = frames_.lookup(parameters.fixed_frame, link, stamp, left);
    }
    if (!X_WL) {
      unplaced_.push_back(link);
      continue;
    }
    known_.insert(link);
    add(pieces, Motion{*X_WL, *X_WL}, parameters, padding);
  }
}

void SelfVolumes::add(const std::vector<sweep_guard_core::ConvexPiece>& pieces, const Motion& motion_W,
                      const Parameters& parameters, double padding) {
  const sweep_guard_core::SweepOptions& options = parameters.guard.sweep;
  parts_W_ = split(motion_W, options.max_rotation, std::move(parts_W_));
  for (const Motion& part_W : parts_W_) {
    for (const sweep_guard_core::ConvexPiece& piece : pieces)
      volumes_W_.push_back(sweptVolume(piece.shape_T, part_W, options.volume, padding));
  }
}

}  // namespace sweep_guard_ros
