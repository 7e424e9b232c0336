#include "sweep_guard/ros/conversions.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <string>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;
using sweep_guard_core::InvalidInput;

template <typename MessageConstant, typename CoreConstant>
constexpr bool equal(MessageConstant in_message, CoreConstant in_core) {
  return static_cast<std::uint32_t>(in_message) == static_cast<std::uint32_t>(in_core);
}

static_assert(equal(Warning::NO_POSE, sweep_guard_core::kNoPose));
static_assert(equal(Warning::POSE_STALE, sweep_guard_core::kPoseStale));
static_assert(equal(Warning::POSE_INVALID, sweep_guard_core::kPoseInvalid));
static_assert(equal(Warning::OUT_OF_ORDER, sweep_guard_core::kOutOfOrder));
static_assert(equal(Warning::FUTURE_STAMP, sweep_guard_core::kFutureStamp));
static_assert(equal(Warning::NO_MESH, sweep_guard_core::kNoMesh));
static_assert(equal(Warning::MESH_STALE, sweep_guard_core::kMeshStale));
static_assert(equal(Warning::MESH_INVALID, sweep_guard_core::kMeshInvalid));
static_assert(equal(Warning::TF_FAIL, sweep_guard_core::kTfFail));
static_assert(equal(Warning::TIME_JUMP, sweep_guard_core::kTimeJump));
static_assert(equal(Warning::DETECTOR_FAULT, sweep_guard_core::kDetectorFault));
static_assert(equal(Warning::NOT_SWEPT, sweep_guard_core::kNotSwept));
static_assert(equal(Warning::NOT_COVERED, sweep_guard_core::kNotCovered));
static_assert(equal(Warning::OVERLOAD, sweep_guard_core::kOverload));
static_assert(equal(Warning::DISABLED, sweep_guard_core::kDisabled));
static_assert(equal(Warning::MULTI_PUBLISHER, sweep_guard_core::kMultiPublisher));
static_assert(equal(Warning::POSE_LOSS, sweep_guard_core::kPoseLoss));
static_assert(equal(Warning::INSIDE_UNTESTED, sweep_guard_core::kInsideUntested));
static_assert(equal(Warning::JUMP, sweep_guard_core::kJump));
static_assert(equal(Warning::NOT_SEEN, sweep_guard_core::kNotSeen));
static_assert(equal(Warning::POSES_UNSWEPT, sweep_guard_core::kPosesUnswept));
static_assert(equal(Warning::MESH_DROPPED, sweep_guard_core::kMeshDropped));
static_assert(equal(Warning::WORKER_HUNG, sweep_guard_core::kWorkerHung));
static_assert(equal(Warning::SELFTEST, sweep_guard_core::kSelftest));
static_assert(equal(Warning::CROSSCHECK, sweep_guard_core::kCrosscheck));
static_assert(equal(Warning::UNKNOWN, sweep_guard_core::WarningLevel::kUnknown));
static_assert(equal(Warning::CLEAR, sweep_guard_core::WarningLevel::kClear));
static_assert(equal(Warning::CONSIDERED, sweep_guard_core::WarningLevel::kConsidered));
static_assert(equal(Warning::REFLEX, sweep_guard_core::WarningLevel::kReflex));
static_assert(equal(Warning::CONTACT, sweep_guard_core::WarningLevel::kContact));

// What a message can hold. roscpp throws beyond that.
constexpr std::int64_t kLastStamp = (std::int64_t{1} << 32) * 1'000'000'000 - 1;  // [ns]
constexpr std::int64_t kLongest = ((std::int64_t{1} << 31) - 1) * 1'000'000'000;  // [ns]

using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

template <typename Vector>
Eigen::Vector3d toEigen(const Vector& v) {
  return {v.x, v.y, v.z};
}

std::string shortText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string inBrackets(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "(" : ", ") + shortText(value);
  return text + ")";
}

Eigen::Isometry3d rigid(const Eigen::Vector3d& translation, const geometry_msgs::Quaternion& rotation) {
  if (!(translation.cwiseAbs().maxCoeff() <= sweep_guard_core::kMaxCoordinate) || translation.hasNaN()) {
    throw InvalidInput("position is NaN, infinite or beyond 1e7 m: " +
                       inBrackets({translation.x(), translation.y(), translation.z()}));
  }
  const Eigen::Quaterniond q(rotation.w, rotation.x, rotation.y, rotation.z);
  if (!(std::abs(q.norm() - 1.0) <= 0.1)) {
    throw InvalidInput("orientation is not a unit quaternion: the length of " +
                       inBrackets({q.x(), q.y(), q.z(), q.w()}) + " is " + shortText(q.norm()));
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = translation;
  return pose;
}

sweep_guard::TriangleContact contactMsg(const sweep_guard_core::TriangleContact& contact,
                                        const sweep_guard_core::Tool& tool) {
  sweep_guard::TriangleContact msg;
  msg.triangle = contact.triangle;
  msg.tool_link = linkOf(tool, contact.piece);
  msg.time_of_impact = contact.impact.time_of_impact;
  msg.point = vectorMsg<geometry_msgs::Point>(contact.impact.point_M);
  msg.normal = vectorMsg<geometry_msgs::Vector3>(contact.impact.normal_M);
  msg.depth = contact.impact.depth;
  return msg;
}

// Converts fractions of the workpiece's interval to fractions of the report's, which is all that a subscriber knows.
void rescale(std::vector<sweep_guard::TriangleContact>& impacts, sweep_guard_core::Time interval_start,
             const sweep_guard_core::SweepReport& report) {
  if (interval_start == report.start) return;
  const double begin = sweep_guard_core::toSeconds(interval_start - report.start) /
                       sweep_guard_core::toSeconds(report.end - report.start);
  for (sweep_guard::TriangleContact& impact : impacts) {
    impact.time_of_impact = begin + (1.0 - begin) * impact.time_of_impact;
  }
}

// The earliest interval of all workpieces.
std::uint8_t intervalOf(const sweep_guard_core::Prediction& prediction, sweep_guard_core::Duration age,
                        const sweep_guard_core::WarningLimits& limits) {
  using sweep_guard_core::WarningLevel;
  const sweep_guard_core::Timestamps pose{prediction.stamp, {}};
  const sweep_guard_core::Instant at{prediction.stamp + age, {}};
  WarningLevel level = WarningLevel::kClear;
  std::optional<sweep_guard_core::PredictedContact> contact;
  for (const sweep_guard_core::PredictedObject& object : prediction.objects) {
    sweep_guard_core::findPredictedContact(
        prediction, object, pose,
        {limits.thresholds.reflex, limits.thresholds.considered_on, age + limits.reflex, age + limits.considered},
        contact);
    if (contact) level = std::max(level, warningLevel(*contact, at, limits));
  }
  if (level == WarningLevel::kReflex) return sweep_guard::Prediction::REFLEX;
  return level == WarningLevel::kConsidered ? sweep_guard::Prediction::CONSIDERED : sweep_guard::Prediction::NONE;
}

}  // namespace

sweep_guard_core::Time fromMsg(const ros::Time& time) {
  return sweep_guard_core::Time(sweep_guard_core::Duration(static_cast<std::int64_t>(time.toNSec())));
}

ros::Time toMsg(sweep_guard_core::Time time) {
  const std::int64_t count = time.time_since_epoch().count();
  return ros::Time().fromNSec(static_cast<std::uint64_t>(std::clamp<std::int64_t>(count, 0, kLastStamp)));
}

ros::Duration toMsg(sweep_guard_core::Duration duration) {
  return ros::Duration().fromNSec(std::clamp<std::int64_t>(duration.count(), -kLongest, kLongest));
}

sweep_guard_core::Instant now() { return {fromMsg(ros::Time::now()), std::chrono::steady_clock::now()}; }

Eigen::Isometry3d fromMsg(const geometry_msgs::Pose& pose) { return rigid(toEigen(pose.position), pose.orientation); }

Eigen::Isometry3d fromMsg(const geometry_msgs::Transform& transform) {
  return rigid(toEigen(transform.translation), transform.rotation);
}

geometry_msgs::Pose toMsg(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  geometry_msgs::Pose msg;
  msg.position = vectorMsg<geometry_msgs::Point>(pose.translation());
  msg.orientation.w = q.w();
  msg.orientation.x = q.x();
  msg.orientation.y = q.y();
  msg.orientation.z = q.z();
  return msg;
}

sweep_guard_core::TriangleMesh fromMsg(const shape_msgs::Mesh& mesh, size_t max_triangles, bool is_sheet) {
  if (mesh.triangles.size() > max_triangles) {
    throw InvalidInput(std::to_string(mesh.triangles.size()) + " triangles exceed limits/max_triangles, " +
                       std::to_string(max_triangles));
  }
  if (mesh.vertices.size() > 3 * max_triangles) {
    throw InvalidInput(std::to_string(mesh.vertices.size()) + " vertices exceed three times limits/max_triangles");
  }
  std::vector<Eigen::Vector3d> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const geometry_msgs::Point& vertex : mesh.vertices) vertices.push_back(toEigen(vertex));
  std::vector<sweep_guard_core::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const shape_msgs::MeshTriangle& triangle : mesh.triangles) {
    const auto& index = triangle.vertex_indices;
    triangles.push_back({index[0], index[1], index[2]});
  }
  return sweep_guard_core::TriangleMesh(vertices, std::move(triangles), is_sheet);
}

sweep_guard::PredictedPose toMsg(const sweep_guard_core::PredictedPose& pose, sweep_guard_core::Duration age) {
  sweep_guard::PredictedPose msg;
  msg.from_now = toMsg(pose.ahead - age);
  msg.pose = toMsg(pose.X_WT);
  Eigen::Map<RowMajor6d>(msg.covariance.data()) = pose.covariance;
  return msg;
}

sweep_guard_core::PredictedPose fromMsg(const sweep_guard::PredictedPose& pose) {
  const sweep_guard_core::Matrix6d covariance = Eigen::Map<const RowMajor6d>(pose.covariance.data());
  if (!covariance.allFinite()) throw InvalidInput("covariance is NaN or infinite");
  return {sweep_guard_core::Duration(pose.from_now.toNSec()), fromMsg(pose.pose), covariance};
}

sweep_guard::ObjectContacts toMsg(const sweep_guard_core::Workpiece& workpiece,
                                  const std::vector<std::uint32_t>& triangles) {
  sweep_guard::ObjectContacts msg;
  msg.mesh_id = workpiece.id;
  msg.revision = workpiece.revision;
  msg.mesh_stamp = toMsg(workpiece.stamp);
  msg.triangles = triangles;
  return msg;
}

sweep_guard::ObjectContacts toMsg(const sweep_guard_core::Workpiece& workpiece,
                                  const sweep_guard_core::SweepResult& result, const sweep_guard_core::Tool& tool) {
  sweep_guard::ObjectContacts msg = toMsg(workpiece, result.triangles);
  msg.fine = result.fine;
  msg.inside = result.inside;
  msg.inside_tested = workpiece.mesh_M.closed();
  msg.intended = result.intended;
  for (const sweep_guard_core::TriangleContact& contact : result.in_contact)
    msg.impacts.push_back(contactMsg(contact, tool));
  return msg;
}

sweep_guard::ObjectContacts allowedMsg(const sweep_guard_core::Workpiece& workpiece,
                                       const sweep_guard_core::SweepResult& result,
                                       const sweep_guard_core::Tool& tool) {
  sweep_guard::ObjectContacts msg = toMsg(workpiece, result.allowed.triangles);
  msg.fine = result.fine;
  for (const sweep_guard_core::TriangleContact& contact : result.allowed.in_contact)
    msg.impacts.push_back(contactMsg(contact, tool));
  return msg;
}

sweep_guard::Contacts toMsg(const sweep_guard_core::SweepReport& report, const sweep_guard_core::Tool& tool) {
  sweep_guard::Contacts msg;
  msg.header.stamp = toMsg(report.end);
  msg.interval_start = toMsg(report.start);
  msg.margin = report.margin();
  const auto add = [&](const sweep_guard_core::SweptObject& object) {
    if (!object.result.allowed.triangles.empty()) {
      msg.allowed.push_back(allowedMsg(*object.workpiece, object.result, tool));
      rescale(msg.allowed.back().impacts, object.interval_start, report);
    }
    if (object.result.triangles.empty() && !object.result.inside) return;
    msg.objects.push_back(toMsg(*object.workpiece, object.result, tool));
    rescale(msg.objects.back().impacts, object.interval_start, report);
  };
  std::for_each(report.objects.begin(), report.objects.end(), add);
  std::for_each(report.replaced.begin(), report.replaced.end(), add);
  return msg;
}

sweep_guard::Prediction toMsg(const sweep_guard_core::Prediction& prediction, sweep_guard_core::Duration age,
                              const sweep_guard_core::WarningLimits& limits) {
  sweep_guard::Prediction msg;
  msg.header.stamp = toMsg(prediction.stamp);
  for (const sweep_guard_core::PredictedPose& pose : prediction.path) {
    if (pose.ahead > age) msg.poses.push_back(toMsg(pose, age));
  }
  for (const sweep_guard_core::PredictedPath& path : prediction.body_paths) {
    sweep_guard::PredictedBody& body = msg.bodies.emplace_back();
    for (const sweep_guard_core::PredictedPose& pose : path) {
      if (pose.ahead > age) body.poses.push_back(toMsg(pose, age));
    }
  }
  msg.prediction_source = textOf(prediction.source);
  msg.sweeps_asked = static_cast<std::uint32_t>(prediction.sweeps_asked);
  msg.sweeps_made = static_cast<std::uint32_t>(prediction.sweeps_made);
  msg.valid = prediction.complete();
  const double probability =
      prediction.probability(sweep_guard_core::PredictionInterval::kConsidered, age + limits.considered);
  msg.probability = msg.valid ? probability : std::numeric_limits<double>::quiet_NaN();
  msg.time_to_collision = ros::Duration(-1.0);
  if (const auto first = prediction.firstContact()) {
    msg.collision = true;
    msg.time_to_collision = toMsg(std::max(*first - age, sweep_guard_core::Duration::zero()));
  }
  msg.interval = intervalOf(prediction, age, limits);
  for (const sweep_guard_core::PredictedObject& object : prediction.objects) {
    const std::vector<std::uint32_t> triangles = object.triangles();
    if (!triangles.empty()) msg.objects.push_back(toMsg(*object.workpiece, triangles));
  }
  return msg;
}

std::string linkOf(const sweep_guard_core::Tool& tool, size_t piece) {
  return piece < tool.pieces().size() ? tool.pieces()[piece].link : "";
}

double timeToCollision(const sweep_guard::Prediction& prediction) {
  if (prediction.time_to_collision >= ros::Duration(0)) return prediction.time_to_collision.toSec();
  return prediction.valid ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
}

void setLevel(sweep_guard::Warning& msg, sweep_guard_core::WarningLevel level, std::uint32_t reasons) {
  using sweep_guard_core::WarningLevel;
  msg.level = static_cast<std::uint8_t>(level);
  msg.reasons = reasons;
  msg.clear = level == WarningLevel::kClear;
  msg.contact = level == WarningLevel::kContact;
  msg.considered = !msg.clear;
  msg.reflex = msg.contact || level == WarningLevel::kReflex || (reasons & ~sweep_guard_core::kNotStopping) != 0;
}

sweep_guard::Warning toMsg(const sweep_guard_core::Warning& warning) {
  Warning msg;
  msg.header.stamp = toMsg(warning.pose_stamp);
  setLevel(msg, warning.level, warning.reasons);
  msg.time_to_collision = ros::Duration(msg.contact ? 0.0 : -1.0);
  if (!msg.contact && warning.time_to_collision) msg.time_to_collision = toMsg(*warning.time_to_collision);
  msg.mesh_id = warning.mesh_id;
  msg.triangles = warning.triangles;
  msg.text = warning.text;
  msg.covered_until = toMsg(warning.covered_until);
  msg.held = warning.held_since.has_value();
  if (warning.held_since) msg.held_since = toMsg(*warning.held_since);
  msg.acknowledged = warning.acknowledged;
  msg.intended = warning.intended;
  msg.seen = orNan(warning.seen);
  return msg;
}

}  // namespace sweep_guard_ros
