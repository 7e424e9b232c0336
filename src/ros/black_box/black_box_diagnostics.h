#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include "ros/black_box/recorder.h"

namespace sweep_guard_ros {

/// Publishes on /diagnostics what the black box keeps in memory, its recordings, and why none can be written.
class BlackBoxDiagnostics {
 public:
  /// @param warnings  subscriber to the warnings of the guard
  BlackBoxDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                      const BlackBoxParameters& parameters, const Recorder& recorder, const ros::Subscriber& warnings);

  void publish() { updater_.force_update(); }  ///< to be called once a second

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  void memory(Status& status) const;
  void recordings(Status& status) const;

  const BlackBoxParameters& parameters_;
  const Recorder& recorder_;
  const ros::Subscriber warnings_;
  diagnostic_updater::Updater updater_;
};

}  // namespace sweep_guard_ros
