#include "ros/parameters/camera_parameters.h"

#include <ros/names.h>

#include <algorithm>
#include <array>
#include <set>

#include "ros/parameters/parameter_text.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using XmlRpc::XmlRpcValue;

// A group of a list. What it throws follows "must be".
class GroupReader {
 public:
  explicit GroupReader(XmlRpcValue& group) : group_(group) {
    if (group.getType() != XmlRpcValue::TypeStruct) refuse("a list of groups");
  }

  std::string text(const std::string& name) {
    names_.push_back(name);
    if (!group_.hasMember(name) || group_[name].getType() != XmlRpcValue::TypeString ||
        static_cast<std::string>(group_[name]).empty())
      refuse("a list of groups that each have " + name + ": TEXT, not empty");
    texts_.push_back(group_[name]);
    return texts_.back();
  }

  double number(const std::string& name, double fallback, const ParameterRange& range) {
    names_.push_back(name);
    const double number = group_.hasMember(name) ? toNumber(group_[name]) : fallback;
    if (!within(number, range)) refuse("with " + name + ": " + described(range));
    texts_.push_back(shown(ParameterValue(number)));
    return number;
  }

  std::array<double, 2> pair(const std::string& name, std::array<double, 2> fallback, const ParameterRange& range) {
    names_.push_back(name);
    if (group_.hasMember(name)) {
      XmlRpcValue& list = group_[name];
      const std::string wanted = "with " + name + ": a list of two numbers, each " + described(range);
      if (list.getType() != XmlRpcValue::TypeArray || list.size() != 2) refuse(wanted);
      fallback = {toNumber(list[0]), toNumber(list[1])};
      if (!within(fallback[0], range) || !within(fallback[1], range)) refuse(wanted);
    }
    texts_.push_back(bracketed(std::vector{shown(ParameterValue(fallback[0])), shown(ParameterValue(fallback[1]))}));
    return fallback;
  }

  // Of all entries, which must have been read.
  std::string shownAll() {
    for (const auto& [name, value] : group_) {
      if (std::count(names_.begin(), names_.end(), name) == 0)
        refuse("without " + sweep_guard_core::printable(name) + ", of which a camera has none");
    }
    return grouped(names_, texts_);
  }

  [[noreturn]] static void refuse(const std::string& wanted) { throw sweep_guard_core::InvalidInput(wanted); }

 private:
  XmlRpcValue& group_;
  std::vector<std::string> names_;
  std::vector<std::string> texts_;
};

CameraParameters cameraOf(GroupReader& group) {
  CameraParameters camera;
  camera.id = group.text("id");
  std::string error;
  if (!sweep_guard_core::isName(camera.id) || !ros::names::validate("cameras/" + camera.id, error) ||
      camera.id.find('/') != std::string::npos)
    GroupReader::refuse("with ids of at most 128 letters, digits and _, which the topic ~cameras/ID may have");
  camera.depth = group.text("depth");
  const auto [nearest, farthest] = group.pair("range", {0.1, 4.0}, {0.001, 1000.0, "m"});
  if (!(nearest < farthest)) GroupReader::refuse("with range: [nearest, farthest]");
  camera.options.nearest = nearest;
  camera.options.farthest = farthest;
  camera.options.margin = group.pair("margin", camera.options.margin, {0.0, 1.0});
  camera.timeout = sweep_guard_core::fromSeconds(group.number("timeout", 0.2, {0.01, 60.0, "s"}));
  camera.options.surface_speed = group.number("surface_speed", camera.options.surface_speed, {0.0, 100.0, "m/s"});
  camera.self_padding = group.number("self_padding", 0.03, {0.0, 1.0, "m"});
  camera.options.remember = group.number("remember", camera.options.remember, {0.0, 60.0, "s"});
  return camera;
}

}  // namespace

std::vector<CameraParameters> readCameras(ParameterReader& read) {
  std::vector<CameraParameters> cameras;
  std::set<std::string> ids;
  read.groups("cameras", "a list of groups {id: TEXT, depth: TEXT} with further numbers, or []",
              "Depth cameras, each a workpiece that must be there: id (letters, digits, _), depth (topic of images) "
              "and, as doc/cameras.md says, range [m, m], margin [m, 1/m], timeout [s], surface_speed [m/s], "
              "self_padding [m], remember [s].",
              [&](XmlRpcValue& group) {
                GroupReader reader(group);
                cameras.push_back(cameraOf(reader));
                if (!ids.insert(cameras.back().id).second) GroupReader::refuse("with each id once");
                return reader.shownAll();
              });
  return cameras;
}

double readMinSeen(ParameterReader& read, double fallback) {
  return read.live().number(
      "min_seen", fallback, {0.001, 1.0},
      "With cameras: UNKNOWN where they see less than this share of the predicted path to be free.");
}

}  // namespace sweep_guard_ros
