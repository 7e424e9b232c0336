#include "ros/profile_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "ros/ros_home.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using std::filesystem::path;
using sweep_guard_core::Error;
using sweep_guard_core::InvalidInput;

constexpr size_t kMaxName = 64;
constexpr std::ptrdiff_t kMaxFiles = 100;

class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

std::string because(int error) { return std::string(": ") + std::strerror(error); }

// O_NONBLOCK: opening a pipe must not wait.
std::string readText(const path& file) {
  const Descriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (opened.get() < 0 || fstat(opened.get(), &status) != 0) throw InvalidInput("cannot be opened" + because(errno));
  if (!S_ISREG(status.st_mode)) throw InvalidInput("is not a regular file");
  if (status.st_size > static_cast<off_t>(sweep_guard_core::kMaxProfileSize)) {
    throw InvalidInput("is larger than " + std::to_string(sweep_guard_core::kMaxProfileSize) + " bytes");
  }
  std::string text(static_cast<size_t>(status.st_size), '\0');
  const ssize_t length = read(opened.get(), text.data(), text.size());
  if (length < 0) throw InvalidInput("cannot be read" + because(errno));
  text.resize(static_cast<size_t>(length));
  return text;
}

void writeText(int file, const std::string& text) {
  for (size_t written = 0; written < text.size();) {
    const ssize_t length = write(file, text.data() + written, text.size() - written);
    if (length < 0 && errno != EINTR) throw Error(std::strerror(errno));
    if (length > 0) written += static_cast<size_t>(length);
  }
  if (fsync(file) != 0) throw Error(std::strerror(errno));
}

bool isPlain(const std::string& name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !name.empty() && name.size() <= kMaxName && std::all_of(name.begin(), name.end(), plain);
}

}  // namespace

std::shared_ptr<const sweep_guard_core::Profile> readProfile(const path& file) {
  try {
    if (!file.is_absolute()) throw InvalidInput("is not an absolute path");
    return std::make_shared<const sweep_guard_core::Profile>(sweep_guard_core::profileFromText(readText(file)));
  } catch (const InvalidInput& error) {
    throw InvalidInput(
        file.string() + ": " + error.what() +
        "; give a file that ~save_profile of this version has written, or leave prediction/profile empty");
  }
}

// The other file is next to it: only within one file system is a file renamed in one step.
void writeProfile(const path& file, const sweep_guard_core::Profile& profile) {
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  std::string other = file.string() + ".XXXXXX";
  const Descriptor opened(mkostemp(other.data(), O_CLOEXEC));
  if (opened.get() < 0) throw Error(file.string() + ": cannot be written" + because(errno));
  try {
    writeText(opened.get(), toText(profile));
    if (rename(other.c_str(), file.c_str()) != 0) throw Error(std::strerror(errno));
  } catch (const Error& error) {
    unlink(other.c_str());
    throw Error(file.string() + ": cannot be written: " + error.what());
  }
}

path profileNamed(const std::string& name) {
  if (!isPlain(name)) throw InvalidInput("a name has 1 to 64 letters, digits, - and _");
  const path folder = writableFolder("prediction/profile, and send an empty name");
  path file = folder / (name + ".profile");
  std::error_code none;
  const auto files = std::distance(std::filesystem::directory_iterator(folder, none), {});
  if (files < kMaxFiles || exists(file, none)) return file;
  throw InvalidInput(folder.string() + " has " + std::to_string(files) +
                     " files: remove some, or use one of their names");
}

}  // namespace sweep_guard_ros
