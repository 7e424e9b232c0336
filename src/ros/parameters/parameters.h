#pragma once

#include <ros/node_handle.h>

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "sweep_guard/guard/guard.h"
#include "sweep_guard/monitor/warning.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_ros {

enum class ToolSource { kTopic, kTf };

/// Every parameter of the node, checked. loadParameters() has key, unit, range, default and effect of each;
/// doc/interface.md and config/sweep_guard.yaml are written from these.
struct Parameters {
  std::string fixed_frame;
  ToolSource tool_source;
  std::string tool_frame;
  std::shared_ptr<const sweep_guard_core::Tool> tool;
  double tool_padding;                ///< [m]
  std::string tool_description_text;  ///< what it is and where it comes from, for people
  std::string detector;
  std::string detector_description;  ///< its name, and what gives it OpenGL, for people
  sweep_guard_core::DetectorOptions detector_options;
  sweep_guard_core::GuardOptions guard;
  sweep_guard_core::WarningLimits limits;
  double marker_rate;                       ///< [Hz]
  std::set<std::string> marker_namespaces;  ///< those that are published
  int realtime_priority;                    ///< of the thread that sweeps; 0: none
  size_t max_triangles;
  ParameterReader::Settings settings;    ///< all that is set
  std::vector<ParameterInfo> described;  ///< always the same keys in the same order
};

/// Reads the private parameters; a missing one takes its default. Warns of each parameter that no one reads.
/// Makes the tool, too: of a robot description, if that is what tool/type asks for.
/// @throws sweep_guard_core::InvalidInput naming key, value and range if one has the wrong type, is NaN or is out of range;
///     naming link and file if the robot description makes no tool
Parameters loadParameters(const ros::NodeHandle& private_node);

/// Not all do: tools, topics and devices stay what they were made as.
bool changesWhileRunning(const std::string& key);

/// The parameters with some of them set anew, checked in the same way as at the start, each by itself and all together.
/// The others are as they were, whatever the parameter server says by now.
/// @throws sweep_guard_core::InvalidInput as loadParameters(), or if there is no such parameter or it does not change while
///     running
Parameters changeParameters(const ros::NodeHandle& private_node, const Parameters& before,
                            const std::map<std::string, ParameterValue>& changes);

struct ParameterChange {
  std::string key;
  ParameterValue before;
  ParameterValue after;
};

std::vector<ParameterChange> differences(const Parameters& before, const Parameters& after);

/// Whether one of those differs whose keys begin so.
bool differ(const Parameters& before, const Parameters& after, const std::string& beginning);

/// Whether a detector made for the one does not fit the other.
bool detectorsDiffer(const Parameters& before, const Parameters& after);

/// The parameters in force. What is handed out does not change; any thread.
class LiveParameters {
 public:
  explicit LiveParameters(Parameters initial);

  std::shared_ptr<const Parameters> get() const;
  void set(std::shared_ptr<const Parameters> parameters);
  const Parameters& initial() const { return *initial_; }  ///< those of the start

 private:
  const std::shared_ptr<const Parameters> initial_;
  mutable std::mutex mutex_;
  std::shared_ptr<const Parameters> current_;
};

}  // namespace sweep_guard_ros
