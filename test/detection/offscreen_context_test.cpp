#include "detection/offscreen_context.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <thread>

#include "detection/every_context.h"
#include "refusal.h"
#include "scenes.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {
namespace {

constexpr std::uint64_t kScenes = 100;

using Answers = std::vector<std::vector<std::uint32_t>>;

Answers answersOf(Detector& detector) {
  Answers answers;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const Scene scene = randomScene(seed);
    answers.push_back(detector.detect(scene.mesh_M, scene.swept_M).triangles);
  }
  return answers;
}

std::unique_ptr<Detector> selectOn(const std::string& gl_context) {
  return makeDetector("select", {/*cull=*/true, gl_context});
}

TEST(OffscreenContextTest, RefusesANameItDoesNotKnow) {
  for (const char* name : {"", "EGL", "glx"}) EXPECT_THROW(makeOffscreenContext(name), InvalidInput) << name;
}

TEST(OffscreenContextTest, ThereIsOne) {
  for (const std::string& name : offscreenContextNames()) {
    if (whyMissing(name).empty()) return;
  }
  ADD_FAILURE() << "every test of selection is skipped";
}

TEST(GlLibraryTest, SaysWhatToDoWithoutTheLibrary) {
  const std::string message = refusal<DeviceError>([] { GlLibrary("libsweep_guard_nowhere.so.1", "install it"); });
  EXPECT_TRUE(has(message, "libsweep_guard_nowhere.so.1"));
  EXPECT_TRUE(has(message, "install it"));
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(GlLibraryTest, NamesTheFunctionThatIsMissing) {
  const GlLibrary library("libc.so.6", "install it");
  EXPECT_THROW(library.function<void()>("makeNoContext"), DeviceError);
}

// A library reads its environment once: these make their contexts in processes of their own.
class EnvironmentTest : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { testing::FLAGS_gtest_death_test_style = "threadsafe"; }

  [[noreturn]] static void makeContext() {
    try {
      makeOffscreenContext(GetParam());
    } catch (const DeviceError&) {
      std::exit(1);
    }
    std::exit(0);
  }

  static bool madeOrMissing(int status) {
    return testing::ExitedWithCode(0)(status) ||
           (testing::ExitedWithCode(1)(status) && !whyMissing(GetParam()).empty());
  }
};

// Neither graphics card nor home are there on many a robot.
TEST_P(EnvironmentTest, NothingIsPrintedWhereNothingIsWrong) {
  const auto homeless = [] {
    for (const char* unset : {"LIBGL_ALWAYS_SOFTWARE", "DISPLAY"}) unsetenv(unset);
    for (const char* none : {"HOME", "XDG_CACHE_HOME"}) setenv(none, "/nonexistent/home", 1);
    makeContext();
  };
  EXPECT_EXIT(homeless(), madeOrMissing, testing::Eq(""));
}

TEST_P(EnvironmentTest, ADriverThatMesaDoesNotKnowIsNotAskedFor) {
  const auto misled = [] {
    setenv("GALLIUM_DRIVER", "crayon", 1);
    makeContext();
  };
  EXPECT_EXIT(misled(), madeOrMissing, testing::Eq(""));
}

INSTANTIATE_ON_EVERY_CONTEXT(EnvironmentTest);

TEST(EglContextTest, SaysWhatToDoWithoutADriver) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto without_driver = [] {
    setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
    std::cerr << whyMissing("egl");
    std::exit(0);
  };
  EXPECT_EXIT(without_driver(), testing::ExitedWithCode(0), "install libegl1 and libegl-mesa0");
}

// Two kinds in one process.
class BothContextsTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const std::string& name : offscreenContextNames()) {
      if (const std::string why = whyMissing(name); !why.empty()) FAIL() << why;
    }
    expected_ = answersOf(*makeDetector("reference"));
  }

  // A few grazed triangles more may be named.
  bool right(const Answers& answers) const {
    for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
      if (!std::includes(answers[seed].begin(), answers[seed].end(), expected_[seed].begin(), expected_[seed].end())) {
        return false;
      }
    }
    return true;
  }

  Answers expected_;
};

TEST_F(BothContextsTest, AnswerAlikeInTurns) {
  const auto osmesa = selectOn("osmesa");
  const auto egl = selectOn("egl");
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const Scene scene = randomScene(seed);
    const auto found = osmesa->detect(scene.mesh_M, scene.swept_M).triangles;
    EXPECT_EQ(egl->detect(scene.mesh_M, scene.swept_M).triangles, found) << "seed " << seed;
    EXPECT_TRUE(std::includes(found.begin(), found.end(), expected_[seed].begin(), expected_[seed].end()));
  }
}

TEST_F(BothContextsTest, AnswerInThreadsOfTheirOwn) {
  std::vector<int> right_here(4, 0);
  std::vector<std::thread> threads;
  for (size_t i = 0; i < right_here.size(); ++i) {
    threads.emplace_back([&, i] { right_here[i] = right(answersOf(*selectOn(offscreenContextNames()[i % 2]))); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right_here, std::vector<int>(4, 1));
}

TEST_F(BothContextsTest, AnswerAfterTheOtherCameAndWent) {
  const auto answers_around = [&](const std::string& name, const std::string& other) {
    const auto detector = selectOn(name);
    EXPECT_TRUE(right(answersOf(*detector))) << name;
    auto guest = selectOn(other);
    EXPECT_TRUE(right(answersOf(*detector))) << name << " beside " << other;
    EXPECT_TRUE(right(answersOf(*guest))) << other << " beside " << name;
    guest.reset();
    EXPECT_TRUE(right(answersOf(*detector))) << name << " after " << other;
  };
  answers_around("osmesa", "egl");
  answers_around("egl", "osmesa");
}

}  // namespace
}  // namespace sweep_guard_core
