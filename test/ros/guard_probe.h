#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <geometry_msgs/PoseStamped.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <sweep_guard/Acknowledge.h>
#include <sweep_guard/CheckSweep.h>
#include <sweep_guard/Contacts.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>
#include <sweep_guard/Predict.h>
#include <sweep_guard/Warning.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace sweep_guard_ros {

inline const Eigen::Vector3d kAway(0, 0, 0.5);  ///< where the tool meets nothing [m]
inline const Eigen::Vector3d kSquare(0, 0, -1);

inline double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Where the guard is configured to take the tool's pose from.
enum class ProbeSource { kTopic, kTf };

/// Publishes the inputs of a running guard, keeps its outputs, and waits for events. Drives the clock under simulated
/// time.
class GuardProbe {
 public:
  /// Returns when all connections to the guard exist. @throws std::runtime_error after 20 s
  explicit GuardProbe(bool drives_clock, ProbeSource pose_source = ProbeSource::kTopic);

  /// Moves the clock and returns when the guard has noticed.
  void setClock(ros::Time time);
  void advance(double seconds) { setClock(time_ + ros::Duration(seconds)); }
  /// Moves the clock by a small step. The guard may notice later, by at most 40 ms: it accepts stamps 50 ms ahead.
  void tick(double seconds);
  ros::Time time() const { return time_; }

  void publish(const geometry_msgs::PoseStamped& pose) { pose_publisher_.publish(pose); }
  void publish(const sweep_guard::DeformableMesh& mesh) { mesh_publisher_.publish(mesh); }
  void publish(const sweep_guard::MeshVertices& vertices) { vertices_publisher_.publish(vertices); }

  /// Publishes the pose of a frame in `world` now.
  void placeFrame(const std::string& frame, const Eigen::Isometry3d& X_WF);

  /// Publishes, and returns when the guard has this workpiece: ~check_sweep finds its first vertex.
  void place(const sweep_guard::DeformableMesh& mesh);
  void place(const sweep_guard::MeshVertices& vertices);
  void remove(const std::string& mesh_id);

  /// Publishes the pose, and returns the contacts of the sweep to it.
  sweep_guard::Contacts move(const geometry_msgs::PoseStamped& pose);

  /// Returns the first warning that fits, after the one returned before and after skipWarnings().
  /// @throws std::runtime_error after 20 s
  using Fits = std::function<bool(const sweep_guard::Warning&)>;
  sweep_guard::Warning awaitWarning(const Fits& fits);
  void skipWarnings();
  std::vector<sweep_guard::Warning> warnings() const;
  std::vector<sweep_guard::Contacts> awaitContacts(size_t count);  ///< all since the last call of forgetContacts()
  /// Returns them up to the pose of this stamp. Of queued poses only the last has contacts.
  std::vector<sweep_guard::Contacts> awaitContactsUpTo(ros::Time stamp);
  void forgetContacts();
  /// Returns the first markers that fit, after the ones returned before. @throws std::runtime_error after 20 s
  using MarkersFit = std::function<bool(const visualization_msgs::MarkerArray&)>;
  visualization_msgs::MarkerArray awaitMarkers(const MarkersFit& fit);

  /// Returns the prediction from the pose of this stamp. @throws std::runtime_error after 20 s
  sweep_guard::Prediction awaitPrediction(ros::Time stamp) const;
  std::vector<double> timesToCollision() const;  ///< one per prediction, in their order
  std::vector<sweep_guard::Prediction> predictions() const;
  void forgetPredictions();

  /// A flag, and when it was received.
  struct Flag {
    bool raised;
    std::chrono::steady_clock::time_point received;
  };
  /// Waits for this many flags, and returns all since the start. @throws std::runtime_error after 20 s
  std::vector<Flag> awaitReflexFlags(size_t count) const;
  std::vector<Flag> awaitConsideredFlags(size_t count) const;

  sweep_guard::CheckSweep::Response check(sweep_guard::CheckSweep::Request request);
  sweep_guard::Predict::Response predict(double horizon);
  sweep_guard::Acknowledge::Response acknowledge(const std::string& mesh_id);
  std_srvs::SetBool::Response enable(bool enabled);
  std_srvs::Trigger::Response reset();

  /// Changes parameters while the guard runs; false: refused.
  bool configure(const dynamic_reconfigure::Config& changes);
  dynamic_reconfigure::Config configuration() const;  ///< newest one published by the guard

  /// Waits for a status of this name that fits. @throws std::runtime_error after 20 s
  using Status = diagnostic_msgs::DiagnosticStatus;
  Status awaitStatus(const std::string& name, const std::function<bool(const Status&)>& fits);

  size_t markersReceived() const;

 private:
  template <typename Message, typename Take>
  void listen(const std::string& topic, Take take);
  void publishClock(ros::Time time);
  void awaitPlaced(const std::string& id, const Eigen::Vector3d& first_vertex, const std_msgs::Header& header);
  template <typename Condition>
  void await(const std::string& what, Condition&& condition) const;
  template <typename Condition>
  void awaitAnswer(const std::string& what, const sweep_guard::CheckSweep::Request& request, const Condition& fits);
  template <typename Message, typename Condition>
  Message awaitNext(const std::string& what, const std::vector<Message>& messages, size_t& next,
                    const Condition& fits) const;
  template <typename Value>
  Value copyOf(const Value& value) const;

  ros::NodeHandle node_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::vector<sweep_guard::Warning> warnings_;
  size_t next_warning_ = 0;
  std::vector<sweep_guard::Contacts> contacts_;
  std::vector<sweep_guard::Prediction> predictions_;
  std::vector<double> times_to_collision_;
  std::vector<Flag> reflex_flags_;
  std::vector<Flag> considered_flags_;
  std::vector<visualization_msgs::MarkerArray> markers_;
  size_t next_markers_ = 0;
  std::vector<Status> statuses_;
  dynamic_reconfigure::Config configuration_;
  ros::Time time_;

  ros::Publisher clock_publisher_;
  ros::Publisher pose_publisher_;
  ros::Publisher mesh_publisher_;
  ros::Publisher vertices_publisher_;
  ros::Publisher tf_publisher_;
  std::vector<ros::Subscriber> subscribers_;
  ros::ServiceClient check_sweep_;
  ros::ServiceClient predict_;
  ros::ServiceClient acknowledge_;
  ros::ServiceClient enable_;
  ros::ServiceClient reset_;
  ros::ServiceClient configure_;
  ros::AsyncSpinner spinner_{1};
};

/// Returns whether each interval begins where the previous one ended, so that no motion was left out.
bool endToEnd(const std::vector<sweep_guard::Contacts>& contacts);
size_t contactCount(const std::vector<sweep_guard::Contacts>& contacts);  ///< number of contacts with objects

/// Returns the value of a key in a status; empty if missing.
std::string valueOf(const diagnostic_msgs::DiagnosticStatus& status, const std::string& key);

/// Returns a tool pose with the tip at a point [m] in `world`, pointing down unless rotated.
geometry_msgs::PoseStamped poseAt(
    const Eigen::Vector3d& tip_W, ros::Time stamp,
    const Eigen::Quaterniond& rotation = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX())));

/// Returns a request to sweep along these tips [m] at the newest time.
sweep_guard::CheckSweep::Request requestAlong(const std::vector<Eigen::Vector3d>& tips_W);

/// Returns a square of two triangles, parallel to x and y, with its center at a point [m].
sweep_guard::DeformableMesh squareAt(const std::string& id, const Eigen::Vector3d& center, ros::Time stamp,
                                     double half_side = 0.1);
sweep_guard::MeshVertices squareMovedTo(const std::string& id, const Eigen::Vector3d& center, ros::Time stamp,
                                        double half_side = 0.1);

}  // namespace sweep_guard_ros
