#include "latency/listener.h"

#include <ros/node_handle.h>

#include <algorithm>
#include <cstdlib>

namespace sweep_guard_benchmark {
namespace {

const std::string kStatus = ": stages";
const std::string kUnit = " [%]";
constexpr std::uint32_t kQueued = 100'000;  // no message is lost here

Nanoseconds nanoseconds(const ros::Time& time) { return static_cast<Nanoseconds>(time.toNSec()); }

bool ofStages(const diagnostic_msgs::DiagnosticStatus& status) {
  const size_t place = status.name.rfind(kStatus);
  return place != std::string::npos && place + kStatus.size() == status.name.size();
}

Nanoseconds now() { return nanoseconds(ros::Time::now()); }

}  // namespace

Listener::Listener(const std::string& guard) {
  ros::NodeHandle node(guard);
  node.setCallbackQueue(&queue_);
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  contacts_ = node.subscribe("contacts", kQueued, &Listener::onContacts, this, hints);
  predictions_ = node.subscribe("prediction", kQueued, &Listener::onPrediction, this, hints);
  warnings_ = node.subscribe("warning", kQueued, &Listener::onWarning, this, hints);
  diagnostics_ = node.subscribe("/diagnostics", kQueued, &Listener::onDiagnostics, this, hints);
  thread_.start();
}

ReceivedMessages Listener::messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

Nanoseconds Listener::newestContacts() const {
  const std::lock_guard lock(mutex_);
  return messages_.contacts.empty() ? 0 : messages_.contacts.back().stamp;
}

void Listener::onContacts(const sweep_guard::Contacts& contacts) {
  const Nanoseconds received = now();
  const std::lock_guard lock(mutex_);
  messages_.contacts.push_back({nanoseconds(contacts.interval_start), nanoseconds(contacts.header.stamp), received});
  messages_.met += contacts.objects.empty() ? 0 : 1;
}

void Listener::onPrediction(const sweep_guard::Prediction& prediction) {
  const Nanoseconds received = now();
  const Nanoseconds stamp = nanoseconds(prediction.header.stamp);
  const std::lock_guard lock(mutex_);
  messages_.predictions.push_back({stamp, stamp, received});
  messages_.sweeps_asked += prediction.sweeps_asked;
  messages_.sweeps_made += prediction.sweeps_made;
  messages_.whole_predictions += prediction.sweeps_made == prediction.sweeps_asked ? 1 : 0;
}

void Listener::onWarning(const sweep_guard::Warning& warning) {
  const Nanoseconds received = now();
  const Nanoseconds stamp = nanoseconds(warning.header.stamp);
  const std::lock_guard lock(mutex_);
  messages_.warnings.push_back({stamp, stamp, received});
  if (warning.level != level_) messages_.changes.push_back({stamp, stamp, received});
  if (!warning.clear) messages_.unclear.push_back({stamp, stamp, received});
  level_ = warning.level;
}

void Listener::onDiagnostics(const diagnostic_msgs::DiagnosticArray& diagnostics) {
  const auto status = std::find_if(diagnostics.status.begin(), diagnostics.status.end(), ofStages);
  if (status == diagnostics.status.end()) return;
  StageReport report{now(), {}};
  for (const diagnostic_msgs::KeyValue& share : status->values) {
    report.shares.push_back({share.key.substr(0, share.key.find(kUnit)), std::strtod(share.value.c_str(), nullptr)});
  }
  const std::lock_guard lock(mutex_);
  messages_.stages.push_back(report);
}

}  // namespace sweep_guard_benchmark
