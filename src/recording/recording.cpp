#include "recording/recording.h"

#include <filesystem>

#include "recording/bag.h"
#include "recording/motion_file.h"

namespace sweep_guard_recording {

Recording readRecording(const std::string& path, const std::string& topic) {
  return {std::filesystem::path(path).stem(), isBag(path) ? readBag(path, topic) : readMotionFile(path)};
}

}  // namespace sweep_guard_recording
