#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "black_box/recording_files.h"

namespace sweep_guard_core {

/// Returns how many bytes a process without rights of its own may still write to the file system of a folder.
/// @throws DeviceError
std::uintmax_t freeSpace(const std::filesystem::path& folder);

/// The folder of the recordings of one writer. Deletes only regular files in it that have the name of a recording. Not
/// thread-safe. Failures throw DeviceError with the path and the reason; complete recordings stay as they are.
class RecordingFolder {
 public:
  struct Options {
    std::filesystem::path folder;  ///< absolute
    std::uintmax_t quota;          ///< of all recordings together [bytes]
    std::uintmax_t min_free;       ///< what a recording leaves free on the file system [bytes]
    std::function<std::uintmax_t(const std::filesystem::path&)> free_space = freeSpace;
  };

  explicit RecordingFolder(Options options) : options_(std::move(options)) {}
  ~RecordingFolder();
  RecordingFolder(const RecordingFolder&) = delete;
  RecordingFolder& operator=(const RecordingFolder&) = delete;

  /// Makes the folder and locks it against other writers. When it has got the lock, it deletes what a writer left
  /// that ended within a file. Checks that files can be written there. May be called repeatedly.
  void open();

  /// Opens the folder, and checks that a recording of `size` bytes could be written: it is within the quota, and the
  /// disk has room for it once the recordings are deleted that exceed the quota.
  void check(std::uintmax_t size);

  struct Paths {
    std::filesystem::path bag;
    std::filesystem::path config;
  };
  /// Writes a recording: checks the folder, deletes the oldest recordings for the quota, has both files written, and
  /// renames them when they are complete and on the disk. Nothing remains of a recording that fails.
  /// @param size   approximate [bytes]
  /// @param write  writes the two files, whose names end in .active
  /// @return the paths of the files
  Paths write(const std::string& name, std::uintmax_t size, const std::function<void(const Paths&)>& write);

  RecordingSizes stored() const;  ///< recordings that are whole; empty if the folder cannot be read

 private:
  bool lock();
  void deleteLeftovers() const;
  void probe() const;
  std::vector<std::string> surplusFor(std::uintmax_t size) const;
  void keepQuota(std::uintmax_t size) const;
  Paths pathsOf(const std::string& name, const std::string& end) const;

  const Options options_;
  int lock_ = -1;
};

}  // namespace sweep_guard_core
