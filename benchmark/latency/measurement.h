#pragma once

#include <string>
#include <vector>

#include "latency/listener.h"
#include "latency/process.h"
#include "latency/sender.h"

namespace sweep_guard_benchmark {

/// Settings of one measurement.
struct Settings {
  int triangles = 1600;   ///< of the hull; even, >= 6
  double seconds = 10.0;  ///< duration of the measurement [s]
  Rates rates;
  bool away = false;                 ///< the tool is too far away to be warned of
  std::string transport = "tcpros";  ///< tcpros: the guard is a node; nodelet: it runs in this process
  std::string detector = "select";
  std::string label;                    ///< text for the tables beside the transport, such as "rviz looks on"
  std::string csv;                      ///< figures are appended to this file; empty: none
  std::string stages;                   ///< shares of the stages are appended to this file; empty: none
  std::string histogram;                ///< distributions are appended to this file; empty: none
  std::vector<std::string> parameters;  ///< parameters of the guard, such as gl_context=egl
};

/// Result of one measurement.
struct Measurement {
  Nanoseconds begin = 0;
  Nanoseconds end = 0;
  Usage before = {};
  Usage after = {};
  double load = 0.0;
  std::vector<Nanoseconds> poses;  ///< stamps of all poses sent
  ReceivedMessages messages;       ///< counts of the measurement; messages since the start

  double seconds() const { return 1e-9 * static_cast<double>(end - begin); }
  double perSecond(std::size_t count) const { return static_cast<double>(count) / seconds(); }
  double processorShare() const { return (after.processor_s - before.processor_s) / seconds(); }
  double growthMb() const { return after.resident_mb - before.resident_mb; }
};

/// Starts a guard, sends it the scene and receives its messages. Needs a ROS master.
/// @throws sweep_guard_core::DeviceError if the guard cannot be started or publishes nothing
Measurement measure(const Settings& settings);

/// The latencies of one line of the table.
struct LatencyRow {
  std::string work;
  std::vector<double> milliseconds;
};

/// Returns the latencies from a pose to contacts, prediction, warning and change of level, in this order.
std::vector<LatencyRow> rowsOf(const Measurement& measured);

/// Returns the mean shares of the stages, over the periods that lie within the measurement; none without such a period.
std::vector<StageShare> stagesOf(const Measurement& measured);

/// Returns the number of warnings during the measurement that were not CLEAR.
std::size_t unclearWarnings(const Measurement& measured);

/// Returns the number of sweeps during the measurement, per second.
double sweepsPerSecond(const Measurement& measured);

/// Returns the poses sent during the measurement.
std::vector<Nanoseconds> posesOf(const Measurement& measured);

}  // namespace sweep_guard_benchmark
