#include "black_box/recording_files.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <string_view>

namespace sweep_guard_core {
namespace {

constexpr std::string_view kPattern = "black_box_ddddddddTdddddd.dddZ_";  // d: a digit

bool fits(std::string_view name) {
  if (name.size() < kPattern.size()) return false;
  for (std::size_t i = 0; i < kPattern.size(); ++i) {
    const bool digit = kPattern[i] == 'd' && i >= std::string_view("black_box_").size();
    if (digit ? name[i] < '0' || name[i] > '9' : name[i] != kPattern[i]) return false;
  }
  return true;
}

bool endsWith(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

bool isCause(std::string_view word) {
  constexpr std::array kCauses = {RecordingCause::kSave, RecordingCause::kReflex, RecordingCause::kContact};
  return std::any_of(kCauses.begin(), kCauses.end(), [word](RecordingCause cause) { return word == nameOf(cause); });
}

}  // namespace

std::string recordingName(std::chrono::system_clock::time_point time, RecordingCause cause) {
  const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
  const auto seconds = static_cast<std::time_t>(milliseconds / 1000);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 40> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "black_box_%Y%m%dT%H%M%S", &utc);
  std::snprintf(text.data() + length, text.size() - length, ".%03dZ_", static_cast<int>(milliseconds % 1000));
  return std::string(text.data()) + nameOf(cause);
}

std::optional<RecordingFile> parseRecordingFile(const std::string& name) {
  RecordingFile file;
  std::string_view rest = name;
  file.active = endsWith(rest, kActiveSuffix);
  if (file.active) rest.remove_suffix(std::string_view(kActiveSuffix).size());
  for (const char* const suffix : {kBagSuffix, kConfigSuffix}) {
    if (endsWith(rest, suffix)) file.suffix = suffix;
  }
  rest.remove_suffix(file.suffix.size());
  if (file.suffix.empty() || !fits(rest) || !isCause(rest.substr(kPattern.size()))) return std::nullopt;
  file.recording = rest;
  return file;
}

std::optional<std::vector<std::string>> recordingsToDelete(const RecordingSizes& stored, std::uintmax_t quota,
                                                           std::uintmax_t size) {
  if (size > quota) return std::nullopt;
  std::uintmax_t taken = size;
  for (const auto& [name, bytes] : stored) taken += bytes;
  std::vector<std::string> names;
  for (auto oldest = stored.begin(); taken > quota; ++oldest) {
    taken -= oldest->second;
    names.push_back(oldest->first);
  }
  return names;
}

}  // namespace sweep_guard_core
