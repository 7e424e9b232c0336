// Machines without OSMesa or EGL: in processes of their own, because the dynamic linker reads its path once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "missing_libraries.h"
#include "refusal.h"
#include "scenes.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {
namespace {

class AvailableDetectorTest : public testing::Test {
 protected:
  void SetUp() override { testing::FLAGS_gtest_death_test_style = "threadsafe"; }
  void TearDown() override { setenv("LD_LIBRARY_PATH", before_.c_str(), 1); }

  static void hide(const std::vector<std::string>& libraries) {
    setenv("LD_LIBRARY_PATH", pathWithout(libraries).c_str(), 1);
  }

  const std::string before_ = pathWithout({});
};

bool missesNothing(Detector& detector) {
  const auto reference = makeDetector("reference");
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scene scene = randomScene(seed);
    const TriangleSet found = detector.detect(scene.mesh_M, scene.swept_M).triangles;
    const TriangleSet met = reference->detect(scene.mesh_M, scene.swept_M).triangles;
    if (!std::includes(found.begin(), found.end(), met.begin(), met.end())) return false;
  }
  return true;
}

[[noreturn]] void reportChoice(const DetectorOptions& options) {
  const DetectorChoice choice = availableDetector("select", options);
  std::cerr << choice.name << ' ' << choice.options.gl_context << (choice.replacesSelect() ? " replaces select" : "");
  if (!choice.missing.empty()) std::cerr << ", " << choice.missing;
  if (!missesNothing(*makeDetector(choice.name, choice.options))) std::cerr << ", misses triangles";
  std::exit(0);
}

[[noreturn]] void reportRefusal(const DetectorOptions& options) {
  const std::string message = refusal<DeviceError>([&] { makeDetector("select", options); });
  std::cerr << (message.empty() ? "makes it" : message);
  std::exit(0);
}

DetectorOptions on(const std::string& gl_context) { return {/*cull=*/true, gl_context}; }

void expectChoice(const DetectorOptions& options, const std::string& expected) {
  EXPECT_EXIT(reportChoice(options), testing::ExitedWithCode(0), testing::Eq(expected));
}

void expectRefusal(const DetectorOptions& options, const std::string& expected) {
  EXPECT_EXIT(reportRefusal(options), testing::ExitedWithCode(0), testing::Eq(expected));
}

TEST_F(AvailableDetectorTest, IsSelectOnOsMesaWhereThereIsAll) { expectChoice({}, "select osmesa"); }

TEST_F(AvailableDetectorTest, IsSelectOnEglWithoutOsMesa) {
  hide({"libOSMesa.so.8"});
  expectChoice({}, "select egl, " + kNoOsMesa);
}

TEST_F(AvailableDetectorTest, IsSelectOnOsMesaWithoutEgl) {
  hide({"libEGL.so.1"});
  expectChoice({}, "select osmesa");
}

TEST_F(AvailableDetectorTest, IsHalfspaceWithoutBothAndSaysWhatIsMissing) {
  hide({"libOSMesa.so.8", "libEGL.so.1"});
  expectChoice({}, "halfspace auto replaces select, " + kNoOsMesa + "; " + kNoEgl);
}

TEST_F(AvailableDetectorTest, IsHalfspaceWhereEglHasNoDriver) {
  hide({"libOSMesa.so.8"});
  setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
  EXPECT_EXIT(reportChoice({}), testing::ExitedWithCode(0), "halfspace auto replaces select.*libEGL.so.1, it has no");
  unsetenv("__EGL_VENDOR_LIBRARY_DIRS");
}

TEST_F(AvailableDetectorTest, IsNoOtherThanOneThatIsNamed) {
  for (const char* name : {"halfspace", "reference"}) {
    const DetectorChoice choice = availableDetector(name);
    EXPECT_EQ(choice.name, name);
    EXPECT_EQ(choice.options.gl_context, kAnyGlContext);
    EXPECT_FALSE(choice.replacesSelect());
  }
  for (const std::string& gl_context : offscreenContextNames()) {
    const DetectorChoice choice = availableDetector("select", on(gl_context));
    EXPECT_EQ(choice.name, "select");
    EXPECT_EQ(choice.options.gl_context, gl_context);
  }
}

TEST_F(AvailableDetectorTest, MakingSelectTakesTheContextThatThereIs) {
  hide({"libOSMesa.so.8"});
  expectRefusal({}, "makes it");
}

TEST_F(AvailableDetectorTest, MakingSelectWithoutAnyContextMakesNoOtherDetector) {
  hide({"libOSMesa.so.8", "libEGL.so.1"});
  expectRefusal({}, kNoOsMesa + "; " + kNoEgl + "; or set detector to halfspace");
}

TEST_F(AvailableDetectorTest, MakingSelectOnOneContextNeverTakesTheOther) {
  const auto without_its_name = [](const std::string& missing) { return missing.substr(missing.find(": ") + 2); };
  hide({"libOSMesa.so.8"});
  expectRefusal(on("osmesa"), without_its_name(kNoOsMesa) + "; or set gl_context to auto");
  hide({"libEGL.so.1"});
  expectRefusal(on("egl"), without_its_name(kNoEgl) + "; or set gl_context to auto");
}

}  // namespace
}  // namespace sweep_guard_core
