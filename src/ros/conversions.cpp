#include "sweep_guard/ros/conversions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::InvalidInput;
using sweep_guard::Warning;

template <typename MessageConstant, typename CoreConstant>
constexpr bool same(MessageConstant in_message, CoreConstant in_core) {
  return static_cast<std::uint32_t>(in_message) == static_cast<std::uint32_t>(in_core);
}

static_assert(same(Warning::NO_POSE, sweep_guard::kNoPose));
static_assert(same(Warning::POSE_STALE, sweep_guard::kPoseStale));
static_assert(same(Warning::POSE_INVALID, sweep_guard::kPoseInvalid));
static_assert(same(Warning::OUT_OF_ORDER, sweep_guard::kOutOfOrder));
static_assert(same(Warning::FUTURE_STAMP, sweep_guard::kFutureStamp));
static_assert(same(Warning::NO_MESH, sweep_guard::kNoMesh));
static_assert(same(Warning::MESH_STALE, sweep_guard::kMeshStale));
static_assert(same(Warning::MESH_INVALID, sweep_guard::kMeshInvalid));
static_assert(same(Warning::TF_FAIL, sweep_guard::kTfFail));
static_assert(same(Warning::TIME_JUMP, sweep_guard::kTimeJump));
static_assert(same(Warning::DETECTOR_FAULT, sweep_guard::kDetectorFault));
static_assert(same(Warning::NOT_SWEPT, sweep_guard::kNotSwept));
static_assert(same(Warning::NOT_COVERED, sweep_guard::kNotCovered));
static_assert(same(Warning::OVERLOAD, sweep_guard::kOverload));
static_assert(same(Warning::UNKNOWN, sweep_guard::Level::kUnknown));
static_assert(same(Warning::CLEAR, sweep_guard::Level::kClear));
static_assert(same(Warning::CONSIDERED, sweep_guard::Level::kConsidered));
static_assert(same(Warning::REFLEX, sweep_guard::Level::kReflex));
static_assert(same(Warning::CONTACT, sweep_guard::Level::kContact));

template <typename Vector>
Eigen::Vector3d toEigen(const Vector& v) {
  return {v.x, v.y, v.z};
}

Eigen::Isometry3d rigid(const Eigen::Vector3d& translation, const geometry_msgs::Quaternion& rotation) {
  if (!(translation.cwiseAbs().maxCoeff() <= sweep_guard::kMaxCoordinate) || translation.hasNaN()) {
    throw InvalidInput("position is NaN, infinite or beyond 1e7 m");
  }
  const Eigen::Quaterniond q(rotation.w, rotation.x, rotation.y, rotation.z);
  if (!(std::abs(q.norm() - 1.0) <= 0.1)) throw InvalidInput("orientation is not a unit quaternion");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = translation;
  return pose;
}

sweep_guard::TriangleContact contact(const sweep_guard::TouchedTriangle& touched, const sweep_guard::Tool& tool) {
  sweep_guard::TriangleContact msg;
  msg.triangle = touched.triangle;
  msg.tool_link = tool.parts()[touched.part].link;
  msg.time_of_impact = touched.impact.time_of_impact;
  const auto& [p_M, n_M] = std::pair(touched.impact.point_M, touched.impact.normal_M);
  msg.point.x = p_M.x();
  msg.point.y = p_M.y();
  msg.point.z = p_M.z();
  msg.normal.x = n_M.x();
  msg.normal.y = n_M.y();
  msg.normal.z = n_M.z();
  msg.depth = touched.impact.depth;
  return msg;
}

sweep_guard::PredictedPose predictedPose(const sweep_guard::ExpectedPose& expected, sweep_guard::Duration age) {
  using RowMajor = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  sweep_guard::PredictedPose msg;
  msg.from_now = toMsg(expected.ahead - age);
  msg.pose = toMsg(expected.X_WT);
  Eigen::Map<RowMajor>(msg.covariance.data()) = expected.covariance;
  return msg;
}

}  // namespace

sweep_guard::Time fromMsg(const ros::Time& time) {
  return sweep_guard::Time(sweep_guard::Duration(static_cast<std::int64_t>(time.toNSec())));
}

ros::Time toMsg(sweep_guard::Time time) {
  ros::Time stamp;
  stamp.fromNSec(static_cast<std::uint64_t>(std::max<std::int64_t>(0, time.time_since_epoch().count())));
  return stamp;
}

ros::Duration toMsg(sweep_guard::Duration duration) { return ros::Duration().fromNSec(duration.count()); }

sweep_guard::Instant now() { return {fromMsg(ros::Time::now()), std::chrono::steady_clock::now()}; }

Eigen::Isometry3d fromMsg(const geometry_msgs::Pose& pose) { return rigid(toEigen(pose.position), pose.orientation); }

Eigen::Isometry3d fromMsg(const geometry_msgs::Transform& transform) {
  return rigid(toEigen(transform.translation), transform.rotation);
}

geometry_msgs::Pose toMsg(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  geometry_msgs::Pose msg;
  msg.position.x = pose.translation().x();
  msg.position.y = pose.translation().y();
  msg.position.z = pose.translation().z();
  msg.orientation.w = q.w();
  msg.orientation.x = q.x();
  msg.orientation.y = q.y();
  msg.orientation.z = q.z();
  return msg;
}

sweep_guard::TriangleMesh fromMsg(const shape_msgs::Mesh& mesh, size_t max_triangles) {
  if (mesh.triangles.size() > max_triangles) {
    throw InvalidInput(std::to_string(mesh.triangles.size()) + " triangles: limits/max_triangles is " +
                       std::to_string(max_triangles));
  }
  if (mesh.vertices.size() > 3 * max_triangles) {
    throw InvalidInput(std::to_string(mesh.vertices.size()) +
                       " vertices: more than three for each of limits/max_triangles");
  }
  std::vector<Eigen::Vector3d> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const geometry_msgs::Point& vertex : mesh.vertices) vertices.push_back(toEigen(vertex));
  std::vector<sweep_guard::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const shape_msgs::MeshTriangle& triangle : mesh.triangles) {
    const auto& index = triangle.vertex_indices;
    triangles.push_back({index[0], index[1], index[2]});
  }
  return sweep_guard::TriangleMesh(vertices, std::move(triangles));
}

sweep_guard::ObjectContacts toMsg(const sweep_guard::Workpiece& workpiece,
                                  const std::vector<std::uint32_t>& triangles) {
  sweep_guard::ObjectContacts msg;
  msg.mesh_id = workpiece.id;
  msg.revision = workpiece.revision;
  msg.mesh_stamp = toMsg(workpiece.stamp);
  msg.triangles = triangles;
  return msg;
}

sweep_guard::ObjectContacts toMsg(const sweep_guard::Workpiece& workpiece, const sweep_guard::SweepFindings& findings,
                                  const sweep_guard::Tool& tool) {
  sweep_guard::ObjectContacts msg = toMsg(workpiece, findings.triangles);
  msg.fine = findings.fine;
  msg.inside = findings.inside;
  msg.inside_tested = workpiece.mesh_M.closed();
  for (const sweep_guard::TouchedTriangle& touched : findings.touched) msg.impacts.push_back(contact(touched, tool));
  return msg;
}

sweep_guard::Contacts toMsg(const sweep_guard::SweepReport& report, const sweep_guard::Tool& tool) {
  sweep_guard::Contacts msg;
  msg.header.stamp = toMsg(report.end);
  msg.interval_start = toMsg(report.start);
  msg.margin = report.margin();
  for (const sweep_guard::SweptObject& object : report.objects) {
    if (object.findings.triangles.empty() && !object.findings.inside) continue;
    msg.objects.push_back(toMsg(*object.workpiece, object.findings, tool));
  }
  return msg;
}

sweep_guard::Prediction toMsg(const sweep_guard::Outlook& outlook, sweep_guard::Duration age,
                              const sweep_guard::VerdictLimits& limits) {
  sweep_guard::Prediction msg;
  msg.header.stamp = toMsg(outlook.stamp);
  for (const sweep_guard::ExpectedPose& expected : outlook.path) {
    if (expected.ahead > age) msg.poses.push_back(predictedPose(expected, age));
  }
  msg.sweeps_asked = static_cast<std::uint32_t>(outlook.sweeps_asked);
  msg.sweeps_made = static_cast<std::uint32_t>(outlook.sweeps_made);
  msg.valid = outlook.complete();
  msg.probability = msg.valid ? outlook.probability() : std::numeric_limits<double>::quiet_NaN();
  msg.time_to_collision = ros::Duration(-1.0);
  if (const auto met = outlook.met()) {
    msg.collision = true;
    msg.time_to_collision = toMsg(std::max(*met - age, sweep_guard::Duration::zero()));
  }
  if (const auto expected = sweep_guard::expectedContact(outlook, limits.min_probability)) {
    const sweep_guard::Level level = sweep_guard::warningOf(expected->from - outlook.stamp - age, limits);
    if (level == sweep_guard::Level::kReflex) msg.interval = sweep_guard::Prediction::REFLEX;
    if (level == sweep_guard::Level::kConsidered) msg.interval = sweep_guard::Prediction::CONSIDERED;
  }
  for (const sweep_guard::PredictedObject& object : outlook.objects) {
    const std::vector<std::uint32_t> triangles = object.triangles();
    if (!triangles.empty()) msg.objects.push_back(toMsg(*object.workpiece, triangles));
  }
  return msg;
}

double timeToCollision(const sweep_guard::Prediction& prediction) {
  if (prediction.time_to_collision >= ros::Duration(0)) return prediction.time_to_collision.toSec();
  return prediction.valid ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
}

sweep_guard::Warning toMsg(const sweep_guard::Verdict& verdict) {
  using sweep_guard::Level;
  Warning msg;
  msg.header.stamp = toMsg(verdict.pose_stamp);
  msg.level = static_cast<std::uint8_t>(verdict.level);
  msg.clear = verdict.level == Level::kClear;
  msg.contact = verdict.level == Level::kContact;
  msg.considered = !msg.clear;
  msg.reflex = msg.contact || verdict.level == Level::kReflex || (verdict.reasons & ~sweep_guard::kDegraded) != 0;
  msg.time_to_collision = ros::Duration(msg.contact ? 0.0 : -1.0);
  if (!msg.contact && verdict.time_to_collision) msg.time_to_collision = toMsg(*verdict.time_to_collision);
  msg.mesh_id = verdict.mesh_id;
  msg.triangles = verdict.triangles;
  msg.reasons = verdict.reasons;
  msg.text = verdict.text;
  msg.covered_until = toMsg(verdict.covered_until);
  return msg;
}

}  // namespace sweep_guard_ros
