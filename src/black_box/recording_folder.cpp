#include "black_box/recording_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

using std::filesystem::path;

constexpr std::uintmax_t kMebibyte = 1U << 20U;

[[noreturn]] void fail(const path& file, const std::string& reason) {
  throw DeviceError(file.string() + ": " + reason);
}
[[noreturn]] void fail(const path& file, int error) { fail(file, std::strerror(error)); }

// Not every file system can do that with a folder.
void synchronize(const path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(file, errno);
  const int error = fsync(descriptor) == 0 ? 0 : errno;
  close(descriptor);
  if (error != 0 && error != EINVAL) fail(file, error);
}

void giveName(const path& from, const path& to) {
  std::error_code error;
  std::filesystem::rename(from, to, error);
  if (error) fail(to, error.message());
}

// Calls a function with the parts of its name, the path and the size [bytes] of each file of a recording.
template <typename Function>
void forEachFile(const path& folder, const Function& function) {
  std::error_code error;
  for (std::filesystem::directory_iterator next(folder, error), end; !error && next != end; next.increment(error)) {
    const auto name = parseRecordingFile(next->path().filename().string());
    std::error_code gone;
    if (!name || next->symlink_status(gone).type() != std::filesystem::file_type::regular) continue;
    const std::uintmax_t size = next->file_size(gone);
    if (!gone) function(*name, next->path(), size);
  }
}

}  // namespace

std::uintmax_t freeSpace(const path& folder) {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  if (error) fail(folder, error.message());
  return space.available;
}

RecordingFolder::~RecordingFolder() {
  if (lock_ >= 0) close(lock_);
}

void RecordingFolder::open() {
  std::error_code error;
  std::filesystem::create_directories(options_.folder, error);
  if (error) fail(options_.folder, error.message());
  if (lock()) deleteLeftovers();
  probe();
}

// The kernel gives the lock back when the process ends, however that happens. A folder that was replaced is locked
// again.
bool RecordingFolder::lock() {
  std::error_code error;
  const path locked = "/proc/self/fd/" + std::to_string(lock_);
  if (lock_ >= 0 && std::filesystem::equivalent(locked, options_.folder, error)) return false;
  if (lock_ >= 0) close(lock_);
  lock_ = ::open(options_.folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0) fail(options_.folder, errno);
  if (flock(lock_, LOCK_EX | LOCK_NB) == 0) return true;
  const int reason = errno;
  close(lock_);
  lock_ = -1;
  if (reason != EWOULDBLOCK) fail(options_.folder, reason);
  fail(options_.folder, "another black box writes to this folder; set another one as folder");
}

void RecordingFolder::deleteLeftovers() const {
  std::vector<std::pair<RecordingFile, path>> files;  // of one reading: a bag that another one missed would be deleted
  std::set<std::string> whole;
  forEachFile(options_.folder, [&](const RecordingFile& name, const path& file, std::uintmax_t /*size*/) {
    files.emplace_back(name, file);
    if (!name.active && name.suffix == kBagSuffix) whole.insert(name.recording);
  });
  for (const auto& [name, file] : files) {
    std::error_code ignored;
    if (name.active || whole.count(name.recording) == 0) std::filesystem::remove(file, ignored);
  }
}

void RecordingFolder::probe() const {
  std::string file = (options_.folder / ".black_box_XXXXXX").string();
  const int descriptor = mkostemp(file.data(), O_CLOEXEC);
  if (descriptor < 0) fail(options_.folder, errno);
  close(descriptor);
  unlink(file.c_str());
}

std::vector<std::string> RecordingFolder::surplusFor(std::uintmax_t size) const {
  const auto surplus = recordingsToDelete(stored(), options_.quota, size);
  if (surplus) return *surplus;
  fail(options_.folder, "a recording of " + std::to_string(size / kMebibyte) + " MiB is larger than the quota");
}

void RecordingFolder::check(std::uintmax_t size) {
  open();
  const std::vector<std::string> surplus = surplusFor(size);
  std::uintmax_t free = options_.free_space(options_.folder);
  for (const auto& [name, bytes] : stored()) {
    if (std::find(surplus.begin(), surplus.end(), name) != surplus.end()) free += bytes;
  }
  if (free >= options_.min_free && free - options_.min_free >= size) return;
  fail(options_.folder, "only " + std::to_string(free / kMebibyte) + " MiB are free, and a recording of " +
                            std::to_string(size / kMebibyte) + " MiB has to leave " +
                            std::to_string(options_.min_free / kMebibyte) + " MiB: free space on the disk");
}

// The bag first: a configuration without one is deleted at the next start.
void RecordingFolder::keepQuota(std::uintmax_t size) const {
  for (const std::string& recording : surplusFor(size)) {
    const Paths paths = pathsOf(recording, "");
    for (const path& file : {paths.bag, paths.config}) {
      std::error_code error;
      std::filesystem::remove(file, error);
      if (error) fail(file, error.message());
    }
  }
}

RecordingFolder::Paths RecordingFolder::pathsOf(const std::string& name, const std::string& end) const {
  return {options_.folder / (name + kBagSuffix + end), options_.folder / (name + kConfigSuffix + end)};
}

// The bag last: when it has its name, the recording is whole.
RecordingFolder::Paths RecordingFolder::write(const std::string& name, std::uintmax_t size,
                                              const std::function<void(const Paths&)>& write) {
  check(size);
  keepQuota(size);
  const Paths active = pathsOf(name, kActiveSuffix);
  Paths whole = pathsOf(name, "");
  try {
    write(active);
    synchronize(active.config);
    synchronize(active.bag);
    keepQuota(std::filesystem::file_size(active.bag) + std::filesystem::file_size(active.config));
    giveName(active.config, whole.config);
    giveName(active.bag, whole.bag);
    synchronize(options_.folder);
  } catch (...) {
    std::error_code ignored;
    for (const path& file : {active.bag, active.config, whole.bag, whole.config})
      std::filesystem::remove(file, ignored);
    throw;
  }
  return whole;
}

RecordingSizes RecordingFolder::stored() const {
  RecordingSizes sizes;
  forEachFile(options_.folder, [&](const RecordingFile& name, const path& /*file*/, std::uintmax_t size) {
    if (!name.active) sizes[name.recording] += size;
  });
  return sizes;
}

}  // namespace sweep_guard_core
