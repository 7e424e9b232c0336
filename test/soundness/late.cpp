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
constexpr Duration kBeforeChange(1);
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
  // @param early  the motion ends so much before its last stamp
  Real fraction(size_t end, Time time, Duration early = {}) const {
    const Time begin = stamps[end - 1];
    return static_cast<Real>((time - begin).count()) / static_cast<Real>((stamps[end] - early - begin).count());
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
  std::vector<Time> tool_arrivals;
  std::vector<Time> tray_arrivals;
  Isometry3d X_WTable = Isometry3d::Identity();
  Anew anew = Anew::kNothing;
  size_t anew_from = 0;     // pose of the tool
  size_t known_before = 0;  // the newest transform of the tray then
  Isometry3d change = Isometry3d::Identity();
  std::array<Triangles, 2> triangles;
  std::vector<KnownContact> contacts;

  Time changesAt() const { return tool_W.stamps[anew_from]; }
  Duration toolEnds(size_t end) const {
    return anew != Anew::kNothing && end == anew_from ? kBeforeChange : Duration::zero();
  }
  Isometry3d toolChange(bool changed) const { return changed && anew == Anew::kTool ? change : Isometry3d::Identity(); }
  Isometry3d tablePose(bool changed) const { return changed && anew == Anew::kTable ? X_WTable * change : X_WTable; }
  Isometry3d trayChange(bool changed) const { return changed && anew == Anew::kTray ? change : Isometry3d::Identity(); }
  Isometry3d toolPose(size_t i) const { return toolChange(i >= anew_from) * tool_W.poses[i]; }
  // Between two transforms, after the change of its place or before.
  Isometry3d trayPose(size_t end, Time stamp, bool changed) const {
    return tray_W.motion(end, Isometry3d::Identity(), trayChange(changed))
        .at(static_cast<double>(tray_W.fraction(end, stamp)));
  }
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
    scene_.anew_from = 1 + static_cast<size_t>(random_.below(kToolPoses - 1));
    if (random_.chance(0.3)) letOneStampBe(scene_.changesAt(), scene_.tray_W.stamps);
    scene_.tool_arrivals = arrivals(random_, scene_.tool_W, random_.logUniform(1e-4, 0.05));
    scene_.tray_arrivals = arrivals(random_, scene_.tray_W, random_.logUniform(1e-4, 0.2));
    scene_.known_before = newestTransformAt(scene_.tool_arrivals[scene_.anew_from]);
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

  // Tool and tray are often measured together.
  static void letOneStampBe(Time stamp, std::vector<Time>& stamps) {
    const auto later = std::upper_bound(stamps.begin() + 1, stamps.end(), stamp);
    if (later != stamps.end() && *std::prev(later) < stamp) *later = stamp;
  }

  size_t newestTransformAt(Time at) const {
    const auto& times = scene_.tray_arrivals;
    const auto later = std::upper_bound(times.begin() + 1, times.end(), at);
    return static_cast<size_t>(later - times.begin()) - 1;
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

  void addToTray() {
    const PoseTrack& tray = scene_.tray_W;
    const Time from = std::max(scene_.tool_W.stamps.front(), tray.stamps.front());
    const Time to = std::min(scene_.tool_W.stamps.back(), tray.stamps.back());
    if (from >= to) return;
    const Time time = timeBetween(from, to);
    const size_t end = scene_.tool_W.endOfMotionAt(time);
    const bool both = scene_.anew == LateScene::Anew::kTray || scene_.anew == LateScene::Anew::kTool;
    if (both && end == scene_.anew_from && random_.chance(0.5)) return addToTrayAnew();
    const Duration early = scene_.toolEnds(end);
    if (time > scene_.tool_W.stamps[end] - early || !isKnown(time)) return;
    const bool changed = end > scene_.anew_from;
    const ExactMotion tool(scene_.tool_W.motion(end, scene_.toolChange(changed)));
    addToTray(tool.at(scene_.tool_W.fraction(end, time, early), point()), time, changed);
  }
  // The way to the pose at which the tool or the tray was placed anew, which takes no time.
  void addToTrayAnew() {
    const Time stamp = scene_.changesAt();
    const auto& stamps = scene_.tray_W.stamps;
    const Time known = scene_.anew == LateScene::Anew::kTray ? stamps[scene_.known_before] : stamps.back();
    if (known < stamp || stamp <= stamps.front()) return;
    const ExactMotion tool(scene_.tool_W.motion(scene_.anew_from, scene_.toolChange(true)));
    addToTray(tool.at(static_cast<Real>(random_.uniform(0.0, 1.0)), point()), stamp, /*changed=*/true);
  }
  void addToTray(const Vector3r& p_W, Time time, bool changed) {
    const size_t end = scene_.tray_W.endOfMotionAt(time);
    const ExactMotion tray(scene_.tray_W.motion(end, Isometry3d::Identity(), scene_.trayChange(changed)));
    add(1, tray.inTool(scene_.tray_W.fraction(end, time), p_W), time);
  }
  // Around the change, the tray goes on from its newest transform before, to the first one after.
  bool isKnown(Time time) const {
    const Time newest = scene_.tray_W.stamps[scene_.known_before];
    if (scene_.anew != LateScene::Anew::kTray || time <= newest || newest >= scene_.changesAt()) return true;
    const auto& stamps = scene_.tray_W.stamps;
    const auto first = std::upper_bound(stamps.begin(), stamps.end(), scene_.changesAt());
    return first != stamps.end() && time >= *first;
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
    const std::vector<Time>& poses = scene_.tool_arrivals;
    const std::vector<Time>& transforms = scene_.tray_arrivals;
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
    std::vector<FramePose> samples;
    const auto sample = [&](Time stamp) {
      if (tray_anew_from_ < stamp) samples.push_back({stamp, trayPose(stamp)});
    };
    for (const Time stamp : wanted_) {
      if (i > 0 && tray.stamps[i - 1] < stamp && stamp < tray.stamps[i]) sample(stamp);
    }
    wanted_.erase(wanted_.begin(), std::upper_bound(wanted_.begin(), wanted_.end(), tray.stamps[i]));
    sample(tray.stamps[i]);
    store_.add("tray", samples);
    monitor_.frameHeard("tray", tray.stamps[i], instant(at));
    if (!swept_ || passed_ || random_.chance(0.1)) return;
    follow();
    placeFollowed(*store_.get(), *swept_);
    guard_.sweep(*swept_, workpieces_, report_, /*arrived=*/false);
    take(at);
  }

  // As it is now, at a time that is known.
  Isometry3d trayPose(Time stamp) const {
    return scene_.trayPose(scene_.tray_W.endOfMotionAt(stamp), stamp, tray_anew_from_ > Time());
  }

  void placeTrayAnew(Time stamp) {
    const size_t newest = next_transform_ - 1;
    const auto motion = store_.find("tray");
    const auto X_old = motion->at(stamp);
    tray_anew_from_ = stamp;
    std::vector<FramePose> placed;
    const Isometry3d& X_newest = scene_.tray_W.poses[newest];
    if (stamp <= scene_.tray_W.stamps[newest] && stamp >= scene_.tray_W.stamps.front()) {
      placed.push_back({stamp, trayPose(stamp)});
    } else if (X_old) {
      placed.push_back({stamp, X_newest * scene_.change * X_newest.inverse() * X_old->X_WM});
    }
    for (const FramePose& pose : motion->measured) {
      if (stamp < pose.stamp) placed.push_back({pose.stamp, trayPose(pose.stamp)});
    }
    store_.placeAnew("tray", placed);
  }

  void hearPose(Time at) {
    const size_t i = next_pose_++;
    const Time stamp = scene_.tool_W.stamps[i];
    const PoseTrack& tray = scene_.tray_W;
    if (stamp >= tray.stamps[next_transform_ - 1]) {
      wanted_.push_back(stamp);
    } else if (stamp > tray.stamps.front()) {
      store_.add("tray", {{stamp, trayPose(stamp)}});
    }
    if (i == scene_.anew_from && scene_.anew != LateScene::Anew::kNothing) passAnew(i);
    const PoseWithFrames now = pose(stamp, scene_.toolPose(i), i >= scene_.anew_from);
    if (i + 1 < scene_.tool_W.size() && random_.chance(0.3)) return pass(now);
    follow();
    guard_.sweep(now, workpieces_, report_);
    swept_ = now;
    passed_ = false;
    take(at);
    store_.forgetBefore(stamp, *store_.get());
  }

  // The way to this pose, where things were and then where they are; it is repeated in no time.
  void passAnew(size_t i) {
    const Time stamp = scene_.tool_W.stamps[i];
    pass(pose(stamp - kBeforeChange, scene_.tool_W.poses[i], /*changed=*/false));
    if (scene_.anew == LateScene::Anew::kTray) placeTrayAnew(stamp);
    PoseWithFrames before = pose(stamp, scene_.toolChange(true) * scene_.tool_W.poses[i - 1], /*changed=*/true);
    before.anew = PlacedAnew{};
    before.anew->tool = scene_.anew == LateScene::Anew::kTool;
    if (scene_.anew == LateScene::Anew::kTable) before.anew->frames = {"table"};
    if (scene_.anew == LateScene::Anew::kTray) before.anew->frames = {"tray"};
    pass(before);
    if (random_.chance(0.5)) return;
    before.anew->goes_on = true;
    before.X_WT = scene_.toolPose(i);
    before.bodies = {{before.X_WT}};
    pass(before);
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
  Time tray_anew_from_;
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
