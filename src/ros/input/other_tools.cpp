#include "ros/input/other_tools.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "common/frame_name.h"
#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::FrameMotion;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::Time;

constexpr std::uint32_t kToolsQueued = 1000;
constexpr size_t kMaxBodiesSize = 16U << 20U;               // [bytes]
constexpr auto kKept = std::chrono::seconds(1);             // of the measured motion
constexpr auto kForgetPublisher = std::chrono::seconds(1);  // that is silent
constexpr size_t kMaxBodies = 1000;
constexpr size_t kJobSize = 1U << 20U;  // [bytes]

std::string frameOf(const std::string& name, const std::string& run_id, std::uint32_t revision, size_t body) {
  return name + "/" + run_id + "." + std::to_string(revision) + "." + std::to_string(body);
}

double checked(double deviation_bound) {
  if (deviation_bound >= 0.0 && deviation_bound <= sweep_guard_core::kMaxCoordinate) return deviation_bound;
  throw InvalidInput("a deviation bound of its poses is no length from 0 to 1e7 m");
}

std::vector<sweep_guard_core::PredictedFrame> pathFrom(const sweep_guard::BodyMotion& motion) {
  if (motion.predicted.size() != motion.predicted_deviation_bounds.size())
    throw InvalidInput("there are not as many deviation bounds as predicted poses");
  std::vector<sweep_guard_core::PredictedFrame> path;
  for (size_t i = 0; i < motion.predicted.size(); ++i) {
    const sweep_guard_core::PredictedPose pose = fromMsg(motion.predicted[i]);
    path.push_back({pose.ahead, pose.X_WT, pose.covariance, checked(motion.predicted_deviation_bounds[i])});
    const bool ascends = path.size() == 1 ? path[0].ahead == sweep_guard_core::Duration::zero()
                                          : path.back().ahead > path[path.size() - 2].ahead;
    if (!ascends) throw InvalidInput("predicted poses do not begin at 0 s and ascend in time");
  }
  return path;
}

}  // namespace

/// A checked ToolSurface.
struct OtherTools::Surface {
  std::string run_id;
  std::uint32_t revision;
  size_t bodies;
  std::vector<sweep_guard_core::Workpiece> links;
};

OtherTools::OtherTools(const ros::NodeHandle& node, const Parameters& parameters,
                       const OtherToolsDependencies& dependencies)
    : fixed_frame_(parameters.fixed_frame), max_triangles_(parameters.max_triangles), dependencies_(dependencies) {
  dependencies_.monitor.requireTools(parameters.other_tools);
  for (const std::string& name : parameters.other_tools) tools_.push_back({name});
  for (size_t i = 0; i < tools_.size(); ++i) {
    subscribers_.push_back(subscribe<sweep_guard::ToolSurface>(
        node, i, "/surface", parameters.max_message_size,
        [this, i](const sweep_guard::ToolSurface& msg, const std::string& /*publisher*/) { hear(i, msg); }));
    subscribers_.push_back(subscribe<sweep_guard::ToolBodies>(
        node, i, "/bodies", kMaxBodiesSize,
        [this, i, sole = SolePublisher(kForgetPublisher)](const sweep_guard::ToolBodies& msg,
                                                          const std::string& publisher) mutable {
          if (!sole.alone(publisher, now().steady)) throw InvalidInput("several nodes publish its poses");
          hear(i, msg);
        }));
  }
}

void OtherTools::start(Supervisor& supervisor) {
  if (subscribers_.empty()) return;
  thread_.start(supervisor,
                {"other tools", sweep_guard_core::Stage::kReceive, /*watched=*/true, /*loses_latched=*/true});
}

template <typename Msg, typename Hear>
BoundedSubscriber OtherTools::subscribe(const ros::NodeHandle& node, size_t tool, const std::string& topic,
                                        size_t max_size, Hear hear) {
  const std::string name = tools_[tool].name;
  return subscribeBounded<Msg>(
      thread_.on(node), {name + topic, kToolsQueued, max_size},
      [this, name, hear](const ros::MessageEvent<const Msg>& event) mutable {
        try {
          hear(*event.getConstMessage(), event.getPublisherName());
        } catch (const InvalidInput& error) {
          refuse(name, error.what());
        }
      },
      [this, name](const std::string& reason) { refuse(name, reason); });
}

void OtherTools::refuse(const std::string& name, const std::string& reason) {
  dependencies_.monitor.toolUnknown(name, reason);
  log_.error(name, "tool of '" + name + "': " + reason);
}

OtherTools::Surface OtherTools::surfaceFrom(const std::string& name, const sweep_guard::ToolSurface& msg) const {
  if (!sweep_guard_core::isName(msg.run_id)) throw InvalidInput("its surface has no run_id");
  Surface surface{msg.run_id, msg.revision, 0, {}};
  std::set<std::string> ids;
  for (const sweep_guard::LinkSurface& link : msg.links) {
    const std::string id = name + "/" + link.link;
    if (!sweep_guard_core::isName(link.link) || !sweep_guard_core::isName(id) || !ids.insert(id).second)
      throw InvalidInput("a link of its surface has no name of its own of up to 128 printable characters");
    if (link.body >= kMaxBodies) throw InvalidInput("its surface has more than 1000 bodies");
    surface.bodies = std::max<size_t>(surface.bodies, link.body + size_t{1});
    sweep_guard_core::Workpiece workpiece{id,
                                          msg.revision,
                                          now().stamp,
                                          now().steady,
                                          frameOf(name, msg.run_id, msg.revision, link.body),
                                          fromMsg(link.mesh, max_triangles_)};
    workpiece.of_other_tool = true;
    surface.links.push_back(std::move(workpiece));
  }
  if (surface.links.empty()) throw InvalidInput("its surface has no link");
  return surface;
}

// The thread of the store changes it; until then, no pose counts.
void OtherTools::hear(size_t tool, const sweep_guard::ToolSurface& msg) {
  const std::string& name = tools_[tool].name;
  {
    const sweep_guard_core::Lock lock(mutex_);
    Tool& known = tools_[tool];
    if (known.bodies > 0 && known.run_id == msg.run_id && known.revision == msg.revision) return;
    known.bodies = 0;
  }
  dependencies_.monitor.toolUnknown(name, "no pose has come since its surface came");
  const auto surface = std::make_shared<const Surface>(surfaceFrom(name, msg));
  dependencies_.change_store({[this, tool, surface] { take(tool, *surface); },
                              [this, name] { refuse(name, "its surface was dropped: too many meshes wait"); },
                              kJobSize});
}

void OtherTools::take(size_t tool, const Surface& surface) {
  const std::string beginning = tools_[tool].name + "/";
  std::set<std::string> frames;
  std::set<std::string> ids;
  for (const sweep_guard_core::Workpiece& link : surface.links) {
    frames.insert(link.frame);
    ids.insert(link.id);
  }
  dependencies_.frame_motions.expect(beginning, frames);
  const Time latest = now().stamp + kFutureTolerance;
  for (const auto& known : dependencies_.workpieces.snapshot()) {
    const bool gone = known->id.compare(0, beginning.size(), beginning) == 0 && ids.count(known->id) == 0;
    if (gone) dependencies_.workpieces.remove(known->id, latest);
  }
  try {
    for (const sweep_guard_core::Workpiece& link : surface.links) dependencies_.workpieces.set(link, latest);
  } catch (const InvalidInput& error) {
    return refuse(tools_[tool].name, error.what());
  }
  const sweep_guard_core::Lock lock(mutex_);
  Tool& known = tools_[tool];
  known.run_id = surface.run_id;
  known.revision = surface.revision;
  known.bodies = surface.bodies;
  known.sequence = 0;
  known.motions.clear();
}

void OtherTools::hear(size_t tool, const sweep_guard::ToolBodies& msg) {
  sweep_guard_core::Timestamps timestamps{fromMsg(msg.header.stamp), std::chrono::steady_clock::now()};
  const bool is_ahead = liesInFuture(timestamps);
  const sweep_guard_core::Lock lock(mutex_);
  Tool& known = tools_[tool];
  if (known.bodies == 0 || msg.run_id != known.run_id || msg.revision != known.revision)
    throw InvalidInput("its surface has not come");
  if (!sweep_guard_core::isSameFrame(msg.header.frame_id, fixed_frame_)) {
    throw InvalidInput("its poses are in '" + sweep_guard_core::printable(msg.header.frame_id) + "', not in '" +
                       fixed_frame_ + "': set fixed_frame alike");
  }
  if (timestamps.stamp == Time() || is_ahead) throw InvalidInput("the stamp of its pose is 0 or lies in the future");
  if (msg.bodies.size() != known.bodies) throw InvalidInput("its poses are not of as many bodies as its surface has");
  sweep_guard_core::FrameMotions motions;
  for (size_t body = 0; body < known.bodies; ++body) {
    add(body, msg, known);
    motions[frameOf(known.name, known.run_id, known.revision, body)] =
        std::make_shared<const FrameMotion>(known.motions[body]);
  }
  const bool lost = known.sequence != 0 && msg.sequence != known.sequence + 1;
  known.sequence = msg.sequence;
  dependencies_.frame_motions.set(motions);
  if (lost) {
    dependencies_.monitor.fault(sweep_guard_core::kPosesUnswept,
                                "how the tool of '" + known.name + "' moved is not known: poses of it were lost");
  }
  dependencies_.monitor.toolHeard(known.name, timestamps);
}

// After time went back, the motion begins anew.
void OtherTools::add(size_t body, const sweep_guard::ToolBodies& msg, Tool& tool) {
  const sweep_guard::BodyMotion& moved = msg.bodies[body];
  const sweep_guard_core::FramePose pose{fromMsg(msg.header.stamp), fromMsg(moved.pose),
                                         checked(moved.deviation_bound)};
  FrameMotion& motion = tool.motions[body];
  auto& measured = motion.measured;
  if (!measured.empty() && pose.stamp < measured.back().stamp) measured.clear();
  if (measured.empty() || pose.stamp > measured.back().stamp) measured.push_back(pose);
  const auto is_kept = [&](const sweep_guard_core::FramePose& one) { return pose.stamp - one.stamp <= kKept; };
  measured.erase(measured.begin(), std::find_if(measured.begin(), measured.end(), is_kept));
  if (!moved.predicted.empty() && msg.predicted_from > msg.header.stamp)
    throw InvalidInput("its prediction begins after its newest pose");
  motion.predicted = pathFrom(moved);
  motion.predicted_from = fromMsg(msg.predicted_from);
}

}  // namespace sweep_guard_ros
