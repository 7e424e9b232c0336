#pragma once

#include <sweep_guard/ToolBodies.h>
#include <sweep_guard/ToolSurface.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "guard/workpiece_store.h"
#include "ros/connection/bounded.h"
#include "ros/connection/sole_publisher.h"
#include "ros/input/worker.h"
#include "ros/parameters/parameters.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/queue_thread.h"
#include "sweep_guard/common/mutex.h"
#include "sweep_guard/guard/frame_motion.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

struct OtherToolsDependencies {
  std::function<void(const Worker::Job&)> change_store;  ///< runs a job in the thread that changes the workpieces
  sweep_guard_core::WorkpieceStore& workpieces;
  sweep_guard_core::FrameMotionStore& frame_motions;
  sweep_guard_core::WarningMonitor& monitor;
};

/// Makes the links of other tools workpieces, in frames that move as the guards of these tools say. A frame belongs to one
/// surface in one run of its guard: poses are never combined with the surface of another tool.
class OtherTools {
 public:
  OtherTools(const ros::NodeHandle& node, const Parameters& parameters, const OtherToolsDependencies& dependencies);

  void start(Supervisor& supervisor);

 private:
  /// What is known of one of them.
  struct Tool {
    std::string name;
    std::string run_id = {};     // of the surface that is in force
    std::uint32_t revision = 0;  // the same
    size_t bodies = 0;           // the same; 0: there is no surface yet
    std::uint32_t sequence = 0;  // of the newest message of `run_id` and `revision`; 0: there is none
    std::map<size_t, sweep_guard_core::FrameMotion> motions = {};  // by body
  };
  struct Surface;

  template <typename Msg, typename Hear>
  BoundedSubscriber subscribe(const ros::NodeHandle& node, size_t tool, const std::string& topic, size_t max_size,
                              Hear hear);
  void hear(size_t tool, const sweep_guard::ToolSurface& msg);
  void hear(size_t tool, const sweep_guard::ToolBodies& msg);
  Surface surfaceFrom(const std::string& name, const sweep_guard::ToolSurface& msg) const;
  void take(size_t tool, const Surface& surface);
  void add(size_t body, const sweep_guard::ToolBodies& msg, Tool& tool);
  void refuse(const std::string& name, const std::string& reason);

  const std::string fixed_frame_;
  const size_t max_triangles_;
  const OtherToolsDependencies dependencies_;
  LogThrottle log_;
  sweep_guard_core::Mutex mutex_;  // of the tools
  std::vector<Tool> tools_;
  QueueThread thread_;  // before the subscribers, which use its queue
  std::vector<BoundedSubscriber> subscribers_;
};

}  // namespace sweep_guard_ros
