#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/round_tool.h"
#include "guard/fake_detector.h"
#include "guard/guard_results.h"
#include "guard/path_checker.h"
#include "monitor/warnings.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;
using Indices = std::vector<std::uint32_t>;

GuardOptions constantVelocity() {
  GuardOptions options;
  options.predictor.predictor = "constant_velocity";
  options.clock = [] { return SteadyTime(); };  // everything is free of cost
  return options;
}

std::shared_ptr<const Workpiece> workpieceWith(const std::string& id, const TriangleMesh& mesh_M,
                                               const std::string& frame = "table") {
  return std::make_shared<const Workpiece>(Workpiece{id, 0, Time(1s), SteadyTime{}, frame, mesh_M});
}

TriangleMesh squareAt(double z) {
  return TriangleMesh({{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}}, {{0, 1, 2}, {0, 2, 3}});
}

// A constant velocity and rate of turn in W.
struct Steady {
  Eigen::Isometry3d X_WT;            // at time 0
  Eigen::Vector3d velocity;          // [m/s]
  Eigen::Vector3d turn = {0, 0, 0};  // [rad/s]

  Eigen::Isometry3d at(double t) const {
    Eigen::Isometry3d X = X_WT;
    X.translation() += t * velocity;
    if (turn.norm() > 0.0) X.linear() = Eigen::AngleAxisd(t * turn.norm(), turn.normalized()) * X_WT.linear();
    return X;
  }
};

// Points down from there, and comes down.
Steady comingDown(double z, double speed) {
  Steady motion{Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX())), {0, 0, -speed}};
  motion.X_WT.translation().z() = z;
  return motion;
}

class GuardPredictionTest : public testing::Test {
 protected:
  // Ten poses of 10 ms; the last is where the motion is at time 0, its stamp is 10 s.
  void follow(const Steady& motion,
              const std::map<std::string, Eigen::Isometry3d>& X_WM = {{"table", Eigen::Isometry3d::Identity()}}) {
    for (int i = -9; i <= 0; ++i) {
      reportOf(guard_, {Time(10s + i * 10ms), SteadyTime(), motion.at(0.01 * i), X_WM}, workpieces_);
    }
  }

  Prediction predict(Duration age = 0ms) { return predictionOf(guard_, age, workpieces_); }

  Workpieces workpieces_;
  FakeDetector::Record record_;
  Guard guard_{Tool::cylinder(0.005, 0.1), std::make_unique<FakeDetector>(record_), constantVelocity()};
};

TEST_F(GuardPredictionTest, PredictsNothingBeforeAMotionIsKnown) {
  workpieces_ = {workpieceWith("square", squareAt(0.0))};
  EXPECT_TRUE(predictionOf(guard_, 0ms, workpieces_).path.empty());
  reportOf(guard_, {Time(10s), SteadyTime(), Eigen::Isometry3d::Identity(), {{"table", Eigen::Isometry3d::Identity()}}},
           workpieces_);
  const Prediction prediction = predictionOf(guard_, 0ms, workpieces_);
  EXPECT_TRUE(prediction.path.empty());
  EXPECT_TRUE(prediction.objects.empty());
  EXPECT_EQ(prediction.coveredUntil(), Time(10s));
}

TEST_F(GuardPredictionTest, PredictsNothingAfterAReset) {
  workpieces_ = {workpieceWith("square", squareAt(0.0))};
  follow(comingDown(0.05, 0.1));
  guard_.reset();
  EXPECT_TRUE(predict().path.empty());
}

TEST_F(GuardPredictionTest, CoversTheHorizonCountedFromNow) {
  workpieces_ = {workpieceWith("square", squareAt(0.0))};
  follow(comingDown(5.0, 0.1));
  const Prediction prediction = predict(30ms);
  EXPECT_EQ(prediction.stamp, Time(10s));
  EXPECT_EQ(prediction.reflex_sweeps, 13U);
  EXPECT_EQ(prediction.sweeps_asked, 23U);
  ASSERT_EQ(prediction.path.size(), 23U);
  EXPECT_EQ(prediction.path[12].ahead, 130ms);
  EXPECT_EQ(prediction.coveredUntil(), Time(11130ms));
  ASSERT_EQ(prediction.objects.size(), 1U);
  EXPECT_EQ(prediction.objects[0].workpiece, workpieces_[0]);
  EXPECT_EQ(prediction.objects[0].sweeps.size(), 23U);
  EXPECT_EQ(prediction.objects[0].volumes_M.size(), 23U);
}

// A clock that is an hour off: the sweeps to now would be split into 25 ms.
TEST_F(GuardPredictionTest, PredictsNothingFromAPoseOlderThanTheReserve) {
  workpieces_ = {workpieceWith("square", squareAt(0.0))};
  follow(comingDown(0.05, 0.1));
  const size_t detections = record_.volumes.size();
  for (const Duration age : {Duration(100ms + 1ns), Duration(1s), Duration(1h), Duration(8760h)}) {
    const Prediction prediction = predict(age);
    EXPECT_TRUE(prediction.path.empty());
    EXPECT_TRUE(prediction.objects.empty());
    EXPECT_FALSE(predictedContact(prediction));
  }
  EXPECT_EQ(record_.volumes.size(), detections);
  EXPECT_FALSE(predict(100ms).path.empty());
}

// 2 s are the largest reserve that timing/pose_timeout allows. Splitting takes at most 15 volumes for 100 ms.
TEST_F(GuardPredictionTest, TestsABoundedNumberOfVolumesAtAnyAge) {
  workpieces_ = {workpieceWith("square", squareAt(0.0))};
  GuardOptions options = constantVelocity();
  options.horizon.reserve = 2s;
  for (const double speed : {0.0, 0.001, 0.01, 0.1, 1.0}) {
    for (const Duration age : {Duration(0ms), Duration(1s), Duration(2s - 1ns)}) {
      Guard guard(Tool::cylinder(0.005, 0.1), std::make_unique<ReferenceDetector>(), options);
      for (int i = -9; i <= 0; ++i) {
        reportOf(guard,
                 {Time(10s + i * 10ms),
                  SteadyTime(),
                  comingDown(0.05, speed).at(0.01 * i),
                  {{"table", Eigen::Isometry3d::Identity()}}},
                 workpieces_);
      }
      const Prediction prediction = predictionOf(guard, age, workpieces_);
      ASSERT_EQ(prediction.objects.size(), 1U);
      EXPECT_LE(prediction.sweeps_asked, 210U + 29U);
      EXPECT_LE(prediction.objects[0].volumes_tested, 210U + 29U * 15U) << speed << " m/s, age " << age.count();
    }
  }
}

TEST_F(GuardPredictionTest, PredictsTheMotionForAnyHorizonWithoutTesting) {
  EXPECT_TRUE(guard_.predictMotion(0ms, 1s).path.empty());
  workpieces_ = {workpieceWith("square", squareAt(0.0))};
  follow(comingDown(0.05, 0.1));
  const size_t detections = record_.volumes.size();
  const PredictedMotion predicted = guard_.predictMotion(20ms, 3s);
  EXPECT_EQ(record_.volumes.size(), detections);
  EXPECT_EQ(predicted.from.stamp, Time(10s));
  EXPECT_EQ(predicted.path.back().ahead, 3020ms);
  EXPECT_NEAR(predicted.path.back().X_WT.translation().z(), 0.05 - 0.1 * 3.02, 1e-9);
}

// 5 cm at 0.1 m/s: half a second. It is known to 5 ms when the sweep of 100 ms is halved that often.
TEST_F(GuardPredictionTest, ReportsWhenThePathMeetsASquare) {
  workpieces_ = {workpieceWith("square", squareAt(0.0))};
  follow(comingDown(0.05, 0.1));
  const Prediction prediction = predict();
  const auto expected = predictedContact(prediction);
  ASSERT_TRUE(expected);
  EXPECT_TRUE(expected->contact);
  EXPECT_LE(expected->earliest(), Time(10500ms));
  EXPECT_GT(expected->earliest(), Time(10494ms));
  EXPECT_EQ(expected->mesh_id, "square");
  EXPECT_EQ(expected->triangles, (Indices{0, 1}));
  EXPECT_GE(expected->considered_probability, probabilityWithin(PredictionInterval::kConsidered, 0.0));
  EXPECT_EQ(prediction.objects[0].reflex, Indices{});
  EXPECT_EQ(prediction.objects[0].considered, (Indices{0, 1}));
  for (const PredictedSweep& sweep : prediction.objects[0].sweeps) {
    EXPECT_EQ(sweep.contact, sweep.from > 494ms) << toSeconds(sweep.from);
  }
}

TEST_F(GuardPredictionTest, APaddedWorkpieceIsMetEarlierByItsPadding) {
  TriangleMesh padded = squareAt(0.0);
  padded.pad(0.01);
  workpieces_ = {workpieceWith("square", padded)};
  follow(comingDown(0.05, 0.1));
  const auto expected = predictedContact(predict());
  ASSERT_TRUE(expected);
  EXPECT_LE(expected->earliest(), Time(10400ms));
  EXPECT_GT(expected->earliest(), Time(10394ms));
}

TEST_F(GuardPredictionTest, ReportsTrianglesOfTheReflexIntervalSeparately) {
  workpieces_ = {workpieceWith("square", squareAt(0.0))};
  follow(comingDown(0.005, 0.1));
  const Prediction prediction = predict();
  EXPECT_EQ(prediction.objects[0].reflex, (Indices{0, 1}));
  EXPECT_EQ(prediction.objects[0].considered, Indices{});
}

// The square lives in a frame that is turned and far away: what counts is where it is in the world.
TEST_F(GuardPredictionTest, TakesAWorkpieceWhereItsFrameIs) {
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Isometry3d X_MW = random.pose(random.inBox({10, 10, 10}));
    std::vector<Eigen::Vector3d> corners_M;
    for (const auto& [x, y] : {std::pair(-1.0, -1.0), {1.0, -1.0}, {0.0, 1.0}}) {
      corners_M.push_back(X_MW * Eigen::Vector3d(x, y, 0.0));
    }
    workpieces_ = {workpieceWith("square", TriangleMesh(corners_M, {{0, 1, 2}}), "turned")};
    guard_.reset();
    follow(comingDown(0.05, 0.1), {{"turned", X_MW.inverse()}});
    const auto expected = predictedContact(predict());
    ASSERT_TRUE(expected);
    EXPECT_LE(expected->earliest(), Time(10500ms));
    EXPECT_GT(expected->earliest(), Time(10494ms));
  }
}

// The drill swings past a wall, 0.01 mm beside it. 25 ms take a margin of 0.018 mm for its arc.
TEST_F(GuardPredictionTest, AVolumeThatIsMerelyLooseMeetsNothing) {
  const double x = 0.005 + 0.00001;
  workpieces_ = {workpieceWith("wall", TriangleMesh({{x, -1, -1}, {x, 1, -1}, {x, 0, 1}}, {{0, 1, 2}}))};
  follow({Eigen::Isometry3d::Identity(), {0, 0, 0}, {1.5, 0, 0}});
  const size_t asked_before = record_.volumes.size();
  const Prediction prediction = predict();
  EXPECT_GT(record_.volumes.size(), asked_before);
  EXPECT_EQ(prediction.objects[0].considered, Indices{});
  for (const PredictedSweep& sweep : prediction.objects[0].sweeps) EXPECT_FALSE(sweep.contact);
}

// Far away the detector is not asked.
TEST_F(GuardPredictionTest, AFarWorkpieceCostsNoDetection) {
  workpieces_ = {workpieceWith("square", squareAt(0.0))};
  follow(comingDown(5.0, 0.1));
  record_.volumes.clear();
  EXPECT_FALSE(predictedContact(predict(), kMaxDeviations));
  EXPECT_TRUE(record_.volumes.empty());
}

TEST_F(GuardPredictionTest, AContactTooFarToMatterIsNotReported) {
  workpieces_ = {workpieceWith("square", squareAt(0.0))};
  constexpr double kMost = 1.3;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  int far = 0;
  int near = 0;
  for (int mm = 5; mm < 400; ++mm) {
    GuardOptions options = constantVelocity();
    const auto nearestWithin = [&](double most) {
      options.max_deviations = most;
      GuardChange change{options};
      guard_.exchange(change);
      guard_.reset();
      follow(comingDown(0.001 * mm, 0.02));
      const Prediction prediction = predict();
      double nearest = kFar;
      for (const PredictedSweep& sweep : prediction.objects.at(0).sweeps) nearest = std::min(nearest, sweep.deviations);
      return nearest;
    };
    const double nearest = nearestWithin(kMaxDeviations);
    if (std::abs(nearest - kMost) < 0.01) continue;
    const double found = nearestWithin(kMost);
    EXPECT_NEAR(std::min(found, kMost), std::min(nearest, kMost), 5e-3) << mm;
    EXPECT_EQ(found > kMost, nearest > kMost) << mm;
    far += nearest > kMost && nearest < kFar;
    near += nearest > 0.0 && nearest < kMost;
  }
  EXPECT_GT(far, 2);
  EXPECT_GT(near, 2);
}

TEST_F(GuardPredictionTest, AFailureOnOneWorkpieceDoesNotHideAnother) {
  workpieces_ = {workpieceWith("first", squareAt(0.0)), workpieceWith("second", squareAt(-0.01))};
  follow(comingDown(0.05, 0.1));
  record_.failures_left = 1;
  const Prediction prediction = predictionOf(guard_, 0ms, workpieces_);
  ASSERT_EQ(prediction.failures.size(), 1U);
  EXPECT_EQ(prediction.failures[0].workpiece, workpieces_[0]);
  EXPECT_EQ(prediction.coveredUntil(), Time(10s));
  ASSERT_TRUE(predictedContact(prediction));
  EXPECT_EQ(predictedContact(prediction)->mesh_id, "second");
}

TEST_F(GuardPredictionTest, NamesWorkpiecesWhoseFrameIsMissing) {
  workpieces_ = {workpieceWith("here", squareAt(0.0)), workpieceWith("lost", squareAt(0.0), "nowhere")};
  follow(comingDown(0.05, 0.1));
  const Prediction prediction = predict();
  ASSERT_EQ(prediction.unplaced.size(), 1U);
  EXPECT_EQ(prediction.unplaced[0], workpieces_[1]);
  EXPECT_EQ(prediction.objects.size(), 1U);
  EXPECT_EQ(prediction.coveredUntil(), Time(10s));
}

bool contains(const SweptVolume& volume_M, const Eigen::Vector3d& p_M) {
  const Eigen::Vector3d p_B = volume_M.box.X_MB.inverse() * p_M;
  const auto half_spaces_B = volume_M.halfSpaces_B();
  return std::all_of(half_spaces_B.begin(), half_spaces_B.end(),
                     [&](const HalfSpace& half_space) { return half_space.signedDistance(p_B) <= 1e-9; });
}

// Wherever the tool is on its predicted path, at any time up to the end, each of its points lies in a volume.
TEST_F(GuardPredictionTest, TheVolumesCoverThePathWithoutHoles) {
  Random random(6);
  const auto rims_T = roundToolPoints_T(guard_.tool().whole(), 8);
  workpieces_ = {workpieceWith("square", squareAt(0.0))};
  for (int i = 0; i < 20; ++i) {
    const Steady motion{random.pose(random.inBox({1, 1, 1})), random.logUniform(0.01, 2.0) * random.direction(),
                        random.logUniform(0.01, 10.0) * random.direction()};
    guard_.reset();
    const Eigen::Isometry3d X_WM = random.pose(random.inBox({1, 1, 1}));
    follow(motion, {{"table", X_WM}});
    const Prediction prediction = predict(fromSeconds(random.uniform(0.0, 0.05)));
    const std::vector<SweptVolume>& volumes_M = prediction.objects[0].volumes_M;
    Motion segment{motion.at(0.0), prediction.path[0].X_WT};
    for (size_t k = 0; k < prediction.path.size(); ++k) {
      if (k > 0) segment = {prediction.path[k - 1].X_WT, prediction.path[k].X_WT};
      for (const double fraction : {0.0, 0.3, 0.5, 0.9, 1.0}) {
        for (const Eigen::Vector3d& p_T : rims_T) {
          const Eigen::Vector3d p_M = X_WM.inverse() * segment.at(fraction) * p_T;
          ASSERT_TRUE(std::any_of(volumes_M.begin(), volumes_M.end(),
                                  [&](const SweptVolume& volume_M) { return contains(volume_M, p_M); }))
              << "episode " << i << " sweep " << k << " at " << fraction;
        }
      }
    }
  }
}

// Ten steps of 10 ms, then ten of 100 ms.
PredictedPath pathAlong(const std::function<Eigen::Isometry3d(double)>& X_WT) {
  PredictedPath path;
  for (const Duration ahead : horizonUpTo(1100ms, {}, 0ms).ends)
    path.push_back({ahead, X_WT(toSeconds(ahead)), Matrix6d::Zero()});
  return path;
}

// Of a reflex interval of ten sweeps.
std::vector<size_t> endsOf(const Eigen::Isometry3d& X_WT, const PredictedPath& path, size_t considered_sweeps) {
  std::vector<size_t> ends;
  findSweepEnds(X_WT, path, 10, considered_sweeps, ends);
  return ends;
}

// However coarsely the considered interval is swept, in time or not.
class CoarseSweepsTest : public testing::Test {
 protected:
  template <typename Check>
  void atEveryGranularity(const ConvexShape& tool, const std::function<Eigen::Isometry3d(double)>& X_WT,
                          const TriangleMesh& mesh_M, const Check& check) {
    const PredictedPath path = pathAlong(X_WT);
    for (size_t sweeps = 1; sweeps <= 10; ++sweeps) {
      const auto ends = endsOf(X_WT(0.0), path, sweeps);
      ASSERT_EQ(ends.back(), path.size());
      for (const bool spent : {false, true}) {
        SCOPED_TRACE(std::to_string(sweeps) + (spent ? " sweeps, no time" : " sweeps"));
        PathChecker checker(SweepOptions(), 5ms);
        PredictedObject object;
        checker.check(detector_,
                      {Tool(tool),
                       X_WT(0.0),
                       path,
                       10,
                       Eigen::Isometry3d::Identity(),
                       workpieceWith("one", mesh_M),
                       {ends, [spent] { return spent; }}},
                      object);
        check(object);
      }
    }
  }

  ReferenceDetector detector_;
};

bool inContact(const PredictedObject& object) {
  return std::any_of(object.sweeps.begin(), object.sweeps.end(), [](const auto& sweep) { return sweep.contact; });
}

// From 0.1 s to 1.1 s it turns once: the first pose and the last are the same.
TEST_F(CoarseSweepsTest, FindWhatASpinningToolMeets) {
  const auto spinning = [](double t) {
    return Eigen::Isometry3d(Eigen::AngleAxisd(2.0 * M_PI * t, Eigen::Vector3d::UnitX()));
  };
  for (const double t : {0.15, 0.4, 0.65, 0.9}) {
    const Eigen::Vector3d p = spinning(t) * Eigen::Vector3d(0.0, 0.0, -0.15);
    const TriangleMesh dot({p, p, p}, {{0, 1, 2}});
    atEveryGranularity(ConvexShape::cylinder(0.005, 0.2), spinning, dot,
                       [](const PredictedObject& object) { EXPECT_TRUE(inContact(object)); });
  }
}

// x = 0.6 t - 0.5 t^2 reaches 0.18 m, and is back at 0.055 m at the end.
TEST_F(CoarseSweepsTest, FindWhatLiesBeforeAToolThatTurnsBack) {
  const auto there_and_back = [](double t) {
    Eigen::Isometry3d X_WT(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitY()));
    X_WT.translation().x() = 0.6 * t - 0.5 * t * t;
    return X_WT;
  };
  const TriangleMesh wall({{0.12, -9, -9}, {0.12, 9, -9}, {0.12, 0, 9}}, {{0, 1, 2}});
  atEveryGranularity(ConvexShape::cylinder(0.005, 0.1), there_and_back, wall,
                     [](const PredictedObject& object) { EXPECT_TRUE(inContact(object)); });
}

// Against the motion from pose to pose, not against the chord that a long sweep takes.
TEST_F(CoarseSweepsTest, CoverTheMotionThroughEveryPose) {
  Random random(8);
  const ConvexShape tool = ConvexShape::cylinder(0.01, 0.15);
  const auto rims_T = roundToolPoints_T(tool, 8);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d swing = random.uniform(0.0, 0.3) * random.direction();
    const Eigen::Vector3d axis = random.direction();
    const double wave = random.uniform(1.0, 6.0);
    const double turn = random.uniform(0.0, 3.0);
    const auto swinging = [&](double t) {
      Eigen::Isometry3d X_WT(Eigen::AngleAxisd(turn * std::sin(wave * t), axis));
      X_WT.translation() = std::sin(1.3 * wave * t) * swing + 0.1 * t * axis;
      return X_WT;
    };
    const PredictedPath path = pathAlong(swinging);
    const auto covered = [&](const PredictedObject& object) {
      for (size_t k = 0; k < path.size(); ++k) {
        const Motion segment{k == 0 ? swinging(0.0) : path[k - 1].X_WT, path[k].X_WT};
        for (const double fraction : {0.1, 0.5, 1.0}) {
          for (const Eigen::Vector3d& p_T : rims_T) {
            const Eigen::Vector3d p_M = segment.at(fraction) * p_T;
            ASSERT_TRUE(std::any_of(object.volumes_M.begin(), object.volumes_M.end(),
                                    [&](const SweptVolume& volume_M) { return contains(volume_M, p_M); }))
                << "episode " << i << " step " << k << " at " << fraction;
          }
        }
      }
    };
    atEveryGranularity(tool, swinging, squareAt(0.0), covered);
  }
}

// A drill, and 5 cm beside it along x a round camera whose front is level with the tip.
class ToolPiecesTest : public testing::Test {
 protected:
  static Tool drillAndCamera() {
    const ConvexShape camera = ConvexShape::sphere(0.01);
    return Tool({{"drill", ConvexShape::cylinder(0.005, 0.1)},
                 {"camera", camera.placed(Eigen::Isometry3d(Eigen::Translation3d(0.05, 0.0, -0.01)))}});
  }

  static TriangleMesh patchAt(double x, double y, double z) {
    constexpr double kHalf = 0.001;
    return TriangleMesh({{x - kHalf, y - kHalf, z}, {x + kHalf, y - kHalf, z}, {x, y + kHalf, z}}, {{0, 1, 2}});
  }

  // The tip comes up along z, 0.1 m/s, its position uncertain by the deviation in each direction.
  PredictedObject predictContact(const TriangleMesh& mesh_M, double deviation, bool in_time = true) {
    const auto rising = [](double t) { return Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.1 * t)); };
    PredictedPath path = pathAlong(rising);
    for (PredictedPose& pose : path) {
      pose.covariance.topLeftCorner<3, 3>().diagonal().setConstant(deviation * deviation);
    }
    PathChecker checker(SweepOptions(), 5ms);
    PredictedObject object;
    checker.check(detector_,
                  {tool_,
                   rising(0.0),
                   path,
                   10,
                   Eigen::Isometry3d::Identity(),
                   workpieceWith("patch", mesh_M),
                   {{}, [in_time] { return !in_time; }}},
                  object);
    return object;
  }

  static std::optional<size_t> pieceOfFirst(const PredictedObject& object, bool contact) {
    for (const PredictedSweep& sweep : object.sweeps) {
      if (contact ? sweep.contact : sweep.tool_piece.has_value()) return sweep.tool_piece;
    }
    ADD_FAILURE() << "there is none";
    return {};
  }

  Tool tool_ = drillAndCamera();
  ReferenceDetector detector_;
};

TEST_F(ToolPiecesTest, ThePieceInContactIsNamedInTimeOrNot) {
  for (const bool in_time : {true, false}) {
    EXPECT_EQ(pieceOfFirst(predictContact(patchAt(0.0, 0.0, 0.05), 0.0, in_time), /*contact=*/true), 0U);
    EXPECT_EQ(pieceOfFirst(predictContact(patchAt(0.05, 0.0, 0.05), 0.0, in_time), /*contact=*/true), 1U);
  }
}

// The patch lies 9 mm beside the camera, or 10 mm beside the drill.
TEST_F(ToolPiecesTest, TheLikeliestPieceIsNamed) {
  const PredictedObject beside_camera = predictContact(patchAt(0.05, 0.02, 0.05), 0.005);
  EXPECT_FALSE(beside_camera.firstContact());
  EXPECT_EQ(pieceOfFirst(beside_camera, /*contact=*/false), 1U);
  const PredictedObject beside_drill = predictContact(patchAt(0.0, 0.016, 0.05), 0.005);
  EXPECT_FALSE(beside_drill.firstContact());
  EXPECT_EQ(pieceOfFirst(beside_drill, /*contact=*/false), 0U);
}

// Either may meet it: 9 mm from the one, 24 mm from the other.
TEST_F(ToolPiecesTest, WhatIsNearerIsLikelier) {
  for (const auto& [x, nearer] : {std::pair(0.015, 0U), std::pair(0.03, 1U)}) {
    const PredictedObject between = predictContact(patchAt(x, 0.0, 0.05), 0.02);
    EXPECT_FALSE(between.firstContact());
    const auto less = [](const auto& a, const auto& b) { return a.deviations < b.deviations; };
    const auto nearest = std::min_element(between.sweeps.begin(), between.sweeps.end(), less);
    ASSERT_LT(nearest->deviations, 0.67);
    EXPECT_EQ(nearest->tool_piece, nearer);
  }
}

TEST_F(ToolPiecesTest, NoneIsNamedWhereNothingIsNear) {
  for (const PredictedSweep& sweep : predictContact(patchAt(0.5, 0.5, 0.05), 0.001).sweeps)
    EXPECT_FALSE(sweep.tool_piece);
}

TEST(SweepEndsTest, AreThePosesOfTheReflexIntervalAndEvenlyManyBeyond) {
  const PredictedPath path = pathAlong([](double t) { return Eigen::Isometry3d(Eigen::Translation3d(t, 0, 0)); });
  for (size_t sweeps = 1; sweeps <= 10; ++sweeps) {
    const auto ends = endsOf(Eigen::Isometry3d::Identity(), path, sweeps);
    ASSERT_EQ(ends.size(), 10 + sweeps);
    for (size_t i = 0; i < 10; ++i) EXPECT_EQ(ends[i], i + 1);
    EXPECT_EQ(ends.back(), 20U);
    for (size_t i = 10; i < ends.size(); ++i) EXPECT_LE(ends[i] - ends[i - 1], (10 + sweeps - 1) / sweeps);
  }
}

// 0.6 rad a step: two are joined, three are not.
TEST(SweepEndsTest, DoNotJoinStepsThatTurnFar) {
  const auto turning = [](double t) { return Eigen::Isometry3d(Eigen::AngleAxisd(6.0 * t, Eigen::Vector3d::UnitX())); };
  const auto ends = endsOf(turning(0.0), pathAlong(turning), 1);
  EXPECT_EQ(ends, (std::vector<size_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 20}));
}

// Every detection takes time on the guard's clock.
class SlowDetector : public Detector {
 public:
  SlowDetector(SteadyTime& clock, const Duration& cost) : clock_(clock), cost_(cost) {}

 private:
  void find(const Submesh& part, const SweptVolume& swept_M, Detection& detection) override {
    clock_ += cost_;
    detection = reference_.detect(part, swept_M);
  }

  SteadyTime& clock_;
  const Duration& cost_;
  ReferenceDetector reference_;
};

// A drill sticks in a square and moves along it: the detector is asked about every sweep.
class SlowGuard {
 public:
  SlowGuard() {
    GuardOptions options = constantVelocity();
    options.clock = [this] { return clock_; };
    options.cycle = 66ms;
    guard_.emplace(Tool::cylinder(0.005, 0.1), std::make_unique<SlowDetector>(clock_, cost), options);
  }

  // Sweeps to the next pose and looks ahead. Returns what that took.
  Duration cycle() {
    const SteadyTime begin = clock_;
    pose_.X_WT.translation().x() += 0.0001;
    pose_.X_WT.rotate(Eigen::AngleAxisd(0.066 * turn_rate, Eigen::Vector3d::UnitX()));
    pose_.bodies = {{pose_.X_WT}};
    pose_.stamp += 66ms;
    reportOf(*guard_, pose_, workpieces_);
    PredictionRun run = guard_->beginPrediction(5ms, workpieces_, prediction);
    for (; !run.done(); run.step()) {
      if (between) between();
    }
    return clock_ - begin;
  }
  void spend(Duration time) { clock_ += time; }

  Duration cost{};
  double turn_rate = 0.0;  // [rad/s]
  std::function<void()> between;
  Prediction prediction;

 private:
  SteadyTime clock_;
  PoseWithFrames pose_{
      Time(10s), SteadyTime(), Eigen::Isometry3d::Identity(), {{"table", Eigen::Isometry3d::Identity()}}};
  Workpieces workpieces_ = {workpieceWith("square", squareAt(-0.05))};
  std::optional<Guard> guard_;
};

// [P, Sec. 3.2]: prediction must not slow the guard below 15 Hz.
TEST(SlowDetectorTest, MakesTheConsideredIntervalCoarserAndNothingElse) {
  size_t before = 21;
  for (const Duration cost : {100us, 1000us, 2000us, 3000us, 3500us, 4200us}) {
    SlowGuard guard;
    guard.cost = cost;
    for (int i = 0; i < 50; ++i) {
      EXPECT_LE(guard.cycle(), 66ms) << cost.count() << " ns, cycle " << i;
      if (i == 0) continue;  // no motion yet
      EXPECT_EQ(guard.prediction.reflex_sweeps, 11U);
      EXPECT_EQ(guard.prediction.sweeps_asked, 21U);
      EXPECT_EQ(guard.prediction.path[10].ahead, 105ms);
      EXPECT_EQ(guard.prediction.coveredUntil(), guard.prediction.stamp + 1105ms);
    }
    EXPECT_LE(guard.prediction.sweeps_made, before);
    EXPECT_EQ(guard.prediction.path.size(), 21U);
    before = guard.prediction.sweeps_made;
  }
  EXPECT_EQ(before, 12U);
}

// Its far end goes through the square and back. A step of 100 ms takes four volumes, a measured sweep three.
TEST(SlowDetectorTest, DoesNotDelayATurningToolEither) {
  for (const Duration cost : {500us, 1000us, 2000us, 3000us, 4000us}) {
    SlowGuard guard;
    guard.cost = cost;
    guard.turn_rate = 6.0;
    for (int i = 0; i < 100; ++i) {
      EXPECT_LE(guard.cycle(), 66ms) << cost.count() << " ns, cycle " << i;
      if (i == 0) continue;  // no motion yet
      EXPECT_EQ(guard.prediction.coveredUntil(), guard.prediction.stamp + 1105ms);
      EXPECT_TRUE(predictedContact(guard.prediction));
    }
  }
}

TEST(SlowDetectorTest, NeverCostsTheReflexInterval) {
  SlowGuard guard;
  guard.cost = 30ms;
  for (int i = 0; i < 10; ++i) guard.cycle();
  EXPECT_EQ(guard.prediction.reflex_sweeps, 11U);
  EXPECT_EQ(guard.prediction.sweeps_made, 12U);
  EXPECT_EQ(guard.prediction.coveredUntil(), guard.prediction.stamp + 1105ms);
}

TEST(SlowDetectorTest, ThatBecomesSlowerKeepsTheCycle) {
  SlowGuard guard;
  guard.cost = 500us;
  for (int i = 0; i < 10; ++i) guard.cycle();
  EXPECT_EQ(guard.prediction.sweeps_made, 21U);
  for (int i = 0; i < 40; ++i) {
    guard.cost = guard.cost * 105 / 100;
    EXPECT_LE(guard.cycle(), 66ms) << i;
  }
  EXPECT_LT(guard.prediction.sweeps_made, 21U);
}

// Two guards follow the same motion; one sweeps on while it looks ahead, the other before and after.
class InterruptedGuardTest : public testing::Test {
 protected:
  PoseWithFrames poseAt(int i) const {
    return {Time(10s + i * 10ms), SteadyTime(), motion_.at(0.01 * i), {{"table", Eigen::Isometry3d::Identity()}}};
  }
  void SetUp() override {
    for (int i = -9; i <= 0; ++i) {
      reportOf(guard_, poseAt(i), workpieces_);
      reportOf(other_, poseAt(i), workpieces_);
    }
  }
  static void expectSame(const Prediction& a, const Prediction& b) {
    EXPECT_EQ(a.stamp, b.stamp);
    EXPECT_EQ(a.sweeps_made, b.sweeps_made);
    ASSERT_EQ(a.objects.size(), b.objects.size());
    EXPECT_EQ(a.objects[0].reflex, b.objects[0].reflex);
    EXPECT_EQ(a.objects[0].considered, b.objects[0].considered);
    for (const auto interval : {PredictionInterval::kReflex, PredictionInterval::kConsidered}) {
      EXPECT_EQ(a.probability(interval, 1s), b.probability(interval, 1s));
    }
    EXPECT_EQ(a.firstContact(), b.firstContact());
    ASSERT_EQ(a.path.size(), b.path.size());
    for (size_t i = 0; i < a.path.size(); ++i) EXPECT_TRUE(a.path[i].X_WT.isApprox(b.path[i].X_WT, 0.0)) << i;
  }

  const Steady motion_ = comingDown(0.05, 0.2);
  const Workpieces workpieces_ = {workpieceWith("square", squareAt(0.0))};
  Guard guard_{Tool::cylinder(0.005, 0.1), std::make_unique<ReferenceDetector>(), constantVelocity()};
  Guard other_{Tool::cylinder(0.005, 0.1), std::make_unique<ReferenceDetector>(), constantVelocity()};
};

TEST_F(InterruptedGuardTest, APredictionIsTheSameIfPosesAreSweptBetweenItsSweeps) {
  const Prediction expected = predictionOf(other_, 0ms, workpieces_);
  ASSERT_TRUE(expected.firstContact());
  int swept = 0;
  Prediction prediction;
  PredictionRun run = guard_.beginPrediction(0ms, workpieces_, prediction);
  for (; !run.done(); run.step()) reportOf(guard_, poseAt(++swept), workpieces_);
  EXPECT_GE(swept, 20);
  expectSame(prediction, expected);
}

TEST_F(InterruptedGuardTest, PosesSweptBetweenTheSweepsOfAPredictionMeetTheSameTriangles) {
  Prediction prediction;
  int swept = 0;
  bool contact = false;
  PredictionRun run = guard_.beginPrediction(0ms, workpieces_, prediction);
  for (; !run.done(); run.step()) {
    const PoseWithFrames pose = poseAt(3 * ++swept);
    const SweepReport report = reportOf(guard_, pose, workpieces_);
    const SweepReport expected = reportOf(other_, pose, workpieces_);
    EXPECT_EQ(report.contact(), expected.contact()) << swept;
    ASSERT_EQ(report.objects.size(), 1U);
    EXPECT_EQ(report.objects[0].result.not_ruled_out, expected.objects[0].result.not_ruled_out) << swept;
    contact = contact || report.contact();
  }
  EXPECT_TRUE(contact);
  expectSame(predictionOf(guard_, 0ms, workpieces_), predictionOf(other_, 0ms, workpieces_));
}

TEST_F(InterruptedGuardTest, APredictionEndsThoughAllIsForgottenMeanwhile) {
  const Prediction expected = predictionOf(other_, 0ms, workpieces_);
  Prediction prediction;
  PredictionRun run = guard_.beginPrediction(0ms, workpieces_, prediction);
  for (; !run.done(); run.step()) guard_.reset();
  expectSame(prediction, expected);
  EXPECT_TRUE(predictionOf(guard_, 0ms, workpieces_).path.empty());
}

TEST_F(InterruptedGuardTest, APredictionIsGivenUpWhenTheNextOneBegins) {
  const Prediction expected = predictionOf(other_, 0ms, workpieces_);
  Prediction given_up;
  PredictionRun run = guard_.beginPrediction(0ms, workpieces_, given_up);
  for (int i = 0; i < 3; ++i) run.step();
  ASSERT_FALSE(run.done());
  expectSame(predictionOf(guard_, 0ms, workpieces_), expected);
}

TEST(SlowDetectorTest, TimeForOtherThingsIsNotThePredictions) {
  SlowGuard guard;
  guard.cost = 500us;
  for (int i = 0; i < 10; ++i) guard.cycle();
  ASSERT_EQ(guard.prediction.sweeps_made, 21U);
  const size_t volumes = guard.prediction.objects[0].volumes_tested;
  guard.between = [&guard] { guard.spend(10ms); };
  for (int i = 0; i < 10; ++i) guard.cycle();
  EXPECT_EQ(guard.prediction.sweeps_made, 21U);
  EXPECT_EQ(guard.prediction.objects[0].volumes_tested, volumes);
}

TEST(GuardOptionsTest, RefusedOnesNameWhatIsWrong) {
  const auto refused = [](const std::function<void(GuardOptions&)>& spoil) {
    GuardOptions options;
    spoil(options);
    EXPECT_THROW(Guard(Tool::cylinder(0.005, 0.1), std::make_unique<ReferenceDetector>(), options), InvalidInput);
  };
  refused([](auto& options) { options.cycle = 0ms; });
  refused([](auto& options) { options.horizon.reflex_step = 0ms; });
  refused([](auto& options) { options.horizon.considered = options.horizon.reflex; });
  refused([](auto& options) { options.predictor.predictor = "oracle"; });
}

}  // namespace
}  // namespace sweep_guard_core
