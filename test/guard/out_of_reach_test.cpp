#include "guard/out_of_reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "guard/clearance_by_clipping.h"
#include "guard/fake_detector.h"
#include "guard/guard_results.h"
#include "guard/path_in_mesh.h"
#include "guard/times.h"
#include "guard/two_links.h"
#include "guard/united_bodies.h"
#include "kinematics/random_robot.h"
#include "scenes.h"
#include "sweep_guard/kinematics/robot_path.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

TEST(StaysBesideTest, IsDecidedByTheBoxAroundTheMesh) {
  const TriangleMesh mesh({{4, 0, 0}, {6, 2, 0}, {6, 0, 2}}, {{0, 1, 2}});
  const Eigen::AlignedBox3d points(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1));
  EXPECT_TRUE(staysBeside(mesh, points, 2.999));
  EXPECT_FALSE(staysBeside(mesh, points, 3.0));
  EXPECT_FALSE(staysBeside(mesh, {Eigen::Vector3d(5, 1, 1), Eigen::Vector3d(5, 1, 1)}, 0.0));
}

Workpiece workpieceAt(const std::string& id, const std::string& frame, const TriangleMesh& mesh_M, int ms) {
  return {id, 0, at(ms), SteadyTime{}, frame, mesh_M};
}

// As the next message of vertices does.
std::shared_ptr<const Workpiece> updated(const Workpiece& before, std::vector<float> positions_M, Time stamp) {
  auto next = std::make_shared<Workpiece>(before);
  next->mesh_M.deform(positions_M);
  next->stamp = stamp;
  countUpdate(before, *next);
  return next;
}

// A ball of 10 mm on a slide, over a sheet that moves; another one, 10 m aside.
class BallOverASheetTest : public testing::Test {
 protected:
  static std::shared_ptr<const Robot> twoBalls() {
    return TwoLinks("ball", "other", JointType::kPrismatic, ConvexShape::sphere(0.01)).robot();
  }

  static std::vector<float> sheetAt(float z) { return {-1, -1, z, 1, -1, z, 0, 1, z}; }

  SweepReport sweep(int ms, const Eigen::Isometry3d& X_WB, const Eigen::Isometry3d& X_WM = up(0.0),
                    double deviation_bound = 0.0) {
    PoseWithFrames pose{at(ms), {}, Eigen::Isometry3d::Identity(), {{"table", X_WM}}};
    pose.bodies = {{X_WB, deviation_bound}, {X_WB * Eigen::Translation3d(10.0, 0.0, 0.0)}};
    pose.state.positions = {0.0, 0.0};
    record_.volumes.clear();
    return reportOf(guard_, pose, workpieces_);
  }

  void moveSheet(int ms, float z) { workpieces_ = {updated(*workpieces_[0], sheetAt(z), at(ms))}; }

  void place(const TriangleMesh& mesh_M) {
    workpieces_ = {std::make_shared<const Workpiece>(workpieceAt("sheet", "table", mesh_M, 0))};
  }

  const TriangleMesh sheet_ = TriangleMesh({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}});
  Workpieces workpieces_ = {std::make_shared<const Workpiece>(workpieceAt("sheet", "table", sheet_, 0))};
  FakeDetector::Record record_;
  Guard guard_{twoBalls(), std::make_unique<FakeDetector>(record_), {}};
};

// Half of the diagonal of the box around a ball is sqrt(3) radii, and so much again are the corners of a volume's box farther.
TEST_F(BallOverASheetTest, HasNoVolumeJustOutOfReachAndOneJustWithin) {
  const SweepReport beside = sweep(0, up(0.0301));
  EXPECT_TRUE(beside.complete());
  EXPECT_FALSE(beside.contact());
  EXPECT_TRUE(record_.volumes.empty());
  EXPECT_TRUE(beside.objects[0].result.fine);
  EXPECT_EQ(beside.objects[0].interval_start, at(0));
  EXPECT_FALSE(sweep(10, up(0.0299)).contact());
  EXPECT_EQ(record_.volumes.size(), 1U);
}

TEST_F(BallOverASheetTest, IsMetWhereItTouches) {
  sweep(0, up(0.0301));
  EXPECT_FALSE(sweep(10, up(0.01 + 1e-6)).contact());
  EXPECT_TRUE(sweep(20, up(0.01 - 1e-6)).contact());
}

TEST_F(BallOverASheetTest, IsMetBetweenTwoPosesOutOfReach) {
  sweep(0, up(1.0));
  const SweepReport report = sweep(10, up(-1.0));
  ASSERT_EQ(report.objects[0].result.in_contact.size(), 1U);
  EXPECT_NEAR(report.objects[0].result.in_contact[0].impact.time_of_impact, 0.495, 1e-6);
  EXPECT_FALSE(sweep(20, up(-1.0)).contact());
}

TEST_F(BallOverASheetTest, IsMetByASheetWhoseFrameMoves) {
  sweep(0, up(0.0), up(-0.5));
  EXPECT_TRUE(record_.volumes.empty());
  EXPECT_TRUE(sweep(10, up(0.0), up(0.5)).contact());
  EXPECT_FALSE(sweep(20, up(0.0), up(0.5)).contact());
}

// Seen from the table, the ball goes half around it; the dot is on the other side.
TEST_F(BallOverASheetTest, IsMetOnTheArcThatATurningFrameMakesOfItsRest) {
  const Eigen::Vector3d on_arc(std::cos(1.5), -std::sin(1.5), 0.0);
  place(TriangleMesh({on_arc, on_arc, on_arc}, {{0, 1, 2}}));
  const Eigen::Isometry3d X_WB(Eigen::Translation3d(1.0, 0.0, 0.0));
  EXPECT_FALSE(sweep(0, X_WB).contact());
  EXPECT_TRUE(record_.volumes.empty());
  EXPECT_TRUE(sweep(10, X_WB, Eigen::Isometry3d(Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitZ()))).contact());
}

TEST_F(BallOverASheetTest, IsMetByASheetThatJumpsOverIt) {
  moveSheet(0, -1.0F);
  sweep(0, up(0.0));
  EXPECT_TRUE(record_.volumes.empty());
  moveSheet(10, 1.0F);
  EXPECT_TRUE(sweep(10, up(0.0)).contact());
  EXPECT_FALSE(sweep(20, up(0.0)).contact());
  EXPECT_TRUE(record_.volumes.empty());
}

// Between two sweeps it was up and is back: only the length of its path tells.
TEST_F(BallOverASheetTest, IsMetByASheetThatIsBackAlready) {
  moveSheet(0, -1.0F);
  sweep(0, up(0.0));
  moveSheet(4, 0.5F);
  moveSheet(8, -1.0F);
  EXPECT_TRUE(sweep(10, up(0.0)).contact());
}

// It was down for a moment only, before the update that tells where the sheet was then.
TEST_F(BallOverASheetTest, IsMetWhereItWasBeforeTheUpdateCame) {
  moveSheet(0, -1.0F);
  for (int ms = 0; ms <= 16; ++ms) EXPECT_FALSE(sweep(ms, up(ms == 9 ? -0.3 : 0.5)).contact());
  moveSheet(16, -0.25F);
  EXPECT_TRUE(sweep(17, up(0.5)).contact());
}

TEST_F(BallOverASheetTest, IsMetByASheetThatCameLater) {
  const Workpieces sheet = workpieces_;
  workpieces_.clear();
  sweep(0, up(0.5));
  workpieces_ = sheet;
  const SweepReport report = sweep(10, up(-0.5));
  EXPECT_TRUE(report.contact());
  EXPECT_EQ(report.start, at(0));
}

TEST_F(BallOverASheetTest, IsMetWhereJointsMayHaveTakenIt) {
  sweep(0, up(0.5));
  EXPECT_FALSE(sweep(10, up(0.5), up(0.0), 0.48).contact());
  EXPECT_TRUE(sweep(20, up(0.5), up(0.0), 0.5).contact());
}

TEST_F(BallOverASheetTest, HasFailedOnceTheGuardIsStopped) {
  guard_.stop();
  const SweepReport report = sweep(0, up(0.5));
  EXPECT_TRUE(report.objects.empty());
  EXPECT_EQ(report.failures.size(), 1U);
}

auto valuesOf(const Eigen::Vector3d& v) { return std::tuple(v.x(), v.y(), v.z()); }

auto valuesOf(const TriangleContact& contact) {
  const Impact& impact = contact.impact;
  return std::tuple(contact.triangle, contact.piece, contact.intended, impact.time_of_impact, impact.depth,
                    valuesOf(impact.point_M), valuesOf(impact.normal_M));
}

bool areSame(const std::vector<TriangleContact>& one, const std::vector<TriangleContact>& other) {
  const auto same = [](const auto& a, const auto& b) { return valuesOf(a) == valuesOf(b); };
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), same);
}

void expectSame(const SweptObject& one, const SweptObject& other) {
  EXPECT_EQ(one.workpiece, other.workpiece);
  EXPECT_EQ(one.interval_start, other.interval_start);
  EXPECT_EQ(one.behind, other.behind);
  EXPECT_EQ(one.result.fine, other.result.fine);
  EXPECT_EQ(one.result.inside, other.result.inside);
  EXPECT_EQ(one.result.triangles, other.result.triangles);
  EXPECT_EQ(one.result.not_ruled_out, other.result.not_ruled_out);
  EXPECT_TRUE(areSame(one.result.in_contact, other.result.in_contact));
  EXPECT_EQ(one.result.allowed.triangles, other.result.allowed.triangles);
  EXPECT_TRUE(areSame(one.result.allowed.in_contact, other.result.allowed.in_contact));
}

void expectSame(const SweepReport& one, const SweepReport& other) {
  EXPECT_EQ(one.start, other.start);
  EXPECT_EQ(one.end, other.end);
  EXPECT_EQ(one.backlog, other.backlog);
  EXPECT_EQ(one.unplaced, other.unplaced);
  EXPECT_EQ(one.complete(), other.complete());
  ASSERT_EQ(one.objects.size(), other.objects.size());
  for (size_t i = 0; i < one.objects.size(); ++i) expectSame(one.objects[i], other.objects[i]);
}

Robot randomArm(Random& random) {
  KinematicTree tree = randomRobot(random, 4, /*branches=*/true);
  std::vector<std::pair<size_t, std::vector<ConvexPiece>>> pieces;
  for (size_t link = 0; link < tree.links().size(); ++link) {
    const std::string name = "link" + std::to_string(link);
    pieces.push_back({link, {{name, ConvexShape::sphere(0.02)}}});
    if (random.chance(0.7)) pieces.back().second.push_back({name, ConvexShape::cylinder(0.01, 0.08)});
  }
  return robotOf(std::move(tree), pieces);
}

// An arm among hulls that deform, some in frames that move: one guard sweeps all bodies, and leaves out those out of reach; of
// the others, each sweeps one body, wherever that is.
class ArmAmongHulls {
 public:
  explicit ArmAmongHulls(std::uint64_t seed)
      : random_(seed), robot_(std::make_shared<const Robot>(randomArm(random_))), options_(randomOptions(random_)) {
    together_ = std::make_unique<Guard>(robot_, makeDetector("halfspace"), options_);
    for (const Tool& body : robot_->tools)
      alone_.push_back(std::make_unique<Guard>(body, makeDetector("halfspace"), options_));
    for (const char* frame : {"table", "sliding", "turning"}) add(frame);
    X_WM_ = Eigen::Isometry3d(Eigen::Translation3d(random_.inBox({0.2, 0.2, 0.2})));
  }

  void step() {
    moveAll();
    const PoseWithFrames pose = nextPose();
    if (random_.chance(0.3)) return pass(pose);
    compare(pose);
    if (random_.chance(0.1)) takeBack(pose);
  }

  int contacts = 0;
  int volumes_of_all = 0;
  int volumes_in_reach = 0;

 private:
  static GuardOptions randomOptions(Random& random) {
    GuardOptions options;
    options.allowed = {{"link1", "table"}};
    options.clock = [] { return SteadyTime(); };
    options.sweep.fine = random.chance(0.7);
    options.sweep.margin = random.chance(0.5) ? 0.005 : 0.0;
    const VolumeKind kinds[] = {VolumeKind::kObb, VolumeKind::kObbPlanes, VolumeKind::kHull};
    options.sweep.volume = kinds[random.below(3)];
    return options;
  }

  static std::vector<float> positionsAt(double phase, const Eigen::Vector3d& place_M) {
    std::vector<float> positions = streamedPositions(wavyHull(10, 14, phase));
    for (size_t i = 0; i < positions.size(); ++i) positions[i] += static_cast<float>(place_M[static_cast<int>(i % 3)]);
    return positions;
  }

  void add(const std::string& frame) {
    places_M_.push_back(random_.inBox({0.4, 0.4, 0.4}));
    const TriangleMesh mesh_M = deformed(wavyHull(10, 14, 0.0), positionsAt(0.0, places_M_.back()));
    workpieces_.push_back(std::make_shared<const Workpiece>(workpieceAt(frame, frame, mesh_M, ms_)));
  }

  void moveAll() {
    ms_ += 1 + random_.below(15);
    if (ms_ > 150 && workpieces_.size() == 3) add("table of one that comes later");
    if (random_.chance(0.5)) X_WM_ = turned(X_WM_, 0.3);
    X_WS_ = turned(X_WS_, 0.1);
    sliding_.measured.push_back({at(ms_ - random_.below(2)), X_WS_, random_.chance(0.5) ? 0.0 : 1e-3});
    const auto frames =
        std::make_shared<const FrameMotions>(FrameMotions{{"sliding", std::make_shared<const FrameMotion>(sliding_)}});
    forEachGuard([&](Guard& guard) { guard.follow(frames); });
    for (size_t i = 0; i < workpieces_.size(); ++i) {
      if (!random_.chance(0.3)) continue;
      places_M_[i] += random_.inBox({0.01, 0.01, 0.01});
      const Time stamp = std::max(at(ms_ - random_.below(20)), workpieces_[i]->stamp + milliseconds(1));
      workpieces_[i] = updated(*workpieces_[i], positionsAt(0.01 * ms_, places_M_[i]), stamp);
    }
  }

  Eigen::Isometry3d turned(const Eigen::Isometry3d& X, double angle) {
    return Eigen::Translation3d(random_.inBox({0.02, 0.02, 0.02})) * X * Eigen::Isometry3d(random_.turn(angle));
  }

  PoseWithFrames nextPose() {
    const RobotState from = state_;
    state_ = randomStateNear(random_, from, random_.chance(0.1) ? 0.3 : 0.02);
    const RobotMotion motion(robot_->tree, robot_->bodies, from, state_);
    std::vector<Eigen::Isometry3d> X_WB;
    bodyPoses(robot_->tree, robot_->bodies, state_, X_WB);
    PoseWithFrames pose{at(ms_), {}, state_.X_WR, {{"table", up(0.0)}, {"table of one that comes later", up(0.1)}}};
    if (random_.chance(0.9)) pose.X_WM["turning"] = X_WM_;
    pose.bodies.clear();
    for (size_t i = 0; i < X_WB.size(); ++i) pose.bodies.push_back({X_WB[i], motion.deviationBound(i, 1)});
    pose.state = state_;
    return pose;
  }

  static PoseWithFrames ofBody(PoseWithFrames pose, size_t body) {
    pose.bodies = {pose.bodies[body]};
    pose.X_WT = pose.bodies[0].X_WB;
    return pose;
  }

  template <typename Work>
  void forEachGuard(const Work& work) {
    work(*together_);
    for (const auto& guard : alone_) work(*guard);
  }

  void pass(const PoseWithFrames& pose) {
    together_->pass(pose);
    for (size_t body = 0; body < alone_.size(); ++body) alone_[body]->pass(ofBody(pose, body));
  }

  void takeBack(const PoseWithFrames& pose) {
    forEachGuard([](Guard& guard) { guard.takeBack(); });
    compare(pose);
  }

  void compare(const PoseWithFrames& pose) {
    const SweepReport all = reportOf(*together_, pose, workpieces_);
    SweepReport expected;
    size_t first_piece = 0;
    for (size_t body = 0; body < alone_.size(); ++body) {
      SweepReport one = reportOf(*alone_[body], ofBody(pose, body), workpieces_);
      if (body == 0) expected = one;
      if (body > 0) unite(expected, one, first_piece);
      first_piece += robot_->tools[body].pieces().size();
    }
    expectSame(all, expected);
    contacts += all.contact() ? 1 : 0;
    volumes_in_reach += volumesOf(all);
    volumes_of_all += volumesOf(expected);
  }

  static int volumesOf(const SweepReport& report) {
    int volumes = 0;
    for (const SweptObject& object : report.objects) volumes += static_cast<int>(object.result.volumes_M.size());
    return volumes;
  }

  Random random_;
  std::shared_ptr<const Robot> robot_;
  GuardOptions options_;
  std::unique_ptr<Guard> together_;
  std::vector<std::unique_ptr<Guard>> alone_;
  RobotState state_{Eigen::Isometry3d::Identity(), std::vector<double>(robot_->tree.variables().size(), 0.0)};
  Workpieces workpieces_;
  std::vector<Eigen::Vector3d> places_M_;
  Eigen::Isometry3d X_WM_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_WS_ = Eigen::Isometry3d::Identity();
  FrameMotion sliding_;
  int ms_ = 0;
};

TEST(OutOfReachTest, ChangesNothingThatIsMetHoweverToolFramesAndMeshesMove) {
  int contacts = 0;
  int volumes_of_all = 0;
  int volumes_in_reach = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ArmAmongHulls scene(seed);
    for (int i = 0; i < 40 && !testing::Test::HasFailure(); ++i) scene.step();
    contacts += scene.contacts;
    volumes_of_all += scene.volumes_of_all;
    volumes_in_reach += scene.volumes_in_reach;
  }
  RecordProperty("contacts", contacts);
  EXPECT_GT(contacts, 100);
  EXPECT_LT(volumes_in_reach, volumes_of_all * 9 / 10);
  EXPECT_GT(volumes_in_reach, volumes_of_all / 10);
}

using namespace std::chrono_literals;

constexpr double kMargin = 0.002;        // [m]
constexpr double kStepTolerance = 1e-3;  // [standard deviations]
constexpr double kMaxTurn = 0.1;         // [rad]

Tool randomTool(Random& random) {
  std::vector<ConvexPiece> pieces;
  for (int i = random.below(5); i >= 0; --i) {
    pieces.push_back(
        {"link", randomShape(random, /*hull_points=*/6).placed(random.pose(random.inBox({0.1, 0.1, 0.2})))});
  }
  return Tool(pieces);
}

// Of any kind: what grows with time need not be all of it.
Matrix6d randomCovariance(Random& random) {
  Matrix6d covariance = Matrix6d::Zero();
  for (int i = random.below(4); i >= 0; --i) {
    Eigen::Matrix<double, 6, 1> error;
    error << random.logUniform(0.01, 0.1) * random.direction(), random.logUniform(0.01, 0.2) * random.direction();
    covariance += error * error.transpose();
  }
  return covariance;
}

// Two steps, so that the first pose of the second errs, too.
PredictedPath randomSteps(Random& random, const Eigen::Isometry3d& X_WT) {
  PredictedPath path;
  Eigen::Isometry3d X = X_WT;
  for (int i = 1; i <= 2; ++i) {
    X = Eigen::Translation3d(random.uniform(0.0, 0.05) * random.direction()) * X *
        random.turn(random.uniform(0.0, 0.4));
    path.push_back({i * 50ms, X, randomCovariance(random), random.chance(0.5) ? 0.0 : 0.005});
  }
  return path;
}

std::vector<PredictedFrame> randomFrame(Random& random) {
  std::vector<PredictedFrame> frame;
  Eigen::Isometry3d X = random.pose(random.inBox({0.3, 0.3, 0.3}));
  for (int i = 0; i <= 2; ++i) {
    frame.push_back({i * 50ms, X, i == 0 ? Matrix6d::Zero() : randomCovariance(random), i == 0 ? 0.0 : 0.001});
    X = Eigen::Translation3d(random.uniform(0.0, 0.05) * random.direction()) * X *
        random.turn(random.uniform(0.0, 0.3));
  }
  return frame;
}

TriangleMesh trianglesAround(Random& random, const Eigen::Vector3d& place) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      vertices.emplace_back((place + random.inBox({0.05, 0.05, 0.05})).cast<float>().cast<double>());
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return TriangleMesh(vertices, triangles);
}

Eigen::AlignedBox3d boundsOf(const TriangleMesh& mesh_M) {
  Eigen::AlignedBox3d bounds_M;
  for (std::uint32_t i = 0; i < mesh_M.vertexCount(); ++i) bounds_M.extend(mesh_M.vertex(i));
  return bounds_M;
}

// Of the step and of its parts.
double leastClearance(const PathInMesh& path_M, const PathSegment& segment, const ConvexShape& piece,
                      const TriangleMesh& mesh_M, VolumeKind kind, int halvings) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<Motion> motions_M;
  path_M.motions_M(segment, kMaxTurn, motions_M);
  for (const Motion& motion_M : motions_M) {
    const SweptVolume swept_M = sweptVolume(piece, motion_M, kind, kMargin);
    const PerHalfSpace deviations =
        planeDeviations(piece, path_M.end_M(segment).X_MT, path_M.end_M(segment).covariance_M, swept_M);
    least = std::min(least, clearanceByClipping(mesh_M, swept_M, deviations));
  }
  if (halvings == 0) return least;
  const auto [first, second] = path_M.halves(segment);
  return std::min({least, leastClearance(path_M, first, piece, mesh_M, kind, halvings - 1),
                   leastClearance(path_M, second, piece, mesh_M, kind, halvings - 1)});
}

bool holds(const Tool& tool, const Tool::Node& node, size_t piece) {
  if (node.piece) return *node.piece == piece;
  return holds(tool, tool.tree()[node.below[0]], piece) || holds(tool, tool.tree()[node.below[1]], piece);
}

TEST(UncertainStepTest, NoVolumeOfAPieceIsNearerThanItsBoundWhateverTheStepAndTheFrame) {
  Random random(/*seed=*/21);
  int near = 0;
  int far = 0;
  for (int i = 0; i < 1000; ++i) {
    const Tool tool = randomTool(random);
    const Eigen::Isometry3d X_WT = random.pose(random.inBox({0.3, 0.3, 0.3}));
    const PredictedPath path = randomSteps(random, X_WT);
    PathInMesh path_M;
    if (random.chance(0.5)) {
      path_M.follow(tool, X_WT, path, random.pose(random.inBox({0.3, 0.3, 0.3})));
    } else {
      path_M.follow(tool, X_WT, path, randomFrame(random));
    }
    const PathSegment step = path_M.between(1, 2);
    const Eigen::Vector3d beside_M = path_M.end_M(step).X_MT * tool.bounds_T().center();
    const TriangleMesh mesh_M = trianglesAround(random, beside_M + random.uniform(0.1, 0.5) * random.direction());
    const UncertainStep uncertain = path_M.uncertainStep(step, kMargin);
    const VolumeKind kind = random.chance(0.5) ? VolumeKind::kObb : VolumeKind::kObbPlanes;
    for (size_t piece = 0; piece < tool.pieces().size(); ++piece) {
      const double clearance = leastClearance(path_M, step, tool.pieces()[piece].shape_T, mesh_M, kind, 2);
      near += clearance < kMaxDeviations;
      for (const Tool::Node& node : tool.tree()) {
        if (!holds(tool, node, piece)) continue;
        const UncertainBall ball = uncertain.ballAround(node.bounds_T);
        const double least = ball.deviationsWithin(boundsOf(mesh_M).exteriorDistance(ball.center_M));
        far += least > 0.0 && clearance < kMaxDeviations;
        if (clearance < kMaxDeviations) {
          EXPECT_LE(least, std::max(0.0, clearance) + kStepTolerance) << i;
        }
      }
    }
  }
  EXPECT_GT(near, 200);
  EXPECT_GT(far, 50) << "bounds that tell apart";
}

// Its 10 mm count along each of three axes; so does a margin, in any direction.
TEST(UncertainStepTest, TheBallAroundABallIsThatAroundItsBox) {
  const Tool tool(ConvexShape::sphere(0.01));
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal() << 0.04, 0.0, 0.0, 0.0, 0.0, 0.0;
  const UncertainPose sure{Eigen::Isometry3d::Identity(), Matrix6d::Zero()};
  const UncertainPose unsure{Eigen::Isometry3d(Eigen::Translation3d(0.2, 0.0, 0.0)), covariance};
  const UncertainBall ball = UncertainStep(sure, unsure, 0.0).ballAround(tool.tree()[0].bounds_T);
  EXPECT_NEAR(ball.center_M.x(), 0.1, 1e-12);
  EXPECT_NEAR(ball.radius, 0.03 + 0.1, 1e-8);
  EXPECT_NEAR(ball.sigma, 0.2, 1e-8);
  EXPECT_NEAR(ball.deviationsWithin(0.53), 2.0, 1e-6);
  const UncertainBall grown = UncertainStep(unsure, sure, 0.1).ballAround(tool.tree()[0].bounds_T);
  EXPECT_NEAR(grown.radius, 0.03 + 0.1 + 0.1 * std::sqrt(3.0), 1e-8);
  EXPECT_NEAR(grown.sigma, 0.2, 1e-8);
}

}  // namespace
}  // namespace sweep_guard_core
