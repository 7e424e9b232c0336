#include "ros/service/intend.h"

#include <ros/console.h>

#include <algorithm>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::isName;

constexpr std::uint32_t kQueueLength = 100;  // of a stroke of the brush

sweep_guard::Intention intentionMsg(const sweep_guard_core::Intention& intention, const sweep_guard_core::Instant& now,
                                    std::uint32_t revision) {
  sweep_guard::Intention msg;
  msg.mesh_id = intention.mesh_id;
  msg.revision = revision;
  msg.triangles = intention.triangles;
  msg.depth = intention.depth;
  msg.tool_links = intention.tool_links;
  if (intention.until) msg.until = toMsg(now.stamp + (*intention.until - now.steady));
  return msg;
}

sweep_guard::Intended intendedMsg(const sweep_guard_core::Intentions& intentions,
                                  const sweep_guard_core::Workpieces& workpieces) {
  const sweep_guard_core::Instant at = now();
  sweep_guard::Intended msg;
  msg.header.stamp = toMsg(at.stamp);
  for (const sweep_guard_core::Intention& intention : intentions) {
    const auto concerned = std::find_if(workpieces.begin(), workpieces.end(),
                                        [&](const auto& workpiece) { return intention.concerns(*workpiece); });
    if (concerned == workpieces.end()) continue;
    msg.intentions.push_back(intentionMsg(intention, at, (*concerned)->revision));
  }
  return msg;
}

std::string summaryOf(const sweep_guard_core::Intentions& intentions) {
  if (intentions.empty()) return "contact is meant nowhere";
  size_t triangles = 0;
  for (const sweep_guard_core::Intention& intention : intentions) triangles += intention.triangles.size();
  return "contact is meant in " + std::to_string(intentions.size()) + " region(s) of " + std::to_string(triangles) +
         " triangle(s) in all";
}

}  // namespace

IntendService::IntendService(const ros::NodeHandle& private_node, ServiceThreads& threads,
                             const ServiceDependencies& dependencies, sweep_guard_core::IntentionStore& intentions)
    : dependencies_(dependencies),
      intentions_(intentions),
      publisher_(ros::NodeHandle(private_node).advertise<sweep_guard::Intended>("intended", 1, /*latch=*/true)),
      calls_(threads.brief, threads.refusals),
      updates_(subscribeBounded<sweep_guard::Intend>(
          threads.brief.on(private_node),
          {"intend_updates", kQueueLength, dependencies.parameters.initial().max_message_size},
          [this](const ros::MessageEvent<const sweep_guard::Intend>& event) { onUpdate(*event.getConstMessage()); },
          [this](const std::string& reason) { refuseUpdate(reason); })),
      server_(calls_.advertise<Event>(private_node, "intend", dependencies.parameters.initial().max_message_size,
                                      [this](Event& event) { return onCall(event); })) {
  publish({}, /*only_if_changed=*/false);
}

bool IntendService::onCall(Event& event) {
  sweep_guard::SetIntent::Response& response = event.getResponse();
  answerWith(response, [&] {
    set(event.getRequest().intends);
    return summaryOf(*intentions_.at(std::chrono::steady_clock::now()));
  });
  ROS_INFO("~intend called by %s: %s", sweep_guard_core::printable(event.getCallerName()).c_str(),
           response.message.c_str());
  publishIfChanged();
  return true;
}

void IntendService::onUpdate(const sweep_guard::Intend& intend) {
  try {
    set({intend});
    publish({}, /*only_if_changed=*/true);
  } catch (const std::exception& error) {
    refuseUpdate(error.what());
  }
}

void IntendService::refuseUpdate(const std::string& reason) {
  log_.error("update", "~intend_updates refused: " + reason);
  publish(reason, /*only_if_changed=*/false);
}

void IntendService::set(const std::vector<sweep_guard::Intend>& intends) {
  if (intends.size() > sweep_guard_core::kMaxIntentions) throw InvalidInput("send at most 64 regions at once");
  std::vector<sweep_guard_core::IntentionRequest> requests;
  requests.reserve(intends.size());
  for (const sweep_guard::Intend& intend : intends) requests.push_back(requestFrom(intend));
  intentions_.set(requests, std::chrono::steady_clock::now());
}

sweep_guard_core::IntentionRequest IntendService::requestFrom(const sweep_guard::Intend& intend) const {
  if (!isName(intend.mesh_id)) throw InvalidInput("mesh_id is no name");
  sweep_guard_core::IntentionRequest request{intend.mesh_id, intend.triangles};
  request.depth = intend.depth;
  request.tool_links = intend.tool_links;
  request.duration = std::chrono::nanoseconds(intend.duration.toNSec());
  if (intend.radius != 0.0) {
    request.radius = intend.radius;
    request.center_M = centerOf(intend);
  }
  if (request.takesBack()) return request;
  if (!dependencies_.parameters.get()->guard.sweep.fine) {
    throw InvalidInput("the parameter fine is false: no contact is confirmed, so none can be intended");
  }
  checkLinks(intend);
  return request;
}

Eigen::Vector3d IntendService::centerOf(const sweep_guard::Intend& intend) const {
  Eigen::Vector3d center(intend.center.x, intend.center.y, intend.center.z);
  const auto workpieces = dependencies_.workpieces.snapshot();
  const auto same = [&](const auto& workpiece) { return workpiece->id == intend.mesh_id; };
  const auto workpiece = std::find_if(workpieces.begin(), workpieces.end(), same);
  if (workpiece == workpieces.end() || intend.frame_id.empty()) return center;
  if (!isName(intend.frame_id)) throw InvalidInput("frame_id has more than 128 or unprintable characters");
  return dependencies_.frames.lookup((*workpiece)->frame, intend.frame_id, {}, kTransformWait) * center;
}

void IntendService::checkLinks(const sweep_guard::Intend& intend) const {
  const auto parameters = dependencies_.parameters.get();
  const auto& pieces = parameters->tool->pieces();
  for (const std::string& link : intend.tool_links) {
    const auto same = [&](const sweep_guard_core::ConvexPiece& piece) { return piece.link == link; };
    if (std::any_of(pieces.begin(), pieces.end(), same)) continue;
    throw InvalidInput("the tool has no link '" + sweep_guard_core::printable(link) + "'");
  }
}

void IntendService::publishIfChanged() {
  const sweep_guard_core::Lock lock(mutex_);
  const auto intentions = intentions_.at(std::chrono::steady_clock::now());
  if (intentions == published_) return;
  published_ = intentions;
  sweep_guard::Intended msg = intendedMsg(*intentions, dependencies_.workpieces.snapshot());
  msg.refusal = refusal_;
  publisher_.publish(msg);
}

void IntendService::publish(const std::string& refusal, bool only_if_changed) {
  {
    const sweep_guard_core::Lock lock(mutex_);
    if (!only_if_changed || refusal != refusal_) published_.reset();
    refusal_ = refusal;
  }
  publishIfChanged();
}

}  // namespace sweep_guard_ros
