#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace sweep_guard_ros {

/// A program that plays the samples on its standard input, as aplay does.
class SoundPlayer {
 public:
  /// @param command  program, looked up in PATH, and its arguments; not empty (asserted)
  /// @throws sweep_guard_core::DeviceError if it cannot be run
  explicit SoundPlayer(const std::vector<std::string>& command);
  ~SoundPlayer();  ///< ends the program
  SoundPlayer(const SoundPlayer&) = delete;
  SoundPlayer& operator=(const SoundPlayer&) = delete;

  /// Hands over samples, without waiting.
  /// @returns how many the program has room for; what is in between makes the sound late by at most 4 KiB
  /// @throws sweep_guard_core::DeviceError if the program has ended
  size_t play(const std::vector<std::int16_t>& samples);

 private:
  const std::string name_;
  int samples_in_ = -1;
  pid_t process_ = 0;
};

}  // namespace sweep_guard_ros
