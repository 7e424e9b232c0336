#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <utility>

#include "scene/planning_scene.h"

namespace sweep_guard_core {
namespace {

using Operation = CollisionObject::Operation;

// Reads what planning_scene_oracle.py prints. Throws at the end of the file.
class StepReader {
 public:
  explicit StepReader(const char* path) : file_(path) { file_.exceptions(std::ios::badbit | std::ios::failbit); }

  bool isAtEnd() { return (file_ >> std::ws).eof() || file_.peek() == std::ifstream::traits_type::eof(); }
  std::string word() {
    std::string word;
    file_ >> word;
    return word == "-" ? "" : word;
  }
  template <typename Number>
  Number number() {
    Number number{};
    file_ >> number;
    return number;
  }
  bool flag() { return number<int>() != 0; }
  // Reads their count and that many items.
  template <typename Read>
  auto list(Read read) {
    std::vector<decltype(read())> items;
    for (auto left = number<size_t>(); left > 0; --left) items.push_back(read());
    return items;
  }
  Eigen::Vector3d point() {
    Eigen::Vector3d point;
    file_ >> point.x() >> point.y() >> point.z();
    return point;
  }
  Triangle triangle() {
    Triangle triangle;
    file_ >> triangle[0] >> triangle[1] >> triangle[2];
    return triangle;
  }
  TriangleSurface surface() {
    auto vertices = list([this] { return point(); });
    return {std::move(vertices), list([this] { return triangle(); })};
  }
  // Returns the pose, and whether it is set.
  std::pair<Eigen::Isometry3d, bool> pose() {
    const Eigen::Translation3d position(point());
    Eigen::Quaterniond turn;
    file_ >> turn.x() >> turn.y() >> turn.z() >> turn.w();
    const bool is_set = turn.norm() > 0.0 || position.vector().norm() > 0.0;
    if (turn.norm() == 0.0) turn.setIdentity();
    return {position * turn.normalized(), is_set};
  }
  CollisionShapes shapes() {
    auto surfaces = list([this] { return surface(); });
    return {std::move(surfaces), list([this] { return pose().first; })};
  }
  CollisionObject object() {
    static const std::map<std::string, Operation> kOperations = {{"ADD", Operation::kAdd},
                                                                 {"REMOVE", Operation::kRemove},
                                                                 {"APPEND", Operation::kAppend},
                                                                 {"MOVE", Operation::kMove}};
    CollisionObject object;
    object.id = word();
    object.frame = word();
    object.operation = kOperations.at(word());
    for (const auto& [X_FO, is_set] : list([this] { return pose(); })) {
      object.X_FO = X_FO;
      object.is_pose_unset = !is_set;
    }
    object.shapes[0] = shapes();
    object.shapes[1] = shapes();
    return object;
  }
  AttachedObject attached() {
    std::string link = word();
    return {std::move(link), object()};
  }
  PlanningSceneMessage scene() {
    PlanningSceneMessage message;
    for (bool* field : {&message.is_diff, &message.is_state_diff, &message.names_joints}) *field = flag();
    message.attached = list([this] { return attached(); });
    message.objects = list([this] { return object(); });
    return message;
  }
  // Refused ones have no frame.
  SceneChange expected() {
    SceneChange expected;
    expected.object.id = word();
    expected.link = word();
    expected.object.frame = word();
    expected.object.surface_M = surface();
    return expected;
  }

 private:
  std::ifstream file_;
};

SceneUpdate applyNext(StepReader& reader, PlanningScene& scene) {
  const std::string type = reader.word();
  if (type == "await") return scene.awaitFullScene();
  if (type == "object") return scene.apply({true, true, false, {}, {reader.object()}});
  if (type == "attached") return scene.apply({true, true, false, {reader.attached()}, {}});
  if (type == "scene") return scene.apply(reader.scene());
  throw std::runtime_error("unknown step: " + type);
}

using Told = std::map<std::string, SceneChange>;

void followChanges(const SceneUpdate& update, Told& told) {
  for (const SceneChange& change : update.changes) {
    told.erase(change.object.id);
    const bool is_there = !change.refused.empty() || !change.object.surface_M.triangles.empty();
    if (is_there) told.emplace(change.object.id, change);
  }
}

void expectSame(const SceneChange& told, const SceneChange& expected) {
  const bool is_refused = expected.object.frame.empty();
  EXPECT_EQ(told.refused.empty(), !is_refused) << expected.object.id << ": " << told.refused;
  EXPECT_EQ(told.link, expected.link) << expected.object.id;
  EXPECT_EQ(told.object.frame, expected.object.frame) << expected.object.id;
  EXPECT_EQ(told.object.surface_M.triangles, expected.object.surface_M.triangles) << expected.object.id;
  const auto& vertices = told.object.surface_M.vertices;
  ASSERT_EQ(vertices.size(), expected.object.surface_M.vertices.size()) << expected.object.id;
  for (size_t i = 0; i < vertices.size(); ++i) {
    EXPECT_LE((vertices[i] - expected.object.surface_M.vertices[i]).norm(), 1e-9) << expected.object.id << ", " << i;
  }
}

void expectNext(StepReader& reader, const SceneUpdate& update, const Told& told) {
  ASSERT_EQ(reader.word(), "expect");
  EXPECT_EQ(update.needs_full_scene, reader.flag());
  const std::vector<SceneChange> expected = reader.list([&reader] { return reader.expected(); });
  EXPECT_EQ(told.size(), expected.size());
  for (const SceneChange& change : expected) {
    const auto found = told.find(change.object.id);
    ASSERT_NE(found, told.end()) << change.object.id;
    expectSame(found->second, change);
  }
}

// A copy that begins to await the full scene tells all that it holds.
void expectHeld(PlanningScene scene, const Told& told) {
  std::map<std::string, std::string> held;
  for (const SceneChange& change : scene.awaitFullScene().changes) held[change.object.id] = change.link;
  for (const auto& [id, link] : held) {
    const auto found = told.find(id);
    ASSERT_NE(found, told.end()) << id;
    EXPECT_EQ(link, found->second.link) << id;
  }
  for (const auto& [id, change] : told) EXPECT_TRUE(!change.refused.empty() || held.count(id) == 1) << id;
}

TEST(PlanningSceneRandomTest, HoldsAndTellsWhatTheOracleHolds) {
  const char* const path = std::getenv("SWEEP_GUARD_SCENE_STEPS");
  if (path == nullptr)
    GTEST_SKIP() << "planning_scene_random.sh runs it, on the steps of its oracle (SWEEP_GUARD_SCENE_STEPS)";
  StepReader reader(path);
  PlanningScene scene(/*awaits_full_scene=*/true);
  Told told;
  int step = 0;
  for (; !reader.isAtEnd() && !HasFailure(); ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    const SceneUpdate update = applyNext(reader, scene);
    followChanges(update, told);
    expectNext(reader, update, told);
    expectHeld(scene, told);
  }
  EXPECT_GE(step, 1000);
}

}  // namespace
}  // namespace sweep_guard_core
