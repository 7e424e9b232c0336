#include "sweep_guard/prediction/joint_predictor.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "prediction/direct_extrapolator.h"
#include "prediction/motion_channel.h"
#include "sweep_guard/common/unwound.h"

namespace sweep_guard_core {
namespace {

constexpr double kPriorSpeed = 0.02;     // [m/s]
constexpr double kPriorTurnRate = 0.15;  // [rad/s]

JointSpace spaceOf(const JointVariable& joint, const PredictorOptions& options) {
  JointSpace space{joint.turns ? options.max_turn_rate : options.max_speed, joint.turns ? kPriorTurnRate : kPriorSpeed};
  if (joint.continuous) return space;
  space.lower = joint.lower;
  space.upper = joint.upper;
  return space;
}

// One hand moves the joints, so they begin and end together: those of one kind share what is learned.
std::shared_ptr<LearnedMotion<JointSpace>> learnedBy(const std::vector<JointVariable>& joints, bool turn) {
  const auto count =
      std::count_if(joints.begin(), joints.end(), [turn](const auto& joint) { return joint.turns == turn; });
  const JointSpace::Speeds prior_speed(turn ? kPriorTurnRate : kPriorSpeed);
  return std::make_shared<LearnedMotion<JointSpace>>(prior_speed, std::max<size_t>(1, static_cast<size_t>(count)));
}

}  // namespace

struct JointPredictor::Joint {
  Joint(const JointVariable& joint, const PredictorOptions& options, std::shared_ptr<LearnedMotion<JointSpace>> learned)
      : continuous(joint.continuous), channel(options, spaceOf(joint, options), std::move(learned)) {}

  bool continuous;
  MotionChannel<JointSpace> channel;
  double newest = 0.0;  // as observed [rad or m]
};

JointPredictor::JointPredictor(const PredictorOptions& options, const std::vector<JointVariable>& joints) {
  checked(options);
  const auto turning = learnedBy(joints, true);
  const auto sliding = learnedBy(joints, false);
  for (const JointVariable& joint : joints) joints_.emplace_back(joint, options, joint.turns ? turning : sliding);
}

JointPredictor::~JointPredictor() = default;
JointPredictor::JointPredictor(JointPredictor&&) noexcept = default;
JointPredictor& JointPredictor::operator=(JointPredictor&&) noexcept = default;

void JointPredictor::command(const SentCommand& command) {
  const auto* joints = std::get_if<CommandedJoints>(&command.value);
  if (joints == nullptr) return;
  assert(joints->velocities.size() == joints_.size());
  for (size_t i = 0; i < joints_.size(); ++i) {
    const double velocity = joints->velocities[i];
    if (!std::isnan(velocity)) joints_[i].channel.command(command.stamp, JointSpace::Vector(velocity));
  }
}

bool JointPredictor::usesCommand() const {
  return std::any_of(joints_.begin(), joints_.end(), [](const Joint& joint) { return joint.channel.usesCommand(); });
}

void JointPredictor::observe(Time stamp, const std::vector<double>& positions) {
  assert(positions.size() == joints_.size());
  for (size_t i = 0; i < positions.size(); ++i) {
    auto& [continuous, channel, newest] = joints_[i];
    newest = positions[i];
    channel.observe({stamp, continuous ? unwound(newest, channel.newest().value) : newest});
  }
}

bool JointPredictor::knowsMotion() const {
  return std::all_of(joints_.begin(), joints_.end(), [](const Joint& joint) { return joint.channel.knowsMotion(); });
}

void JointPredictor::predict(Duration ahead, PredictedJoints& joints) const {
  assert(ahead > Duration::zero() && knowsMotion());
  joints.positions.clear();
  joints.variances.clear();
  const double seconds = toSeconds(ahead);
  for (const Joint& joint : joints_) {
    joints.positions.push_back(joint.newest + joint.channel.displacementIn(seconds)[0]);
    joints.variances.push_back(joint.channel.covariance(seconds)(0, 0));
  }
}

void JointPredictor::restart() {
  for (Joint& joint : joints_) joint.channel.interrupt();
}

}  // namespace sweep_guard_core
