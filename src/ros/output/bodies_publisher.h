#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sweep_guard/ToolBodies.h>
#include <sweep_guard/ToolSurface.h>

#include <memory>
#include <string>
#include <vector>

#include "guard/pose_history.h"
#include "ros/parameters/live_parameters.h"
#include "sweep_guard/guard/prediction.h"

namespace sweep_guard_ros {

/// Converts the surfaces of all bodies, without stamp, run and revision. Takes seconds for ten thousand corners.
boost::shared_ptr<sweep_guard::ToolSurface> surfaceMsg(const Parameters& parameters);

/// Publishes what the guards of other tools need: `~surface`, latched; and, if there is a subscriber, `~bodies` for each pose,
/// at most at 200 Hz, and for each prediction. One thread.
class BodiesPublisher {
 public:
  BodiesPublisher(ros::NodeHandle private_node, const LiveParameters& parameters);

  /// Publishes the surface of a tool in place of the one before.
  /// @param surface  from surfaceMsg(), of these bodies
  void setTool(const std::vector<sweep_guard_core::Tool>& bodies,
               const boost::shared_ptr<sweep_guard::ToolSurface>& surface);
  void moved(const sweep_guard_core::PoseWithFrames& pose);
  void predicted(const sweep_guard_core::PoseWithFrames& from, const sweep_guard_core::Prediction& prediction);
  void reset();  ///< the motion of the tool in between is not known

 private:
  void publish();

  const LiveParameters& parameters_;
  const std::string run_id_;
  ros::Publisher surface_publisher_;
  ros::Publisher bodies_publisher_;
  std::uint32_t revision_ = 0;
  std::uint32_t sequence_ = 0;
  std::vector<sweep_guard_core::SparseMotion> motions_;  // by body
  std::vector<sweep_guard_core::BodyPose> poses_;        // the published ones, by body
  sweep_guard_core::Time newest_;                        // stamp of the newest pose; 0: none
  sweep_guard_core::Time published_;                     // stamp of the newest published pose
  ros::Time predicted_from_;
  std::vector<sweep_guard::BodyMotion> predicted_;  // by body; their measured poses mean nothing
};

}  // namespace sweep_guard_ros
