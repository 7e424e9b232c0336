#pragma once

#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "motion/arms.h"
#include "motion/random_arms.h"
#include "solids.h"
#include "sweep_guard/motion/joint_motion_guard.h"
#include "sweep_guard/motion/proximity_finder.h"

namespace sweep_guard_core {

/// An arm and one obstacle at rest.
class ArmScene {
 public:
  static constexpr double kReach = 0.3;  ///< of the planes [m]

  ArmScene(const CapsuleArm& arm, const SentSurface& obstacle_W) : arm_(arm), obstacle_(obstacle_W) {
    for (const Eigen::Vector3d& vertex : obstacle_.vertices)
      center_ += vertex / static_cast<double>(obstacle_.vertices.size());
    for (const Eigen::Vector3d& vertex : obstacle_.vertices) radius_ = std::max(radius_, (vertex - center_).norm());
    for (const auto& [a, b, c] : obstacle_.triangles) {
      const auto& p = obstacle_.vertices;
      longest_ = std::max({longest_, (p[a] - p[b]).norm(), (p[b] - p[c]).norm(), (p[c] - p[a]).norm()});
    }
    workpieces_ = {std::make_shared<const Workpiece>(
        Workpiece{"obstacle", 1, at(0).stamp, at(0).steady, "obstacle", obstacle_.mesh()})};
    ToolBalls balls{1, {}, {}};
    for (size_t link = 0; link < arm_.bodies.size(); ++link) {
      for (const ConvexPiece& piece : arm_.bodies[link].pieces()) {
        balls.pieces.push_back(enclosingBalls(piece.shape_T));
        balls.frames.push_back(arm_.tree->links()[link].name);
      }
    }
    balls_ = std::make_shared<const ToolBalls>(balls);
  }

  const CapsuleArm& arm() const { return arm_; }
  const std::shared_ptr<const ToolBalls>& balls() const { return balls_; }

  std::vector<Eigen::Isometry3d> linksAt(const std::vector<double>& positions) const {
    std::vector<Eigen::Isometry3d> X_WL;
    arm_.tree->poses(positions, X_WL);
    return X_WL;
  }
  static Capsule placed(const Eigen::Isometry3d& X_WL, const Capsule& capsule) {
    return {X_WL * capsule.from, X_WL * capsule.to, capsule.radius};
  }

  /// Returns the nearest points of a capsule's axis and the obstacle. Empty distance: farther than `beyond` from the surface.
  NearestPair nearestOf(const Capsule& capsule, double beyond = std::numeric_limits<double>::infinity()) const {
    NearestPair nearest;
    NearestPair bound;
    takeSegments(capsule, center_, center_, bound);
    if (bound.distance - radius_ - capsule.radius > beyond) return nearest;
    const Eigen::Vector3d middle = 0.5 * (capsule.from + capsule.to);
    const double around = 0.5 * (capsule.to - capsule.from).norm() + longest_;
    for (const auto& [a, b, c] : obstacle_.triangles) {
      if ((obstacle_.vertices[a] - middle).norm() - around > nearest.distance) continue;
      takeTriangle(capsule, {obstacle_.vertices[a], obstacle_.vertices[b], obstacle_.vertices[c]}, nearest);
    }
    return nearest;
  }

  /// Returns the distance of the arm from the obstacle; negative: they overlap.
  double gapAt(const std::vector<double>& positions) const {
    double gap = std::numeric_limits<double>::infinity();
    const auto X_WL = linksAt(positions);
    for (size_t link = 0; link < X_WL.size(); ++link) {
      for (const Capsule& capsule : arm_.capsules[link])
        gap = std::min(gap, nearestOf(placed(X_WL[link], capsule), gap).distance - capsule.radius);
    }
    return gap;
  }

  std::shared_ptr<const PlaneSet> planesAt(const std::vector<double>& positions, int ms) {
    PoseWithFrames pose{
        at(ms).stamp, at(ms).steady, Eigen::Isometry3d::Identity(), {{"obstacle", Eigen::Isometry3d::Identity()}}};
    pose.bodies.clear();
    for (const Eigen::Isometry3d& X_WL : linksAt(positions)) pose.bodies.push_back({X_WL});
    BodyTools bodies;
    for (const Tool& body : arm_.bodies) bodies.push_back(&body);
    finder_.find({bodies, pose, workpieces_, kReach}, proximity_);
    PlaneSet planes{received(ms), at(ms + 100).stamp, true, 1, {}, proximity_.uncovered};
    for (const ProximityPlane& found : proximity_.planes) planes.planes.push_back(found.plane);
    for (const JointVariable& joint : arm_.tree->variables()) planes.joints.push_back(joint.name);
    planes.positions = positions;
    return std::make_shared<const PlaneSet>(planes);
  }

 private:
  const CapsuleArm& arm_;
  SentSurface obstacle_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;
  double longest_ = 0.0;  // edge [m]
  Workpieces workpieces_;
  std::shared_ptr<const ToolBalls> balls_;
  ProximityFinder finder_;
  Proximity proximity_;
};

/// An arm that follows commands at 100 Hz after 20 ms with a lag of 30 ms, and brakes no harder than the guard counts on, with or
/// without a guard. Positions reach the guard after
/// 10 ms, planes after 20 ms. A copy continues from the same state.
class ArmLoop {
 public:
  static constexpr int kPeriodMs = 10;
  static constexpr double kArm = 1.3;   ///< largest distance of a point from an axis [m]
  static constexpr double kGain = 1.0;  ///< of the speeds of all joints, until the gap is seen again [rad/s]

  ArmLoop(ArmScene& scene, const std::vector<double>& positions, bool guarded)
      : scene_(&scene),
        velocity_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(positions.size()))),
        followed_(velocity_),
        robot_(scene.arm().tree) {
    state_.positions = positions;
    for (int i = 0; i < 20; ++i) sent_.push_back(velocity_);
    if (!guarded) return;
    guard_ = std::make_shared<JointMotionGuard>(options(), scene.arm().tree);
    for (int i = 0; i < 3; ++i) measure();
  }
  ArmLoop(const ArmLoop& other) : robot_(other.scene_->arm().tree) { *this = other; }
  ArmLoop& operator=(const ArmLoop& other) {
    if (this == &other) return *this;
    scene_ = other.scene_;
    state_ = other.state_;
    velocity_ = other.velocity_;
    followed_ = other.followed_;
    sent_ = other.sent_;
    measured_ = other.measured_;
    ms_ = other.ms_;
    gap_ = other.gap_;
    unseen_ = other.unseen_;
    guard_ = other.guard_ ? std::make_shared<JointMotionGuard>(*other.guard_) : nullptr;
    return *this;
  }

  static MotionGuardOptions options() {
    MotionGuardOptions options;
    options.deceleration = 2.0;
    options.dead_time = std::chrono::milliseconds(20);
    options.time_constant = std::chrono::milliseconds(30);
    return options;
  }

  struct Cycle {
    double scale;
    double least_gap;  ///< at the steps of 1 ms; one is passed over where no contact is possible
  };

  Cycle run(const Eigen::VectorXd& command) {
    Cycle cycle{1.0, std::numeric_limits<double>::infinity()};
    if (guard_) cycle.scale = guarded(command);
    for (int step = 0; step < kPeriodMs; ++step) {
      sent_.emplace_back(cycle.scale * command);
      followed_ += (sent_.front() - followed_) / 30.0;
      sent_.pop_front();
      velocity_ = changed(robot_, state_, *scene_->balls(), options().deceleration, velocity_, followed_);
      state_ = after(state_, velocity_, 1e-3);
      if (gap_ > kArm * (velocity_.cwiseAbs().sum() + kGain) * 1e-3 * ++unseen_) continue;
      gap_ = scene_->gapAt(state_.positions);
      unseen_ = 0;
      cycle.least_gap = std::min(cycle.least_gap, gap_);
    }
    ms_ += kPeriodMs;
    return cycle;
  }

  const std::vector<double>& positions() const { return state_.positions; }
  const Eigen::VectorXd& velocity() const { return velocity_; }
  const ArmScene& scene() const { return *scene_; }

 private:
  void measure() {
    measured_.emplace_back(state_, scene_->planesAt(state_.positions, ms_));
    if (measured_.size() > 3) measured_.pop_front();
  }
  double guarded(const Eigen::VectorXd& command) {
    measure();
    auto planes = std::make_shared<PlaneSet>(*measured_[0].second);
    planes->timestamps = received(ms_ - 20);
    planes->valid_until = at(ms_ + 80).stamp;
    MotionInputs inputs{
        planes, scene_->balls(), {}, MotionInputs::GuardWarning{WarningLevel::kClear, 0, at(ms_).steady}};
    return guard_
        ->guard(inputs, {measured_[1].first, received(ms_ - 10)},
                {command, received(ms_), std::chrono::milliseconds(kPeriodMs)}, at(ms_))
        .scale;
  }

  ArmScene* scene_ = nullptr;
  RobotState state_;
  Eigen::VectorXd velocity_;
  Eigen::VectorXd followed_;  // without the limit of braking
  MovingTool robot_;
  std::deque<Eigen::VectorXd> sent_;                                             // not yet begun
  std::deque<std::pair<RobotState, std::shared_ptr<const PlaneSet>>> measured_;  // of the last three commands
  int ms_ = 0;
  double gap_ = 0.0;  // at the step that was seen last
  int unseen_ = 0;    // steps since
  std::shared_ptr<JointMotionGuard> guard_;
};

}  // namespace sweep_guard_core
