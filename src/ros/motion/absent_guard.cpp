#include "ros/motion/absent_guard.h"

#include <ros/names.h>

namespace sweep_guard_ros {
namespace {

// @param scope  namespace of the guard's node
std::string absentText(const std::string& topic, const std::string& argument, const std::string& name,
                       const std::string& scope) {
  const bool at_root = scope == "/";
  const std::string elsewhere = at_root ? "/NAMESPACE" + name : name.substr(scope.size());
  return "nobody publishes " + topic + ": start the guard, or give " + argument + ":=" + elsewhere + " if it is " +
         (at_root ? "in a namespace" : "at the root");
}

}  // namespace

std::string absentGuardText(const std::string& guard) {
  return absentText(guard + "/warning", "guard", guard, ros::names::parentNamespace(guard));
}

std::string absentWarningText(const std::string& topic) {
  return absentText(topic, "warning", topic, ros::names::parentNamespace(ros::names::parentNamespace(topic)));
}

}  // namespace sweep_guard_ros
