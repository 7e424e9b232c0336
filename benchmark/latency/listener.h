#pragma once

#include <ros/subscriber.h>
#include <sweep_guard/Contacts.h>
#include <sweep_guard/Prediction.h>
#include <sweep_guard/Warning.h>

#include <mutex>
#include <vector>

#include "latency/figures.h"
#include "sweep_guard/ros/queue_thread.h"

namespace sweep_guard_benchmark {

/// What a guard has said.
struct Said {
  std::vector<Heard> contacts;
  std::vector<Heard> predictions;
  std::vector<Heard> warnings;
  std::vector<Heard> changes;    ///< the warnings that changed the level
  std::size_t met = 0;           ///< contacts that are not empty
  std::size_t sweeps_asked = 0;  ///< of all predictions
  std::size_t sweeps_made = 0;
  std::size_t whole_predictions = 0;  ///< those with all sweeps that were asked for
};

/// Hears what a guard says, and when.
class Listener {
 public:
  /// @param guard  name of the guard's node
  explicit Listener(const std::string& guard);

  /// So far.
  Said said() const;

  /// Stamp of the newest contacts; 0: none so far.
  Nanoseconds newestContacts() const;

 private:
  void onContacts(const sweep_guard::Contacts& contacts);
  void onPrediction(const sweep_guard::Prediction& prediction);
  void onWarning(const sweep_guard::Warning& warning);

  mutable std::mutex mutex_;
  Said said_;
  int level_ = -1;
  sweep_guard_ros::QueueThread thread_;
  ros::Subscriber contacts_;
  ros::Subscriber predictions_;
  ros::Subscriber warnings_;
};

}  // namespace sweep_guard_benchmark
