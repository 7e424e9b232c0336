#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "camera/free_space.h"
#include "guard/body_boxes.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// How much of what a tool takes up on its predicted path cameras see to be free. Each point of a body stands for a place in each step.
/// The smallest share counts of any 64 places that follow each other; they are counted from the end of the path. Places near to where
/// the tool is now do not count: it hides them itself. Keeps its buffers.
class SeenShare {
 public:
  /// Begins a path. @returns whether there is a camera
  bool begin(const Workpieces& workpieces, const PoseWithFrames& pose);

  /// Says where a body is now. `body` must outlive this path; all bodies before add().
  void place(const BodyBoxes& body, const Eigen::Isometry3d& X_WB) { bodies_.push_back({X_WB.inverse(), &body}); }

  /// Adds the path of a body.
  /// @param X_WB  where it is now
  void add(const BodyBoxes& body, const Eigen::Isometry3d& X_WB, const PredictedPath& path);

  double share() const { return share_; }  ///< that any camera sees, 0 to 1; 1 if all stay where they are

 private:
  struct Camera {
    Eigen::Isometry3d X_FW;
    const FreeSpace* space;
  };
  struct PlacedBody {
    Eigen::Isometry3d X_BW;
    const BodyBoxes* boxes;
  };

  bool isNear(const Eigen::Vector3d& p_W) const;
  bool isSeen(const Eigen::Vector3d& p_W) const;

  std::vector<Camera> cameras_;
  std::vector<PlacedBody> bodies_;
  double share_ = 1.0;
};

}  // namespace sweep_guard_core
