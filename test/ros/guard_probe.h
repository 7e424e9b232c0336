#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <geometry_msgs/PoseStamped.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
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

/// Where the guard is configured to take the tool's pose from.
enum class PoseSource { kTopic, kTf };

/// Stands on both sides of a running guard: publishes its inputs, keeps its outputs, and waits for events among them.
/// Under simulated time it is the clock.
class GuardProbe {
 public:
  /// Returns when every connection to the guard stands. @throws std::runtime_error if that takes more than 20 s
  explicit GuardProbe(bool drives_clock, PoseSource pose_source = PoseSource::kTopic);

  /// Moves the clock and returns when the guard has noticed.
  void setClock(ros::Time time);
  void advance(double seconds) { setClock(time_ + ros::Duration(seconds)); }
  /// Moves the clock by a little. The guard may notice later, but is never more than 40 ms behind: stamps may be ahead
  /// of its clock by 50 ms.
  void tick(double seconds);
  ros::Time time() const { return time_; }

  void publish(const geometry_msgs::PoseStamped& pose) { pose_publisher_.publish(pose); }
  void publish(const sweep_guard::DeformableMesh& mesh) { mesh_publisher_.publish(mesh); }
  void publish(const sweep_guard::MeshVertices& vertices) { vertices_publisher_.publish(vertices); }

  /// Tells tf where a frame is in `world` now.
  void placeFrame(const std::string& frame, const Eigen::Isometry3d& X_WF);

  /// Publishes, and returns when the guard has the workpiece in this state: ~check_sweep finds its first vertex.
  void place(const sweep_guard::DeformableMesh& mesh);
  void place(const sweep_guard::MeshVertices& vertices);
  void remove(const std::string& mesh_id);

  /// Publishes the pose and returns what the guard found on the way to it.
  sweep_guard::Contacts move(const geometry_msgs::PoseStamped& pose);

  /// The first warning that fits, of those that came since the one returned last or since skipWarnings().
  /// @throws std::runtime_error after 20 s
  using Fits = std::function<bool(const sweep_guard::Warning&)>;
  sweep_guard::Warning awaitWarning(const Fits& fits);
  void skipWarnings();
  std::vector<sweep_guard::Warning> warnings() const;
  std::vector<sweep_guard::Contacts> awaitContacts(size_t count);  ///< all since the last call of forgetContacts()
  /// Likewise, up to the ones at the pose of this stamp: of poses that wait for each other only the last has any.
  std::vector<sweep_guard::Contacts> awaitContactsUpTo(ros::Time stamp);
  void forgetContacts();
  /// The first that fit, of those that came since the ones returned last. @throws std::runtime_error after 20 s
  using MarkersFit = std::function<bool(const visualization_msgs::MarkerArray&)>;
  visualization_msgs::MarkerArray awaitMarkers(const MarkersFit& fit);

  /// The prediction from the pose of this stamp. @throws std::runtime_error after 20 s
  sweep_guard::Prediction awaitPrediction(ros::Time stamp) const;
  std::vector<double> timesToCollision() const;  ///< as many as there are predictions, in their order
  std::vector<sweep_guard::Prediction> predictions() const;
  void forgetPredictions();

  /// A flag, and when it came.
  struct Flag {
    bool raised;
    std::chrono::steady_clock::time_point came;
  };
  /// Those since the start, as soon as there are so many. @throws std::runtime_error after 20 s
  std::vector<Flag> awaitReflexFlags(size_t count) const;
  std::vector<Flag> awaitConsideredFlags(size_t count) const;

  sweep_guard::CheckSweep::Response check(sweep_guard::CheckSweep::Request request);
  sweep_guard::Predict::Response predict(double horizon);
  std_srvs::SetBool::Response enable(bool enabled);
  std_srvs::Trigger::Response reset();

  /// Changes parameters while the guard runs; false: it refuses.
  bool configure(const dynamic_reconfigure::Config& changes);
  dynamic_reconfigure::Config configuration() const;  ///< the newest that the guard has told

  /// The first status of that name that fits, of those that come from now on. @throws std::runtime_error after 20 s
  using Status = diagnostic_msgs::DiagnosticStatus;
  Status awaitStatus(const std::string& name, const std::function<bool(const Status&)>& fits);

  size_t markersSoFar() const;

 private:
  template <typename Message, typename Take>
  void listen(const std::string& topic, Take take);
  void publishClock(ros::Time time);
  void awaitPlaced(const std::string& id, const Eigen::Vector3d& first_vertex, const std_msgs::Header& header);
  template <typename Condition>
  void await(const std::string& what, Condition&& condition) const;

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
  ros::ServiceClient enable_;
  ros::ServiceClient reset_;
  ros::ServiceClient configure_;
  ros::AsyncSpinner spinner_{1};
};

/// Each interval begins where the one before ended: no motion was left out.
bool endToEnd(const std::vector<sweep_guard::Contacts>& contacts);
size_t objectsMet(const std::vector<sweep_guard::Contacts>& contacts);  ///< in all of them

/// What a status says for a key; empty if it says nothing.
std::string valueOf(const diagnostic_msgs::DiagnosticStatus& status, const std::string& key);

/// Tool with its tip at a point [m] in `world`, pointing down unless turned.
geometry_msgs::PoseStamped poseAt(
    const Eigen::Vector3d& tip_W, ros::Time stamp,
    const Eigen::Quaterniond& rotation = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX())));

/// A square sheet of two triangles, parallel to x and y, its centre at a point [m].
sweep_guard::DeformableMesh sheetAt(const std::string& id, const Eigen::Vector3d& center, ros::Time stamp,
                                    double half_side = 0.1);
sweep_guard::MeshVertices sheetMovedTo(const std::string& id, const Eigen::Vector3d& center, ros::Time stamp,
                                       double half_side = 0.1);

}  // namespace sweep_guard_ros
