#include "ros/black_box/recorder.h"

#include <ros/console.h>
#include <ros/serialization.h>

#include <fstream>
#include <memory>
#include <utility>

#include "ros/black_box/message_key.h"
#include "ros/process/process.h"
#include "sweep_guard/Warning.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kInspectionPeriod = std::chrono::seconds(5);
constexpr std::size_t kObjects = 600;  // of a message in memory, besides its bytes and its definition [bytes]

std::vector<std::uint8_t> bytesOf(const topic_tools::ShapeShifter& message) {
  std::vector<std::uint8_t> bytes(message.size());
  ros::serialization::OStream stream(bytes.data(), message.size());
  message.write(stream);
  return bytes;
}

void writeConfig(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text << std::flush;
  if (!stream) throw sweep_guard_core::DeviceError(file.string() + ": cannot be written");
}

}  // namespace

Recorder::Recorder(const BlackBoxParameters& parameters)
    : window_(parameters.window, parameters.memory / 2),
      trigger_(parameters.trigger),
      config_(parameters.guard, stopping_),
      folder_({parameters.folder, parameters.quota, parameters.min_free}),
      writer_([] { setNice(10); }) {}

Recorder::~Recorder() {
  stopping_ = true;
  if (recording_.valid()) recording_.wait();
  if (!trigger_.waiting()) return;
  {
    const sweep_guard_core::Lock lock(mutex_);
    beginRecording();
  }
  recording_.wait();
}

void Recorder::hear(const RecordedTopic& topic, const ros::MessageEvent<const topic_tools::ShapeShifter>& event) {
  const topic_tools::ShapeShifter::ConstPtr& message = event.getConstMessage();
  const bool is_warning = topic.recorded == kRecordedWarning;
  std::vector<std::uint8_t> bytes;
  if (is_warning || topic.kept != KeptMessages::kNone) bytes = bytesOf(*message);
  const Wire wire{bytes.data(), bytes.size()};
  std::string key = messageKey(topic, event.getPublisherName(), wire);
  const std::size_t size = message->size() + message->getMessageDefinition().size() + 2 * key.size() + kObjects;
  const sweep_guard_core::Time received = fromMsg(event.getReceiptTime());

  bool kept = false;
  {
    const sweep_guard_core::Lock lock(mutex_);
    makeRoomFor(received, size);
    kept = window_.add({received, size, std::move(key), {topic.recorded, message, event.getConnectionHeaderPtr()}});
    if (!kept) ++summary_.too_large;
    if (is_warning) heardWarning(wire);
  }
  if (kept) return;
  log_.error("too large", "black box: a message on " + topic.topic + " is not kept: it takes " +
                              std::to_string(size >> 20U) + " MiB, more than half of memory");
}

// An event that waits is written before its messages leave the window, also where the clock leaps or the memory is full.
void Recorder::makeRoomFor(sweep_guard_core::Time received, std::size_t size) {
  const bool starts_over = window_.hasGoneBack(received);
  if (trigger_.waiting() && !summary_.writing) {
    const bool due = trigger_.due({received, std::chrono::steady_clock::now()});
    if (starts_over || due || window_.isLeaving(trigger_.waiting()->begin.stamp, size)) beginRecording();
  }
  if (starts_over) window_.startOver();
}

sweep_guard_core::Instant Recorder::now() const { return {window_.newest(), std::chrono::steady_clock::now()}; }

void Recorder::heardWarning(Wire message) {
  try {
    checkLengths<sweep_guard::Warning>(message);
  } catch (const sweep_guard_core::InvalidInput&) {
    return;
  }
  sweep_guard::Warning warning;
  ros::serialization::IStream stream(const_cast<std::uint8_t*>(message.bytes),
                                     static_cast<std::uint32_t>(message.size));
  ros::serialization::deserialize(stream, warning);
  if (warning.level > sweep_guard::Warning::CONTACT) return;
  trigger_.warned(static_cast<sweep_guard_core::WarningLevel>(warning.level), now());
}

std::string Recorder::requestRecording() {
  const sweep_guard_core::Lock lock(mutex_);
  trigger_.requested(now());
  return summary_.problem;
}

void Recorder::tick() {
  const sweep_guard_core::Lock lock(mutex_);
  if (summary_.writing) return;
  const sweep_guard_core::Instant instant = now();
  if (trigger_.due(instant)) {
    beginRecording();
  } else if (instant.steady >= next_inspection_) {
    next_inspection_ = instant.steady + kInspectionPeriod;
    writer_.submit<void>([this] { attempt([this] { inspectFolder(); }); });
  }
}

void Recorder::beginRecording() {
  const sweep_guard_core::RecordingTrigger::Event event = *trigger_.take();
  const auto ago = std::chrono::steady_clock::now() - event.begin.steady;
  const std::string name = sweep_guard_core::recordingName(
      std::chrono::system_clock::now() - std::chrono::duration_cast<std::chrono::system_clock::duration>(ago),
      event.cause);
  auto messages = std::make_shared<const HeardMessages>(window_.snapshot());
  const bool covered = event.cause == sweep_guard_core::RecordingCause::kSave || window_.covers(event.begin.stamp);
  summary_.writing = true;
  recording_ = writer_.submit<void>([this, name, messages = std::move(messages), covered]() mutable {
    if (!covered) log_.error("late", "black box: " + name + " was written too late to contain its event");
    const bool written = attempt([&] { write(name, *messages); });
    messages.reset();  // recording_ keeps this function until the next one
    const sweep_guard_core::Lock lock(mutex_);
    summary_.writing = false;
    ++(written ? summary_.written : summary_.failed);
  });
}

void Recorder::write(const std::string& name, const HeardMessages& messages) {
  config_.refresh();
  const auto paths = folder_.write(name, bagSize(messages), [&](const sweep_guard_core::RecordingFolder::Paths& files) {
    writeConfig(files.config, config_.yaml());
    writeBag(files.bag, messages);
  });
  ROS_INFO("recorded %zu messages: %s", messages.size(), paths.bag.c_str());
  sweep_guard_core::RecordingSizes stored = folder_.stored();
  const sweep_guard_core::Lock lock(mutex_);
  summary_.newest = paths.bag;
  summary_.stored = std::move(stored);
}

void Recorder::inspectFolder() {
  config_.refresh();
  sweep_guard_core::RecordingSizes stored = folder_.stored();
  std::size_t size = 0;
  {
    const sweep_guard_core::Lock lock(mutex_);
    summary_.stored = std::move(stored);
    size = window_.size();
  }
  folder_.check(size);
}

bool Recorder::attempt(const std::function<void()>& work) {
  std::string problem;
  try {
    work();
  } catch (const std::exception& error) {
    problem = error.what();
    log_.error("recording", "black box: " + problem);
  }
  const sweep_guard_core::Lock lock(mutex_);
  summary_.problem = problem;
  return problem.empty();
}

Recorder::Summary Recorder::summary() const {
  const sweep_guard_core::Lock lock(mutex_);
  Summary summary = summary_;
  summary.length = window_.length();
  summary.messages = window_.count();
  summary.size = window_.size();
  if (trigger_.waiting()) summary.waiting = trigger_.waiting()->cause;
  return summary;
}

}  // namespace sweep_guard_ros
