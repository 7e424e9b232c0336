#include "soundness/late.h"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>

#include "soundness/exact_motion.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_core::soundness {
namespace {

using Eigen::Isometry3d;

constexpr int kToolPoses = 30;
constexpr int kContacts = 60;  // of each workpiece
constexpr size_t kMaxTransforms = 300;
constexpr double kDeep = 1e-9;  // [m]: more than what poses are rounded by
const Time kBegin(std::chrono::seconds(100));

// Poses at ascending times.
struct PoseTrack {
  std::vector<Time> stamps;
  std::vector<Isometry3d> poses;

  size_t size() const { return stamps.size(); }
  Motion motion(size_t end, const Isometry3d& before = Isometry3d::Identity(),
                const Isometry3d& after = Isometry3d::Identity()) const {
    return {before * poses[end - 1] * after, before * poses[end] * after};
  }
  // @param late  the motion begins so much after its first stamp
  Real fraction(size_t end, Time time, Duration late = {}) const {
    const Time begin = stamps[end - 1] + late;
    return static_cast<Real>((time - begin).count()) / static_cast<Real>((stamps[end] - begin).count());
  }
  size_t endOfMotionAt(Time time) const {
    const auto end = std::lower_bound(stamps.begin() + 1, stamps.end() - 1, time);
    return static_cast<size_t>(end - stamps.begin());
  }
};

PoseTrack randomTrack(Random& random, Time begin, double period, size_t count, double step) {
  PoseTrack track;
  Time stamp = begin;
  Isometry3d X = random.pose(random.inBox(step * Eigen::Vector3d::Ones()));
  for (size_t i = 0; i < count; ++i) {
    track.stamps.push_back(stamp);
    track.poses.push_back(X);
    stamp += std::max(fromSeconds(period * random.uniform(0.3, 1.7)), Duration(1000));
    X.translation() += random.inBox(step * Eigen::Vector3d::Ones());
    X.linear() = X.linear() * random.turn(random.uniform(0.0, 0.6));
  }
  return track;
}

// When each of them arrives, in their order.
std::vector<Time> arrivals(Random& random, const PoseTrack& track, double delay) {
  std::vector<Time> times;
  for (const Time stamp : track.stamps) {
    const Time time = stamp + fromSeconds(delay * random.uniform(0.5, 1.5));
    times.push_back(times.empty() ? time : std::max(time, times.back()));
  }
  return times;
}

struct KnownContact {
  size_t workpiece;  // 0: table, 1: tray
  std::uint32_t triangle;
  Time known_from;  // stamp up to which tool and frame have to be known
};

// The tool moves, the table rests and the tray moves. One of them may be placed anew.
struct LateScene {
  enum class Anew { kNothing, kTable, kTool, kTray };

  Bodies tool;
  PoseTrack tool_W;
  PoseTrack tray_W;
  Isometry3d X_WTable = Isometry3d::Identity();
  Anew anew = Anew::kNothing;
  size_t anew_from = 0;  // pose of the tool, or transform of the tray
  Isometry3d change = Isometry3d::Identity();
  std::array<Triangles, 2> triangles;
  std::vector<KnownContact> contacts;

  bool isAnew(Anew what, size_t index) const { return anew == what && index >= anew_from; }
  Isometry3d toolChange(bool changed) const { return changed && anew == Anew::kTool ? change : Isometry3d::Identity(); }
  Isometry3d tablePose(bool changed) const { return changed && anew == Anew::kTable ? X_WTable * change : X_WTable; }
  Isometry3d trayPose(size_t i) const { return isAnew(Anew::kTray, i) ? tray_W.poses[i] * change : tray_W.poses[i]; }
  Duration trayBegins(size_t end) const { return Duration(anew == Anew::kTray && end == anew_from ? 1 : 0); }
  Isometry3d toolPose(size_t i) const { return isAnew(Anew::kTool, i) ? change * tool_W.poses[i] : tool_W.poses[i]; }
};

Vector3r deepPoint(Random& random, const Body& body, Real inset) {
  const Vector3r p = support(body, random.direction().cast<Real>(), inset);
  const Vector3r q = support(body, random.direction().cast<Real>(), inset);
  return p + static_cast<Real>(random.uniform(0.0, 1.0)) * (q - p);
}

void addTriangle(Random& random, const Vector3r& p_M, double size, Triangles& triangles) {
  const double u = random.uniform(0.0, 1.0);
  const double v = random.uniform(0.0, 1.0) * (1.0 - u);
  const Eigen::Vector3d first_edge = size * random.direction();
  const Eigen::Vector3d second_edge = size * random.direction();
  const Eigen::Vector3d corner = p_M.cast<double>() - u * first_edge - v * second_edge;
  triangles.corners_M.insert(triangles.corners_M.end(), {corner, corner + first_edge, corner + second_edge});
}

class SceneMaker {
 public:
  explicit SceneMaker(Random& random) : random_(random) {}

  LateScene make() {
    makeTool();
    const double step = size_ * random_.uniform(0.05, 1.5);
    const double period = random_.logUniform(0.002, 0.06);
    scene_.tool_W = randomTrack(random_, kBegin, period, kToolPoses, step);
    const double seldom = random_.logUniform(0.003, 0.4);
    const size_t count = std::min(kMaxTransforms, static_cast<size_t>(2.0 * kToolPoses * period / seldom) + 4);
    scene_.tray_W = randomTrack(random_, kBegin - fromSeconds(random_.uniform(0.0, seldom)), seldom, count, step);
    scene_.X_WTable = random_.pose(random_.inBox(size_ * Eigen::Vector3d::Ones()));
    scene_.anew = static_cast<LateScene::Anew>(random_.below(4));
    const size_t last = scene_.anew == LateScene::Anew::kTray ? count - 1 : kToolPoses - 1;
    scene_.anew_from = 1 + static_cast<size_t>(random_.below(static_cast<int>(last)));
    scene_.change = random_.pose(random_.inBox(size_ * Eigen::Vector3d::Ones()));
    for (int i = 0; i < kContacts; ++i) {
      addToTable();
      addToTray();
    }
    for (Triangles& triangles : scene_.triangles) {
      if (triangles.count() == 0) addTriangle(random_, Vector3r::Constant(1000), size_, triangles);
    }
    return scene_;
  }

 private:
  void makeTool() {
    do {
      scene_.tool = randomBodies(random_, random_.logUniform(0.01, 0.2));
      size_ = extentOf(scene_.tool);
    } while (!hasInset(scene_.tool.front(), kDeep));
  }

  Vector3r point() { return deepPoint(random_, scene_.tool.front(), kDeep); }
  double triangleSize() { return size_ * random_.logUniform(1e-3, 1.0); }
  Time timeBetween(Time from, Time to) {
    return from +
           Duration(static_cast<Duration::rep>(random_.uniform(0.0, 1.0) * static_cast<double>((to - from).count())));
  }
  void add(size_t workpiece, const Vector3r& p_M, Time known_from) {
    Triangles& triangles = scene_.triangles[workpiece];
    scene_.contacts.push_back({workpiece, static_cast<std::uint32_t>(triangles.count()), known_from});
    addTriangle(random_, p_M, triangleSize(), triangles);
  }

  // The way to the pose at which something was placed anew is swept in both places.
  void addToTable() {
    const size_t end = 1 + static_cast<size_t>(random_.below(kToolPoses - 1));
    const bool placed = scene_.anew == LateScene::Anew::kTable || scene_.anew == LateScene::Anew::kTool;
    const bool both = placed && end == scene_.anew_from && random_.chance(0.5);
    const bool changed = placed && (end > scene_.anew_from || both);
    const Time time = timeBetween(scene_.tool_W.stamps[end - 1], scene_.tool_W.stamps[end]);
    const ExactMotion tool(scene_.tool_W.motion(end, scene_.toolChange(changed)));
    const Isometry3d X_WM = scene_.tablePose(changed);
    const Vector3r p_W = tool.at(scene_.tool_W.fraction(end, time), point());
    add(0, ExactMotion(Motion{X_WM, X_WM}).inTool(0, p_W), scene_.tool_W.stamps[end]);
  }

  // Where the tray is placed anew at its newest transform, both places count from there on.
  void addToTray() {
    const PoseTrack& tray = scene_.tray_W;
    const Time from = std::max(scene_.tool_W.stamps.front(), tray.stamps.front());
    const Time to = std::min(scene_.tool_W.stamps.back(), tray.stamps.back());
    if (from >= to) return;
    const Time time = timeBetween(from, to);
    const size_t end = scene_.tool_W.endOfMotionAt(time);
    const size_t tray_end = tray.endOfMotionAt(time);
    if (scene_.anew == LateScene::Anew::kTool && end == scene_.anew_from) return;  // where the tray is then is not kept
    const Duration late = scene_.trayBegins(tray_end);
    if (time <= tray.stamps[tray_end - 1] + late) return;
    const bool changed = scene_.isAnew(LateScene::Anew::kTray, tray_end);
    const ExactMotion tool(scene_.tool_W.motion(end, scene_.toolChange(end > scene_.anew_from)));
    const ExactMotion frame(
        tray.motion(tray_end, Isometry3d::Identity(), changed ? scene_.change : Isometry3d::Identity()));
    const Vector3r p_W = tool.at(scene_.tool_W.fraction(end, time), point());
    add(1, frame.inTool(tray.fraction(tray_end, time, late), p_W), time);
  }

  Random& random_;
  LateScene scene_;
  double size_ = 1.0;
};

// Feeds a guard as the node does.
class LateSession {
 public:
  LateSession(Random& random, const LateScene& scene)
      : random_(random),
        scene_(scene),
        workpieces_{workpiece("table", 0), workpiece("tray", 1)},
        guard_(toolOf(scene.tool), makeDetector("halfspace"), options()),
        monitor_({std::chrono::milliseconds(100), Duration::max(), std::chrono::hours(1)}) {
    monitor_.setWorkpieces(workpieces_);
  }

  void play() {
    const std::vector<Time> poses = arrivals(random_, scene_.tool_W, random_.logUniform(1e-4, 0.05));
    const std::vector<Time> transforms = arrivals(random_, scene_.tray_W, random_.logUniform(1e-4, 0.2));
    hearTray(transforms[0]);
    while (next_pose_ < poses.size() || next_transform_ < transforms.size()) {
      const bool is_pose = next_transform_ == transforms.size() ||
                           (next_pose_ < poses.size() && poses[next_pose_] < transforms[next_transform_]);
      if (is_pose) {
        hearPose(poses[next_pose_]);
      } else {
        hearTray(transforms[next_transform_]);
      }
    }
  }

  size_t missed() const { return missed_.size(); }
  size_t unwarned() const { return unwarned_; }

 private:
  static GuardOptions options() {
    GuardOptions options;
    options.predictor.predictor = "constant_velocity";
    options.clock = [] { return SteadyTime(); };
    return options;
  }

  std::shared_ptr<const Workpiece> workpiece(const std::string& frame, size_t i) const {
    return std::make_shared<const Workpiece>(
        Workpiece{frame, 0, kBegin - std::chrono::seconds(1), SteadyTime{}, frame, scene_.triangles[i].mesh()});
  }

  void hearTray(Time at) {
    const size_t i = next_transform_++;
    const PoseTrack& tray = scene_.tray_W;
    if (i > 0 && i == scene_.anew_from && scene_.anew == LateScene::Anew::kTray) {
      const Time stamp = tray.stamps[i - 1] + Duration(1);
      store_.add("tray", {stamp, tray.poses[i - 1] * scene_.change, 0.0, /*anew=*/true});
    }
    for (const Time stamp : wanted_) {
      if (i > 0 && tray.stamps[i - 1] + Duration(1) < stamp && stamp < tray.stamps[i]) sampleTray(i, stamp);
    }
    wanted_.erase(wanted_.begin(), std::upper_bound(wanted_.begin(), wanted_.end(), tray.stamps[i]));
    store_.add("tray", {tray.stamps[i], scene_.trayPose(i)});
    monitor_.frameHeard("tray", tray.stamps[i], instant(at));
    if (!swept_ || passed_ || random_.chance(0.1)) return;
    guard_.follow(store_.get());
    guard_.sweepOn(workpieces_, report_);
    take(at);
  }

  void sampleTray(size_t end, Time stamp) {
    const bool changed = scene_.isAnew(LateScene::Anew::kTray, end);
    const Motion motion =
        scene_.tray_W.motion(end, Isometry3d::Identity(), changed ? scene_.change : Isometry3d::Identity());
    store_.add("tray",
               {stamp, motion.at(static_cast<double>(scene_.tray_W.fraction(end, stamp, scene_.trayBegins(end))))});
  }

  void hearPose(Time at) {
    const size_t i = next_pose_++;
    const Time stamp = scene_.tool_W.stamps[i];
    const PoseTrack& tray = scene_.tray_W;
    if (stamp < tray.stamps[next_transform_ - 1]) {
      const size_t end = tray.endOfMotionAt(stamp);
      if (tray.stamps[end - 1] + Duration(1) < stamp) sampleTray(end, stamp);
    } else {
      wanted_.push_back(stamp);
    }
    const bool is_anew =
        i == scene_.anew_from && (scene_.anew == LateScene::Anew::kTable || scene_.anew == LateScene::Anew::kTool);
    if (is_anew) {
      pass(pose(stamp, scene_.tool_W.poses[i], /*changed=*/false));
      PoseWithFrames before = pose(stamp, scene_.toolChange(true) * scene_.tool_W.poses[i - 1], /*changed=*/true);
      before.anew = PlacedAnew{};
      before.anew->tool = scene_.anew == LateScene::Anew::kTool;
      if (!before.anew->tool) before.anew->frames = {"table"};
      pass(before);
    }
    const PoseWithFrames now = pose(stamp, scene_.toolPose(i), i >= scene_.anew_from);
    if (i + 1 < scene_.tool_W.size() && random_.chance(0.3)) return pass(now);
    follow();
    guard_.sweep(now, workpieces_, report_);
    swept_ = now;
    passed_ = false;
    take(at);
    store_.forgetBefore(std::min(stamp, tray.stamps[next_transform_ - 1]));
  }

  PoseWithFrames pose(Time stamp, const Isometry3d& X_WT, bool changed) {
    PoseWithFrames pose{stamp, {}, X_WT, {{"table", scene_.tablePose(changed)}}};
    placeFollowed(*store_.get(), pose);
    return pose;
  }
  void follow() { guard_.follow(store_.get()); }
  void pass(const PoseWithFrames& pose) {
    follow();
    guard_.pass(pose);
    passed_ = true;
  }

  static Instant instant(Time at) { return {at, SteadyTime(at.time_since_epoch())}; }

  void take(Time at) {
    for (const SweptObject& object : report_.objects) {
      const size_t i = object.workpiece == workpieces_[0] ? 0 : 1;
      reported_[i].insert(object.result.not_ruled_out.begin(), object.result.not_ruled_out.end());
    }
    const Instant now = instant(at);
    monitor_.swept(report_, {swept_->stamp, now.steady}, monitor_.checkpoint(), now.steady);
    const Time tray = std::min(swept_->stamp, scene_.tray_W.stamps[next_transform_ - 1]);
    bool contact = false;
    for (size_t i = 0; i < scene_.contacts.size(); ++i) {
      const KnownContact& known = scene_.contacts[i];
      if (known.known_from > (known.workpiece == 0 ? swept_->stamp : tray)) continue;
      contact = true;
      if (reported_[known.workpiece].count(known.triangle) == 0) missed_.insert(i);
    }
    if (!contact) return;
    Warning warning;
    monitor_.warning(now, warning);
    if (warning.level != WarningLevel::kContact) ++unwarned_;
  }

  Random& random_;
  const LateScene& scene_;
  Workpieces workpieces_;
  Guard guard_;
  WarningMonitor monitor_;
  FrameMotionStore store_;
  SweepReport report_;
  size_t next_pose_ = 0;
  size_t next_transform_ = 0;
  std::vector<Time> wanted_;
  std::optional<PoseWithFrames> swept_;
  bool passed_ = false;
  std::array<std::set<std::uint32_t>, 2> reported_;
  std::set<size_t> missed_;
  size_t unwarned_ = 0;
};

std::string described(const LateScene& scene, const LateSession& session) {
  std::ostringstream text;
  text << session.missed() << " of " << scene.contacts.size() << " contacts missed, " << session.unwarned()
       << " warnings without contact; placed anew: " << static_cast<int>(scene.anew) << " from " << scene.anew_from
       << "; " << scene.tray_W.size() << " transforms\n";
  return text.str();
}

}  // namespace

void checkLate(const Context& context, std::uint64_t seed) {
  Random random(seed);
  const LateScene scene = SceneMaker(random).make();
  LateSession session(random, scene);
  session.play();
  Tally& tally = context.report.of(context.detectors.front().name, context.family);
  tally.cases += scene.contacts.size();
  tally.positives += scene.contacts.size();
  tally.misses += session.missed() + session.unwarned();
  if (session.missed() + session.unwarned() == 0) return;
  context.report.fail(context.family + " " + context.about, [&] { return described(scene, session); });
}

}  // namespace sweep_guard_core::soundness
