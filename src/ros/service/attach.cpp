#include "ros/service/attach.h"

#include <ros/console.h>

#include <algorithm>

#include "common/number_text.h"
#include "guard/rigid_shape.h"
#include "ros/tool/payload.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/geometry/decomposition.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Error;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::PoseWithFrames;
using sweep_guard_core::printable;
using sweep_guard_core::TriangleMesh;
using sweep_guard_core::Workpiece;

constexpr size_t kMaxCut = 20000;  // triangles; the time to cut grows with them: a larger mesh becomes one hull

std::vector<sweep_guard_core::ConvexShape> shapesOf(const TriangleMesh& mesh_M) {
  sweep_guard_core::DecompositionOptions cuts;
  if (mesh_M.triangles().size() > kMaxCut) cuts.max_depth = 0;
  return sweep_guard_core::convexPieces(mesh_M, cuts);
}

Eigen::Isometry3d motionSince(const Workpiece& before, const Workpiece& newest) {
  if (before.frame != newest.frame || before.revision != newest.revision ||
      !sweep_guard_core::sameTriangles(before.mesh_M, newest.mesh_M))
    throw InvalidInput("'" + before.id + "' was replaced meanwhile: ask again");
  const sweep_guard_core::RigidFit fit = sweep_guard_core::rigidFit(before.mesh_M, newest.mesh_M);
  const double rounding = before.mesh_M.rounding() + newest.mesh_M.rounding();
  if (fit.deviation <= sweep_guard_core::WorkpieceStore::rigidWithin(rounding)) return fit.X_MM;
  throw InvalidInput("'" + before.id + "' has deformed by " + sweep_guard_core::shortText(fit.deviation) +
                     " m meanwhile: the tool can carry what keeps its shape");
}

// Returns the workpiece where the tool holds it at a pose.
Workpiece movedBy(const Eigen::Isometry3d& X_MM, const Workpiece& held, const PoseWithFrames& pose) {
  std::vector<Eigen::Vector3d> vertices_M;
  for (size_t i = 0; i < held.mesh_M.vertexCount(); ++i) vertices_M.push_back(X_MM * held.mesh_M.vertex(i));
  TriangleMesh moved_M(vertices_M, held.mesh_M.triangles(), held.mesh_M.isSheet(), held.mesh_M.rounding());
  moved_M.pad(held.mesh_M.padding());
  return {held.id, held.revision, pose.stamp, pose.received, held.frame, std::move(moved_M)};
}

}  // namespace

AttachService::AttachService(const ros::NodeHandle& private_node, ServiceThreads& threads,
                             const ServiceDependencies& dependencies, NewestPose newest_pose,
                             ExchangeTool exchange_tool)
    : dependencies_(dependencies),
      newest_pose_(std::move(newest_pose)),
      exchange_tool_(std::move(exchange_tool)),
      calls_(threads.lasting, threads.refusals),
      server_(calls_.advertise<Event>(private_node, "attach", kMaxRequest,
                                      [this](Event& event) { return onCall(event); })) {}

bool AttachService::onCall(Event& event) {
  const sweep_guard::Attach::Request& request = event.getRequest();
  sweep_guard::Attach::Response& response = event.getResponse();
  answerWith(response, [&] {
    if (!sweep_guard_core::isName(request.mesh_id)) throw InvalidInput("mesh_id is no name");
    return request.attach != 0 ? attach(request.mesh_id, request.link) : detach(request.mesh_id);
  });
  ROS_INFO("~attach called by %s: %s", printable(event.getCallerName()).c_str(), response.message.c_str());
  return true;
}

std::string AttachService::attach(const std::string& id, const std::string& link) {
  const auto before = dependencies_.parameters.get();
  if (before->attached.count(id) != 0) throw InvalidInput("'" + id + "' is attached already: detach it first");
  bodyWithLink(*before, link);
  const auto cut = workpieceOf(id);
  Payload payload{id, link, shapesOf(cut->mesh_M)};
  const std::string problems = dependencies_.monitor.meshProblems(now(), {id});
  if (!problems.empty()) throw Error(problems + ": where the tool holds it is not known");
  const auto newest = workpieceOf(id);  // the tool may have carried it meanwhile
  const PoseWithFrames pose = newestPose();
  payload.X_WM = lookup(newest->frame, pose.stamp) * motionSince(*cut, *newest);
  const auto next = std::make_shared<const Parameters>(withPayload(*before, payload, pose));
  exchange_tool_(before, next, [&] {
    dependencies_.workpieces.attach(cut, pose.bodies[bodyWithLink(*before, link)].X_WB.inverse() * payload.X_WM);
    require(*next);
  });
  return "'" + id + "' is part of the tool: " + std::to_string(payload.shapes_M.size()) + " convex piece(s) on " +
         (link.empty() ? "the cylinder" : "link '" + link + "'");
}

std::shared_ptr<const Workpiece> AttachService::workpieceOf(const std::string& id) const {
  const auto workpieces = dependencies_.workpieces.snapshot();
  const auto same = [&](const auto& workpiece) { return workpiece->id == id; };
  const auto found = std::find_if(workpieces.begin(), workpieces.end(), same);
  if (found == workpieces.end()) throw InvalidInput("there is no workpiece '" + id + "'");
  if ((*found)->of_other_tool) throw InvalidInput("'" + id + "' is a link of another tool");
  if ((*found)->of_camera)
    throw InvalidInput("'" + id + "' is what a camera sees: attach the mesh of what the tool holds");
  return *found;
}

std::string AttachService::detach(const std::string& id) {
  const auto before = dependencies_.parameters.get();
  const auto held = dependencies_.workpieces.attached(id);
  if (!held) throw InvalidInput("'" + id + "' is not attached");
  const PoseWithFrames pose = newestPose();
  const Eigen::Isometry3d X_WB = pose.bodies[bodyWithLink(*before, id)].X_WB;
  const Eigen::Isometry3d X_MM = lookup(held->workpiece->frame, pose.stamp).inverse() * X_WB * held->X_BM;
  const auto next = std::make_shared<const Parameters>(withoutPayload(*before, id));
  exchange_tool_(before, next, [&, restored = movedBy(X_MM, *held->workpiece, pose)] {
    dependencies_.workpieces.detach(restored);
    require(*next);
  });
  return "'" + id + "' is a workpiece, where the tool has held it last";
}

PoseWithFrames AttachService::newestPose() const {
  auto future = newest_pose_();
  if (future.wait_for(kGuardTimeout) != std::future_status::ready) throw Error("the guard is busy: ask again");
  return future.get();
}

Eigen::Isometry3d AttachService::lookup(const std::string& frame, sweep_guard_core::Time stamp) const {
  return dependencies_.frames.lookup(dependencies_.parameters.initial().fixed_frame, frame, stamp, kTransformWait);
}

// What is part of the tool need not be there as a workpiece.
void AttachService::require(const Parameters& next) const {
  std::set<std::string> ids = requiredIds(next);
  for (const std::string& id : next.attached) ids.erase(id);
  dependencies_.monitor.require(ids);
}

}  // namespace sweep_guard_ros
