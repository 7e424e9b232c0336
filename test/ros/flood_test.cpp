// Floods of harmless and of wrong messages, at 1 kHz beside good inputs, on the wall clock.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <thread>

#include "guard_probe.h"
#include "guard_process.h"
#include "raw_message.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::DeformableMesh;
using sweep_guard::MeshVertices;
using sweep_guard::Warning;
using SteadyClock = std::chrono::steady_clock;

constexpr double kMaxRecovery = 1.2;  // [s]
constexpr size_t kMaxLines = 20;
constexpr double kMaxMemory = 4096.0;  // [MB] limits/memory

GuardProbe& floodProbe() {
  static GuardProbe probe(/*drives_clock=*/false);
  return probe;
}

GuardLog& guardLog() {
  static GuardLog log;
  return log;
}

// Poses at 100 Hz and vertices at 30 Hz, until it is destroyed.
class GoodInputs {
 public:
  GoodInputs() : thread_([this] { run(); }) {}
  ~GoodInputs() {
    stopping_ = true;
    thread_.join();
  }

 private:
  void run() const {
    ros::WallRate rate(100.0);
    for (int i = 0; !stopping_; ++i) {
      floodProbe().publish(poseAt(kAway, ros::Time::now()));
      if (i % 3 == 0) floodProbe().publish(squareMovedTo("square", kSquare, ros::Time::now()));
      rate.sleep();
    }
  }

  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

template <typename Msg>
class RawTopic {
 public:
  explicit RawTopic(const std::string& topic) : publisher_(ros::NodeHandle().advertise<Raw<Msg>>(topic, 100)) {}
  void forge(size_t from_end, std::uint32_t length) { publisher_.publish(forged(serialized(Msg()), from_end, length)); }

 private:
  ros::Publisher publisher_;
};

struct Flood {
  const char* name;
  std::function<void(int)> send;  // the message of this number
};
void PrintTo(const Flood& flood, std::ostream* out) { *out << flood.name; }

void sendMeshAgain(int /*i*/) {
  static const DeformableMesh mesh = squareAt("square", kSquare, ros::Time::now() - ros::Duration(1.0));
  floodProbe().publish(mesh);
}

void sendStrayVertices(int i) {
  static const char* const ids[] = {"", "gone", "ghost", "sheeet"};
  floodProbe().publish(squareMovedTo(ids[i % 4], kSquare, ros::Time::now()));
}

void sendForgedLength(int i) {
  static RawTopic<MeshVertices> vertices("mesh_vertices");
  static RawTopic<DeformableMesh> meshes("mesh");
  static RawTopic<tf2_msgs::TFMessage> transforms("/tf");
  if (i % 4 == 0) vertices.forge(4, 0x40000001);
  if (i % 4 == 1) meshes.forge(8, 0x40000001);
  if (i % 4 == 2) meshes.forge(4, 0x20000001);
  if (i % 4 == 3) transforms.forge(4, 0x20000001);
}

void sendOldPose(int /*i*/) { floodProbe().publish(poseAt(kAway, ros::Time::now() - ros::Duration(3600.0))); }

void sendLongName(int i) {
  const std::string name = "fresh\n" + std::to_string(i) + std::string(5000, 'x');
  auto pose = poseAt(kAway, ros::Time::now());
  pose.header.frame_id = i % 2 == 0 ? name : "fresh" + std::to_string(i);
  if (i % 4 == 0) floodProbe().publish(pose);
  if (i % 4 == 1) floodProbe().publish(squareMovedTo(name, kSquare, ros::Time::now()));
  if (i % 4 == 2) floodProbe().publish(squareAt(name, kSquare, ros::Time::now()));
  if (i % 4 != 3) return;
  static ros::Publisher transforms = ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf", 100);
  tf2_msgs::TFMessage message;
  message.transforms.resize(2);
  for (auto& transform : message.transforms) {
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = "world";
    transform.transform.rotation.w = 1.0;
  }
  message.transforms[0].child_frame_id = name;
  message.transforms[1].child_frame_id = "fresh" + std::to_string(i);
  transforms.publish(message);
}

// Ten of one millisecond, each a nanosecond after the one before.
void sendTenPoses(int /*i*/) {
  const ros::Time now = ros::Time::now();
  for (int i = 0; i < 10; ++i) floodProbe().publish(poseAt(kAway, now + ros::Duration(0, i)));
}

// A connection that says nothing, or breaks off in its first number.
void connectAndLeave(int i) {
  static const std::uint16_t port = guardPort();
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 && i % 2 == 0) {
    static_cast<void>(send(socket, "no", 2, MSG_NOSIGNAL));
  }
  close(socket);
}

class FloodTest : public ::testing::TestWithParam<Flood> {
 protected:
  // @returns whether the flood was one, and the guard soon clear after it
  static bool flood(double seconds);
};

bool FloodTest::flood(double seconds) {
  const auto clear = [](const Warning& warning) { return warning.clear; };
  floodProbe().skipWarnings();
  floodProbe().awaitWarning(clear);
  const pid_t pid = guardPid();
  const double before = residentMegabytes(pid);
  const double processor = processorSeconds(pid);
  const size_t lines = guardLog().lines().size();
  const size_t warnings = floodProbe().warnings().size();

  ros::WallRate rate(1000.0);
  const auto begin = SteadyClock::now();
  int sent = 0;
  for (; secondsSince(begin) < seconds; ++sent) {
    GetParam().send(sent);
    rate.sleep();
  }
  const auto end = SteadyClock::now();
  const std::vector<Warning> flooded = floodProbe().warnings();
  const auto clear_ones = std::count_if(flooded.begin() + static_cast<std::ptrdiff_t>(warnings), flooded.end(), clear);
  const double used = processorSeconds(pid) - processor;
  floodProbe().skipWarnings();
  floodProbe().awaitWarning(clear);
  const double recovery = secondsSince(end);
  const size_t logged = guardLog().lines().size() - lines;
  const double after = residentMegabytes(pid);
  std::printf(
      "%s: %d messages in %.1f s; clear again after %.2f s; resident %.0f MB, after %.0f MB, peak %.0f MB; %zu lines "
      "logged; %.0f %% of a processor; %ld of %zu warnings clear\n",
      GetParam().name, sent, seconds, recovery, before, after, peakMegabytes(pid), logged, 100.0 * used / seconds,
      static_cast<long>(clear_ones), flooded.size() - warnings);
  EXPECT_LT(after - before, kMaxGrowth);
  EXPECT_LT(peakMegabytes(pid), kMaxMemory);
  EXPECT_EQ(guardPid(), pid);
  EXPECT_LE(logged, kMaxLines);
  return sent > 500.0 * seconds && recovery < kMaxRecovery;
}

// On a busy machine one of several floods is in time.
TEST_P(FloodTest, LeavesNothingBehind) {
  floodProbe();
  guardLog();
  floodProbe().publish(squareAt("square", kSquare, ros::Time::now()));
  const GoodInputs good;
  const double seconds = ros::param::param("~seconds", 2.0);
  for (int tries_left = 5; !flood(seconds); --tries_left) ASSERT_GT(tries_left, 1);
}

INSTANTIATE_TEST_SUITE_P(Floods, FloodTest,
                         ::testing::Values(Flood{"OfMeshesDeliveredAgain", sendMeshAgain},
                                           Flood{"OfStrayVertices", sendStrayVertices},
                                           Flood{"OfForgedLengths", sendForgedLength},
                                           Flood{"OfPosesAnHourOld", sendOldPose}, Flood{"OfLongNames", sendLongName},
                                           Flood{"OfPosesAtTenKilohertz", sendTenPoses},
                                           Flood{"OfConnections", connectAndLeave}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace sweep_guard_ros
