// Requests to the services of the guard, as bytes from the wire. They run in the threads of the services, one at a time. Not
// ~set_parameters, which is the target `parameters`.
#include <cmath>
#include <future>
#include <limits>

#include "guard/intention_store.h"
#include "guard/workpiece_store.h"
#include "require.h"
#include "ros/input/frames.h"
#include "ros/service/attach.h"
#include "ros/service/check_sweep.h"
#include "ros/service/check_trajectory.h"
#include "ros/service/controls.h"
#include "ros/service/intend.h"
#include "ros/service/predict.h"
#include "roscpp_alone.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/ros/conversions.h"
#include "target.h"
#include "wire_bytes.h"

namespace sweep_guard_fuzz {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::SteadyTime;

constexpr double kHalfWidth = 0.5;  // of the workpiece, a square in the plane z = 0 of the fixed frame [m]
constexpr double kLength = 0.15;    // of the tool, from its tip at the origin against z [m]
constexpr std::uint32_t kTriangles = 2;
const std::string kId = "liver";
constexpr double kUpperArm = 0.3;  // [m] along x at position 0, as the forearm; both turn about y
constexpr double kForearm = 0.2;   // [m]
const std::string kArm = R"(<robot name="arm">
  <link name="base"/>
  <link name="upper"><collision><origin xyz="0.15 0 0"/><geometry><box size="0.3 0.02 0.02"/></geometry></collision></link>
  <link name="fore"><collision><origin xyz="0.1 0 0"/><geometry><box size="0.2 0.02 0.02"/></geometry></collision></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0.3 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>)";

// Runs a call where roscpp would.
class Call : public ros::CallbackInterface {
 public:
  Call(ros::ServiceCallbackHelperPtr helper, ros::ServiceCallbackHelperCallParams& params, std::promise<bool>& sent)
      : helper_(std::move(helper)), params_(params), sent_(sent) {}
  CallResult call() override {
    sent_.set_value(helper_->call(params_));
    return Success;
  }

 private:
  const ros::ServiceCallbackHelperPtr helper_;
  ros::ServiceCallbackHelperCallParams& params_;
  std::promise<bool>& sent_;
};

// The services and what they ask, once for all inputs.
class Servers {
 public:
  Servers()
      : node_("/guard"),
        robot_node_("/robot"),
        live_(parameters(node_)),
        robot_live_(parameters(robot_node_)),
        monitor_(live_.initial().limits),
        store_([this](const sweep_guard_core::Workpieces& newest) {
          monitor_.setWorkpieces(newest);
          intentions_.follow(newest);
        }),
        frames_(node_, 1 << 16, [](const auto&, const auto&) {}),
        guard_(*live_.initial().tool, sweep_guard_core::makeDetector("halfspace"), live_.initial().guard),
        path_tests_({live_, frames_, store_, monitor_}, /*frame_motions=*/nullptr, makeDetector),
        robot_tests_({robot_live_, frames_, store_, monitor_}, /*frame_motions=*/nullptr, makeDetector),
        check_sweep_(node_, "check_sweep", service_threads_, path_tests_, sweep_guard_ros::checkSweep),
        check_trajectory_(robot_node_, "check_trajectory", service_threads_, robot_tests_,
                          sweep_guard_ros::checkTrajectory),
        predict_(node_, service_threads_, live_, store_,
                 [this](sweep_guard_core::Duration end) { return motion(end); }),
        intend_(node_, service_threads_, {live_, frames_, store_, monitor_}, intentions_),
        attach_(
            node_, service_threads_, {live_, frames_, store_, monitor_}, [this] { return newestPose(); },
            [this](const auto& /*before*/, const auto& next, const auto& /*also*/) { exchange(*next); }),
        controls_(node_, live_, monitor_, store_, service_threads_,
                  {[] {}, [this](const std::string& id) { return acknowledge(id); }, [] {}}) {
    const sweep_guard_core::TriangleMesh mesh({{-kHalfWidth, -kHalfWidth, 0},
                                               {kHalfWidth, -kHalfWidth, 0},
                                               {kHalfWidth, kHalfWidth, 0},
                                               {-kHalfWidth, kHalfWidth, 0}},
                                              {{0, 1, 2}, {0, 2, 3}});
    const auto now = sweep_guard_ros::now();
    store_.set({kId, 1, now.stamp, now.steady, "world", mesh}, now.stamp);
    sweep_guard_core::SweepReport report;
    for (int i = 0; i < 3; ++i) {
      sweep_guard_core::PoseWithFrames pose;
      pose.stamp = now.stamp + milliseconds(10 * (i - 3));
      pose.X_WT.translation() = Eigen::Vector3d(0.0, 0.0, -0.2 + 0.01 * i);
      pose.bodies = {{pose.X_WT}};
      pose.X_WM["world"] = Eigen::Isometry3d::Identity();
      guard_.sweep(pose, store_.snapshot(), report);
    }
    path_tests_.start(supervisor_);
    robot_tests_.start(supervisor_);
    service_threads_.start(supervisor_);
  }

  void call(Input& input) {
    switch (input.below(7)) {
      case 0:
        return judge(ask<sweep_guard::CheckSweep>("/guard/check_sweep", input.rest()));
      case 1:
        return judge(ask<sweep_guard::CheckTrajectory>("/robot/check_trajectory", input.rest()));
      case 2:
        return judge(ask<sweep_guard::Predict>("/guard/predict", input.rest()));
      case 3:
        return judge(ask<sweep_guard::SetIntent>("/guard/intend", input.rest()));
      case 4:
        return judge(ask<sweep_guard::Acknowledge>("/guard/acknowledge", input.rest()));
      case 5:
        return judge(ask<std_srvs::SetBool>("/guard/enable", input.rest()));
      default:
        return judge(ask<sweep_guard::Attach>("/guard/attach", input.rest()));
    }
  }

  void forget() {
    exchanged_ = false;
    intentions_.clear();
    monitor_.enable();
  }

 private:
  std::future<sweep_guard_core::PoseWithFrames> newestPose() {
    std::promise<sweep_guard_core::PoseWithFrames> pose;
    pose.set_value({sweep_guard_ros::now().stamp, std::chrono::steady_clock::now()});
    return pose.get_future();
  }

  void exchange(const sweep_guard_ros::Parameters& next) {
    require(next.tool->pieces().size() > live_.initial().tool->pieces().size(), "the tool has the payload");
    exchanged_ = true;
    throw sweep_guard_core::Error("the tool is as before");
  }

  template <typename Service>
  struct Exchange {
    std::optional<typename Service::Request> request;  // empty: it cannot be read
    typename Service::Response response;
  };

  static sweep_guard_ros::Parameters parameters(const ros::NodeHandle& node) {
    serverParameters() = {{"/guard/detector", std::string("halfspace")},
                          {"/guard/check_sweep/deadline", 0.2},
                          {"/guard/tool/length", kLength},
                          {"/guard/timing/mesh_timeout", std::numeric_limits<double>::infinity()},
                          {"/robot_description", kArm},
                          {"/robot/detector", std::string("halfspace")},
                          {"/robot/check_sweep/deadline", 0.2},
                          {"/robot/tool_frame", std::string("base")},
                          {"/robot/tool/type", std::string("urdf")}};
    return sweep_guard_ros::loadParameters(node);
  }

  static std::unique_ptr<sweep_guard_core::Detector> makeDetector(const std::string& name,
                                                                  const sweep_guard_core::DetectorOptions& options) {
    if (name == "select") throw sweep_guard_core::DeviceError("OpenGL is not fuzzed");
    return sweep_guard_core::makeDetector(name, options);
  }

  std::future<sweep_guard_ros::PredictService::Motion> motion(sweep_guard_core::Duration end) {
    std::promise<sweep_guard_ros::PredictService::Motion> promise;
    promise.set_value({guard_.predictMotion(milliseconds(10), end), milliseconds(10)});
    return promise.get_future();
  }

  std::string acknowledge(const std::string& id) {
    const std::string refusal = monitor_.acknowledge(id, sweep_guard_ros::now());
    if (!refusal.empty()) throw sweep_guard_core::Error(refusal);
    return id;
  }

  template <typename Service>
  static Exchange<Service> ask(const std::string& name, const std::string& bytes) {
    ros::ServiceCallbackHelperCallParams params;
    const boost::shared_array<std::uint8_t> buffer(new std::uint8_t[bytes.size() + 1]);
    std::copy(bytes.begin(), bytes.end(), buffer.get());
    params.request = ros::SerializedMessage(buffer, bytes.size());
    params.request.message_start = buffer.get();
    params.connection_header = connectionFrom("/caller");
    std::promise<bool> sent;
    std::future<bool> is_sent = sent.get_future();
    const sweep_guard_fuzz::Service& service = services().at(name);
    service.queue->addCallback(boost::make_shared<Call>(service.helper, params, sent), 1);
    require(is_sent.get(), "every request is answered");
    Exchange<Service> exchange;
    // As the client reads it: after a byte and the length.
    ros::SerializedMessage answer = params.response;
    answer.message_start = answer.buf.get() + 5;
    ros::serialization::deserializeMessage(answer, exchange.response);
    exchange.request = requestFrom<typename Service::Request>(bytes);
    return exchange;
  }

  template <typename Request>
  static std::optional<Request> requestFrom(const std::string& bytes) {
    std::optional<Request> request;
    try {
      const auto* const begin = reinterpret_cast<const std::uint8_t*>(bytes.data());
      sweep_guard_ros::checkLengths<Request>({begin, bytes.size()});
      Bytes copy(bytes.begin(), bytes.end());
      ros::serialization::IStream stream(copy.data(), static_cast<std::uint32_t>(copy.size()));
      ros::serialization::deserialize(stream, request.emplace());
    } catch (const sweep_guard_core::InvalidInput&) {
      request.reset();
    }
    return request;
  }

  // What holds for every path. Returns whether it was tested.
  template <typename Service>
  static bool isTested(const Exchange<Service>& exchange) {
    const auto& [request, response] = exchange;
    require(request || !response.success, "what cannot be read is refused");
    require(response.success || (!response.clear && !response.message.empty()), "a refusal says why, and is not clear");
    require(!response.clear || !response.collision, "a collision is not clear");
    if (!response.success) return false;
    require(response.collision || response.objects.empty() || request->fine,
            "without narrow phase what is named is met");
    require(std::isnan(response.time_of_impact) || (response.time_of_impact >= 0.0 && response.time_of_impact <= 1.0),
            "an impact is in its sweep");
    return true;
  }

  static void judge(const Exchange<sweep_guard::CheckSweep>& exchange) {
    if (!isTested(exchange)) return;
    const auto& [request, response] = exchange;
    require(response.segment < request->path.size(), "a collision is on the path");
    require(response.collision || !crosses(request->path), "no crossing is missed");
  }

  // Whether the line through the tool pierces the square at a pose, or the way of the tip from pose to pose does. A path in the
  // fixed frame alone.
  static bool crosses(const std::vector<geometry_msgs::PoseStamped>& path) {
    std::optional<Eigen::Vector3d> before;
    for (const geometry_msgs::PoseStamped& pose : path) {
      if (pose.header.frame_id != "world") return false;
      const Eigen::Isometry3d X = sweep_guard_ros::fromMsg(pose.pose);
      const Eigen::Vector3d tip = X.translation();
      if (pierces(tip, X * Eigen::Vector3d(0.0, 0.0, -kLength)) || (before && pierces(*before, tip))) return true;
      before = tip;
    }
    return false;
  }

  static void judge(const Exchange<sweep_guard::CheckTrajectory>& exchange) {
    if (!isTested(exchange)) return;
    const auto& [request, response] = exchange;
    require(response.segment < request->trajectory.points.size(), "a collision is on the way");
    require(response.deviation >= 0.0 && response.deviation <= 5e-4,
            "joints bend the way by half a millimeter at most");
    require(response.collision || !crosses(*request), "no crossing is missed");
  }

  // Whether the line through the arm pierces the square at one of 17 moments of a segment. With the base in the fixed frame.
  static bool crosses(const sweep_guard::CheckTrajectory::Request& request) {
    if (request.tool_pose.header.frame_id != "world") return false;
    const Eigen::Isometry3d X_WT = sweep_guard_ros::fromMsg(request.tool_pose.pose);
    const auto& points = request.trajectory.points;
    for (size_t i = 0; i < points.size(); ++i) {
      const Arm from = armAt(request.trajectory, i), to = armAt(request.trajectory, std::min(i + 1, points.size() - 1));
      for (int step = 0; step <= 16; ++step) {
        const double t = step / 16.0;
        const Arm arm{from.shoulder + t * (to.shoulder - from.shoulder), from.elbow + t * (to.elbow - from.elbow)};
        if (pierces(X_WT, arm)) return true;
      }
    }
    return false;
  }

  struct Arm {
    double shoulder, elbow;  // [rad]
  };

  static Arm armAt(const trajectory_msgs::JointTrajectory& trajectory, size_t point) {
    Arm arm{0.0, 0.0};
    for (size_t i = 0; i < trajectory.joint_names.size(); ++i) {
      (trajectory.joint_names[i] == "elbow" ? arm.elbow : arm.shoulder) = trajectory.points[point].positions[i];
    }
    return arm;
  }

  static bool pierces(const Eigen::Isometry3d& X_WT, const Arm& arm) {
    const auto along = [](double angle) { return Eigen::Vector3d(std::cos(angle), 0.0, -std::sin(angle)); };
    const Eigen::Vector3d elbow = kUpperArm * along(arm.shoulder);
    const Eigen::Vector3d wrist = elbow + kForearm * along(arm.shoulder + arm.elbow);
    return pierces(X_WT.translation(), X_WT * elbow) || pierces(X_WT * elbow, X_WT * wrist);
  }

  static bool pierces(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    if (!(from.z() * to.z() < 0.0) || std::abs(from.z()) < 1e-6 || std::abs(to.z()) < 1e-6) return false;
    const Eigen::Vector3d p = from + from.z() / (from.z() - to.z()) * (to - from);
    return std::max(std::abs(p.x()), std::abs(p.y())) < 0.9 * kHalfWidth;
  }

  static void judge(const Exchange<sweep_guard::Predict>& exchange) {
    const auto& [request, response] = exchange;
    require(request || !response.success, "what cannot be read is refused");
    require(response.success || !response.message.empty(), "a refusal says why");
    if (!response.success) return;
    const sweep_guard_core::Duration horizon(request->horizon.toNSec());
    require(horizon >= sweep_guard_core::Duration::zero() && horizon <= std::chrono::seconds(5),
            "a horizon is 5 s at most");
    const double probability = response.prediction.probability;
    require(!response.prediction.valid || (probability >= 0.0 && probability <= 1.0), "a probability is in [0, 1]");
    require(!response.prediction.collision || response.prediction.time_to_collision >= ros::Duration(0),
            "a collision has a time");
    // The tip rises by 1 m/s from 0.18 m below the square.
    require(horizon < milliseconds(500) || !response.prediction.valid || response.prediction.collision,
            "the square ahead is met");
  }

  void judge(const Exchange<sweep_guard::SetIntent>& exchange) {
    const auto& [request, response] = exchange;
    require(!response.message.empty(), "every answer says something");
    const auto intentions = intentions_.at(std::chrono::steady_clock::now());
    require(request || !response.success, "what cannot be read is refused");
    require(response.success || intentions->empty(), "what is refused changes nothing");
    require(intentions->size() <= sweep_guard_core::kMaxIntentions, "intentions are bounded");
    for (const sweep_guard_core::Intention& intention : *intentions) {
      require(intention.mesh_id == kId && !intention.triangles.empty(), "contact is meant with what is there");
      require(intention.triangles.back() < kTriangles, "its triangles exist");
      require(intention.depth > 0.0 && intention.depth <= 0.5, "its depth is bounded");
      require(intention.tool_links.empty() ||
                  intention.tool_links == std::vector<std::string>(intention.tool_links.size(), ""),
              "its links are those of the tool");
    }
  }

  static void judge(const Exchange<sweep_guard::Acknowledge>& exchange) {
    require(!exchange.response.success, "there is no warning to acknowledge");
    require(!exchange.response.message.empty(), "a refusal says why");
  }

  void judge(const Exchange<sweep_guard::Attach>& exchange) {
    const auto& [request, response] = exchange;
    require(!response.message.empty(), "every answer says something");
    require(!response.success, "no tool is exchanged here");
    const bool right = request && request->attach != 0 && request->mesh_id == kId && request->link.empty();
    require(exchanged_ == right, "the tool changes for the workpiece that is there alone");
  }

  void judge(const Exchange<std_srvs::SetBool>& exchange) {
    const auto& [request, response] = exchange;
    require(!response.message.empty(), "every answer says something");
    require(request || !response.success, "what cannot be read is refused");
    const bool disables = request && request->data == 0;
    require(monitor_.disabledBy().has_value() == disables, "the guard is disabled by that request alone");
  }

  const ros::NodeHandle node_;
  const ros::NodeHandle robot_node_;
  sweep_guard_ros::Supervisor supervisor_{sweep_guard_ros::Process::kShared};
  sweep_guard_ros::ServiceThreads service_threads_;
  const sweep_guard_ros::LiveParameters live_;
  const sweep_guard_ros::LiveParameters robot_live_;
  sweep_guard_core::WarningMonitor monitor_;
  sweep_guard_core::IntentionStore intentions_;
  sweep_guard_core::WorkpieceStore store_;
  sweep_guard_ros::Frames frames_;
  sweep_guard_core::Guard guard_;
  sweep_guard_ros::PathTests path_tests_;
  sweep_guard_ros::PathTests robot_tests_;
  sweep_guard_ros::PathService check_sweep_;
  sweep_guard_ros::PathService check_trajectory_;
  sweep_guard_ros::PredictService predict_;
  sweep_guard_ros::IntendService intend_;
  bool exchanged_ = false;  // the tool, by the last call
  sweep_guard_ros::AttachService attach_;
  sweep_guard_ros::Controls controls_;
};

const Target kRequests("requests", [](Input input) {
  startRoscpp();
  static auto* const servers = new Servers;  // its threads end with the process
  servers->call(input);
  servers->forget();
});

}  // namespace
}  // namespace sweep_guard_fuzz
