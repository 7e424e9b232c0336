#include "rviz/panel_sound.h"

#include <QAudioFormat>
#include <QtGlobal>
#include <algorithm>
#include <cstring>
#if QT_VERSION_MAJOR >= 6
#include <QAudioDevice>
#include <QAudioSink>
#include <QMediaDevices>
#else
#include <QAudioDeviceInfo>
#include <QAudioOutput>
#endif

namespace sweep_guard_rviz {
namespace {

constexpr int kBufferSize = Samples::kRate * 2 / 10;  // [bytes] of 0.1 s

#if QT_VERSION_MAJOR >= 6
using Output = QAudioSink;
auto defaultDevice() { return QMediaDevices::defaultAudioOutput(); }

QAudioFormat format() {
  QAudioFormat format;
  format.setSampleRate(Samples::kRate);
  format.setChannelCount(1);
  format.setSampleFormat(QAudioFormat::Int16);
  return format;
}
#else
using Output = QAudioOutput;
auto defaultDevice() { return QAudioDeviceInfo::defaultOutputDevice(); }

QAudioFormat format() {
  QAudioFormat format;
  format.setSampleRate(Samples::kRate);
  format.setChannelCount(1);
  format.setSampleSize(16);
  format.setSampleType(QAudioFormat::SignedInt);
  format.setCodec("audio/pcm");
  return format;
}
#endif

}  // namespace

void Samples::set(const sweep_guard_core::SoundCue& cue) {
  const std::lock_guard lock(mutex_);
  earcon_ = earconOf(cue, /*clear_tick=*/true);
}

qint64 Samples::readData(char* bytes, qint64 size) {
  const std::lock_guard lock(mutex_);
  samples_.clear();
  synthesizer_.render(earcon_, static_cast<size_t>(size) / sizeof samples_[0], samples_);
  const size_t rendered = samples_.size() * sizeof samples_[0];
  std::memcpy(bytes, samples_.data(), rendered);
  return static_cast<qint64>(rendered);
}

class PanelSound::Device {
 public:
  explicit Device(Samples& samples) : output_(defaultDevice(), format()) {
    output_.setBufferSize(kBufferSize);
    output_.start(&samples);
  }

  bool failed() const { return output_.error() != QAudio::NoError && output_.error() != QAudio::UnderrunError; }

 private:
  Output output_;
};

PanelSound::PanelSound() = default;
PanelSound::~PanelSound() = default;

void PanelSound::turnOn() {
  on_ = true;
  if (!device_ && !defaultDevice().isNull()) device_ = std::make_unique<Device>(samples_);
}

void PanelSound::turnOff() {
  on_ = false;
  device_.reset();
}

std::string PanelSound::problem() const {
  if (!on_) return "";
  if (!device_) return "no sound: there is no sound device";
  return device_->failed() ? "no sound: the sound device failed" : "";
}

}  // namespace sweep_guard_rviz
