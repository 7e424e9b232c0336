#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "black_box/recording_trigger.h"

namespace sweep_guard_core {

/// A recording is a bag and the configuration of the guard beside it, with the same name: black_box_, date and time (UTC) in
/// milliseconds, cause, as in black_box_20260131T080910.123Z_contact. Names that are sorted are sorted by time. While a file
/// is written, its name ends in .active.
std::string recordingName(std::chrono::system_clock::time_point time, RecordingCause cause);

constexpr const char* kBagSuffix = ".bag";
constexpr const char* kConfigSuffix = ".yaml";
constexpr const char* kActiveSuffix = ".active";

/// The parts of the name of a file of a recording.
struct RecordingFile {
  std::string recording;
  std::string suffix;  ///< .bag or .yaml
  bool active = false;
};

/// Returns the parts of a file's name; empty if no file of a recording has such a name.
std::optional<RecordingFile> parseRecordingFile(const std::string& name);

/// The sizes [bytes] of the recordings that are there, by name.
using RecordingSizes = std::map<std::string, std::uintmax_t>;

/// Returns the names of the recordings that are deleted before one of `size` bytes is written: the oldest, as few as suffice.
/// @param quota   what all may take together [bytes]
/// @return empty if the new one is larger than the quota by itself: then none helps
std::optional<std::vector<std::string>> recordingsToDelete(const RecordingSizes& stored, std::uintmax_t quota,
                                                           std::uintmax_t size);

}  // namespace sweep_guard_core
