// The monitor as a state machine: bytes are events, and after each of them the warning is judged by a model.
#include <deque>
#include <iterator>

#include "guard/cross_check.h"
#include "monitor_model.h"
#include "require.h"
#include "sweep_guard/monitor/warning_monitor.h"
#include "target.h"

namespace sweep_guard_fuzz {
namespace {

using namespace sweep_guard_core;  // NOLINT(google-build-using-namespace): the monitor's whole vocabulary
using std::chrono::milliseconds;

const WarningLimits kLimits = {milliseconds(100), milliseconds(500), milliseconds(500)};
constexpr int kIds = MonitorModel::kIds;
const std::array<std::string, kIds> kNames = {"bone", "liver", "vein"};
constexpr std::array<Reason, 5> kFaults = {kPoseInvalid, kOutOfOrder, kFutureStamp, kTfFail, kDetectorFault};

class Session {
 public:
  explicit Session(Input input)
      : input_(input),
        monitor_(
            kLimits, [] {}, [this] { return waitingSince(); }, [this] { return hung_ ? "sweeps" : nullptr; }) {}

  void run() {
    while (!input_.atEnd()) {
      step();
      judge();
    }
    if (!model_.ended()) recover();
  }

 private:
  struct Pose {
    MonitorModel::Clock times;
    WarningMonitor::Checkpoint checkpoint;
    MonitorModel::Checkpoint model;
  };

  static size_t at(int id) { return static_cast<size_t>(id); }
  static Time stampAt(std::int64_t ms) { return Time(milliseconds(ms)); }
  static SteadyTime steadyAt(std::int64_t ms) { return SteadyTime(milliseconds(ms)); }
  Instant instant() const { return {stampAt(now_.stamp), steadyAt(now_.steady)}; }
  static Timestamps timestamps(const MonitorModel::Clock& times) {
    return {stampAt(times.stamp), steadyAt(times.steady)};
  }

  std::optional<SteadyTime> waitingSince() const {
    return waiting_.empty() ? std::nullopt : std::optional(steadyAt(waiting_.front().times.steady));
  }

  void step() {
    switch (input_.below(28)) {
      case 0:
      case 1:
        return pass(input_.below(40));
      case 2:
        return pass(10 * input_.byte());
      case 3:
        now_.stamp += 20 * input_.byte();
        return;  // ROS time alone
      case 4:
        now_.stamp = std::max<std::int64_t>(1, now_.stamp - 20 * input_.byte());
        return;
      case 5:
        return mesh(id());
      case 6:
      case 7:
        return vertices(id());
      case 8:
        return remove(id());
      case 9:
      case 10:
        return pose();
      case 11:
      case 12:
        return sweep();
      case 13:
      case 14:
        return predict();
      case 15:
        return fault();
      case 16:
        return fail();
      case 17:
        return refuse();
      case 18:
        return accept();
      case 19:
        return unread();
      case 20:
        return drop();
      case 21:
        return selfTest();
      case 22:
        return disagree();
      case 23:
        return jump();
      case 24:
        return control();
      case 25:
        return require(id());
      case 26:
        return acknowledge();
      default:
        return everythingIsFine();
    }
  }

  int id() { return input_.below(kIds); }
  // Mostly now; sometimes before.
  std::int64_t received() { return now_.steady - std::max(0, input_.byte() - 200); }

  void pass(int ms) {
    now_.stamp += ms;
    now_.steady += ms;
  }

  void place(int id, const TriangleMesh& mesh, int number) {
    const MonitorModel::Clock times = {std::max<std::int64_t>(1, now_.stamp - 4 * std::max(0, input_.byte() - 128)),
                                       now_.steady};
    const Timestamps stamps = timestamps(times);
    workpieces_[at(id)] = std::make_shared<const Workpiece>(
        Workpiece{kNames[at(id)], static_cast<std::uint32_t>(number), stamps.stamp, stamps.received, "table", mesh});
    numbers_[at(id)] = number;
    model_.place(id, number, times);
    setWorkpieces();
  }
  void mesh(int id) { place(id, TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), ++meshes_); }
  void vertices(int id) {
    if (workpieces_[at(id)]) place(id, workpieces_[at(id)]->mesh_M, numbers_[at(id)]);
  }
  void remove(int id) {
    workpieces_[at(id)].reset();
    model_.remove(id);
    setWorkpieces();
  }
  void setWorkpieces() {
    Workpieces known;
    std::copy_if(workpieces_.begin(), workpieces_.end(), std::back_inserter(known),
                 [](const auto& one) { return one != nullptr; });
    monitor_.setWorkpieces(known);
  }

  void pose() {
    waiting_.push_back({{now_.stamp, now_.steady}, monitor_.checkpoint(), model_.checkpoint()});
    model_.wait(waiting_.front().times.steady);
  }

  // What a sweep or a prediction could say about each workpiece. An absent one may have gone while it was tested.
  MonitorModel::Report report(const Pose& pose, int bits) {
    MonitorModel::Report report;
    report.pose = pose.times;
    report.checkpoint = pose.model;
    for (int id = 0; id < kIds; ++id) {
      if (!workpieces_[at(id)]) continue;
      const int how = bits == 0 ? 0 : input_.byte();
      report.missing[at(id)] = how % 8 == 7;
      report.failed = report.failed || how % 16 == 15;
      MonitorModel::Tested& tested = report.tested[at(id)];
      tested.present = how % 8 < 6;
      tested.mesh = numbers_[at(id)];
      tested.received = workpieces_[at(id)]->received.time_since_epoch() / milliseconds(1);
      tested.behind = how % 8 == 5;
      tested.contact = how % 8 == 3 || how % 8 == 4;
      tested.from = 10 * (how / 8);
    }
    return report;
  }

  void sweep() {
    if (waiting_.empty()) return;
    const int bits = input_.byte();
    const Pose newest = waiting_.back();
    MonitorModel::Report said = report(newest, bits % 4);
    said.backlog = newest.times.stamp - waiting_.front().times.stamp;
    waiting_.clear();
    model_.wait({});
    swept_ = newest;
    SweepReport report = sweepReport(said);
    if (bits / 4 % 8 == 7) report.jump = "the tool jumped";
    monitor_.swept(report, timestamps(newest.times), newest.checkpoint, steadyAt(now_.steady));
    model_.sweep(said, now_.steady);
  }

  SweepReport sweepReport(const MonitorModel::Report& said) const {
    SweepReport report;
    report.end = stampAt(said.pose.stamp);
    report.backlog = milliseconds(said.backlog);
    for (int id = 0; id < kIds; ++id) {
      const MonitorModel::Tested& tested = said.tested[at(id)];
      if (said.missing[at(id)]) addMissing(id, said.failed, report);
      if (!tested.present) continue;
      SweptObject object;
      object.workpiece = workpieces_[at(id)];
      object.behind = milliseconds(tested.behind ? 5 : 0);
      if (tested.contact) object.result.triangles = object.result.not_ruled_out = {0};
      report.objects.push_back(object);
    }
    return report;
  }

  template <typename Report>
  void addMissing(int id, bool failed, Report& report) const {
    if (failed) {
      report.failures.push_back({workpieces_[at(id)], "no memory"});
    } else {
      report.unplaced.push_back(workpieces_[at(id)]);
    }
  }

  void predict() {
    if (!swept_) return;
    const int bits = input_.byte();
    MonitorModel::Report said = report(*swept_, bits % 4);
    said.length = bits % 16 == 15 ? 0 : bits % 8 == 7 ? 10 * input_.byte() : 1200;
    said.took = 4 * (bits / 16);
    if (said.length == 0) said.tested = {};
    monitor_.predicted(prediction(said), timestamps(swept_->times), swept_->checkpoint, instant(),
                       milliseconds(said.took));
    model_.predict(said, now_);
  }

  Prediction prediction(const MonitorModel::Report& said) const {
    Prediction prediction;
    prediction.stamp = stampAt(said.pose.stamp);
    prediction.path.resize(said.length == 0 ? 0 : 1);
    if (said.length != 0) prediction.path[0].ahead = milliseconds(said.length);
    for (int id = 0; id < kIds; ++id) {
      const MonitorModel::Tested& tested = said.tested[at(id)];
      if (said.missing[at(id)]) addMissing(id, said.failed, prediction);
      if (!tested.present) continue;
      PredictedObject object;
      object.workpiece = workpieces_[at(id)];
      object.sweeps.resize(1);
      if (tested.contact) object.sweeps.push_back({milliseconds(tested.from), /*contact=*/true, -1.0});
      prediction.objects.push_back(object);
    }
    return prediction;
  }

  void fault() {
    monitor_.fault(kFaults[at(input_.below(kFaults.size()))], "wrong");
    model_.fault();
  }
  void fail() {
    const bool lasting = input_.below(4) == 3;
    monitor_.failed(kDetectorFault, "an exception", steadyAt(now_.steady), lasting);
    model_.fail(now_.steady, lasting);
  }
  void refuse() {
    const int which = id();
    const bool of_mesh = input_.flag();
    const std::int64_t when = received();
    if (of_mesh) {
      monitor_.meshRefused(kNames[at(which)], "NaN", steadyAt(when));
      model_.refuseMesh(which, when);
    } else {
      monitor_.verticesRefused(kNames[at(which)], "NaN", steadyAt(when));
      model_.refuseVertices(which, when);
    }
  }
  void accept() {
    const int which = id();
    const bool of_mesh = input_.flag();
    accept(which, of_mesh, received());
  }
  void accept(int which, bool of_mesh, std::int64_t when) {
    if (of_mesh) {
      monitor_.meshAccepted(kNames[at(which)], steadyAt(when));
      model_.acceptMesh(which, when);
    } else {
      monitor_.verticesAccepted(kNames[at(which)], steadyAt(when));
      model_.acceptVertices(which, when);
    }
  }
  void unread() {
    monitor_.meshUnread("not a mesh", steadyAt(now_.steady));
    model_.unread(now_.steady);
  }
  void drop() {
    const int which = id();
    const std::int64_t when = received();
    monitor_.updateDropped(kNames[at(which)], steadyAt(when));
    model_.drop(which, when);
  }
  void selfTest() {
    const bool passed = input_.flag();
    monitor_.detectorTested(passed ? "" : "misses a triangle");
    model_.selfTest(passed);
  }

  void disagree() {
    const int which = id();
    const int bits = input_.byte();
    if (!workpieces_[at(which)]) return;
    SampledQuery query;
    query.workpiece = workpieces_[at(which)];
    query.origin = {/*measured=*/bits % 2 == 0,
                    monitor_.checkpoint().epoch - static_cast<std::uint64_t>(bits % 8 == 7)};
    std::vector<std::uint32_t> missed;
    if (bits % 4 < 2) missed.push_back(0);
    MonitorModel::Checkpoint asked = model_.checkpoint();
    if (bits % 8 == 7) --asked.epoch;
    monitor_.detectorsDisagree("one misses a triangle", query, missed, steadyAt(now_.steady));
    model_.disagree(which, numbers_[at(which)], query.origin.measured && !missed.empty(), asked, now_.steady);
  }

  void jump() {
    monitor_.timeJumped("time went back");
    model_.jump();
  }

  void control() {
    switch (input_.below(12)) {
      case 0:
        monitor_.restart();
        return model_.restart();
      case 1:
        monitor_.disable("a test");
        return model_.disable();
      case 2:
        return disableBelowReflex();
      case 3:
        hung_ = true;
        return model_.hang(true);
      case 4:
        monitor_.end();
        return model_.end();
      case 5:
      case 6:
        hung_ = false;
        return model_.hang(false);
      case 7:
        monitor_.posesLost("3 poses", steadyAt(now_.steady));
        return;
      default:
        monitor_.enable();
        return model_.enable();
    }
  }

  void disableBelowReflex() {
    const bool allowed = model_.level(now_) < static_cast<int>(WarningLevel::kReflex);
    const bool disabled = monitor_.disableBelow(WarningLevel::kReflex, instant(), "a test").empty();
    sweep_guard_fuzz::require(allowed == disabled, "only below REFLEX may the guard be disabled");
    if (disabled) model_.disable();
  }

  void require(int which) {
    const bool is_required = input_.below(4) == 0;
    required_[at(which)] = is_required;
    model_.require(which, is_required);
    std::set<std::string> ids;
    for (int id = 0; id < kIds; ++id) {
      if (required_[at(id)]) ids.insert(kNames[at(id)]);
    }
    monitor_.require(ids);
  }

  void acknowledge() {
    const int which = id();
    if (input_.below(4) == 0) return monitor_.endAcknowledgement(kNames[at(which)]);
    const std::string refusal = monitor_.whyNotAcknowledged(kNames[at(which)], instant());
    sweep_guard_fuzz::require(monitor_.acknowledge(kNames[at(which)], instant()) == refusal,
                              "an acknowledgement is refused as it says");
    if (!refusal.empty()) return;
    sweep_guard_fuzz::require(model_.level(now_) == static_cast<int>(WarningLevel::kConsidered),
                              "only CONSIDERED can be acknowledged");
    sweep_guard_fuzz::require(model_.known(which), "only what is there can be acknowledged");
  }

  // One good cycle.
  void everythingIsFine() {
    for (int id = 0; id < kIds; ++id) vertices(id);
    pose();
    sweep();
    predict();
  }

  void judge() {
    Warning warning;
    monitor_.warning(instant(), warning);
    const auto level = static_cast<int>(warning.level);
    const std::string why_not = model_.whyNotClear(now_);
    if (warning.level == WarningLevel::kClear && !why_not.empty())
      broken("CLEAR, but " + why_not + ": " + warning.text);
    if (level != model_.level(now_)) {
      broken("level " + std::to_string(level) + " in place of " + std::to_string(model_.level(now_)) + " (" + why_not +
             "): " + warning.text);
    }
    judge(warning, why_not);
  }

  void judge(const Warning& warning, const std::string& why_not) const {
    using sweep_guard_fuzz::require;
    const bool silent = model_.ended() || model_.disabled();
    require((warning.reasons == kDisabled) == silent, "DISABLED stands alone");
    require(((warning.reasons & ~kDegraded) == 0) == why_not.empty(), "a reason whenever the guard could not be CLEAR");
    require(warning.text.rfind(styleOf(warning.level).name, 0) == 0, "the text begins with the level");
    require(!warning.acknowledged || warning.level == WarningLevel::kConsidered, "only CONSIDERED is acknowledged");
    require(!warning.time_to_collision || *warning.time_to_collision >= Duration::zero(),
            "no collision was in the past");
    require(!warning.held_since || *warning.held_since <= stampAt(now_.stamp), "nothing is held since the future");
    require(warning.probability >= 0.0 && warning.probability <= 1.0, "a probability is in [0, 1]");
    const bool names = warning.level >= WarningLevel::kConsidered;
    require(names == !warning.mesh_id.empty(), "a warning names its workpiece, and nothing else does");
  }

  // From any state, good inputs lead to CLEAR.
  void recover() {
    monitor_.enable();
    model_.enable();
    hung_ = false;
    model_.hang(false);
    monitor_.detectorTested("");
    model_.selfTest(true);
    monitor_.restart();
    model_.restart();
    now_.stamp += 2000;
    now_.steady += 2000;
    for (int id = 0; id < kIds; ++id) {
      accept(id, /*of_mesh=*/true, now_.steady);
      mesh(id);
    }
    everythingIsFine();
    judge();
    sweep_guard_fuzz::require(model_.level(now_) == static_cast<int>(WarningLevel::kClear),
                              "good inputs lead to CLEAR");
  }

  Input input_;
  MonitorModel model_;
  MonitorModel::Clock now_ = {5000, 5000};
  bool hung_ = false;
  int meshes_ = 0;
  std::array<std::shared_ptr<const Workpiece>, kIds> workpieces_;
  std::array<int, kIds> numbers_{};
  std::array<bool, kIds> required_{};
  std::deque<Pose> waiting_;
  std::optional<Pose> swept_;
  WarningMonitor monitor_;
};

const Target kMonitor("monitor", [](Input input) { Session(input).run(); });

}  // namespace
}  // namespace sweep_guard_fuzz
