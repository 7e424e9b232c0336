// Messages that are late, wrong, forged or too many neither silence the guard nor mislead it. The test is the clock.
#include <arpa/inet.h>
#include <ros/service_manager.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "guard_process.h"
#include "node_fixture.h"
#include "raw_message.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::CheckSweep;
using sweep_guard::DeformableMesh;
using sweep_guard::MeshVertices;
using sweep_guard::Warning;
using SteadyClock = std::chrono::steady_clock;

constexpr size_t kMaxText = 1000;  // characters

// Comes before the probe's own publisher, which would number the poses.
ros::Publisher& rawPoses() {
  static ros::Publisher publisher = ros::NodeHandle().advertise<Raw<geometry_msgs::PoseStamped>>("tool_pose", 10000);
  return publisher;
}

bool printableText(const std::string& text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; });
}

class HostileTest : public NodeTest {
 protected:
  static void SetUpTestSuite() {
    rawPoses();
    probe();
  }

  // The reasons of all warnings since there were `begin` of them, except that a busy machine may be late, and the tool jumps from
  // test to test.
  static std::uint32_t reasonsSince(size_t begin) {
    const std::vector<Warning> warnings = probe().warnings();
    std::uint32_t reasons = 0;
    for (size_t i = begin; i < warnings.size(); ++i) reasons |= warnings[i].reasons;
    return reasons & ~std::uint32_t{Warning::POSES_UNSWEPT | Warning::OVERLOAD | Warning::JUMP};
  }

  static bool wasClearSince(size_t begin) {
    const std::vector<Warning> warnings = probe().warnings();
    return std::any_of(warnings.begin() + static_cast<std::ptrdiff_t>(begin), warnings.end(), isClear);
  }

  void clearScene() {
    placeSquare("square", kSquare);
    restAt(kAway);
  }

  // Good inputs alone, until the guard is clear. Returns how long that took [s].
  double recover() {
    const auto begin = SteadyClock::now();
    const auto is_clear = [](const Warning& warning) { return isClear(warning) && warning.reasons == 0; };
    probe().skipWarnings();
    moveUntil("square", kSquare, kAway, is_clear);
    return secondsSince(begin);
  }

  GuardLog log_;
};

// Of the stamp of the vertices, and of an older one.
TEST_F(HostileTest, AMeshDeliveredAgainChangesNothing) {
  clearScene();
  const auto mesh = squareAt("square", kSquare, probe().time());
  probe().place(mesh);
  restAt(kAway);
  const size_t begin = probe().warnings().size();
  const auto deliver_again = [&] {
    probe().publish(mesh);
    placeSquare("later", {0, 0, -2});  // the copy before it is read
    restAt(kAway);
  };
  deliver_again();
  probe().place(squareMovedTo("square", kSquare, probe().time()));
  deliver_again();
  for (int i = 0; i < 10; ++i) {
    moveTo(kAway);
    probe().place(squareMovedTo("square", kSquare, probe().time()));
  }
  const std::uint32_t of_the_later = Warning::NOT_SWEPT | Warning::NOT_COVERED;
  EXPECT_EQ(reasonsSince(begin) & ~of_the_later, 0U) << probe().warnings().back().text;
  restAt(kAway);
}

TEST_F(HostileTest, VerticesFromBeforeARemovalChangeNothing) {
  clearScene();
  placeSquare("gone", {0, 0, -2});
  restAt(kAway);
  const ros::Time before = probe().time();
  probe().tick(0.01);
  DeformableMesh removal;
  removal.id = "gone";
  removal.header.stamp = probe().time();
  probe().publish(removal);
  probe().remove("gone");
  moveTo(kAway);
  const size_t begin = probe().warnings().size();
  for (int i = 0; i < 10; ++i) {
    probe().publish(squareMovedTo("gone", {0, 0, -2}, before));
    probe().publish(squareMovedTo("gone", {0, 0, -2}, removal.header.stamp));
    moveTo(kAway);
    probe().place(squareMovedTo("square", kSquare, probe().time()));
  }
  EXPECT_EQ(reasonsSince(begin), 0U) << probe().warnings().back().text;
}

struct Stray {
  const char* name;
  const char* id;
};
void PrintTo(const Stray& stray, std::ostream* out) { *out << stray.name; }

class StrayVerticesTest : public HostileTest, public ::testing::WithParamInterface<Stray> {};

TEST_P(StrayVerticesTest, AreNotClearWhileTheyComeAndAreForgottenASecondLater) {
  clearScene();
  placeSquare("gone", {0, 0, -2});
  probe().remove("gone");
  probe().skipWarnings();
  const auto send = [] { probe().publish(squareMovedTo(GetParam().id, {0, 0, -2}, probe().time())); };
  probe().tick(0.01);
  send();
  probe().awaitWarning(hasReason(Warning::MESH_INVALID));
  const size_t begin = probe().warnings().size();
  for (int i = 0; i < 50; ++i) {
    moveTo(kAway);
    send();
    probe().place(squareMovedTo("square", kSquare, probe().time()));
  }
  EXPECT_FALSE(wasClearSince(begin));
  const double taken = recover();
  EXPECT_GT(taken, 0.8);
  EXPECT_LT(taken, 3.0);  // 1 s where nothing else runs
}

INSTANTIATE_TEST_SUITE_P(Vertices, StrayVerticesTest,
                         ::testing::Values(Stray{"OfARemovedWorkpiece", "gone"}, Stray{"OfAnUnknownId", "ghost"},
                                           Stray{"WithoutAnId", ""}),
                         [](const auto& test) { return test.param.name; });

class ForgedLengthTest : public HostileTest {
 protected:
  void SetUp() override {
    HostileTest::SetUp();
    clearScene();
    before_ = peakMegabytes(guardPid());
    ASSERT_GT(before_, 1.0);
  }

  template <typename Msg>
  void publish(const std::string& topic, const Raw<Msg>& raw) {
    ros::NodeHandle node;
    const ros::Publisher publisher = node.advertise<Raw<Msg>>(topic, 10);
    publisher.publish(raw);  // the topic is connected already, for the probe
  }

  void expectNoGrowth() const { EXPECT_LT(peakMegabytes(guardPid()) - before_, kMaxGrowth); }

  double before_ = 0.0;
};

TEST_F(ForgedLengthTest, OfVerticesIsRefusedWithoutMemory) {
  MeshVertices vertices;
  vertices.id = "square";
  publish("mesh_vertices", forged(serialized(vertices), 4, 0x40000001));
  EXPECT_TRUE(has(probe().awaitWarning(hasReason(Warning::MESH_INVALID)).text, "announces 1073741825 elements"));
  expectNoGrowth();
  recover();
}

TEST_F(ForgedLengthTest, OfTrianglesOrMeshVerticesIsRefusedWithoutMemory) {
  DeformableMesh mesh;
  mesh.id = "square";
  for (const size_t from_end : {8U, 4U}) {
    publish("mesh", forged(serialized(mesh), from_end, 0x40000001));
    EXPECT_TRUE(has(probe().awaitWarning(hasReason(Warning::MESH_INVALID)).text, "announces 1073741825 elements"));
    expectNoGrowth();
    recover();
  }
}

TEST_F(ForgedLengthTest, OfTransformsIsRefusedWithoutMemory) {
  publish("/tf", forged(serialized(tf2_msgs::TFMessage()), 4, 0x20000001));
  log_.await("/tf: message announces 536870913 elements");
  expectNoGrowth();
  moveTo(kAway);
}

TEST_F(ForgedLengthTest, OfAPathIsRefusedWithoutMemory) {
  ros::ServiceClientOptions options;
  options.service = "/sweep_guard/check_sweep";
  options.md5sum = ros::service_traits::md5sum<CheckSweep>();
  ros::ServiceClient client = ros::NodeHandle().serviceClient(options);
  const auto empty = serialized(CheckSweep::Request());
  CheckSweep::Response response;
  ASSERT_TRUE(client.call(forged(empty, empty.bytes.size(), 0x40000001), response, options.md5sum));
  EXPECT_FALSE(response.success || response.clear);
  EXPECT_TRUE(has(response.message, "announces 1073741825 elements"));
  expectNoGrowth();
}

// One hour behind: at 40 sweeps per second of age the first prediction would take minutes.
TEST_F(HostileTest, PosesOfAnotherClockAreStaleAndCheap) {
  clearScene();
  ASSERT_TRUE(probe().reset().success);
  const double before = processorSeconds(guardPid());
  const auto begin = SteadyClock::now();
  const ros::Time hour_ago = probe().time() - ros::Duration(900.0);  // the probe's clock begins at 1000 s
  for (int i = 0; i < 1000; ++i) probe().publish(poseAt(kAway, hour_ago + ros::Duration(0.001 * i)));
  probe().awaitContactsUpTo(hour_ago + ros::Duration(0.999));
  const Warning warning = probe().awaitWarning(hasReason(Warning::POSE_STALE));
  EXPECT_TRUE(has(warning.text, "clocks differ"));
  EXPECT_LT(processorSeconds(guardPid()) - before, 1.0);
  EXPECT_LT(secondsSince(begin), 10.0);
  const auto status = probe().awaitStatus("tool pose", [](const GuardProbe::Status& next) {
    return next.message.find("clocks differ") != std::string::npos;
  });
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::ERROR);
  recover();
}

TEST_F(HostileTest, CheckSweepIsNotClearWhileAMeshIsRefused) {
  clearScene();
  CheckSweep::Request request;
  request.path = {poseAt(kAway, ros::Time())};
  EXPECT_TRUE(probe().check(request).clear);
  auto replacement = squareAt("square", kSquare, probe().time());
  replacement.revision = 2;
  replacement.mesh.vertices[0].x = NAN;
  auto another = replacement;
  another.id = "another";
  for (const DeformableMesh& refused : {replacement, another}) {
    probe().publish(refused);
    probe().awaitWarning(hasReason(Warning::MESH_INVALID));
    const auto response = probe().check(request);
    EXPECT_TRUE(response.success);
    EXPECT_FALSE(response.clear || response.collision);
    EXPECT_TRUE(has(response.message, "'" + refused.id + "' refused"));
    refused.id == "another" ? probe().remove("another") : placeSquare("square", kSquare);
    probe().awaitWarning([](const Warning& warning) { return (warning.reasons & Warning::MESH_INVALID) == 0; });
  }
  EXPECT_TRUE(probe().check(request).clear);
}

TEST_F(HostileTest, CheckSweepIsNotClearOnAnOldTransform) {
  const auto place_frame = [] { probe().placeFrame("lathe", Eigen::Isometry3d::Identity()); };
  place_frame();
  placeSquare("square", kSquare, "lathe");
  CheckSweep::Request request;
  request.path = {poseAt(kAway, ros::Time())};
  EXPECT_TRUE(probe().check(request).clear);
  probe().advance(1.5);
  const auto response = probe().check(request);
  EXPECT_TRUE(response.success);
  EXPECT_FALSE(response.clear || response.collision);
  EXPECT_TRUE(has(response.message, "newest transform"));
}

// ---- names ----

std::string longName() { return "x\n\x1b[31m\x07" + std::string(5000, 'y'); }

void expectShown(const std::string& text) {
  EXPECT_TRUE(printableText(text)) << text;
  EXPECT_LT(text.size(), kMaxText) << text;
}

class LongNameTest : public HostileTest {
 protected:
  // What the guard has said since there were `begin` warnings.
  void expectShortAndPrintable(size_t begin) {
    const std::vector<Warning> warnings = probe().warnings();
    for (size_t i = begin; i < warnings.size(); ++i) expectShown(warnings[i].text);
    probe().awaitStatus("process", [](const GuardProbe::Status&) { return true; });
    for (const char* const name : {"warning", "tool pose", "mesh", "mesh vertices", "workpieces"}) {
      const auto status = probe().awaitStatus(name, [](const GuardProbe::Status&) { return true; });
      expectShown(status.message);
      for (const auto& value : status.values) expectShown(value.key + value.value);
    }
    for (const auto& line : log_.lines()) expectShown(line.msg);
  }
};

TEST_F(LongNameTest, OfAWorkpieceIsShownShort) {
  clearScene();
  const size_t begin = probe().warnings().size();
  probe().publish(squareMovedTo(longName(), kSquare, probe().time()));
  probe().awaitWarning(hasReason(Warning::MESH_INVALID));
  probe().publish(squareAt(longName(), kSquare, probe().time()));
  CheckSweep::Request request;
  request.path = {poseAt(kAway, ros::Time())};
  request.mesh_ids = {longName()};
  expectShown(probe().check(request).message);
  expectShortAndPrintable(begin);
}

TEST_F(LongNameTest, OfAFrameIsShownShort) {
  clearScene();
  const size_t begin = probe().warnings().size();
  auto pose = poseAt(kAway, probe().time());
  pose.header.frame_id = longName();
  probe().publish(pose);
  probe().awaitWarning(hasReason(Warning::TF_FAIL));
  auto mesh = squareAt("framed", kSquare, probe().time());
  mesh.header.frame_id = longName();
  probe().publish(mesh);
  placed_.insert("framed");
  probe().awaitWarning(hasReason(Warning::MESH_INVALID));
  probe().placeFrame(longName(), Eigen::Isometry3d::Identity());
  log_.await("transform to 'x");
  CheckSweep::Request request;
  request.path = {pose};
  expectShown(probe().check(request).message);
  expectShortAndPrintable(begin);
}

// roscpp does not lie about the caller: this speaks its protocol.
TEST_F(LongNameTest, OfACallerIsShownShort) {
  clearScene();
  const size_t begin = probe().warnings().size();
  std::string host;
  std::uint32_t port = 0;
  ASSERT_TRUE(ros::ServiceManager::instance()->lookupService("/sweep_guard/enable", host, port));
  const auto counted = [](const std::string& bytes) {
    const auto size = static_cast<std::uint32_t>(bytes.size());
    return std::string(reinterpret_cast<const char*>(&size), 4) + bytes;
  };
  const std::string header = counted("callerid=" + longName()) + counted("service=/sweep_guard/enable") +
                             counted(std::string("md5sum=") + ros::service_traits::md5sum<std_srvs::SetBool>());
  const std::string request = counted(header) + counted(std::string(1, '\0'));
  const int connection = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(connect(connection, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
  ASSERT_EQ(write(connection, request.data(), request.size()), static_cast<ssize_t>(request.size()));
  const Warning warning = probe().awaitWarning(hasReason(Warning::DISABLED));
  EXPECT_TRUE(has(warning.text, "disabled by x??[31m?yyy"));
  expectShortAndPrintable(begin);
  close(connection);
  ASSERT_TRUE(probe().enable(true).success);
}

// ---- several publishers, lost poses, changed frames ----

// Another node that publishes tool poses: rostopic, until it is destroyed.
class SecondPublisher {
 public:
  SecondPublisher() : process_(fork()) {
    if (process_ != 0) return;
    execlp("rostopic", "rostopic", "pub", "/tool_pose", "geometry_msgs/PoseStamped", "{}", nullptr);
    _exit(1);
  }
  ~SecondPublisher() {
    kill(process_, SIGINT);
    waitpid(process_, nullptr, 0);
  }

 private:
  const pid_t process_;
};

TEST_F(HostileTest, SeveralPublishersOfPosesAreNeverClear) {
  clearScene();
  const auto several = [](const Warning& warning) { return (warning.reasons & Warning::MULTI_PUBLISHER) != 0; };
  {
    const SecondPublisher second;
    moveUntil("square", kSquare, kAway, several);
    const size_t begin = probe().warnings().size();
    for (int i = 0; i < 50; ++i) {
      moveTo(kAway);
      probe().place(squareMovedTo("square", kSquare, probe().time()));
    }
    const std::vector<Warning> warnings = probe().warnings();
    EXPECT_TRUE(std::all_of(warnings.begin() + static_cast<std::ptrdiff_t>(begin), warnings.end(), several));
    EXPECT_FALSE(wasClearSince(begin));
  }
  recover();
}

TEST_F(HostileTest, AGapInTheSequenceOfPosesIsReportedAndStaysClear) {
  clearScene();
  probe().skipWarnings();
  std::uint32_t next = 1;
  const auto send = [&](std::uint32_t sequence) {
    probe().tick(0.01);
    auto pose = poseAt(kAway, probe().time());
    pose.header.seq = sequence;
    rawPoses().publish(serialized(pose));
    probe().place(squareMovedTo("square", kSquare, probe().time()));
  };
  for (; next < 10; ++next) send(next);
  const size_t begin = probe().warnings().size();
  next += 5;
  send(next++);
  const Warning lost =
      probe().awaitWarning([](const Warning& warning) { return (warning.reasons & Warning::POSE_LOSS) != 0; });
  EXPECT_TRUE(has(lost.text, "5 tool poses were lost"));
  for (int i = 0; i < 10; ++i) send(next++);
  EXPECT_EQ(reasonsSince(begin), static_cast<std::uint32_t>(Warning::POSE_LOSS)) << probe().warnings().back().text;
  EXPECT_TRUE(wasClearSince(begin));
  recover();
}

TEST_F(HostileTest, AChangedStaticTransformIsUnknownUntilItIsSwept) {
  ros::Publisher frames = ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf_static", 10, /*latch=*/true);
  const auto place = [&](double z) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(tf2::eigenToTransform(Eigen::Isometry3d(Eigen::Translation3d(0, 0, z))));
    message.transforms[0].header.frame_id = "world";
    message.transforms[0].child_frame_id = "fixture";
    frames.publish(message);
  };
  place(-1.0);
  placeSquare("square", {0, 0, 0}, "fixture");
  CheckSweep::Request in_the_world;
  in_the_world.path = {poseAt(kAway, ros::Time())};
  while (!probe().check(in_the_world).success) continue;  // waits for the transform
  restAt(kAway);
  const size_t begin = probe().warnings().size();
  place(-1.0);
  place(-1.1);
  const Warning jump = probe().awaitWarning(hasReason(Warning::TIME_JUMP));
  EXPECT_TRUE(has(jump.text, "'fixture' to 'world' has changed"));
  EXPECT_EQ(reasonsSince(begin) & Warning::MESH_STALE, 0U);
  restAt(kAway);
}

TEST_F(HostileTest, SeventyMissingFramesDoNotDelayThePoses) {
  clearScene();
  for (int i = 0; i < 70; ++i) placeSquare("part" + std::to_string(i), kSquare, "missing" + std::to_string(i));
  moveTo(kAway);
  const auto begin = SteadyClock::now();
  for (int i = 0; i < 50; ++i) moveTo(kAway);
  EXPECT_LT(secondsSince(begin), 10.0);  // 70 s if each pose waited 20 ms for each frame
  EXPECT_TRUE(has(probe().awaitWarning(hasReason(Warning::TF_FAIL)).text, "missing"));
}

TEST_F(HostileTest, AQuaternionOfEitherSignAndOfAlmostUnitLengthIsTheSameRotation) {
  clearScene();
  const size_t begin = probe().warnings().size();
  for (int i = 0; i < 20; ++i) {
    probe().tick(0.01);
    auto pose = poseAt(kAway, probe().time());
    pose.pose.orientation.x *= (i % 2 == 0 ? -1.0 : 1.0) * (1.0 + 0.004 * i);
    EXPECT_TRUE(probe().move(pose).objects.empty());
    probe().place(squareMovedTo("square", kSquare, probe().time()));
  }
  EXPECT_EQ(reasonsSince(begin), 0U) << probe().warnings().back().text;
}

// By the steady clock the newest pose is stale, however fresh it looks by ROS time.
TEST_F(HostileTest, AClockThatStandsStillIsNotClear) {
  clearScene();
  const auto begin = SteadyClock::now();
  probe().awaitWarning(hasReason(Warning::POSE_STALE));
  EXPECT_LT(secondsSince(begin), 1.2);  // timing/pose_timeout, and 0.2 s
  restAt(kAway);
}

TEST_F(HostileTest, ATransformThatIsNotRigidIsNoTransform) {
  clearScene();
  tf2_msgs::TFMessage message;
  message.transforms.resize(2);
  for (auto& transform : message.transforms) {
    transform.header.frame_id = "world";
    transform.header.stamp = probe().time();
  }
  message.transforms[0].child_frame_id = "stretched";
  message.transforms[0].transform.rotation.w = 2.0;
  message.transforms[1].child_frame_id = "undefined";
  message.transforms[1].transform.rotation.w = 1.0;
  message.transforms[1].transform.translation.z = NAN;
  ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf", 10).publish(message);
  for (const char* const frame : {"stretched", "undefined"}) {
    placeSquare("square", kSquare, frame);
    probe().tick(0.01);
    probe().publish(poseAt(kAway, probe().time()));
    probe().awaitWarning([&](const Warning& warning) {
      return hasReason(Warning::TF_FAIL)(warning) && warning.text.find(frame) != std::string::npos;
    });
  }
}

TEST_F(HostileTest, AMeshOfMoreTrianglesThanAllowedIsRefused) {
  clearScene();
  auto mesh = squareAt("square", kSquare, probe().time());
  mesh.mesh.triangles.resize(1000001, mesh.mesh.triangles[0]);
  probe().publish(mesh);
  EXPECT_TRUE(has(probe().awaitWarning(hasReason(Warning::MESH_INVALID)).text, "1000001"));
  placeSquare("square", kSquare);
  recover();
}

TEST_F(HostileTest, CallsOfManyClientsAreAllAnsweredWhilePosesAreSwept) {
  clearScene();
  CheckSweep::Request request;
  request.path.assign(100, poseAt(kAway, ros::Time()));
  std::atomic<int> answered = 0;
  constexpr size_t kClients = 16;
  std::vector<std::thread> clients;
  clients.reserve(kClients);
  for (size_t i = 0; i < kClients; ++i) {
    clients.emplace_back([&] {
      ros::ServiceClient client = ros::NodeHandle().serviceClient<CheckSweep>("/sweep_guard/check_sweep");
      CheckSweep::Request asked = request;
      CheckSweep::Response response;
      for (int call = 0; call < 5; ++call) {
        const bool well = client.call(asked, response) && (response.success || has(response.message, "BUSY"));
        answered += well ? 1 : 0;
      }
    });
  }
  for (int i = 0; i < 20; ++i) moveTo(kAway);
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(answered, 80);
}

// A flat grid of 999 698 triangles.
DeformableMesh largeMesh(ros::Time stamp) {
  constexpr std::uint32_t kSide = 708;
  DeformableMesh mesh = squareAt("large", {0, 0, -5}, stamp);
  mesh.mesh.vertices.clear();
  mesh.mesh.triangles.clear();
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    const std::uint32_t column = i % kSide;
    const std::uint32_t row = i / kSide;
    mesh.mesh.vertices.emplace_back();
    mesh.mesh.vertices.back().x = 0.001 * column;
    mesh.mesh.vertices.back().y = 0.001 * row;
    mesh.mesh.vertices.back().z = -5.0;
    if (column + 1 == kSide || row + 1 == kSide) continue;
    mesh.mesh.triangles.resize(mesh.mesh.triangles.size() + 2);
    (mesh.mesh.triangles.end() - 2)->vertex_indices = {i, i + 1, i + kSide};
    (mesh.mesh.triangles.end() - 1)->vertex_indices = {i + 1, i + kSide + 1, i + kSide};
  }
  return mesh;
}

// Three of them are converted one after the other. If the updates of the square waited for them, there would be one.
TEST_F(HostileTest, ALargeMeshDoesNotHoldUpOtherWorkpieces) {
  clearScene();
  DeformableMesh large = largeMesh(probe().time());
  const auto begin = SteadyClock::now();
  for (const char* const id : {"large", "larger", "largest"}) {
    large.id = id;
    probe().publish(large);
    placed_.insert(id);
  }
  CheckSweep::Request of_the_last;
  of_the_last.path = {poseAt(kAway, ros::Time())};
  of_the_last.mesh_ids = {large.id};
  int updates = 0;
  do {
    probe().tick(0.001);
    probe().place(squareMovedTo("square", kSquare, probe().time()));
    ++updates;
  } while (!probe().check(of_the_last).success && secondsSince(begin) < 60.0);
  EXPECT_GE(updates, 3);
}

}  // namespace
}  // namespace sweep_guard_ros
