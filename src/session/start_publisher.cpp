#include "session/start_publisher.h"

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_session {

SessionStart StartPublisher::knownOn(const std::string& topic) const {
  if (!playing_) return start_;
  const bool is_mesh = topic == topics_.mesh;
  if (!is_mesh && topic != kStaticTransformsTopic) return {};
  SessionTopics latched;
  if (is_mesh) latched.mesh = topic;
  return readStart(files_, latched, sweep_guard_ros::fromMsg(ros::Time::now()));
}

}  // namespace sweep_guard_session
