#include "ros/black_box/black_box_parameters.h"

#include <cstdlib>

#include "ros/parameters/finish_reading.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::toSeconds;

constexpr int kMaxMebibytes = 16777216;
constexpr std::size_t kMebibyte = 1U << 20U;

Duration seconds(ParameterReader& read, const std::string& key, Duration fallback, double lowest, double highest,
                 const std::string& effect) {
  return sweep_guard_core::fromSeconds(read.number(key, toSeconds(fallback), {lowest, highest, "s"}, effect));
}

// The folder that ROS gives nodes of this package to write to: $ROS_HOME/sweep_guard or ~/.ros/sweep_guard.
std::filesystem::path writableFolder(const std::string& instead) {
  const std::filesystem::path folder = "sweep_guard";
  if (const char* const home = std::getenv("ROS_HOME")) return home / folder;
  if (const char* const home = std::getenv("HOME")) return std::filesystem::path(home) / ".ros" / folder;
  throw sweep_guard_core::InvalidInput("ROS_HOME and HOME are not set: set " + instead);
}

std::filesystem::path readFolder(ParameterReader& read, const ros::NodeHandle& private_node) {
  std::filesystem::path folder = read.path("folder",
                                           "Folder of the recordings, for this node alone. Empty: the one with "
                                           "its name in $ROS_HOME/sweep_guard or ~/.ros/sweep_guard.");
  if (!folder.empty() && !folder.is_absolute()) {
    throw sweep_guard_core::InvalidInput("parameter folder is " + folder.string() + ", but must be an absolute path");
  }
  if (!folder.empty()) return folder;
  return writableFolder("folder") / private_node.getNamespace().substr(1);
}

void readTrigger(ParameterReader& read, sweep_guard_core::RecordingTrigger::Options& trigger) {
  trigger.on_contact = read.flag("on_contact", trigger.on_contact, "Records when the level becomes CONTACT.");
  trigger.on_reflex = read.flag("on_reflex", trigger.on_reflex, "Records when the level becomes REFLEX.");
  trigger.after =
      seconds(read, "after", trigger.after, 0.0, 60.0, "Time from an event to its recording; at most window.");
}

std::size_t mebibytes(ParameterReader& read, const std::string& key, int fallback, int lowest,
                      const std::string& effect) {
  return kMebibyte * static_cast<std::size_t>(read.integer(key, fallback, lowest, kMaxMebibytes, effect));
}

void readSizes(ParameterReader& read, BlackBoxParameters& parameters) {
  parameters.memory =
      mebibytes(read, "memory", 1024, 2,
                "[MiB] All messages in memory. Where `window` would take more than half, less time is kept.");
  parameters.quota =
      mebibytes(read, "quota", 4096, 1, "[MiB] All recordings in the folder. The oldest are deleted for a new one.");
  parameters.min_free =
      mebibytes(read, "min_free", 1024, 0, "[MiB] What a recording leaves free on the disk; else it is not written.");
}

}  // namespace

BlackBoxParameters loadBlackBoxParameters(const ros::NodeHandle& private_node) {
  ParameterReader read(private_node);
  BlackBoxParameters parameters;
  parameters.guard =
      read.node("guard", "sweep_guard", "Node of the guard to record, relative to the namespace of this node.");
  parameters.folder = readFolder(read, private_node);
  parameters.window = seconds(read, "window", std::chrono::seconds(30), 1.0, 600.0,
                              "Time that a recording covers before it is written.");
  readTrigger(read, parameters.trigger);
  if (parameters.trigger.after > parameters.window) {
    throw sweep_guard_core::InvalidInput("parameter after must be at most window");
  }
  readSizes(read, parameters);
  parameters.proximity =
      read.flag("proximity", false, "Records ~proximity, too, which the guard then computes at every pose.");
  parameters.interaction =
      read.flag("interaction", false, "Records ~interaction, too, which the guard then computes at every pose.");
  parameters.settings = finishReading(read);
  parameters.described = read.described();
  return parameters;
}

}  // namespace sweep_guard_ros
