#include "ros/sound/earcon_node.h"

#include <algorithm>

#include "ros/connection/sole_publisher.h"
#include "ros/merger/heard_warning.h"
#include "ros/motion/absent_guard.h"
#include "ros/parameters/finish_reading.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr std::uint32_t kRate = 48000;  // samples per second
constexpr auto kTickPeriod = std::chrono::milliseconds(10);
constexpr auto kAhead = std::chrono::milliseconds(40);  // of the sound
constexpr auto kStartPeriod = std::chrono::seconds(2);
constexpr auto kReportPeriod = std::chrono::seconds(1);
constexpr auto kMotionSilence = std::chrono::milliseconds(300);  // three periods of the status

std::vector<std::string> readCommand(ParameterReader& read) {
  std::vector<std::string> command = read.texts("player");
  if (!command.empty()) return command;
  return {"aplay", "-q", "-t", "raw", "-f", "S16_LE", "-c", "1", "-r", std::to_string(kRate), "--buffer-time=60000",
          "-"};
}

}  // namespace

EarconNode::EarconNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : EarconNode(node, private_node, ParameterReader(private_node)) {}

EarconNode::EarconNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, ParameterReader read)
    : master_watch_(private_node, [this] { return settings_; }),
      supervisor_(Process::kOwn),
      command_(readCommand(read)),
      clear_tick_(read.flag("clear_tick", true)),
      warning_({node.resolveName("warning")}),
      rumble_(private_node, read.integer("rumble/id", 0, 0, 255), read.number("rumble/intensity", 1.0, {0.0, 1.0})),
      synthesizer_(kRate, read.number("volume", 1.0, {0.0, 1.0})),
      updater_(node, private_node, private_node.getNamespace()) {
  settings_ = finishReading(read);
  updater_.setHardwareID("none");
  updater_.add("sound", [this](Status& status) { report(status); });
  subscriber_ = subscribeToSole<sweep_guard::Warning>(
      thread_.on(node), "warning", sweep_guard_core::kWarningValid,
      [this](const sweep_guard::Warning& message) { hear(message); },
      [this, topic = warning_.guards().front()](const std::string& reason) { refuse(topic, reason); });
  motion_subscriber_ = subscribeToSole<sweep_guard::MotionStatus>(
      thread_.on(node), "motion_status", kMotionSilence,
      [this](const sweep_guard::MotionStatus& message) { hear(message); },
      [this, topic = node.resolveName("motion_status")](const std::string& reason) { refuse(topic, reason); });
  sound_.every(kTickPeriod, [this] { sound(); });
  reports_.every(kReportPeriod, [this] { updater_.force_update(); });
}

EarconNode::~EarconNode() {
  sound_.stop();
  reports_.stop();
  master_watch_.stop();  // its thread uses the supervisor, which is declared after it
}

void EarconNode::start() {
  thread_.start(supervisor_, {"guard", sweep_guard_core::Stage::kReceive, /*watched=*/true, /*loses_latched=*/false});
  sound_.start(supervisor_, {"sound", sweep_guard_core::Stage::kPublish});
  reports_.start(supervisor_, {"reports", sweep_guard_core::Stage::kPublish});
  master_watch_.start(supervisor_);
  supervisor_.start();
}

void EarconNode::hear(const sweep_guard::Warning& message) {
  sweep_guard_core::HeardWarning warning = heardFrom(message);
  const sweep_guard_core::Lock lock(mutex_);
  warning_.hear(0, std::move(warning));
}

void EarconNode::hear(const sweep_guard::MotionStatus& status) {
  const bool holds = status.code != sweep_guard::MotionStatus::NO_WARNING && status.scale < 1.0;
  const sweep_guard_core::Lock lock(mutex_);
  held_ = holds ? std::min(1.0, 1.0 - status.scale) : 0.0;
  motion_heard_ = std::chrono::steady_clock::now();
}

void EarconNode::refuse(const std::string& topic, const std::string& reason) {
  log_.error("refused " + topic, "message on " + topic + " refused: " + reason);
}

// A player that has ended is started again: a sound card may come back.
void EarconNode::sound() {
  const sweep_guard_core::Instant at = now();
  sweep_guard_core::MergedWarning merged;
  double held = 0.0;
  {
    const sweep_guard_core::Lock lock(mutex_);
    merged = warning_.merged(at);
    if (at.steady - motion_heard_ <= kMotionSilence) held = held_;
  }
  rumble_.update(held, at.steady);
  std::string problem;
  try {
    play(merged, held);
  } catch (const sweep_guard_core::DeviceError& error) {
    player_.reset();
    problem = error.what();
    log_.error("player", "no sound: " + problem);
  }
  const sweep_guard_core::Lock lock(mutex_);
  sounds_ = merged.level;
  if (player_ || !problem.empty()) problem_ = problem;
}

void EarconNode::play(const sweep_guard_core::MergedWarning& warning, double held) {
  const sweep_guard_core::SteadyTime at = std::chrono::steady_clock::now();
  if (!player_) {
    if (at < next_start_) return;
    next_start_ = at + kStartPeriod;
    samples_.clear();
    player_.emplace(command_);
    played_until_ = at;
  }
  played_until_ = std::max(played_until_, at);
  const double missing = sweep_guard_core::toSeconds(at + kAhead - played_until_);
  if (samples_.empty() && missing > 0.0) {
    const auto count = static_cast<size_t>(missing * synthesizer_.rate());
    synthesizer_.render(earconOf(warning, clear_tick_), count, samples_, sweep_guard_core::heldEarcon(held));
    played_until_ += sweep_guard_core::fromSeconds(static_cast<double>(count) / synthesizer_.rate());
  }
  const size_t taken = player_->play(samples_);
  samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(taken));
}

void EarconNode::report(Status& status) const {
  const sweep_guard_core::Lock lock(mutex_);
  std::string silence = warning_.silence(0, now());
  const bool absent = !silence.empty() && subscriber_.getNumPublishers() == 0;
  if (absent) silence = absentWarningText(warning_.guards().front());
  status.summary(silence.empty() ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                 silence.empty() ? styleOf(sounds_).name : silence);
  if (!problem_.empty()) status.mergeSummary(DiagnosticStatus::ERROR, "no sound: " + problem_);
  status.add("topic", warning_.guards().front());
  status.add("player", command_.front());
}

}  // namespace sweep_guard_ros
