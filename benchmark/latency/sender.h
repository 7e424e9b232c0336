#pragma once

#include <ros/publisher.h>

#include <atomic>
#include <thread>
#include <vector>

#include "latency/latencies.h"
#include "latency/scene.h"

namespace sweep_guard_benchmark {

/// Rates of the messages [Hz].
struct Rates {
  double poses = 1000.0;
  double vertices = 60.0;
};

/// Sends the scene from its construction on: the mesh once, its vertices and the tool's pose at their rates, each
/// stamped with the time at which it is sent. A late message is skipped, not made up for.
class Sender {
 public:
  /// @param away  the tool moves 1 m away from the hull
  Sender(LatencyScene& scene, const Rates& rates, bool away);
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;
  ~Sender();

  /// Stops sending and returns the stamps of all poses sent.
  const std::vector<Nanoseconds>& poses();

  double processor() const;  ///< processor time used for sending [s]

 private:
  void sendPoses();
  void sendVertices();
  void stop();

  LatencyScene& scene_;
  Rates rates_;
  bool away_;
  ros::Publisher mesh_;
  ros::Publisher vertices_;
  ros::Publisher poses_;
  std::vector<Nanoseconds> stamps_;
  std::atomic<bool> stopping_{false};
  std::vector<std::thread> threads_;
};

}  // namespace sweep_guard_benchmark
