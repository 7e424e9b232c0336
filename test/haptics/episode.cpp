#include "haptics/episode.h"

#include <deque>
#include <memory>
#include <utility>

#include "haptics/planes.h"
#include "motion/random_scenes.h"
#include "sweep_guard/haptics/passive_device.h"

namespace sweep_guard_core {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kMilliseconds = 1000;
constexpr int kSteps = 10;  // of the hand in a millisecond
constexpr double kStep = 1e-3 / kSteps;
constexpr double kEpisodeRadius = 0.005;
constexpr int kMaxRun = 5;
constexpr double kMaxDelay = 0.05;

struct LinkTraits {
  double delay = 0.0;  // at most [s]
  double losses = 0.0;
};

LinkTraits randomLink(RandomScenes& random) { return {random.uniform(0.0, kMaxDelay), random.uniform(0.0, 0.3)}; }

// The longest time until a newer message acts.
double longestAge(const LinkTraits& link, double period) {
  return link.delay > 0.0 ? link.delay + kMaxRun * period + kStep : 0.0;
}

template <typename T>
class Link {
 public:
  Link(const LinkTraits& traits, RandomScenes& random) : traits_(traits), random_(random) {}

  void send(const T& value, double now) {
    if (run_ < kMaxRun && random_.chance(traits_.losses)) {
      ++run_;
      return;
    }
    run_ = 0;
    arrival_ = std::max(arrival_, now + traits_.delay * random_.uniform(0.5, 1.0));
    waiting_.emplace_back(arrival_, value);
  }

  // Takes what has arrived; returns whether there is something new.
  bool receive(double now) {
    bool any = false;
    for (; !waiting_.empty() && waiting_.front().first <= now + 1e-9; waiting_.pop_front()) {
      newest_ = waiting_.front();
      any = true;
    }
    return any;
  }

  const std::optional<std::pair<double, T>>& newest() const { return newest_; }

 private:
  const LinkTraits traits_;
  RandomScenes& random_;
  int run_ = 0;
  double arrival_ = 0.0;
  std::deque<std::pair<double, T>> waiting_;
  std::optional<std::pair<double, T>> newest_;
};

struct Located {
  Isometry3d X;
  double time;
};

// What drives a hand: a constant effort and three oscillating ones.
class Drive {
 public:
  Drive(RandomScenes& random, const Vector3d& towards_D, double unit) {
    bias_ = unit * random.uniform(0.3, 2.0) * towards_D;
    for (int i = 0; i < 3; ++i) {
      waves_.push_back({unit * random.uniform(0.3, 2.5) * (random.chance(0.5) ? towards_D : random.direction()),
                        random.logUniform(2.0, 60.0), random.uniform(0.0, 6.28)});
    }
  }

  Vector3d at(double now) const {
    Vector3d effort = bias_;
    for (const Wave& wave : waves_) effort += std::sin(wave.rate * now + wave.phase) * wave.amplitude;
    return effort;
  }

 private:
  struct Wave {
    Vector3d amplitude;
    double rate;  // [rad/s]
    double phase;
  };
  Vector3d bias_;
  std::vector<Wave> waves_;
};

// Each axis has its own limits.
class Hand {
 public:
  Hand(RandomScenes& random, const HandLimits& limits, const Vector3d& towards_D)
      : limits_(limits),
        mass_(random.uniform(0.1, 0.5)),
        damping_(random.uniform(1.0, 4.0)),
        drive_(random, towards_D, /*unit=*/1.0) {}

  Vector3d move(const Vector3d& force_D, double now) {
    const Vector3d acceleration = (force_D + drive_.at(now) - damping_ * velocity_) / mass_;
    velocity_ += kStep * acceleration.cwiseMin(limits_.max_acceleration).cwiseMax(-limits_.max_acceleration);
    velocity_ = velocity_.cwiseMin(limits_.max_speed).cwiseMax(-limits_.max_speed);
    Vector3d way = kStep * velocity_;
    position_ += way;
    return way;
  }

  const Vector3d& position() const { return position_; }

 private:
  const HandLimits limits_;
  const double mass_;
  const double damping_;
  const Drive drive_;
  Vector3d position_ = Vector3d::Zero();
  Vector3d velocity_ = Vector3d::Zero();
};

Vector3d shortened(const Vector3d& vector, double length) {
  return vector.norm() > length ? Vector3d(vector * (length / vector.norm())) : vector;
}

// The wrist that turns the device; all axes together have a limit.
class Wrist {
 public:
  Wrist(RandomScenes& random, const HandLimits& limits, const Vector3d& towards_D)
      : limits_(limits),
        inertia_(random.logUniform(1e-4, 1e-3)),
        damping_(random.uniform(5e-3, 2e-2)),
        drive_(random, towards_D, /*unit=*/0.04) {}

  Vector3d turn(const Vector3d& torque_D, double now) {
    const Vector3d acceleration = (torque_D + drive_.at(now) - damping_ * rate_) / inertia_;
    rate_ = shortened(rate_ + kStep * shortened(acceleration, limits_.max_turn_acceleration), limits_.max_turn_rate);
    Vector3d way = kStep * rate_;
    const Eigen::AngleAxisd turn(way.norm(), way.stableNormalized());
    orientation_ = (turn * orientation_).normalized();
    return way;
  }

  const Eigen::Quaterniond& orientation() const { return orientation_; }

 private:
  const HandLimits limits_;
  const double inertia_;
  const double damping_;
  const Drive drive_;
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
  Vector3d rate_ = Vector3d::Zero();
};

// Energy and impulse at three axes.
class Account {
 public:
  void add(const Vector3d& effort, const Vector3d& way) {
    energy_ += effort.cwiseProduct(way);
    largest_ = std::max(largest_, energy_.maxCoeff());
    impulse_ += kStep * effort.norm();
  }
  EpisodeEnergy result(double tolerance) const { return {largest_, tolerance, impulse_}; }

 private:
  Vector3d energy_ = Vector3d::Zero();
  double largest_ = 0.0;
  double impulse_ = 0.0;
};

// A shaft from the origin of the tool frame.
ToolBalls shaftTo(const Vector3d& end_T) {
  ToolBalls tool = ballTool(kEpisodeRadius);
  tool.pieces[0].push_back({end_T, kEpisodeRadius});
  return tool;
}

Time stampAt(double seconds) { return Time(std::chrono::seconds(100) + fromSeconds(seconds)); }
SteadyTime steadyAt(double seconds) { return SteadyTime(std::chrono::seconds(10) + fromSeconds(seconds)); }

class Episode {
 public:
  explicit Episode(const EpisodeOptions& options)
      : random_(options.seed + 1),
        options_(options),
        force_link_(options.place == Place::kFarAway ? randomLink(random_) : LinkTraits{}),
        force_(forceOptions()),
        renderer_(force_),
        device_(force_, hand_limits_),
        tool_poses_(randomLink(random_), random_),
        to_guard_(randomLink(random_), random_),
        planes_(randomLink(random_), random_),
        hands_(options.place == Place::kFarAway ? randomLink(random_) : LinkTraits{}, random_),
        forces_(force_link_, random_) {
    R_WD_ = Eigen::AngleAxisd(random_.uniform(0.0, 3.0), random_.direction());
    const Vector3d normal_W = random_.direction();
    for (size_t i = 0, count = 1 + random_.count(3); i < count; ++i) {
      const Vector3d tilted = (normal_W + random_.uniform(0.0, 0.7) * random_.direction()).normalized();
      surface_.push_back(planeAt(tilted, -random_.uniform(0.006, 0.02) * normal_W));
    }
    hand_.emplace(random_, hand_limits_, -(R_WD_.transpose() * normal_W));
    if (!options_.turns) return;
    const Vector3d along_W = normal_W.cross(random_.direction()).normalized();
    tool_ = std::make_shared<ToolBalls>(shaftTo(random_.uniform(0.02, 0.1) * along_W));
    wrist_.emplace(random_, hand_limits_, R_WD_.transpose() * normal_W.cross(along_W));
  }

  EpisodeResult run() {
    for (int ms = 0; ms < kMilliseconds; ++ms) {
      sample(ms);
      tick(1e-3 * ms);
      for (int step = 0; step < kSteps; ++step) move(1e-3 * ms + kStep * step);
    }
    return {translation_.result(device_.tolerance()), rotation_.result(device_.turnTolerance())};
  }

 private:
  ForceOptions forceOptions() {
    ForceOptions force;
    force.law.stiffness = random_.logUniform(200.0, 3000.0);
    force.law.damping = random_.chance(0.5) ? 0.0 : random_.uniform(0.0, 0.5);
    force.position_scale = random_.logUniform(0.3, 3.0);
    force.force_scale = random_.logUniform(0.3, 1.0);
    force.max_force_rate = random_.logUniform(100.0, 2000.0);
    force.max_torque = options_.turns ? 0.15 : 0.0;
    force.device_damping = options_.bounded ? 2.0 : 1e9;
    force.device_turn_damping = options_.bounded ? 0.01 : 1e9;
    force.output_delay = fromSeconds(longestAge(force_link_, 1e-3));
    return force;
  }

  Isometry3d hand() const {
    const Isometry3d X_DH(Eigen::Translation3d(hand_->position()));
    return wrist_ ? X_DH * wrist_->orientation() : X_DH;
  }

  Isometry3d tool() const {
    const Isometry3d X_DH = hand();
    return Eigen::Translation3d(force_.position_scale * (R_WD_ * X_DH.translation())) *
           Isometry3d(R_WD_ * X_DH.linear() * R_WD_.transpose());
  }

  void sample(int ms) {
    const double now = 1e-3 * ms;
    hands_.send({hand(), now}, now);
    if (ms % 2 == 0) {
      tool_poses_.send({tool(), now}, now);
      to_guard_.send({tool(), now}, now);
    }
    to_guard_.receive(now);
    if (ms % 17 == 0 && to_guard_.newest()) planes_.send(to_guard_.newest()->second.time, now);
  }

  void receive(double now) {
    inputs_.R_WD = R_WD_;
    inputs_.known.tool = tool_;
    inputs_.known.warning = MotionInputs::GuardWarning{WarningLevel::kContact, 0, steadyAt(now)};
    if (tool_poses_.receive(now)) {
      const Located& tool = tool_poses_.newest()->second;
      inputs_.known.pose = MotionInputs::ToolPose{tool.X, {stampAt(tool.time), steadyAt(now)}};
    }
    if (planes_.receive(now)) {
      auto planes = std::make_shared<PlaneSet>(planeSet(surface_));
      planes->timestamps = {stampAt(planes_.newest()->second), steadyAt(now)};
      planes->valid_until = planes->timestamps.stamp + std::chrono::milliseconds(150);
      inputs_.known.planes = planes;
    }
  }

  void observe(double now, const Instant& at) {
    if (options_.place == Place::kByTheTool) {
      if (const auto& tool = inputs_.known.pose)
        device_.observe({tool->X_WT, R_WD_, force_.position_scale, tool->timestamps}, at);
    } else if (hands_.receive(now)) {
      const Located& hand = hands_.newest()->second;
      device_.observe({hand.X, Eigen::Matrix3d::Identity(), 1.0, {stampAt(hand.time), steadyAt(now)}}, at);
    }
  }

  void tick(double now) {
    const Instant at{stampAt(now), steadyAt(now)};
    receive(now);
    observe(now, at);
    const RenderedForce rendered = renderer_.render(inputs_, sent_, at);
    sent_ = options_.controlled ? device_.limit(rendered.wrench, at.steady) : rendered.wrench;
    forces_.send(sent_, now);
  }

  void move(double now) {
    forces_.receive(now);
    const DeviceWrench acting = forces_.newest() ? forces_.newest()->second : DeviceWrench{};
    translation_.add(acting.force_D, hand_->move(acting.force_D, now));
    if (wrist_) rotation_.add(acting.torque_D, wrist_->turn(acting.torque_D, now));
  }

  RandomScenes random_;
  const EpisodeOptions options_;
  const LinkTraits force_link_;
  const HandLimits hand_limits_;
  const ForceOptions force_;
  ForceRenderer renderer_;
  PassiveDevice device_;
  Link<Located> tool_poses_;
  Link<Located> to_guard_;
  Link<double> planes_;
  Link<Located> hands_;
  Link<DeviceWrench> forces_;
  Eigen::Matrix3d R_WD_;
  std::vector<SeparatingPlane> surface_;
  std::optional<Hand> hand_;
  std::optional<Wrist> wrist_;
  std::shared_ptr<const ToolBalls> tool_ = std::make_shared<ToolBalls>(ballTool(kEpisodeRadius));
  ForceInputs inputs_;
  DeviceWrench sent_;
  Account translation_;
  Account rotation_;
};

}  // namespace

EpisodeResult runEpisode(const EpisodeOptions& options) { return Episode(options).run(); }

}  // namespace sweep_guard_core
