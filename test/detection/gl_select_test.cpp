#include "detection/gl_select.h"

#include <GL/gl.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <thread>

#include "detection/every_context.h"
#include "detection/faulty_context.h"
#include "refusal.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

using Names = std::vector<std::uint32_t>;
using Replacements = FaultyContext::Replacements;

template <typename Function>
OffscreenContext::Function erased(Function* function) {
  return reinterpret_cast<OffscreenContext::Function>(function);
}

std::string tested;  // the context's name

// One that replacements take their originals from. Every context of one kind has the same.
OffscreenContext& sound() {
  static std::map<std::string, std::unique_ptr<OffscreenContext>> contexts;
  std::unique_ptr<OffscreenContext>& context = contexts[tested];
  if (!context) context = makeOffscreenContext(tested);
  return *context;
}

template <typename Function>
Function* original(const char* name) {
  return reinterpret_cast<Function*>(sound().function(name));
}

GLint GLAPIENTRY seeNothing(GLenum mode) {
  original<decltype(::glRenderMode)>("glRenderMode")(mode);
  return 0;
}

GLint GLAPIENTRY overflowForEver(GLenum mode) {
  original<decltype(::glRenderMode)>("glRenderMode")(mode);
  return -1;
}

GLuint* selection = nullptr;

void GLAPIENTRY rememberBuffer(GLsizei size, GLuint* buffer) {
  selection = buffer;
  original<decltype(::glSelectBuffer)>("glSelectBuffer")(size, buffer);
}

GLint GLAPIENTRY misnameTheLastHit(GLenum mode) {
  const GLint records = original<decltype(::glRenderMode)>("glRenderMode")(mode);
  if (records > 0) selection[4 * records - 1] = 0xFFFFFFFFU;
  return records;
}

GLint GLAPIENTRY forgetTheNameOfTheLastHit(GLenum mode) {
  const GLint records = original<decltype(::glRenderMode)>("glRenderMode")(mode);
  if (records > 0) selection[4 * records - 4] = 0;
  return records;
}

// Triangles in a row along x, each 0.01 large; the canary at the center of the cube.
class Row {
 public:
  explicit Row(const std::vector<float>& places) {
    for (const float x : places) {
      corners_.insert(corners_.end(), {x, 0.0F, 0.0F, x + 0.01F, 0.0F, 0.0F, x, 0.01F, 0.0F});
    }
  }

  GlSelect::Query query(int triangles_per_name = 1) const { return {corners_, triangles_per_name, clips, canary}; }

  std::vector<Eigen::Vector4d> clips;
  Eigen::Vector3d canary = Eigen::Vector3d::Zero();

 private:
  std::vector<float> corners_;
};

const Row kRow({-2.0F, -0.5F, 0.0F, 0.5F, 2.0F, 0.9F});

GlSelect faulty(const Replacements& replacements) {
  return GlSelect(std::make_unique<FaultyContext>(makeOffscreenContext(tested), replacements));
}

std::string complaint(const Replacements& replacements) {
  GlSelect select = faulty(replacements);
  return ::refusal<DeviceError>([&] { select.hits(kRow.query()); });
}

Names hits(const Row& row, int triangles_per_name = 1) {
  return GlSelect(makeOffscreenContext(tested)).hits(row.query(triangles_per_name));
}

class GlSelectTest : public OnEveryContext {
 protected:
  void SetUp() override {
    OnEveryContext::SetUp();
    if (IsSkipped()) return;
    tested = GetParam();
    sound();  // to make it while another is current would take that away
  }
};

TEST_P(GlSelectTest, NamesTheTrianglesInTheCube) { EXPECT_EQ(hits(kRow), (Names{1, 2, 3, 5})); }

TEST_P(GlSelectTest, NamesBlocksOfTriangles) {
  EXPECT_EQ(hits(kRow, 2), (Names{0, 1, 2}));
  EXPECT_EQ(hits(kRow, 4), (Names{0, 1}));  // the last block is short
  EXPECT_EQ(hits(kRow, 100), (Names{0}));
  EXPECT_EQ(hits(Row({2.0F, 3.0F, 0.0F}), 2), (Names{1}));
}

TEST_P(GlSelectTest, NamesNothingWhereThereIsNothing) {
  EXPECT_EQ(hits(Row({2.0F, -3.0F})), Names{});
  EXPECT_EQ(hits(Row(std::vector<float>{})), Names{});
}

TEST_P(GlSelectTest, KeepsWhatIsOnThePositiveSideOfEachClip) {
  Row row = kRow;
  row.clips = {{1, 0, 0, 0.25}, {-1, 0, 0, 0.75}};  // x >= -0.25, x <= 0.75
  EXPECT_EQ(hits(row), (Names{2, 3}));
}

TEST_P(GlSelectTest, AppliesSixClips) {
  Row row = kRow;
  row.clips.assign(5, {0, 0, 0, 1});
  row.clips.emplace_back(1, 0, 0, -0.25);
  row.canary = {0.3, 0, 0};
  EXPECT_EQ(hits(row), (Names{3, 5}));
}

TEST_P(GlSelectTest, ForgetsTheClipsOfTheQueryBefore) {
  Row clipped = kRow;
  clipped.clips = {{1, 0, 0, 0.25}};
  GlSelect select(makeOffscreenContext(tested));
  EXPECT_EQ(select.hits(clipped.query()), (Names{2, 3, 5}));
  EXPECT_EQ(select.hits(kRow.query()), (Names{1, 2, 3, 5}));
}

// Touching is meeting. 2e-7 further out is not: so the cube is where it should be.
TEST_P(GlSelectTest, HitsWhatTouchesTheCube) { EXPECT_EQ(hits(Row({1.0F, 1.0000002F})), (Names{0})); }

TEST_P(GlSelectTest, HitsBothWindingsAndDegenerateTriangles) {
  const std::vector<float> corners = {0,  0,  0,    0,    0.1F, 0,    0.1F, 0,    0,      // clockwise
                                      0,  0,  0,    0.1F, 0,    0,    0,    0.1F, 0,      // counter-clockwise
                                      0,  0,  0,    0,    0,    0,    0,    0,    0,      // a point
                                      0,  0,  0,    0,    0,    0.5F, 0,    0,    0.5F,   // a segment, seen end on
                                      -9, -9, 0.5F, 9,    -9,   0.5F, 0,    9,    0.5F,   // encloses the cube
                                      -9, -9, 1.0F, 9,    -9,   1.0F, 0,    9,    1.0F};  // in the plane of a face
  const Eigen::Vector3d canary = Eigen::Vector3d::Zero();
  GlSelect select(makeOffscreenContext(tested));
  EXPECT_EQ(select.hits({corners, 1, {}, canary}), (Names{0, 1, 2, 3, 4, 5}));
}

TEST_P(GlSelectTest, GrowsABufferThatIsTooSmall) {
  GlSelect select(makeOffscreenContext(tested), /*hit_records=*/1);
  EXPECT_EQ(select.hits(kRow.query()), (Names{1, 2, 3, 5}));
  EXPECT_EQ(select.hits(kRow.query()), (Names{1, 2, 3, 5}));
}

// Someone else draws in the same thread between two queries.
TEST_P(GlSelectTest, SetsTheWholeStateForEveryQuery) {
  auto context = makeOffscreenContext(tested);
  OffscreenContext& shared = *context;
  GlSelect select(std::move(context));
  ASSERT_EQ(select.hits(kRow.query()), (Names{1, 2, 3, 5}));

  shared.makeCurrent();
  original<decltype(::glEnable)>("glEnable")(GL_CULL_FACE);
  original<decltype(::glCullFace)>("glCullFace")(GL_FRONT_AND_BACK);
  original<decltype(::glMatrixMode)>("glMatrixMode")(GL_PROJECTION);
  original<decltype(::glScalef)>("glScalef")(100.0F, 100.0F, 100.0F);
  original<decltype(::glEnable)>("glEnable")(GL_CLIP_PLANE5);
  original<decltype(::glDisableClientState)>("glDisableClientState")(GL_VERTEX_ARRAY);
  original<decltype(::glPolygonMode)>("glPolygonMode")(GL_FRONT_AND_BACK, GL_POINT);
  EXPECT_EQ(select.hits(kRow.query()), (Names{1, 2, 3, 5}));
}

TEST_P(GlSelectTest, MakesItsContextCurrentForEveryQuery) {
  GlSelect first(makeOffscreenContext(tested));
  GlSelect second(makeOffscreenContext(tested));
  EXPECT_EQ(first.hits(kRow.query()), (Names{1, 2, 3, 5}));
  EXPECT_EQ(second.hits(Row({0.0F}).query()), (Names{0}));
  EXPECT_EQ(first.hits(kRow.query()), (Names{1, 2, 3, 5}));
}

// Without a current context OpenGL sees nothing and reports no error.
TEST_P(GlSelectTest, MakesItsContextCurrentInTheThreadThatAsks) {
  GlSelect select(makeOffscreenContext(tested));
  Names hits;
  std::thread([&] { EXPECT_NO_THROW(hits = select.hits(kRow.query())); }).join();
  EXPECT_EQ(hits, (Names{1, 2, 3, 5}));
}

TEST_P(GlSelectTest, DoesNotTakeSilenceForAnAnswer) {
  EXPECT_TRUE(has(complaint({{"glRenderMode", erased(seeNothing)}}), "canary"));
}

TEST_P(GlSelectTest, DoesNotTrustACanaryThatIsOutside) {
  Row row = kRow;
  row.canary = {0, 0, 1.5};
  GlSelect select(makeOffscreenContext(tested));
  EXPECT_THROW(select.hits(row.query()), DeviceError);
}

TEST_P(GlSelectTest, DoesNotAnswerAfterAnError) {
  EXPECT_TRUE(has(complaint({{"glGetError", erased(reportAnError)}}), "error 1282"));  // GL_INVALID_OPERATION
}

TEST_P(GlSelectTest, DoesNotGrowItsBufferForEver) {
  EXPECT_TRUE(has(complaint({{"glRenderMode", erased(overflowForEver)}}), "overflows"));
}

TEST_P(GlSelectTest, DoesNotTrustAHitUnderAnUnknownName) {
  for (const auto spoil : {misnameTheLastHit, forgetTheNameOfTheLastHit}) {
    const Replacements replacements = {{"glSelectBuffer", erased(rememberBuffer)}, {"glRenderMode", erased(spoil)}};
    EXPECT_TRUE(has(complaint(replacements), "unknown name"));
  }
}

// A vertex that is no number makes OpenGL leave out its triangle. The canary shows that the others are still seen.
TEST_P(GlSelectTest, SeesTheOthersBesideAVertexThatIsNoNumber) {
  std::vector<float> corners = {0, 0, 0, 0.1F, 0, 0, 0, 0.1F, 0, 0, 0, 0, 0.1F, 0, 0, 0, 0.1F, 0};
  corners[4] = std::numeric_limits<float>::quiet_NaN();
  const Eigen::Vector3d canary = Eigen::Vector3d::Zero();
  GlSelect select(makeOffscreenContext(tested));
  const Names hits = select.hits({corners, 1, {}, canary});
  EXPECT_FALSE(hits.empty());
  EXPECT_EQ(hits.back(), 1U);
}

TEST_P(GlSelectTest, NamesTheFunctionThatIsMissing) {
  EXPECT_TRUE(has(refusal<DeviceError>([] { faulty({{"glInitNames", nullptr}}); }), "glInitNames"));
}

TEST_P(GlSelectTest, PassesOnThatAContextCannotBeMadeCurrent) {
  auto context = std::make_unique<FaultyContext>(makeOffscreenContext(tested), Replacements{});
  FaultyContext& faulty_context = *context;
  GlSelect select(std::move(context));
  faulty_context.refuses = true;
  EXPECT_THROW(select.hits(kRow.query()), DeviceError);
  faulty_context.refuses = false;
  EXPECT_EQ(select.hits(kRow.query()), (Names{1, 2, 3, 5}));
}

INSTANTIATE_ON_EVERY_CONTEXT(GlSelectTest);

}  // namespace
}  // namespace sweep_guard_core
