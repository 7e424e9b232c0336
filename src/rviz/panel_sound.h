#pragma once

#include <QIODevice>
#include <memory>
#include <mutex>
#include <string>

#include "sound/earcon.h"

namespace sweep_guard_rviz {

/// The samples of what the panel shows: signed 16 bits in the order of this machine, one channel. A sound device reads them, in
/// any thread.
class Samples : public QIODevice {
 public:
  static constexpr int kRate = 48000;  ///< samples per second

  Samples() { open(QIODevice::ReadOnly); }

  void set(const sweep_guard_core::SoundCue& cue);

  bool isSequential() const override { return true; }
  qint64 bytesAvailable() const override { return kRate + QIODevice::bytesAvailable(); }

 protected:
  qint64 readData(char* bytes, qint64 size) override;
  qint64 writeData(const char*, qint64) override { return -1; }

 private:
  std::mutex mutex_;  // of all that follows
  sweep_guard_core::Earcon earcon_ = sweep_guard_core::earconOf({}, /*clear_tick=*/true);
  sweep_guard_core::Synthesizer synthesizer_{kRate};
  std::vector<std::int16_t> samples_;
};

/// Lets an operator hear what the panel shows.
class PanelSound {
 public:
  PanelSound();
  ~PanelSound();
  PanelSound(const PanelSound&) = delete;
  PanelSound& operator=(const PanelSound&) = delete;

  void turnOn();  ///< on the default sound device
  void turnOff();
  void set(const sweep_guard_core::SoundCue& cue) { samples_.set(cue); }
  /// Returns why nothing is heard although it is on; empty: it is heard, or off.
  std::string problem() const;

 private:
  class Device;

  Samples samples_;
  bool on_ = false;
  std::unique_ptr<Device> device_;  // none: off, or there is no sound device
};

}  // namespace sweep_guard_rviz
