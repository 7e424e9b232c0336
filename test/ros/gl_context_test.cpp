// Guards on machines without OSMesa or EGL say which detector they use, and why. The test is the clock.
#include <gtest/gtest.h>
#include <signal.h>

#include "child_process.h"
#include "guard_probe.h"
#include "guard_process.h"
#include "missing_libraries.h"
#include "refusal.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;

const std::vector<std::string> kBoth = {"libOSMesa.so.8", "libEGL.so.1"};
const std::string kNoOpenGl = kNoOsMesa + "; " + kNoEgl;

ChildProcess guardWithout(const std::vector<std::string>& libraries, const std::vector<std::string>& arguments = {}) {
  return ChildProcess(guardWith(arguments), {"LD_LIBRARY_PATH=" + pathWithout(libraries)});
}

// A guard in a process of its own, with its tool above a square.
class GuardWithout {
 public:
  explicit GuardWithout(const std::vector<std::string>& libraries)
      : guard_(guardWithout(libraries, {"_timing/pose_timeout:=2.0", "_timing/mesh_timeout:=inf", "_cross_check:=1"})) {
    probe_.place(squareAt("square", {0, 0, 0}, probe_.time()));
  }

  bool findsTheSquare() {
    contactsAt(0.2);
    return contactsAt(0.1) == 0 && contactsAt(-0.1) == 1;
  }

  DiagnosticStatus detectorStatus(const std::string& detector) {
    return probe_.awaitStatus("detector", [&](const auto& status) { return valueOf(status, "detector") == detector; });
  }

  bool set(const std::string& key, const std::string& value) {
    dynamic_reconfigure::Config changes;
    changes.strs.resize(1);
    changes.strs[0].name = key;
    changes.strs[0].value = value;
    return probe_.configure(changes);
  }

  // Returns why the free path was not tested; empty: it was.
  std::string refusedPath(const std::string& detector) {
    sweep_guard::CheckSweep::Request request;
    request.path = {poseAt({0, 0, 1}, probe_.time())};
    request.detector = detector;
    return probe_.check(request).message;
  }

  // Ends the guard, and returns what it has printed.
  std::string output() {
    guard_.signal(SIGTERM);
    EXPECT_EQ(guard_.wait(), 0);
    return guard_.output();
  }

 private:
  size_t contactsAt(double height) {
    probe_.tick(0.01);
    return probe_.move(poseAt({0, 0, height}, probe_.time())).objects.size();
  }

  ChildProcess guard_;
  GuardProbe probe_{/*drives_clock=*/true};
};

class GlContextTest : public ::testing::Test {
 protected:
  void TearDown() override { ros::param::del("/sweep_guard"); }
};

TEST_F(GlContextTest, IsOsMesaWhereThereIsAll) {
  GuardWithout guard({});
  EXPECT_TRUE(guard.findsTheSquare());
  const DiagnosticStatus status = guard.detectorStatus("select");
  EXPECT_EQ(valueOf(status, "gl_context"), "osmesa");
  EXPECT_EQ(valueOf(status, "missing"), "");
  const std::string output = guard.output();
  EXPECT_TRUE(has(output, "by select on osmesa, "));
  EXPECT_FALSE(has(output, "instead of select"));
}

TEST_F(GlContextTest, IsEglWithoutOsMesa) {
  GuardWithout guard({"libOSMesa.so.8"});
  EXPECT_TRUE(guard.findsTheSquare());
  const DiagnosticStatus status = guard.detectorStatus("select");
  EXPECT_EQ(valueOf(status, "gl_context"), "egl");
  EXPECT_EQ(valueOf(status, "missing"), kNoOsMesa);
  EXPECT_FALSE(has(status.message, "instead of select"));
  EXPECT_EQ(guard.refusedPath("select"), "");
  const std::string output = guard.output();
  EXPECT_TRUE(has(output, "by select on egl, "));
  EXPECT_FALSE(has(output, "instead of select"));
}

TEST_F(GlContextTest, WithoutBothTheDetectorIsHalfspaceAndLogAndDiagnosticsSayWhy) {
  GuardWithout guard(kBoth);
  const GuardLog log;
  EXPECT_TRUE(guard.findsTheSquare());
  const DiagnosticStatus status = guard.detectorStatus("halfspace");
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_TRUE(has(status.message, "halfspace instead of select: " + kNoOpenGl));
  EXPECT_EQ(valueOf(status, "missing"), kNoOpenGl);
  EXPECT_EQ(valueOf(status, "gl_context"), "");
  log.await("cross-check by reference instead of select: " + kNoOpenGl);
  const std::string output = guard.output();
  const std::string halfspace = std::string("halfspace on ") + sweep_guard_core::simd::kernels().name;
  EXPECT_TRUE(has(output, "detector " + halfspace + " instead of select: " + kNoOpenGl));
  EXPECT_TRUE(has(output, "by " + halfspace + ", "));
}

TEST_F(GlContextTest, WithoutBothACallerThatAsksForSelectGetsNoOtherDetector) {
  GuardWithout guard(kBoth);
  EXPECT_EQ(guard.refusedPath(""), "");
  EXPECT_EQ(guard.refusedPath("halfspace"), "");
  EXPECT_EQ(guard.refusedPath("select"), kNoOpenGl + "; or set detector to halfspace");
}

TEST_F(GlContextTest, WithoutBothTheDetectorStaysHalfspaceWhateverElseChanges) {
  GuardWithout guard(kBoth);
  ASSERT_TRUE(guard.set("volume", "hull"));
  EXPECT_TRUE(guard.findsTheSquare());
  EXPECT_EQ(valueOf(guard.detectorStatus("halfspace"), "missing"), kNoOpenGl);
  ASSERT_TRUE(guard.set("detector", "reference"));
  EXPECT_EQ(valueOf(guard.detectorStatus("reference"), "missing"), "");
  ASSERT_TRUE(guard.set("detector", "select"));
  EXPECT_TRUE(has(guard.detectorStatus("halfspace").message, kNoOpenGl));
  EXPECT_TRUE(guard.findsTheSquare());
}

TEST_F(GlContextTest, ThatIsNamedAndMissingIsTheEndOfTheNode) {
  for (const auto& [gl_context, library, package] :
       {std::array<const char*, 3>{"osmesa", "libOSMesa.so.8", "libosmesa6"},
        {"egl", "libEGL.so.1", "libegl1 and libegl-mesa0"}}) {
    ChildProcess guard = guardWithout({library}, {std::string("_gl_context:=") + gl_context});
    EXPECT_EQ(guard.wait(), 2);
    EXPECT_TRUE(has(guard.output(), std::string("no off-screen context from ") + library +
                                        ", it cannot be loaded: install " + package + "; or set gl_context to auto"));
  }
}

}  // namespace
}  // namespace sweep_guard_ros
