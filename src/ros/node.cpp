#include "ros/node.h"

#include <ros/console.h>

#include <cstdint>
#include <utility>

#include "sweep_guard/monitor/reason.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

const sweep_guard_core::Duration kViewPeriod = sweep_guard_core::fromSeconds(1.0 / 60.0);
constexpr auto kEarlyPeriod = std::chrono::milliseconds(100);
constexpr auto kDiagnosticsPeriod = std::chrono::seconds(1);
constexpr auto kTouchesPeriod = std::chrono::seconds(1);
constexpr std::uint32_t kSilentInputs =
    sweep_guard_core::kNoPose | sweep_guard_core::kPoseStale | sweep_guard_core::kTfFail | sweep_guard_core::kNoMesh |
    sweep_guard_core::kMeshStale | sweep_guard_core::kNotCovered | sweep_guard_core::kDisabled;

// With a detector that this machine can make.
Parameters withAvailableDetector(Parameters parameters) {
  parameters.detector = sweep_guard_core::availableDetector(parameters.detector.name, parameters.detector.options);
  if (parameters.detector.replacesSelect()) {
    ROS_WARN("detector %s instead of select: %s", describe(parameters.detector).c_str(),
             parameters.detector.missing.c_str());
  }
  return parameters;
}

}  // namespace

SweepGuardNode::SweepGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process)
    : parameters_(withAvailableDetector(loadParameters(private_node))),
      master_watch_(private_node, [this] { return parameters_.get()->settings; }),
      monitor_(
          parameters_.initial().limits, [this] { warnings_.publishIfChanged(); },
          [this] { return queue_.waitingSince(); }, [this] { return supervisor_.hung(); }),
      supervisor_(process,
                  [this](const char* what, const ThreadTraits& thread) {
                    monitor_.failed(sweep_guard_core::kDetectorFault, what, std::chrono::steady_clock::now(),
                                    thread.loses_latched);
                    warnings_.publishIfChanged();
                    statistics_.fault(what);
                  }),
      warnings_(private_node, parameters_, monitor_),
      scene_(private_node, parameters_, monitor_),
      touches_(private_node),
      marker_timer_(reports_.every(sweep_guard_core::fromSeconds(1.0 / parameters_.initial().marker_rate),
                                   [this] { scene_.publishMarkers(); })),
      statistics_(parameters_.initial().guard.cycle),
      frames_(node, parameters_.initial().max_message_size,
              [this](const std::string& parent, const std::string& child) {
                monitor_.placedAnew("static transform from '" + child + "' to '" + parent + "' has changed");
              }),
      allowed_(parameters_.initial().guard.allowed),
      workpieces_([this](const auto& workpieces) {
        monitor_.setWorkpieces(workpieces, std::chrono::steady_clock::now());
        intentions_.follow(workpieces);
        allowed_.follow(workpieces);
      }),
      cross_check_(parameters_, monitor_),
      guard_thread_(private_node, {parameters_, workpieces_, monitor_, statistics_, queue_, warnings_, scene_, touches_,
                                   cross_check_.sampler(), intentions_, &frame_motions_}),
      poses_(node, parameters_, {frames_, workpieces_, monitor_, queue_, frame_motions_}),
      meshes_(node, parameters_.initial(), workpieces_, monitor_),
      other_tools_(
          node, parameters_.initial(),
          {[this](const Worker::Job& job) { meshes_.changeStore(job); }, workpieces_, frame_motions_, monitor_}),
      path_tests_({parameters_, frames_, workpieces_, monitor_, &frame_motions_}),
      check_sweep_(private_node, service_threads_, path_tests_),
      check_trajectory_(private_node, service_threads_, path_tests_),
      predict_(private_node, service_threads_, parameters_, workpieces_,
               [this](sweep_guard_core::Duration horizon) { return guard_thread_.predictMotion(horizon); }),
      controls_(
          private_node, parameters_, monitor_, workpieces_, service_threads_,
          {[this] { guard_thread_.reset(); }, [this](const std::string& id) { return guard_thread_.acknowledge(id); },
           [this] { touches_.reset(); }}),
      intend_(private_node, service_threads_, {parameters_, frames_, workpieces_, intentions_}),
      attach_(private_node, service_threads_, {parameters_, frames_, workpieces_, monitor_},
              {[this] { return guard_thread_.newestPose(); },
               [this](const auto& before, const auto& next, const auto& also) {
                 guard_thread_.exchangeTool(before, next, also);
               }}),
      reconfigure_server_(private_node, service_threads_, master_watch_.thread(), parameters_,
                          [this](const auto& next) { apply(next); }),
      diagnostics_(node, private_node,
                   {parameters_, poses_, meshes_, workpieces_, allowed_, monitor_, statistics_, reconfigure_server_,
                    supervisor_}),
      watchdog_(frames_, workpieces_, monitor_, warnings_, [this] { poses_.applyLateChanges(); }),
      peer_watch_(master_watch_.thread(), [this, warning = sweep_guard_core::Warning()]() mutable {
        monitor_.warning(now(), warning);
        return (warning.reasons & kSilentInputs) != 0;
      }) {
  reports_.every(kViewPeriod, [this] { scene_.publishView(); });
  reports_.every(kViewPeriod, [this] { intend_.publishIfChanged(); });
  reports_.every(kEarlyPeriod, [this] { meshes_.takeEarly(); });
  reports_.every(kTouchesPeriod, [this] { touches_.publishIfChanged(); });
  reports_.every(kDiagnosticsPeriod, [this] { diagnostics_.publish(); });
}

// Not in the constructor: where one thread cannot be started, the destructor ends the others.
void SweepGuardNode::start() {
  guard_thread_.start(supervisor_);
  watchdog_.start(supervisor_);
  frames_.start(supervisor_);
  meshes_.start(supervisor_);
  other_tools_.start(supervisor_);
  poses_.start(supervisor_);
  path_tests_.start(supervisor_);
  service_threads_.start(supervisor_);
  reports_.start(supervisor_, {"reports", sweep_guard_core::Stage::kPublish});
  cross_check_.start(supervisor_);
  master_watch_.start(supervisor_);
  supervisor_.start();
  logStart();
}

SweepGuardNode::~SweepGuardNode() {
  monitor_.end();
  warnings_.publishFinal();
  reports_.stop();       // its calls use what is declared after it
  master_watch_.stop();  // its thread uses the supervisor, which is declared after it
  guard_thread_.stop();
  path_tests_.stop();
  predict_.stop();
  service_threads_.stop();  // its calls use what is declared after it
}

void SweepGuardNode::apply(const std::shared_ptr<const Parameters>& wanted) {
  const auto next = detectorsDiffer(*parameters_.get(), *wanted)
                        ? std::make_shared<const Parameters>(withAvailableDetector(*wanted))
                        : wanted;
  guard_thread_.apply(next);
  marker_timer_.setPeriod(sweep_guard_core::fromSeconds(1.0 / next->marker_rate));
  warnings_.publishIfChanged();
}

void SweepGuardNode::logStart() const {
  const Parameters& initial = parameters_.initial();
  ROS_INFO("guarding '%s' (%s) in '%s' by %s, %s; poses from %s, meshes from %s and %s", initial.tool_frame.c_str(),
           initial.tool_description.c_str(), initial.fixed_frame.c_str(), describe(initial.detector).c_str(),
           sweep_guard_core::nameOf(initial.guard.sweep.volume).c_str(), poses_.source().c_str(),
           meshes_.meshTopic().c_str(), meshes_.verticesTopic().c_str());
  for (const sweep_guard_core::AllowedPair& pair : initial.guard.allowed)
    ROS_INFO("contact of %s is allowed (tool/allowed): it is no warning", describe(pair).c_str());
}

}  // namespace sweep_guard_ros
