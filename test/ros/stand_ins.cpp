#include "stand_ins.h"

#include <std_msgs/Int8.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>

namespace sweep_guard_ros {
namespace {

constexpr int kDecelerateForCollision = 3;
constexpr int kHaltForCollision = 4;
constexpr std::uint32_t kServoQueue = 2;
constexpr auto kServoPeriod = std::chrono::milliseconds(8);
constexpr auto kArmPeriod = std::chrono::milliseconds(10);

geometry_msgs::Twist scaled(double scale, geometry_msgs::Twist twist) {
  for (double* const value :
       {&twist.linear.x, &twist.linear.y, &twist.linear.z, &twist.angular.x, &twist.angular.y, &twist.angular.z}) {
    *value *= scale;
  }
  return twist;
}

}  // namespace

FakeServo::FakeServo(const std::string& name) : node_(name), timeout_(node_.param("incoming_command_timeout", 0.0)) {
  joint_publisher_ = node_.advertise<trajectory_msgs::JointTrajectory>("joint_command", kServoQueue);
  status_publisher_ = node_.advertise<std_msgs::Int8>("status", kServoQueue);
  command_subscriber_ = node_.subscribe<geometry_msgs::TwistStamped>(
      "delta_twist_cmds", kServoQueue, [this](const geometry_msgs::TwistStamped::ConstPtr& command) {
        const std::lock_guard lock(mutex_);
        command_ = *command;
        if (!command->header.stamp.isZero()) newest_stamp_ = command->header.stamp;
      });
  scale_subscriber_ = node_.subscribe<std_msgs::Float64>("internal/collision_velocity_scale", kServoQueue,
                                                         [this](const std_msgs::Float64::ConstPtr& scale) {
                                                           const std::lock_guard lock(mutex_);
                                                           scale_ = scale->data;
                                                         });
  reset_ = node_.advertiseService<std_srvs::EmptyRequest, std_srvs::EmptyResponse>(
      "reset_servo_status", [this](std_srvs::EmptyRequest&, std_srvs::EmptyResponse&) {
        const std::lock_guard lock(mutex_);
        status_ = 0;
        return true;
      });
  repeater_.emplace(kServoPeriod, [this] { iterate(); });
}

void FakeServo::iterate() {
  const std::lock_guard lock(mutex_);
  std_msgs::Int8 status;
  status.data = static_cast<std::int8_t>(status_);
  status_publisher_.publish(status);
  geometry_msgs::Twist velocity;
  const bool stale = (ros::Time::now() - newest_stamp_).toSec() >= timeout_;
  if (command_.twist != geometry_msgs::Twist() && !stale) {
    if (scale_ > 0.0 && scale_ < 1.0) status_ = kDecelerateForCollision;
    if (scale_ == 0.0) status_ = kHaltForCollision;
    if (status_ != kHaltForCollision) velocity = scaled(scale_, command_.twist);
  }
  iterations_.set({velocity, scale_, status_});
  trajectory_msgs::JointTrajectory joints;  // without a stamp, as Servo's: from now on
  joints.joint_names = {"shoulder", "elbow"};
  joints.points.resize(1);
  joints.points[0].velocities = {-velocity.linear.z / kReach, 0.0};
  joints.points[0].time_from_start = ros::Duration(std::chrono::duration<double>(kServoPeriod).count());
  joint_publisher_.publish(joints);
}

FakeTwistMux::FakeTwistMux(const std::string& name) : node_(name) {
  XmlRpc::XmlRpcValue locks;
  if (!node_.getParam("locks", locks)) throw std::runtime_error("no parameter " + node_.resolveName("locks"));
  for (int i = 0; i < locks.size(); ++i) addLock(locks[i]);
  publisher_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  subscriber_ = ros::NodeHandle().subscribe<geometry_msgs::Twist>(
      "nav_vel", 1, [this](const geometry_msgs::Twist::ConstPtr& twist) { pass(*twist); });
}

void FakeTwistMux::addLock(XmlRpc::XmlRpcValue entry) {
  Lock& added = locks_.emplace_back();
  added.timeout = static_cast<double>(entry["timeout"]);
  added.priority = static_cast<int>(entry["priority"]);
  added.subscriber = ros::NodeHandle().subscribe<std_msgs::Bool>(static_cast<std::string>(entry["topic"]), 1,
                                                                 [this, &added](const std_msgs::Bool::ConstPtr& on) {
                                                                   const std::lock_guard lock(mutex_);
                                                                   added.stamp = ros::Time::now();
                                                                   added.on = on->data != 0;
                                                                 });
}

void FakeTwistMux::pass(const geometry_msgs::Twist& twist) {
  const std::lock_guard guard(mutex_);
  const bool locked = std::any_of(locks_.begin(), locks_.end(), [](const Lock& lock) {
    const bool expired = lock.timeout > 0.0 && (ros::Time::now() - lock.stamp).toSec() > lock.timeout;
    return lock.priority > kPriority && (expired || lock.on);
  });
  if (!locked) publisher_.publish(twist);
  locked_.set(locked);
}

FakeArm::FakeArm(const std::string& name, const geometry_msgs::Pose& pose) : node_(name), pose_(pose) {
  publisher_ = node_.advertise<geometry_msgs::PoseStamped>("measured_cp", 1);
  subscriber_ = node_.subscribe<geometry_msgs::PoseStamped>(
      "servo_cp", 1, [this](const geometry_msgs::PoseStamped::ConstPtr& command) {
        const std::lock_guard lock(mutex_);
        pose_ = command->pose;
        commands_.set(*command);
      });
  repeater_.emplace(kArmPeriod, [this] { publish(); });
}

void FakeArm::publish() {
  const std::lock_guard lock(mutex_);
  geometry_msgs::PoseStamped measured;
  measured.header.frame_id = "world";
  measured.header.stamp = ros::Time::now();
  measured.pose = pose_;
  publisher_.publish(measured);
}

}  // namespace sweep_guard_ros
