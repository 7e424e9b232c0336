#pragma once

#include <ros/service_server.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ros/process/process.h"
#include "ros/service/limited_calls.h"
#include "ros/service/service_dependencies.h"
#include "ros/service/service_threads.h"
#include "ros/threads/background_thread.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/guard/frame_motion.h"
#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_ros {

/// Makes a detector by its name.
using MakeDetector = std::function<std::unique_ptr<sweep_guard_core::Detector>(
    const std::string& name, const sweep_guard_core::DetectorOptions& options)>;

/// Throws once a test is to end. What has been tested by then is no answer.
using GoOn = std::function<void(const std::string& where)>;

/// What a caller asks about.
struct PathQuestion {
  struct Path {
    std::shared_ptr<const sweep_guard_core::Workpiece> workpiece;
    std::shared_ptr<const sweep_guard_core::Tool> tool;
    std::vector<Eigen::Isometry3d> path_M;  ///< of the tool's frame
    std::vector<double> deviation_bounds;   ///< as in PathRequest
  };

  std::shared_ptr<const Parameters> parameters;
  std::string detector;  ///< its name
  sweep_guard_core::SweepOptions options;
  std::vector<Path> paths;
  sweep_guard_core::SteadyTime arrival;  ///< of the call
  GoOn go_on;
};

/// Sweeps paths against the workpieces as they are now, for the services that ask. Has a thread and detectors of its own; each
/// of these is tested when it is made (self_test). Works on a snapshot of the meshes, so the guard does not wait for it. A
/// question is given up before its first sweep after its deadline, which counts from the arrival of the call. The caller waits
/// 50 ms longer at most; a sweep that still runs delays the next question.
class PathTests {
 public:
  /// @param frame_motions  of frames that tf does not have; null: there are none
  PathTests(const ServiceDependencies& dependencies, const sweep_guard_core::FrameMotionStore* frame_motions,
            MakeDetector make_detector = sweep_guard_core::makeDetector)
      : dependencies_(dependencies), frame_motions_(frame_motions), make_detector_(std::move(make_detector)) {}
  PathTests(const PathTests&) = delete;
  PathTests& operator=(const PathTests&) = delete;

  void start(Supervisor& supervisor);
  void stop() { stopping_ = true; }  ///< gives up running and later tests soon. Any thread
  const LiveParameters& parameters() const { return dependencies_.parameters; }

  /// Begins a question.
  /// @param volume, detector  names; empty: as configured
  /// @param margin            [m]
  /// @param arrival           of the call
  /// @throws sweep_guard_core::InvalidInput if an option is out of range
  std::shared_ptr<PathQuestion> question(const std::string& volume, const std::string& detector, double margin,
                                         bool fine, sweep_guard_core::SteadyTime arrival) const;

  /// Returns the workpieces with these ids; all, if there are none.
  /// @throws sweep_guard_core::InvalidInput if one does not exist, or there is no workpiece at all
  /// @throws sweep_guard_core::Error if a workpiece was attached or detached meanwhile
  sweep_guard_core::Workpieces selected(const PathQuestion& question, const std::vector<std::string>& ids) const;

  /// Returns the transform from a frame to that of a mesh. Waits up to 0.1 s for it. The link of another tool is where it was
  /// measured last.
  /// @throws sweep_guard_core::Error if there is none
  Eigen::Isometry3d transform(const std::string& mesh_frame, const std_msgs::Header& header) const;

  /// Returns what each tool meets along its path, in the order of the paths.
  /// @throws sweep_guard_core::Error if the detector fails or failed its self-test, or if the question is given up
  std::vector<sweep_guard_core::PathResult> test(const std::shared_ptr<const PathQuestion>& question);

  /// Returns what is wrong with these workpieces, all if there are no ids; empty: nothing.
  std::string meshProblems(const std::vector<std::string>& ids) const;
  /// Returns the same or, if that is nothing, which transform between these frames and those of the workpieces tested is too
  /// old. After the test, which waits for late transforms, and during which a mesh may be refused.
  std::string doubts(const PathQuestion& question, const std::vector<std::string>& ids,
                     const std::set<std::string>& frames) const;

 private:
  bool isOfOtherTool(const std::string& frame) const;
  std::string oldTransforms(const PathQuestion& question, const std::set<std::string>& frames) const;
  GoOn untilDeadline(sweep_guard_core::Duration deadline, sweep_guard_core::SteadyTime arrival) const;

  std::vector<sweep_guard_core::PathResult> sweep(const PathQuestion& question);
  void setParameters(const std::shared_ptr<const Parameters>& current);
  sweep_guard_core::Detector& detector(const std::string& name);

  const ServiceDependencies dependencies_;
  const sweep_guard_core::FrameMotionStore* const frame_motions_;
  const MakeDetector make_detector_;
  // Of the thread that sweeps:
  std::shared_ptr<const Parameters> parameters_;                                  // of the newest call
  std::map<std::string, std::unique_ptr<sweep_guard_core::Detector>> detectors_;  // by name, made on demand
  std::atomic<bool> stopping_ = false;
  BackgroundThread sweeps_{[] { setNice(10); }};
};

/// Says what the test of a question has left out: allowed pairs (tool/allowed), and the inside of open surfaces.
/// @param[in,out] message  to the caller; is added to
void addRemarks(const PathQuestion& question, std::string& message);

/// Fills the answer to a question that was not tested.
template <typename Response>
bool refusePath(const std::string& reason, Response& response) {
  response.time_of_impact = std::numeric_limits<double>::quiet_NaN();
  response.message = reason;
  return true;
}

/// Fills the answer, and how long that took. Errors are answered by a message: a failed ROS call gives the caller none.
/// @param check  fills all but `success`, `message` of a failure and `compute_time`; may throw
template <typename Response, typename Check>
bool answerPath(Response& response, Check check) {
  const auto begin = std::chrono::steady_clock::now();
  response.time_of_impact = std::numeric_limits<double>::quiet_NaN();
  try {
    check();
    response.success = true;
  } catch (const std::exception& error) {
    response = Response();
    refusePath(error.what(), response);
  }
  response.compute_time = ros::Duration(sweep_guard_core::toSeconds(std::chrono::steady_clock::now() - begin));
  return true;
}

/// Serves path tests. Five calls are let in; any more are answered BUSY at once. A path is given up after its deadline. The
/// answer comes later if calls of other services keep the thread until then.
class PathService {
 public:
  /// @param tests  must outlive it
  /// @param check  as for answerPath()
  template <typename Request, typename Response>
  PathService(const ros::NodeHandle& private_node, const std::string& name, ServiceThreads& threads, PathTests& tests,
              void (*check)(PathTests&, sweep_guard_core::SteadyTime arrival, const Request&, Response&))
      : calls_(threads.lasting, threads.refusals),
        server_(calls_.advertise<ros::ServiceSpec<Request, Response>>(
            private_node, name, tests.parameters().initial().max_message_size,
            [this, &tests, check](Request& request, Response& response) {
              return answerPath(response, [&] { check(tests, calls_.arrival(), request, response); });
            },
            refusePath<Response>)) {}

 private:
  LimitedCalls calls_;  // before the server, which uses it
  ros::ServiceServer server_;
};

}  // namespace sweep_guard_ros
