#include "sweep_guard/ros/tool/mesh_file.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <utility>

#include "ros/tool/mesh_answer.h"
#include "ros/tool/mesh_wire.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using std::chrono::steady_clock;
using std::filesystem::path;
using sweep_guard_core::DeviceError;
using sweep_guard_core::InvalidInput;

constexpr auto kReaderTimeout = std::chrono::seconds(30);  // three times its limit of processor time
constexpr size_t kMaxAnswer = wireSize({kMaxMeshVertices, kMaxMeshTriangles});
constexpr size_t kMaxReason = 200;
constexpr char kFormats[] = "STL, OBJ, DAE, PLY or glTF";

class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() { close(); }
  int get() const { return descriptor_; }
  void close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }

 private:
  int descriptor_;
};

std::string formatOf(const path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const std::array<const char*, 6> known = {".stl", ".obj", ".dae", ".ply", ".gltf", ".glb"};
  if (std::find(known.begin(), known.end(), extension) != known.end()) return extension.substr(1);
  throw InvalidInput(file.string() + ": unknown mesh format; give an " + kFormats + " file");
}

// O_NONBLOCK: opening a pipe must not wait.
Descriptor openMesh(const path& file, bool follow_link) {
  const int follow = follow_link ? 0 : O_NOFOLLOW;
  Descriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | follow));
  struct stat status {};
  if (opened.get() < 0 || fstat(opened.get(), &status) != 0) {
    throw InvalidInput(file.string() + ": cannot be opened: " + std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode))
    throw InvalidInput(file.string() + ": not a regular file; give an " + kFormats + " file");
  if (static_cast<std::uint64_t>(status.st_size) > kMaxMeshFile) {
    throw InvalidInput(file.string() + ": larger than 32 MiB; give a coarser mesh");
  }
  return opened;
}

// In devel space and install space, the programs are in a folder next to the libraries.
std::string readerProgram() {
  Dl_info here{};
  if (dladdr(reinterpret_cast<const void*>(&readMesh), &here) == 0) throw DeviceError("mesh_reader cannot be found");
  return (path(here.dli_fname).parent_path() / "sweep_guard" / "mesh_reader").string();
}

// Runs mesh_reader. The destructor kills it if it has not ended.
class Reader {
 public:
  Reader(const std::string& program, const std::string& format, const Descriptor& file) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw DeviceError("no pipe for mesh_reader: " + reason(errno));
    answer_.emplace(ends[0]);
    const Descriptor answer_in(ends[1]);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, file.get(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, answer_in.get(), STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::string name = "mesh_reader";
    std::string argument = format;
    const std::array<char*, 3> arguments{name.data(), argument.data(), nullptr};
    const int failure = posix_spawn(&process_, program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) throw DeviceError(program + " cannot be run: " + reason(failure) + "; build or install it");
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() {
    if (process_ > 0) end();
  }

  // Returns its whole answer; empty if that is too long or takes too long.
  std::optional<std::string> answer() {
    const steady_clock::time_point deadline = steady_clock::now() + kReaderTimeout;
    std::string bytes;
    std::array<char, 65536> buffer{};
    while (bytes.size() <= kMaxAnswer && awaitAnswer(deadline)) {
      const ssize_t length = read(answer_->get(), buffer.data(), buffer.size());
      if (length == 0) return bytes;
      if (length > 0) bytes.append(buffer.data(), static_cast<size_t>(length));
      if (length < 0 && errno != EINTR) return {};
    }
    return {};
  }

  // Returns the status of waitpid().
  int end() {
    kill(process_, SIGKILL);
    return await();
  }

  int await() {
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    return status;
  }

 private:
  static std::string reason(int error) { return std::strerror(error); }

  bool awaitAnswer(steady_clock::time_point deadline) const {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - steady_clock::now());
    if (left.count() <= 0) return false;
    pollfd wait{answer_->get(), POLLIN, 0};
    return poll(&wait, 1, static_cast<int>(left.count())) > 0 || errno == EINTR;
  }

  std::optional<Descriptor> answer_;
  pid_t process_ = 0;
};

std::string plainReason(const std::string& answer) {
  std::string text = sweep_guard_core::printable(answer, kMaxReason);
  text.erase(text.find_last_not_of(" .?") + 1);
  return text;
}

std::string failureText(int status, const std::string& answer) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 1) return "cannot be read: " + plainReason(answer);
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) return "takes too long to read";
  if (WIFSIGNALED(status)) return "crashes mesh_reader (signal " + std::to_string(WTERMSIG(status)) + ")";
  return "cannot be read: mesh_reader ended with status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

MeshSurface readMesh(const path& file, bool follow_link) {
  const std::string format = formatOf(file);
  const Descriptor opened = openMesh(file, follow_link);
  Reader reader(readerProgram(), format, opened);
  const std::optional<std::string> answer = reader.answer();
  const std::string remedy = "; export the mesh again";
  if (!answer) {
    reader.end();
    throw InvalidInput(file.string() + ": takes too long to read" + remedy);
  }
  const int status = reader.await();
  if (status != 0) throw InvalidInput(file.string() + ": " + failureText(status, *answer) + remedy);
  std::optional<MeshSurface> surface = surfaceFrom(*answer);
  if (!surface) throw InvalidInput(file.string() + ": cannot be read: mesh_reader's answer is malformed" + remedy);
  return *std::move(surface);
}

}  // namespace sweep_guard_ros
