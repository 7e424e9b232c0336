#pragma once

#include <ros/message_event.h>
#include <topic_tools/shape_shifter.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "black_box/message_window.h"
#include "black_box/recording_folder.h"
#include "black_box/recording_trigger.h"
#include "common/guarded_by.h"
#include "ros/black_box/bag_file.h"
#include "ros/black_box/black_box_parameters.h"
#include "ros/black_box/guard_config.h"
#include "ros/black_box/recorded_topics.h"
#include "ros/connection/wire.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/background_thread.h"

namespace sweep_guard_ros {

/// Keeps what was heard in memory, and writes it to the disk some time after an event, in a thread of its own. What cannot be
/// written is reported, and nothing waits for the disk. While a recording is written, the next event waits.
class Recorder {
 public:
  explicit Recorder(const BlackBoxParameters& parameters);
  ~Recorder();  ///< waits for the recording that is being written, and writes the one that a waiting event asks for
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  void start(Supervisor& supervisor) {
    writer_.start(supervisor, {"writer", sweep_guard_core::Stage::kOther, /*watched=*/false});
  }

  /// Keeps a message. One thread.
  void hear(const RecordedTopic& topic, const ros::MessageEvent<const topic_tools::ShapeShifter>& event);
  /// Makes the present an event. Any thread.
  /// @return why nothing could be written when that was last tried; empty: it could
  std::string requestRecording();
  /// Writes what is due; otherwise inspects the folder from time to time. To be called often. Any thread.
  void tick();

  struct Summary {
    sweep_guard_core::Duration length;  ///< of what is kept
    std::size_t messages;
    std::size_t size;           ///< [bytes]
    std::size_t too_large = 0;  ///< messages that were not kept
    std::optional<sweep_guard_core::RecordingCause> waiting;
    bool writing;
    std::size_t written = 0;
    std::size_t failed = 0;
    std::string newest;                       ///< path of the newest bag; empty: none since the start
    std::string problem;                      ///< why nothing can be written; empty: nothing known
    sweep_guard_core::RecordingSizes stored;  ///< as of the last look at the folder
  };
  Summary summary() const;  ///< any thread

 private:
  using Window = sweep_guard_core::MessageWindow<HeardMessage>;

  // With the lock.
  sweep_guard_core::Instant now() const REQUIRES(mutex_);
  void makeRoomFor(sweep_guard_core::Time received, std::size_t size) REQUIRES(mutex_);
  void heardWarning(Wire message) REQUIRES(mutex_);
  void beginRecording() REQUIRES(mutex_);
  // In the thread of the writer.
  void write(const std::string& name, const HeardMessages& messages);
  void inspectFolder();
  bool attempt(const std::function<void()>& work);

  mutable sweep_guard_core::Mutex mutex_;  // of what follows, up to the recording
  Window window_ GUARDED_BY(mutex_);
  sweep_guard_core::RecordingTrigger trigger_ GUARDED_BY(mutex_);
  sweep_guard_core::SteadyTime next_inspection_ GUARDED_BY(mutex_){};
  Summary summary_ GUARDED_BY(mutex_){};
  std::future<void> recording_;  // the newest that was begun
  LogThrottle log_;
  // Only in the thread of the writer.
  std::atomic<bool> stopping_ = false;
  GuardConfig config_;
  sweep_guard_core::RecordingFolder folder_;
  BackgroundThread writer_;
};

}  // namespace sweep_guard_ros
