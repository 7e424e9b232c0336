#include "scene/planning_scene.h"

#include <gtest/gtest.h>

#include <utility>

#include "refusal.h"

namespace sweep_guard_core {
namespace {

class PlanningSceneTest : public testing::Test {
 protected:
  using Operation = CollisionObject::Operation;
  using Point = Eigen::Vector3d;
  using Points = std::vector<Point>;
  using Pose = Eigen::Isometry3d;

  static Pose at(double x, double y = 0.0, double z = 0.0) { return Pose(Eigen::Translation3d(x, y, z)); }

  // A quarter turn around z.
  static Pose turned() {
    Pose X = Pose::Identity();
    X.linear() << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
    return X;
  }

  // Its first vertex is the origin of its frame.
  static TriangleSurface triangle() { return {{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)}, {{0, 1, 2}}}; }

  static CollisionObject message(Operation operation, const std::string& id, const Pose& X_FO = Pose::Identity()) {
    CollisionObject object;
    object.id = id;
    object.frame = "world";
    object.operation = operation;
    object.X_FO = X_FO;
    return object;
  }

  // An object of triangles at these poses, as meshes.
  static CollisionObject add(const std::string& id, const Pose& X_FO,
                             const std::vector<Pose>& X_OS = {Pose::Identity()}) {
    CollisionObject object = message(Operation::kAdd, id, X_FO);
    object.shapes[1] = {std::vector<TriangleSurface>(X_OS.size(), triangle()), X_OS};
    return object;
  }

  static CollisionObject add(const std::string& id) { return add(id, Pose::Identity()); }

  static CollisionObject with(CollisionObject object, Operation operation) {
    object.operation = operation;
    return object;
  }

  static CollisionObject append(const std::string& id, const Pose& X_FO,
                                const std::vector<Pose>& X_OS = {Pose::Identity()}) {
    return with(add(id, X_FO, X_OS), Operation::kAppend);
  }

  static CollisionObject move(const std::string& id, const Pose& X_FO, const std::vector<Pose>& X_OS = {}) {
    CollisionObject object = message(Operation::kMove, id, X_FO);
    object.shapes[1].X_OS = X_OS;
    return object;
  }

  static CollisionObject remove(const std::string& id) { return message(Operation::kRemove, id); }

  static CollisionObject inFrame(const std::string& frame, CollisionObject object) {
    object.frame = frame;
    return object;
  }

  static CollisionObject withoutPose(CollisionObject object) {
    object.X_FO = Pose::Identity();
    object.is_pose_unset = true;
    return object;
  }

  // As MoveIt sent it before 1.1.
  static CollisionObject old(CollisionObject object) {
    object.X_FO.reset();
    return object;
  }

  static PlanningSceneMessage diff(std::vector<CollisionObject> objects, std::vector<AttachedObject> attached = {}) {
    return {true, true, false, std::move(attached), std::move(objects)};
  }

  static PlanningSceneMessage full(std::vector<CollisionObject> objects, std::vector<AttachedObject> attached = {}) {
    return {false, false, true, std::move(attached), std::move(objects)};
  }

  static SceneChange only(const SceneUpdate& update) {
    EXPECT_EQ(update.changes.size(), 1U);
    return update.changes.empty() ? SceneChange() : update.changes.front();
  }

  static bool isRemoved(const SceneChange& change) {
    return change.refused.empty() && change.object.surface_M.triangles.empty();
  }

  // The origins of the triangles of an object.
  static std::vector<Point> origins(const SceneChange& change) {
    EXPECT_EQ(change.refused, "");
    std::vector<Point> points;
    for (const Triangle& triangle : change.object.surface_M.triangles) {
      points.push_back(change.object.surface_M.vertices.at(triangle[0]));
    }
    return points;
  }

  SceneUpdate update(PlanningSceneMessage message) { return scene_.apply(std::move(message)); }
  SceneUpdate update(const CollisionObject& object) { return update(diff({object})); }
  SceneUpdate update(const AttachedObject& attached) { return update(diff({}, {attached})); }
  template <typename Message>
  SceneChange apply(const Message& message) {
    return only(update(message));
  }
  template <typename Message>
  std::string refused(const Message& message) {
    return apply(message).refused;
  }

  PlanningScene scene_{/*awaits_full_scene=*/false};
};

TEST_F(PlanningSceneTest, ShapesAreAtThePoseOfTheObjectTimesTheirs) {
  const SceneChange change = apply(add("table", at(1) * turned(), {at(2), at(3)}));
  EXPECT_EQ(change.object.id, "table");
  EXPECT_EQ(change.object.frame, "world");
  EXPECT_EQ(origins(change), (Points{Point(1, 2, 0), Point(1, 3, 0)}));
  EXPECT_EQ(change.object.surface_M.vertices.at(1), Point(1, 3, 0));
}

TEST_F(PlanningSceneTest, ShapesOfAllKindsAreOneSurface) {
  CollisionObject object = message(Operation::kAdd, "table");
  object.shapes[2] = {{triangle()}, {at(3)}};
  object.shapes[0] = {{triangle()}, {at(1)}};
  object.shapes[1] = {{triangle()}, {at(2)}};
  EXPECT_EQ(origins(apply(object)), (Points{Point(1, 0, 0), Point(2, 0, 0), Point(3, 0, 0)}));
}

TEST_F(PlanningSceneTest, TheStampIsThatOfTheNewestMessage) {
  int stamp = 5;
  for (CollisionObject object : {add("table"), move("table", at(1)), append("table", at(1))}) {
    object.stamp = Time(Duration(++stamp));
    EXPECT_EQ(apply(object).object.stamp, Time(Duration(stamp)));
  }
}

TEST_F(PlanningSceneTest, AddReplaces) {
  update(add("table", at(1), {Pose::Identity(), Pose::Identity()}));
  const SceneChange change = apply(inFrame("base", add("table", at(2))));
  EXPECT_EQ(change.object.frame, "base");
  EXPECT_EQ(origins(change), (Points{Point(2, 0, 0)}));
}

TEST_F(PlanningSceneTest, AddWithoutShapesIsRefusedAndChangesNothing) {
  EXPECT_EQ(refused(add("table", at(1), {})), "it has no shapes");
  update(add("table", at(2)));
  EXPECT_EQ(refused(add("table", at(3), {})), "it has no shapes");
  EXPECT_EQ(origins(apply(append("table", Pose::Identity(), {at(1)}))), (Points{Point(2, 0, 0), Point(3, 0, 0)}));
}

TEST_F(PlanningSceneTest, ShapesWithoutTrianglesAreNone) {
  CollisionObject object = message(Operation::kAdd, "table");
  object.shapes[1] = {{TriangleSurface()}, {Pose::Identity()}};
  EXPECT_EQ(refused(object), "it has no shapes");
}

TEST_F(PlanningSceneTest, ShapesWithoutPosesAreAtThatOfTheObject) {
  CollisionObject object = add("table", at(1), {at(1), at(2)});
  object.shapes[1].X_OS.pop_back();
  EXPECT_EQ(origins(apply(object)), (Points{Point(2, 0, 0), Point(1, 0, 0)}));
}

// MoveIt removes the old object before it finds that the new one is wrong.
TEST_F(PlanningSceneTest, MorePosesThanShapesAreRefused) {
  update(add("table"));
  CollisionObject object = add("table");
  object.shapes[0].X_OS = {Pose::Identity()};
  EXPECT_EQ(refused(object), "it has more poses than shapes");
  EXPECT_TRUE(has(refused(move("table", Pose::Identity())), "not in the planning scene"));
}

TEST_F(PlanningSceneTest, ThePoseOfASingleShapeBecomesThatOfAnObjectWithoutPose) {
  EXPECT_EQ(origins(apply(withoutPose(add("table", Pose::Identity(), {at(1)})))), (Points{Point(1, 0, 0)}));
  EXPECT_EQ(origins(apply(move("table", at(5)))), (Points{Point(5, 0, 0)}));
}

TEST_F(PlanningSceneTest, ThePosesOfSeveralShapesStayInAnObjectWithoutPose) {
  update(withoutPose(add("table", Pose::Identity(), {at(1), at(2)})));
  EXPECT_EQ(origins(apply(move("table", at(5)))), (Points{Point(6, 0, 0), Point(7, 0, 0)}));
}

TEST_F(PlanningSceneTest, AnIdentityIsAPose) {
  update(add("table", Pose::Identity(), {at(1)}));
  EXPECT_EQ(origins(apply(move("table", at(5)))), (Points{Point(6, 0, 0)}));
}

TEST_F(PlanningSceneTest, AppendKeepsFrameAndPoseOfTheObject) {
  update(add("table", at(1)));
  const SceneChange change = apply(inFrame("base", append("table", at(7), {at(2)})));
  EXPECT_EQ(change.object.frame, "world");
  EXPECT_EQ(origins(change), (Points{Point(1, 0, 0), Point(3, 0, 0)}));
}

// The pose of the shape becomes that of the object, which APPEND ignores.
TEST_F(PlanningSceneTest, AppendOfASingleShapeWithoutPoseOfTheObjectIgnoresThatOfTheShape) {
  update(add("table", at(1)));
  EXPECT_EQ(origins(apply(withoutPose(append("table", Pose::Identity(), {at(2)})))),
            (Points{Point(1, 0, 0), Point(1, 0, 0)}));
}

TEST_F(PlanningSceneTest, AppendMakesAnObjectAndAsksWhetherItIsWhole) {
  const SceneUpdate told = update(append("table", at(1)));
  EXPECT_TRUE(told.needs_full_scene);
  EXPECT_EQ(origins(only(told)), (Points{Point(1, 0, 0)}));
  EXPECT_FALSE(update(append("table", at(1))).needs_full_scene);
}

TEST_F(PlanningSceneTest, AppendWithMorePosesThanShapesIsRefusedAndChangesNothing) {
  update(add("table"));
  CollisionObject object = append("table", Pose::Identity());
  object.shapes[0].X_OS = {Pose::Identity()};
  EXPECT_EQ(refused(object), "it has more poses than shapes");
  EXPECT_EQ(origins(apply(move("table", at(1)))), (Points{Point(1, 0, 0)}));
}

TEST_F(PlanningSceneTest, MoveSetsFrameAndPoseAndKeepsVerticesAndTrianglesInTheirOrder) {
  const SceneChange before = apply(add("table", at(1), {at(1), at(2)}));
  const SceneChange after = apply(inFrame("base", move("table", at(10))));
  EXPECT_EQ(after.object.frame, "base");
  EXPECT_EQ(origins(after), (Points{Point(11, 0, 0), Point(12, 0, 0)}));
  EXPECT_EQ(after.object.surface_M.triangles, before.object.surface_M.triangles);
}

TEST_F(PlanningSceneTest, MoveIgnoresGeometry) {
  update(add("table", at(1)));
  CollisionObject object = move("table", at(2));
  object.shapes[0].surfaces_S = {triangle(), triangle()};
  EXPECT_EQ(origins(apply(object)), (Points{Point(2, 0, 0)}));
}

TEST_F(PlanningSceneTest, MoveWithoutPoseIsToTheOriginOfTheFrame) {
  update(add("table", at(1)));
  EXPECT_EQ(origins(apply(withoutPose(move("table", Pose::Identity())))), (Points{Point(0, 0, 0)}));
}

TEST_F(PlanningSceneTest, MoveTakesPosesOfAllShapes) {
  update(add("table", at(1), {at(1), at(2)}));
  CollisionObject object = move("table", at(10), {at(4)});
  object.shapes[0].X_OS = {at(3)};
  EXPECT_EQ(origins(apply(object)), (Points{Point(13, 0, 0), Point(14, 0, 0)}));
}

// MoveIt moves the object before it finds that the poses of the shapes are too few.
TEST_F(PlanningSceneTest, MoveWithPosesOfSomeShapesIsRefused) {
  update(add("table", at(1), {at(1), at(2)}));
  EXPECT_EQ(refused(move("table", at(10), {at(3)})), "MOVE with 1 poses of 2 shapes");
  EXPECT_EQ(origins(apply(append("table", Pose::Identity()))).front(), Point(11, 0, 0));
}

TEST_F(PlanningSceneTest, MoveOfAnUnknownObjectIsRefusedAndAsksForTheFullScene) {
  const SceneUpdate told = update(move("table", at(1)));
  EXPECT_TRUE(told.needs_full_scene);
  EXPECT_TRUE(has(only(told).refused, "not in the planning scene"));
  EXPECT_FALSE(update(add("table")).needs_full_scene);
}

TEST_F(PlanningSceneTest, RemoveRemoves) {
  update(add("table"));
  const SceneChange change = apply(remove("table"));
  EXPECT_EQ(change.object.id, "table");
  EXPECT_TRUE(isRemoved(change));
  EXPECT_TRUE(has(refused(move("table", at(1))), "not in the planning scene"));
}

TEST_F(PlanningSceneTest, RemoveWithoutIdRemovesAllOfTheWorldAndWhatWasRefused) {
  update(add("chair"));
  update(add("table", at(1), {}));
  update(AttachedObject{"hand", add("tool")});
  const SceneUpdate told = update(remove(""));
  ASSERT_EQ(told.changes.size(), 2U);
  for (const SceneChange& change : told.changes) EXPECT_TRUE(isRemoved(change)) << change.object.id;
}

TEST_F(PlanningSceneTest, AMessageThatCannotBeReadIsRefusedInItsWords) {
  update(add("table"));
  for (const Operation operation : {Operation::kAdd, Operation::kAppend, Operation::kMove}) {
    CollisionObject object = with(add("table"), operation);
    object.problem = "radius -1";
    EXPECT_EQ(refused(object), "radius -1");
    EXPECT_EQ(refused(AttachedObject{"hand", object}), "radius -1");
  }
  CollisionObject gone = remove("table");
  gone.problem = "radius -1";
  EXPECT_TRUE(isRemoved(apply(gone)));
}

TEST_F(PlanningSceneTest, AnOldMessageHasThePosesOfShapesInItsFrame) {
  EXPECT_EQ(origins(apply(old(add("table", at(9), {at(1)})))), (Points{Point(1, 0, 0)}));
  EXPECT_EQ(origins(apply(old(add("table", at(9), {at(1), at(2)})))), (Points{Point(1, 0, 0), Point(2, 0, 0)}));
}

TEST_F(PlanningSceneTest, AnOldMessageNeedsOnePoseForEachShape) {
  CollisionObject object = add("table");
  object.shapes[1].X_OS.clear();
  EXPECT_EQ(refused(old(object)), "it has not one pose for each shape");
  object.shapes[1].X_OS = {Pose::Identity(), Pose::Identity()};
  EXPECT_EQ(refused(old(object)), "it has not one pose for each shape");
}

TEST_F(PlanningSceneTest, AnOldAppendHasPosesInTheFrameOfTheObject) {
  update(old(add("table", Pose::Identity(), {at(1)})));
  EXPECT_EQ(origins(apply(old(append("table", Pose::Identity(), {at(2)})))), (Points{Point(1, 0, 0), Point(2, 0, 0)}));
  EXPECT_TRUE(has(refused(inFrame("base", old(append("table", Pose::Identity(), {at(2)})))), "another frame"));
}

TEST_F(PlanningSceneTest, AnOldMoveHasPosesOfAllShapes) {
  update(old(add("table", Pose::Identity(), {at(1), at(2)})));
  const SceneChange moved = apply(inFrame("base", old(move("table", Pose::Identity(), {at(3), at(4)}))));
  EXPECT_EQ(moved.object.frame, "base");
  EXPECT_EQ(origins(moved), (Points{Point(3, 0, 0), Point(4, 0, 0)}));
  EXPECT_EQ(refused(old(move("table", Pose::Identity(), {}))), "MOVE with 0 poses of 2 shapes");
  EXPECT_EQ(origins(apply(inFrame("base", old(append("table", Pose::Identity(), {at(5)}))))).front(), Point(3, 0, 0));
}

TEST_F(PlanningSceneTest, WhatIsRefusedIsGivenAgainByTheNextMessageThatCanBeFollowed) {
  update(add("table", at(1)));
  update(add("table", at(2), {}));
  EXPECT_EQ(origins(apply(move("table", at(3)))), (Points{Point(3, 0, 0)}));
}

TEST_F(PlanningSceneTest, ADiffChangesWhatItNames) {
  update(full({add("chair"), add("table")}));
  const SceneUpdate told = update(diff({add("lamp", at(1)), move("table", at(2)), move("lamp", at(3))}));
  ASSERT_EQ(told.changes.size(), 2U);
  EXPECT_EQ(told.changes[0].object.id, "lamp");
  EXPECT_EQ(origins(told.changes[0]), (Points{Point(3, 0, 0)}));
  EXPECT_EQ(origins(told.changes[1]), (Points{Point(2, 0, 0)}));
  EXPECT_FALSE(told.needs_full_scene);
}

TEST_F(PlanningSceneTest, AFullSceneRemovesWhatItDoesNotName) {
  update(diff({add("chair"), add("table"), move("lamp", at(1))}));
  const SceneUpdate told = update(full({add("table", at(1))}));
  ASSERT_EQ(told.changes.size(), 3U);
  EXPECT_TRUE(isRemoved(told.changes[0]));
  EXPECT_TRUE(isRemoved(told.changes[1])) << "what was refused is no more, too";
  EXPECT_EQ(origins(told.changes[2]), (Points{Point(1, 0, 0)}));
}

TEST_F(PlanningSceneTest, ADiffBeforeTheFullSceneIsRefusedAndAsksForIt) {
  PlanningScene scene(/*awaits_full_scene=*/true);
  const SceneUpdate told = scene.apply(diff({add("table")}));
  EXPECT_TRUE(told.needs_full_scene);
  EXPECT_EQ(only(told).refused, "the whole planning scene is not known");
  EXPECT_TRUE(scene.apply(diff({})).needs_full_scene);
  EXPECT_FALSE(scene.apply(full({})).needs_full_scene);
}

TEST_F(PlanningSceneTest, ObjectsAreRefusedWhileTheFullSceneIsAwaited) {
  update(full({add("table")}, {{"hand", add("tool")}}));
  const SceneUpdate told = scene_.awaitFullScene();
  ASSERT_EQ(told.changes.size(), 2U);
  for (const SceneChange& change : told.changes) EXPECT_TRUE(has(change.refused, "is not known"));
  const SceneUpdate known = update(full({add("table", at(1))}, {{"hand", add("tool")}}));
  for (const SceneChange& change : known.changes) EXPECT_EQ(change.refused, "");
}

TEST_F(PlanningSceneTest, WhatStaysAttachedIsGivenAgainWithTheFullScene) {
  update(AttachedObject{"hand", add("tool")});
  scene_.awaitFullScene();
  PlanningSceneMessage message = full({});
  message.is_state_diff = true;
  EXPECT_EQ(refused(message), "");
}

TEST_F(PlanningSceneTest, WhatIsAttachedWithoutShapesIsTakenFromTheWorld) {
  update(add("tool", at(1)));
  const SceneChange change = apply(AttachedObject{"hand", message(Operation::kAdd, "tool")});
  EXPECT_EQ(change.link, "hand");
  EXPECT_EQ(origins(change), (Points{Point(1, 0, 0)}));
  EXPECT_TRUE(has(refused(move("tool", at(2))), "not in the planning scene"));
}

TEST_F(PlanningSceneTest, WhatIsAttachedWithShapesIsAsTheMessageSays) {
  update(add("tool", at(1)));
  const SceneChange change = apply(AttachedObject{"hand", inFrame("hand", add("tool", at(2)))});
  EXPECT_EQ(change.link, "hand");
  EXPECT_EQ(change.object.frame, "hand");
  EXPECT_EQ(origins(change), (Points{Point(2, 0, 0)}));
}

TEST_F(PlanningSceneTest, AnAttachedObjectCanBeAttachedElsewhere) {
  update(AttachedObject{"hand", add("tool", at(1))});
  const SceneChange change = apply(AttachedObject{"arm", add("tool", at(2))});
  EXPECT_EQ(change.link, "arm");
  EXPECT_EQ(origins(change), (Points{Point(2, 0, 0)}));
}

TEST_F(PlanningSceneTest, WhatIsNeitherInTheWorldNorHasShapesCannotBeAttached) {
  const SceneUpdate told = update(AttachedObject{"hand", message(Operation::kAdd, "tool")});
  EXPECT_TRUE(has(only(told).refused, "without shapes"));
  EXPECT_TRUE(told.needs_full_scene);
}

TEST_F(PlanningSceneTest, NothingIsAttachedToALinkWithoutName) {
  update(add("tool"));
  EXPECT_TRUE(has(refused(AttachedObject{"", add("tool")}), "link without name"));
}

TEST_F(PlanningSceneTest, AnAttachedObjectWithMorePosesThanShapesIsRefusedAndStaysInTheWorld) {
  update(add("tool", at(1)));
  CollisionObject object = add("tool", at(2));
  object.shapes[0].X_OS = {Pose::Identity()};
  EXPECT_EQ(refused(AttachedObject{"hand", object}), "it has more poses than shapes");
  EXPECT_EQ(origins(apply(append("tool", Pose::Identity()))).front(), Point(1, 0, 0));
}

TEST_F(PlanningSceneTest, AppendAttachesWithoutWhatTheWorldHas) {
  update(add("tool", at(1)));
  const SceneChange change = apply(AttachedObject{"hand", append("tool", at(2))});
  EXPECT_EQ(change.link, "hand");
  EXPECT_EQ(origins(change), (Points{Point(2, 0, 0)}));
}

TEST_F(PlanningSceneTest, AppendWithoutShapesAttachesNothing) {
  update(add("tool", at(1)));
  EXPECT_TRUE(has(refused(AttachedObject{"hand", append("tool", at(2), {})}), "without shapes"));
  EXPECT_EQ(origins(apply(move("tool", at(3)))).front(), Point(3, 0, 0));
}

TEST_F(PlanningSceneTest, AppendToAnAttachedObjectIsRefusedAndAsksForTheFullScene) {
  update(AttachedObject{"hand", add("tool")});
  const SceneUpdate told = update(AttachedObject{"hand", append("tool", at(2))});
  EXPECT_TRUE(has(only(told).refused, "APPEND to an attached object"));
  EXPECT_TRUE(told.needs_full_scene);
}

TEST_F(PlanningSceneTest, MoveOfAnAttachedObjectIsRefused) {
  update(AttachedObject{"hand", add("tool")});
  EXPECT_TRUE(has(refused(AttachedObject{"hand", move("tool", at(1))}), "MOVE of an attached object"));
}

TEST_F(PlanningSceneTest, ADetachedObjectIsRefusedUntilItsPlaceIsKnown) {
  update(add("tool", at(1)));
  update(AttachedObject{"hand", message(Operation::kAdd, "tool")});
  const SceneUpdate told = update(AttachedObject{"", remove("tool")});
  EXPECT_TRUE(has(only(told).refused, "detached"));
  EXPECT_EQ(only(told).link, "");
  EXPECT_TRUE(told.needs_full_scene);
  EXPECT_TRUE(has(refused(append("tool", at(5))), "detached"));
  EXPECT_EQ(origins(apply(move("tool", at(7)))).front(), Point(7, 0, 0));
}

// So it is published by move_group.
TEST_F(PlanningSceneTest, ADetachedObjectThatTheSameDiffPlacesIsGiven) {
  update(full({}, {{"hand", add("tool")}}));
  const SceneUpdate told = update(diff({add("tool", at(3))}, {{"", remove("tool")}}));
  EXPECT_EQ(origins(only(told)), (Points{Point(3, 0, 0)}));
  EXPECT_EQ(only(told).link, "");
  EXPECT_FALSE(told.needs_full_scene);
}

TEST_F(PlanningSceneTest, ADetachedObjectOfUnknownPlaceHasNoneAfterItIsAttachedAgain) {
  update(AttachedObject{"hand", add("tool")});
  update(AttachedObject{"", remove("tool")});
  EXPECT_TRUE(has(refused(AttachedObject{"arm", message(Operation::kAdd, "tool")}), "detached"));
}

TEST_F(PlanningSceneTest, DetachWithoutIdIsOfAllAtTheLink) {
  update(full({}, {{"hand", add("a")}, {"arm", add("b")}, {"hand", add("c")}}));
  const SceneUpdate told = update(AttachedObject{"hand", remove("")});
  ASSERT_EQ(told.changes.size(), 2U);
  EXPECT_EQ(told.changes[0].object.id, "a");
  EXPECT_EQ(told.changes[1].object.id, "c");
  EXPECT_EQ(only(update(AttachedObject{"", remove("")})).object.id, "b");
}

TEST_F(PlanningSceneTest, DetachFromAnotherLinkDoesNothing) {
  update(AttachedObject{"hand", add("tool")});
  EXPECT_TRUE(update(AttachedObject{"arm", remove("tool")}).changes.empty());
  EXPECT_TRUE(update(AttachedObject{"hand", remove("other")}).changes.empty());
}

TEST_F(PlanningSceneTest, AnIdBothInTheWorldAndAttachedIsRefused) {
  update(AttachedObject{"hand", add("tool")});
  const SceneChange change = apply(add("tool", at(1)));
  EXPECT_TRUE(has(change.refused, "both in the world and attached to 'hand'"));
  EXPECT_EQ(origins(apply(AttachedObject{"hand", remove("tool")})), (Points{Point(1, 0, 0)}));
}

TEST_F(PlanningSceneTest, ARobotStateWithJointsThatIsNoDiffReplacesWhatIsAttached) {
  update(full({}, {{"hand", add("a")}}));
  const SceneUpdate told = update(full({}, {{"hand", add("b", at(1))}}));
  ASSERT_EQ(told.changes.size(), 2U);
  EXPECT_TRUE(isRemoved(told.changes[0]));
  EXPECT_EQ(told.changes[1].link, "hand");
}

TEST_F(PlanningSceneTest, ARobotStateThatIsADiffOrWithoutJointsKeepsWhatIsAttached) {
  update(full({}, {{"hand", add("a")}}));
  PlanningSceneMessage without_joints = diff({}, {{"hand", add("b")}});
  without_joints.is_state_diff = false;
  EXPECT_EQ(apply(without_joints).object.id, "b");
  PlanningSceneMessage state_diff = full({});
  state_diff.is_state_diff = true;
  EXPECT_TRUE(update(state_diff).changes.empty());
}

TEST_F(PlanningSceneTest, ARobotStateThatIsNoDiffDetachesNothing) {
  update(full({}, {{"hand", add("a")}}));
  PlanningSceneMessage message = diff({}, {{"hand", remove("a")}});
  message.is_state_diff = false;
  const SceneChange change = apply(message);
  EXPECT_TRUE(has(change.refused, "set is_diff"));
  EXPECT_EQ(change.link, "hand");
}

// What is attached comes first: it is in the old world.
TEST_F(PlanningSceneTest, AFullSceneAttachesWithoutShapesWhatTheOldWorldHas) {
  update(add("tool", at(1)));
  const SceneChange change = apply(full({}, {{"hand", message(Operation::kAdd, "tool")}}));
  EXPECT_EQ(change.link, "hand");
  EXPECT_EQ(origins(change), (Points{Point(1, 0, 0)}));
}

TEST_F(PlanningSceneTest, AfterAThousandObjectsTheNextIsRefused) {
  std::vector<CollisionObject> objects;
  for (size_t i = 1; i < PlanningScene::kMaxObjects; ++i) objects.push_back(add(std::to_string(i)));
  update(full(objects, {{"hand", add("tool")}}));
  EXPECT_TRUE(has(refused(add("more")), "1000 objects"));
  EXPECT_TRUE(has(refused(AttachedObject{"hand", add("other tool")}), "1000 objects"));
  EXPECT_EQ(refused(add("1", at(1))), "") << "one that is there already";
  EXPECT_EQ(refused(AttachedObject{"hand", add("tool", at(1))}), "");
  update(remove("1"));
  EXPECT_EQ(refused(add("more")), "");
}

TEST_F(PlanningSceneTest, OfRefusedIdsTenThousandAreRemembered) {
  std::vector<CollisionObject> objects(10001, add("", at(1), {}));
  for (size_t i = 0; i < objects.size(); ++i) objects[i].id = std::to_string(i);
  EXPECT_EQ(update(diff(objects)).changes.size(), 10001U);
  EXPECT_EQ(update(full({})).changes.size(), 10000U);
}

}  // namespace
}  // namespace sweep_guard_core
