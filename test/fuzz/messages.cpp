// Bytes from the wire, as they arrive at each subscription of the guard and the motion guard: lengths are checked, then they are read, converted and
// taken over.
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <sweep_guard/Intend.h>

#include <cmath>

#include "guard/workpiece_store.h"
#include "require.h"
#include "ros/connection/bounded.h"
#include "ros/input/frames.h"
#include "ros/input/other_tools.h"
#include "ros/input/pose_input.h"
#include "ros/motion/guard_input.h"
#include "ros/motion/motion_parameters.h"
#include "roscpp_alone.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/motion/motion_guard.h"
#include "sweep_guard/ros/conversions.h"
#include "target.h"
#include "wire_bytes.h"

namespace sweep_guard_fuzz {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::SteadyTime;
using sweep_guard_ros::BoundedMessages;

constexpr size_t kMaxSize = 1 << 16;
constexpr size_t kMaxTriangles = 1000;

// What the subscribers of both nodes keep, made anew for each input.
class Subscribers {
 public:
  Subscribers()
      : node_("/"),
        monitor_({milliseconds(100), milliseconds(500), milliseconds(500)}),
        store_([this](const sweep_guard_core::Workpieces& newest) { monitor_.setWorkpieces(newest); }),
        frames_(node_, kMaxSize,
                [this](const auto&, const auto&) { monitor_.placedAnew("a static transform changed"); }),
        live_(guardParameters()),
        poses_(node_, live_, {frames_, store_, monitor_, queue_, frame_motions_, recent_poses_}),
        other_tools_(node_, guardParameters(), {[](const auto& job) { job.run(); }, store_, frame_motions_, monitor_}),
        guard_(node_, motionParameters().guard, motionParameters().tool),
        motion_guard_(motionParameters().options) {}

  // The first byte chooses the topic, two more are the length.
  void receive(Input& input) {
    const int topic = input.byte();
    const size_t size = input.raw<std::uint16_t>();
    Bytes bytes;
    while (bytes.size() < size && !input.atEnd()) bytes.push_back(static_cast<std::uint8_t>(input.byte()));
    switch (topic % 13) {
      case 0:
        return deliver<geometry_msgs::PoseStamped>("/tool_pose", bytes);
      case 1:
        return deliver<tf2_msgs::TFMessage>("/tf", bytes);
      case 2:
        return deliver<tf2_msgs::TFMessage>("/tf_static", bytes);
      case 3:
        return convert<sweep_guard::DeformableMesh>(bytes, [this](const auto& msg) { setMesh(msg); });
      case 4:
        return convert<sweep_guard::MeshVertices>(bytes, [this](const auto& msg) { deform(msg); });
      case 5:
        return deliver<sweep_guard::Proximity>("/sweep_guard/proximity", bytes);
      case 6:
        return deliver<sweep_guard::ToolBalls>("/sweep_guard/tool_balls", bytes);
      case 7:
        return deliver<sweep_guard::Warning>("/sweep_guard/warning", bytes);
      case 8:
        return convert<geometry_msgs::Twist>(bytes, [this](const auto& msg) { command(msg); });
      case 9:
        return convert<geometry_msgs::TwistStamped>(bytes, [this](const auto& msg) { command(msg.twist); });
      case 10:
        return convert<sweep_guard::Intend>(bytes, [](const auto&) {});
      case 11:
        return deliver<sweep_guard::ToolSurface>("/peer/surface", bytes);
      default:
        return deliver<sweep_guard::ToolBodies>("/peer/bodies", bytes);
    }
  }

  void check() {
    sweep_guard_core::Warning warning;
    monitor_.warning(sweep_guard_ros::now(), warning);
    require(warning.level == sweep_guard_core::WarningLevel::kUnknown, "without a sweep no level is known");
    bytesOf(sweep_guard_ros::toMsg(warning));
    for (const auto& workpiece : store_.snapshot()) check(*workpiece);
    for (const auto& [frame, motion] : *frame_motions_.get()) check(*motion);
    sweep_guard_core::WorkQueue::Work work;
    if (queue_.hasPoses()) queue_.take(work);
    for (const sweep_guard_core::QueuedPose& queued : work.poses) {
      check(queued.pose.X_WT);
      for (const auto& [frame, X_WM] : queued.pose.X_WM) check(X_WM);
    }
  }

 private:
  static const sweep_guard_ros::Parameters& guardParameters() {
    static const sweep_guard_ros::Parameters parameters = [] {
      sweep_guard_ros::Parameters with_peer = sweep_guard_ros::loadParameters(ros::NodeHandle("/guard"));
      with_peer.other_tools = {"/peer"};
      with_peer.max_triangles = kMaxTriangles;
      return with_peer;
    }();
    return parameters;
  }
  static const sweep_guard_ros::MotionParameters& motionParameters() {
    static const sweep_guard_ros::MotionParameters parameters =
        sweep_guard_ros::loadMotionParameters(ros::NodeHandle("/motion"));
    return parameters;
  }

  template <typename Msg>
  static boost::shared_ptr<const Msg> read(BoundedMessages<Msg>& subscription, Bytes bytes) {
    ros::SubscriptionCallbackHelperDeserializeParams params;
    const Bytes sent = bytes;
    params.buffer = bytes.data();
    params.length = static_cast<std::uint32_t>(bytes.size());
    params.connection_header = connectionFrom("/sender");
    auto msg = boost::static_pointer_cast<const Msg>(subscription.deserialize(params));
    require(msg == nullptr || bytesOf(*msg) == sent, "a message that is read has all its bytes, and no others");
    return msg;
  }

  // As roscpp does.
  template <typename Msg>
  static void deliver(const std::string& topic, const Bytes& bytes) {
    auto& subscription = dynamic_cast<BoundedMessages<Msg>&>(*subscriptions().at(topic));
    const auto msg = read(subscription, bytes);
    if (msg == nullptr) return;
    ros::SubscriptionCallbackHelperCallParams params;
    params.event = ros::MessageEvent<void const>(msg, connectionFrom("/sender"), ros::Time(1000.0), false,
                                                 ros::DefaultMessageCreator<Msg>());
    subscription.call(params);
  }

  template <typename Msg, typename Take>
  static void convert(const Bytes& bytes, const Take& take) {
    BoundedMessages<Msg> subscription(
        "/topic", [](const auto&) {}, [](const std::string&) {}, kMaxSize);
    const auto msg = read(subscription, bytes);
    if (msg != nullptr) take(*msg);
  }

  // What MeshInput does in its threads.
  void setMesh(const sweep_guard::DeformableMesh& msg) {
    if (!sweep_guard_core::isName(msg.id) || !sweep_guard_core::isName(msg.header.frame_id)) return;
    try {
      store_.set({msg.id, msg.revision, sweep_guard_ros::fromMsg(msg.header.stamp), SteadyTime(), msg.header.frame_id,
                  sweep_guard_ros::fromMsg(msg.mesh, kMaxTriangles)},
                 sweep_guard_ros::now().stamp);
    } catch (const InvalidInput&) {
    }
  }
  void deform(const sweep_guard::MeshVertices& msg) {
    if (!sweep_guard_core::isName(msg.id) || !sweep_guard_core::isName(msg.header.frame_id)) return;
    try {
      store_.deform({msg.id, msg.revision, sweep_guard_ros::fromMsg(msg.header.stamp), SteadyTime(),
                     msg.header.frame_id, msg.positions},
                    sweep_guard_ros::now().stamp);
    } catch (const InvalidInput&) {
    }
  }

  void command(const geometry_msgs::Twist& msg) {
    sweep_guard_core::MotionInputs inputs = guard_.inputs();
    const sweep_guard_core::Instant now = sweep_guard_ros::now();
    inputs.pose = {Eigen::Isometry3d::Identity(), {now.stamp, now.steady}};
    sweep_guard_core::MotionCommand command;
    command.twist_W = {{msg.linear.x, msg.linear.y, msg.linear.z}, {msg.angular.x, msg.angular.y, msg.angular.z}};
    command.timestamps = {now.stamp, now.steady};
    command.period = milliseconds(10);
    try {
      const sweep_guard_core::GuardedMotion motion = motion_guard_.guard(inputs, command, now);
      require(motion.twist_W.v_W.allFinite() && motion.twist_W.w_W.allFinite(), "what is sent is finite");
      require(motion.scale >= 0.0 && motion.scale <= 1.0, "nothing is sent faster than it was commanded");
      const bool knows = inputs.warning && inputs.warning->level != sweep_guard_core::WarningLevel::kUnknown;
      const bool stands = motion.twist_W.v_W.isZero(0.0) && motion.twist_W.w_W.isZero(0.0);
      require(stands || (knows && inputs.planes && inputs.tool), "without a guard that knows, the tool stands still");
    } catch (const InvalidInput&) {
    }
  }

  static void check(const sweep_guard_core::Workpiece& workpiece) {
    require(sweep_guard_core::isName(workpiece.id) && sweep_guard_core::isName(workpiece.frame), "names are printable");
    const sweep_guard_core::TriangleMesh& mesh_M = workpiece.mesh_M;
    require(!mesh_M.triangles().empty() && mesh_M.triangles().size() <= kMaxTriangles,
            "a mesh has triangles, and not too many");
    for (size_t i = 0; i < mesh_M.vertexCount(); ++i) {
      require(mesh_M.vertex(i).cwiseAbs().maxCoeff() <= 1.0001e7, "vertices are finite, and within 1e7 m");
    }
    for (const auto& triangle : mesh_M.triangles()) {
      for (const std::uint32_t corner : triangle) require(corner < mesh_M.vertexCount(), "corners are vertices");
    }
  }

  static void check(const sweep_guard_core::FrameMotion& motion) {
    for (size_t i = 0; i < motion.measured.size(); ++i) {
      check(motion.measured[i].X_WM);
      require(motion.measured[i].deviation_bound >= 0.0, "a bound is a length");
      require(i == 0 || motion.measured[i - 1].stamp < motion.measured[i].stamp, "stamps ascend");
    }
    for (size_t i = 0; i < motion.predicted.size(); ++i) {
      check(motion.predicted[i].X_WM);
      require(motion.predicted[i].deviation_bound >= 0.0, "a bound is a length");
      require(i == 0 || motion.predicted[i - 1].ahead < motion.predicted[i].ahead, "predicted times ascend");
    }
  }

  static void check(const Eigen::Isometry3d& pose) {
    require(pose.matrix().allFinite(), "poses are finite");
    const Eigen::Matrix3d product = pose.linear() * pose.linear().transpose();
    require((product - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-9, "rotations are orthonormal");
  }

  const ros::NodeHandle node_;
  sweep_guard_core::WarningMonitor monitor_;
  sweep_guard_core::WorkpieceStore store_;
  sweep_guard_core::WorkQueue queue_;
  sweep_guard_ros::Frames frames_;
  sweep_guard_core::FrameMotionStore frame_motions_;
  sweep_guard_core::RecentPoses recent_poses_;
  sweep_guard_ros::LiveParameters live_;
  sweep_guard_ros::PoseInput poses_;
  sweep_guard_ros::OtherTools other_tools_;
  sweep_guard_ros::GuardInput guard_;
  sweep_guard_core::MotionGuard motion_guard_;
};

const Target kMessages("messages", [](Input input) {
  startRoscpp();
  Subscribers subscribers;
  for (int count = 0; count < 20 && !input.atEnd(); ++count) {
    subscribers.receive(input);
    subscribers.check();
  }
});

}  // namespace
}  // namespace sweep_guard_fuzz
