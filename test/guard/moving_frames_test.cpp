#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/libccd_overlap.h"
#include "guard/guard_results.h"
#include "guard/path_in_mesh.h"
#include "guard/pose_history.h"
#include "scenes.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/geometry/link_surface.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

const std::string kOtherTool = "other";

GuardOptions timeless() {
  GuardOptions options;
  options.predictor.predictor = "constant_velocity";
  options.clock = [] { return SteadyTime(); };
  return options;
}

// Poses at ascending times: between two, lerp and slerp, written down once more.
struct Course {
  std::vector<Time> stamps;
  std::vector<Eigen::Isometry3d> poses;

  void add(Time stamp, const Eigen::Isometry3d& X) {
    stamps.push_back(stamp);
    poses.push_back(X);
  }
  Eigen::Isometry3d at(Time time) const {
    size_t i = 1;
    while (i + 1 < stamps.size() && stamps[i] < time) ++i;
    const double share = toSeconds(time - stamps[i - 1]) / toSeconds(stamps[i] - stamps[i - 1]);
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation() = poses[i - 1].translation() + share * (poses[i].translation() - poses[i - 1].translation());
    const Eigen::Quaterniond from(poses[i - 1].linear());
    X.linear() = from.slerp(share, Eigen::Quaterniond(poses[i].linear())).toRotationMatrix();
    return X;
  }
};

struct Placed {
  const ConvexShape& shape;
  const Eigen::Isometry3d& X;
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const {
    return X * shape.supportPoint(X.linear().transpose() * direction);
  }
};

bool overlap(const Tool& a, const Eigen::Isometry3d& X_WA, const Tool& b, const Eigen::Isometry3d& X_WB) {
  for (const ConvexPiece& one : a.pieces()) {
    for (const ConvexPiece& other : b.pieces()) {
      if (overlapByLibccd(Placed{one.shape_T, X_WA}, Placed{other.shape_T, X_WB})) return true;
    }
  }
  return false;
}

Tool randomBody(Random& random) {
  std::vector<ConvexPiece> pieces;
  for (int i = random.below(2); i >= 0; --i) {
    const double padding = random.chance(0.3) ? random.uniform(0.0, 0.01) : 0.0;
    pieces.push_back({"link", randomShape(random, /*hull_points=*/12)
                                  .padded(padding)
                                  .placed(random.pose(random.inBox({0.05, 0.05, 0.05})))});
  }
  return Tool(pieces);
}

std::shared_ptr<const Workpiece> asWorkpiece(const Tool& body) {
  const LinkSurface surface = linkSurfaces(body)[0];
  return std::make_shared<const Workpiece>(Workpiece{"/other/link", 0, Time(1s), SteadyTime{}, kOtherTool,
                                                     TriangleMesh(surface.vertices_B, surface.triangles)});
}

// Every 10 ms or so, from about `place` to about there again.
Course randomCourse(Random& random, const Eigen::Vector3d& place, int poses) {
  Course course;
  Time stamp(1s + std::chrono::microseconds(random.below(10000)));
  Eigen::Isometry3d X = random.pose(place);
  for (int i = 0; i < poses; ++i) {
    course.add(stamp, X);
    stamp += std::chrono::microseconds(500 + random.below(20000));
    X.translation() += random.inBox({0.08, 0.08, 0.08});
    if (random.chance(0.8)) X.linear() = X.linear() * random.turn(random.uniform(0.0, 0.7));
  }
  return course;
}

// A tool and a body of another tool that both move, and what a guard says of them.
class TwoTools {
 public:
  /// @param share  of the poses of the other tool that the guard gets
  TwoTools(Random& random, double share)
      : random_(random),
        share_(share),
        tool_(randomBody(random)),
        other_(randomBody(random)),
        workpieces_{asWorkpiece(other_)},
        guard_(tool_, makeDetector("halfspace"), timeless()) {
    course_ = randomCourse(random, Eigen::Vector3d::Zero(), 6);
    other_course_ = randomCourse(random, random.uniform(0.05, 0.4) * random.direction(), 8);
  }

  // In any order, and of the other tool only some, with bounds.
  void sweep() {
    SparseMotion sparse(other_.boundingRadius());
    size_t next = 0;
    const auto hear = [&] {
      sparse.add(other_course_.stamps[next], {other_course_.poses[next]});
      const bool end = next == 0 || next + 1 == other_course_.stamps.size();
      if (end || random_.chance(share_)) {
        const BodyPose pose = sparse.take();
        motion_.measured.push_back({other_course_.stamps[next], pose.X_WB, pose.deviation_bound});
      }
      ++next;
    };
    hear();
    for (size_t i = 0; i < course_.stamps.size(); ++i) {
      while (next < other_course_.stamps.size() && random_.chance(0.6)) hear();
      follow();
      const PoseWithFrames pose{course_.stamps[i], {}, course_.poses[i]};
      if (i + 1 < course_.stamps.size() && random_.chance(0.3)) {
        guard_.pass(pose);
      } else {
        add(reportOf(guard_, pose, workpieces_));
      }
    }
    while (next < other_course_.stamps.size()) hear();
    follow();
    add(reportOf(guard_, {course_.stamps.back() + 1ms, {}, course_.poses.back()}, workpieces_));
  }

  bool contact() const { return contact_; }
  bool overlaps() const {
    const Time from = std::max(course_.stamps.front(), other_course_.stamps.front());
    const Time to = std::min(course_.stamps.back(), other_course_.stamps.back());
    for (int i = 0; i <= 150 && from < to; ++i) {
      const Time time = from + (to - from) * i / 150;
      if (overlap(tool_, course_.at(time), other_, other_course_.at(time))) return true;
    }
    return false;
  }

 private:
  void follow() {
    if (motion_.measured.empty()) return;
    guard_.follow(
        std::make_shared<const FrameMotions>(FrameMotions{{kOtherTool, std::make_shared<const FrameMotion>(motion_)}}));
  }
  void add(const SweepReport& report) { contact_ = contact_ || report.contact(); }

  Random& random_;
  double share_;
  Tool tool_;
  Tool other_;
  Workpieces workpieces_;
  Guard guard_;
  Course course_;
  Course other_course_;
  FrameMotion motion_;
  bool contact_ = false;
};

struct Count {
  int overlaps = 0;
  int contacts = 0;
};

Count countPairs(int pairs, double share, std::uint64_t seed) {
  Random random(seed);
  Count count;
  for (int i = 0; i < pairs; ++i) {
    TwoTools tools(random, share);
    tools.sweep();
    const bool overlap = tools.overlaps();
    EXPECT_TRUE(tools.contact() || !overlap) << "pair " << i;
    count.overlaps += overlap ? 1 : 0;
    count.contacts += tools.contact() ? 1 : 0;
  }
  testing::Test::RecordProperty("pairs", pairs);
  testing::Test::RecordProperty("overlaps", count.overlaps);
  testing::Test::RecordProperty("contacts", count.contacts);
  EXPECT_GT(count.overlaps, pairs / 5);
  EXPECT_LT(count.contacts, pairs * 9 / 10) << "a guard that always warns misses nothing";
  return count;
}

TEST(MovingFramesTest, NoContactOfTwoToolsThatMoveIsMissed) {
  const Count count = countPairs(sceneCount(10000, 3), 1.0, 11);
  EXPECT_LT(count.contacts, count.overlaps * 6 / 5);
}

TEST(MovingFramesTest, NoContactIsMissedWhereNotAllPosesCome) { countPairs(sceneCount(10000, 3), 0.6, 13); }

FrameMotion moving(const std::function<Eigen::Isometry3d(double)>& X_WM, Time from) {
  FrameMotion motion;
  for (int i = -20; i <= 0; ++i) motion.measured.push_back({from + i * 10ms, X_WM(0.01 * i), 0.0});
  motion.predicted_from = from;
  for (int i = 0; i <= 22; ++i) motion.predicted.push_back({i * 50ms, X_WM(0.05 * i)});
  return motion;
}

class PredictedFramesTest : public testing::Test {
 protected:
  // The tool moves along, up to 10 s; the other tool has measured its own motion up to then, and predicts it from a bit before.
  Prediction predict(const Eigen::Vector3d& from, const Eigen::Vector3d& velocity, const FrameMotion& motion) {
    guard_.follow(
        std::make_shared<const FrameMotions>(FrameMotions{{kOtherTool, std::make_shared<const FrameMotion>(motion)}}));
    for (int i = -9; i <= 0; ++i)
      reportOf(guard_, {Time(10s + i * 10ms), {}, placedAt(from + 0.01 * i * velocity)}, workpieces_);
    return predictionOf(guard_, 0ms, workpieces_);
  }

  const Tool ball_ = Tool(ConvexShape::sphere(0.01));
  Workpieces workpieces_ = {asWorkpiece(ball_)};
  Guard guard_{ball_, makeDetector("halfspace"), timeless()};
};

// They meet after (0.17 m - 0.02 m) / 0.3 m/s; if one of them stayed where it is, it would take twice as long or longer.
TEST_F(PredictedFramesTest, TwoToolsThatMoveMeetInTime) {
  const auto towards = [](double t) { return placedAt({0.17 - 0.15 * t, 0.0, 0.0}); };
  const Prediction prediction = predict({0, 0, 0}, {0.15, 0, 0}, moving(towards, Time(9980ms)));
  ASSERT_TRUE(prediction.complete());
  EXPECT_EQ(prediction.coveredUntil(), Time(11100ms));
  ASSERT_TRUE(prediction.firstContact());
  EXPECT_NEAR(toSeconds(*prediction.firstContact()), 0.5 - 0.01, 0.03) << "the prediction begins 20 ms later";
}

TEST_F(PredictedFramesTest, AToolThatRestsIsMetInTime) {
  const auto towards = [](double t) { return placedAt({0.17 - 0.3 * t, 0.0, 0.0}); };
  const Prediction prediction = predict({0, 0, 0}, {0, 0, 0}, moving(towards, Time(10s)));
  ASSERT_TRUE(prediction.firstContact());
  EXPECT_NEAR(toSeconds(*prediction.firstContact()), 0.5, 0.02);
}

TEST_F(PredictedFramesTest, ToolsThatMoveAlikeDoNotMeet) {
  const auto along = [](double t) { return placedAt({0.15 + 0.3 * t, 0.0, 0.0}); };
  const Prediction prediction = predict({0, 0, 0}, {0.3, 0, 0}, moving(along, Time(10s)));
  ASSERT_TRUE(prediction.complete());
  EXPECT_FALSE(prediction.firstContact());
}

TEST_F(PredictedFramesTest, NothingIsCoveredWithoutThePredictionOfTheOther) {
  FrameMotion motion = moving([](double) { return placedAt({1.0, 0.0, 0.0}); }, Time(10s));
  motion.predicted.clear();
  const Prediction prediction = predict({0, 0, 0}, {0, 0, 0}, motion);
  EXPECT_EQ(prediction.unplaced, workpieces_);
  EXPECT_EQ(prediction.coveredUntil(), Time(10s));
}

TEST_F(PredictedFramesTest, AContactIsProbableWhereTheOtherMayErr) {
  const auto aside = [](double) { return placedAt({0.0, 0.08, 0.0}); };
  FrameMotion motion = moving(aside, Time(10s));
  const auto probability = [&] {
    return predict({0, 0, 0}, {0, 0, 0}, motion).probability(PredictionInterval::kConsidered, 1s);
  };
  const double certain = probability();
  for (PredictedFrame& pose : motion.predicted) pose.covariance(1, 1) = std::pow(0.2 * toSeconds(pose.ahead), 2);
  guard_.reset();
  EXPECT_GT(probability(), certain + 0.05);
}

// Any two steady motions, the other one turning, too.
TEST_F(PredictedFramesTest, NoPredictedContactIsMissed) {
  Random random(12);
  int overlaps = 0;
  int contacts = 0;
  const int pairs = sceneCount(10000, 3);
  for (int i = 0; i < pairs; ++i) {
    const Tool tool = randomBody(random);
    const Tool other = randomBody(random);
    const Workpieces workpieces = {asWorkpiece(other)};
    Guard guard(tool, makeDetector("halfspace"), timeless());
    const Eigen::Vector3d velocity = random.inBox({0.4, 0.4, 0.4});
    const Eigen::Isometry3d begin = random.pose(random.inBox({0.4, 0.4, 0.4}));
    const Eigen::Vector3d drift = random.inBox({0.4, 0.4, 0.4});
    const Eigen::Vector3d axis = random.direction();
    const double rate = random.uniform(0.0, 3.0);
    const auto moves = [&](double t) {
      Eigen::Isometry3d X = begin;
      X.linear() = Eigen::AngleAxisd(rate * t, axis) * begin.linear();
      X.translation() += t * drift;
      return X;
    };
    const FrameMotion motion = moving(moves, Time(10s - std::chrono::milliseconds(random.below(60))));
    guard.follow(
        std::make_shared<const FrameMotions>(FrameMotions{{kOtherTool, std::make_shared<const FrameMotion>(motion)}}));
    for (int k = -9; k <= 0; ++k)
      reportOf(guard, {Time(10s + k * 10ms), {}, placedAt(0.01 * k * velocity)}, workpieces);
    const Prediction prediction = predictionOf(guard, 10ms, workpieces);
    ASSERT_TRUE(prediction.complete());
    Course course;
    course.add(prediction.stamp, placedAt(Eigen::Vector3d::Zero()));
    for (const PredictedPose& pose : prediction.path) course.add(prediction.stamp + pose.ahead, pose.X_WT);
    const auto contact = prediction.firstContact();
    contacts += contact ? 1 : 0;
    for (int k = 0; k <= 200; ++k) {
      const Duration ahead = prediction.path.back().ahead * k / 200;
      const Time time = prediction.stamp + ahead;
      if (!overlap(tool, course.at(time), other, motion.at(time)->X_WM)) continue;
      ++overlaps;
      ASSERT_TRUE(contact && *contact <= ahead) << "pair " << i;
      break;
    }
  }
  RecordProperty("overlaps", overlaps);
  RecordProperty("contacts", contacts);
  EXPECT_GT(overlaps, pairs / 20);
  EXPECT_LT(contacts, overlaps * 3 / 2);
}

}  // namespace
}  // namespace sweep_guard_core
