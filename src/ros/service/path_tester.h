#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ros/parameters/parameters.h"
#include "sweep_guard/detection/detector.h"
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

/// Sweeps paths for callers, with detectors of its own, each of which is tested when it is made.
class PathTester {
 public:
  explicit PathTester(MakeDetector make_detector) : make_detector_(std::move(make_detector)) {}

  /// Returns what each tool meets along its path.
  /// @throws sweep_guard_core::Error if the detector fails or failed its self-test; and what go_on() throws
  std::vector<sweep_guard_core::PathResult> test(const PathQuestion& question);

 private:
  void setParameters(const std::shared_ptr<const Parameters>& current);
  sweep_guard_core::Detector& detector(const std::string& name);

  const MakeDetector make_detector_;
  std::shared_ptr<const Parameters> parameters_;                                  // of the newest call
  std::map<std::string, std::unique_ptr<sweep_guard_core::Detector>> detectors_;  // by name, made on demand
};

}  // namespace sweep_guard_ros
