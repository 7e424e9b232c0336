#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/callback_queue.h>
#include <ros/spinner.h>
#include <ros/subscriber.h>
#include <sweep_guard/Contacts.h>
#include <sweep_guard/Prediction.h>
#include <sweep_guard/Warning.h>

#include <mutex>
#include <string>
#include <vector>

#include "latency/latencies.h"

namespace sweep_guard_benchmark {

/// The time that the guard's threads spent in a stage of their work, during the period of one diagnostics message.
struct StageShare {
  std::string stage;
  double percent;  ///< of one processor's time
};

/// The shares of one period.
struct StageReport {
  Nanoseconds received;
  std::vector<StageShare> shares;  ///< in the order of the diagnostics
};

/// The messages received from a guard.
struct ReceivedMessages {
  std::vector<ReceivedMessage> contacts;
  std::vector<ReceivedMessage> predictions;
  std::vector<ReceivedMessage> warnings;
  std::vector<ReceivedMessage> changes;  ///< the warnings that changed the level
  std::vector<ReceivedMessage> unclear;  ///< the warnings that were not CLEAR
  std::vector<StageReport> stages;
  std::size_t met = 0;           ///< number of contacts messages that are not empty
  std::size_t sweeps_asked = 0;  ///< in all predictions
  std::size_t sweeps_made = 0;
  std::size_t whole_predictions = 0;  ///< predictions with all sweeps that were asked for
};

/// Receives the messages of a guard.
class Listener {
 public:
  /// @param guard  name of the guard's node
  explicit Listener(const std::string& guard);

  /// Returns all messages received since the start.
  ReceivedMessages messages() const;

  /// Returns the stamp of the newest contacts message; 0: none yet.
  Nanoseconds newestContacts() const;

 private:
  void onContacts(const sweep_guard::Contacts& contacts);
  void onPrediction(const sweep_guard::Prediction& prediction);
  void onWarning(const sweep_guard::Warning& warning);
  void onDiagnostics(const diagnostic_msgs::DiagnosticArray& diagnostics);

  mutable std::mutex mutex_;
  ReceivedMessages messages_;
  int level_ = -1;
  ros::CallbackQueue queue_;
  ros::AsyncSpinner thread_{1, &queue_};
  ros::Subscriber contacts_;
  ros::Subscriber predictions_;
  ros::Subscriber warnings_;
  ros::Subscriber diagnostics_;
};

}  // namespace sweep_guard_benchmark
