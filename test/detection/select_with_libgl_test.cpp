// Built with libGL linked: there every linked OpenGL call of this process goes to the wrong library,
// which answers a selection with silence.
#include <GL/gl.h>
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "detection/every_context.h"
#include "detection/reference_detector.h"
#include "detection/select_detector.h"
#include "refusal.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

std::string libraryOf(const void* symbol) {
  Dl_info info;
  return dladdr(symbol, &info) != 0 ? info.dli_fname : "";
}

// Without this the test below would prove nothing. The call keeps libGL linked.
TEST(LibGlTest, LinkedCallsReachLibGl) {
  EXPECT_EQ(glGetString(GL_RENDERER), nullptr);  // libGL has no context here
  EXPECT_TRUE(has(libraryOf(dlsym(RTLD_DEFAULT, "glRenderMode")), "libGL.so"));
}

class SelectWithLibGlTest : public OnEveryContext {};

TEST_P(SelectWithLibGlTest, SelectStillHits) {
  SelectDetector detector({}, [] { return makeOffscreenContext(GetParam()); });
  ReferenceDetector reference;
  size_t hits = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Scene scene = randomScene(seed);
    const std::vector<std::uint32_t> found = detector.detect(scene.mesh_M, scene.swept_M).triangles;
    const std::vector<std::uint32_t> met = reference.detect(scene.mesh_M, scene.swept_M).triangles;
    EXPECT_TRUE(std::includes(found.begin(), found.end(), met.begin(), met.end())) << "seed " << seed;
    hits += met.size();
  }
  EXPECT_GT(hits, 500U);
}

INSTANTIATE_ON_EVERY_CONTEXT(SelectWithLibGlTest);

}  // namespace
}  // namespace sweep_guard_core
