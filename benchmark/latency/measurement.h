#pragma once

#include <string>
#include <vector>

#include "latency/listener.h"
#include "latency/process.h"
#include "latency/sender.h"

namespace sweep_guard_benchmark {

/// What is measured.
struct Settings {
  int triangles = 1600;   ///< of the hull; even, >= 6
  double seconds = 10.0;  ///< to measure for
  Rates rates;
  std::string transport = "tcpros";  ///< tcpros: the guard is a node; nodelet: it runs in this process
  std::string detector = "select";
  std::string label;                    ///< said beside the transport, as in "rviz looks on"; empty: nothing
  std::string csv;                      ///< file that the figures are appended to; empty: none
  std::string histogram;                ///< file that the distributions are appended to; empty: none
  std::vector<std::string> parameters;  ///< of the guard, as in gl_context=egl
};

/// What came of it.
struct Measurement {
  Nanoseconds begin = 0;
  Nanoseconds end = 0;
  Usage before = {};
  Usage after = {};
  double load = 0.0;
  std::vector<Nanoseconds> poses;  ///< all that were sent
  Said said;                       ///< the counts: meanwhile; the rest: from the start

  double seconds() const { return 1e-9 * static_cast<double>(end - begin); }
};

/// Starts a guard, sends it the scene, and listens. Needs a ROS master.
/// @throws sweep_guard_core::DeviceError if the guard cannot be started or says nothing
Measurement measure(const Settings& settings);

/// One line of the table, and of the CSV file.
struct LatencyRow {
  std::string work;
  std::vector<double> milliseconds;
};

/// From the stamp of a pose to the contacts, the prediction, the warning and the change of level, in this order.
std::vector<LatencyRow> rowsOf(const Measurement& measured);

/// The poses sent meanwhile.
std::vector<Nanoseconds> posesOf(const Measurement& measured);

}  // namespace sweep_guard_benchmark
