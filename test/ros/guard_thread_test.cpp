// The thread that sweeps, with a detector that says when it is asked. The guard's parts run in this process.
#include "ros/guard/guard_thread.h"

#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <sweep_guard/Prediction.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <future>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include "guard/fake_detector.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using std::chrono::milliseconds;

class GuardThreadTest : public ::testing::Test {
 protected:
  GuardThreadTest() {
    workpieces_.set({"wavy", 1, now().stamp, now().steady, "world", sweep_guard_core::wavyHull(20, 40, 0.0)},
                    now().stamp);
    guard_thread_.start(supervisor_);
  }
  ~GuardThreadTest() override { guard_thread_.stop(); }

  static ros::NodeHandle privateNode() {
    ros::NodeHandle node("~");
    node.setParam("self_test", "none");
    node.setParam("cross_check", 0);
    node.setParam("timing/mesh_timeout", std::numeric_limits<double>::infinity());
    return node;
  }

  // Through the workpiece, so that the detector is asked about measured and predicted sweeps.
  void push(bool frame_is_known = true) {
    sweep_guard_core::PoseWithFrames pose;
    stamp_ = std::max(stamp_ + milliseconds(10), now().stamp);  // no pose is old, and none is faster than a hand
    pose.stamp = stamp_;
    pose.received = now().steady;
    pose.X_WT.translation().x() = 0.001 * ++pushed_;
    pose.bodies = {{pose.X_WT}};
    if (frame_is_known) pose.X_WM["world"] = Eigen::Isometry3d::Identity();
    queue_.push({pose, monitor_.checkpoint()});
  }

  // Tasks run before the poses that are taken with them; so many of them pass by no pose that waits.
  void passTheQueue() {
    for (int i = 0; i < 10; ++i) queue_.submit<void>([] {}).get();
  }

  // Asks in the guard's thread, between its work.
  bool await(const std::function<bool()>& reached) {
    for (const auto end = now().steady + std::chrono::seconds(20); now().steady < end;) {
      if (queue_.submit<bool>(reached).get()) return true;
      std::this_thread::sleep_for(milliseconds(1));
    }
    return false;
  }

  // Once the poses taken are swept, none waits: the detector is asked about a predicted sweep.
  bool inPrediction() const { return !queue_.waitingSince(); }

  std::uint64_t predictionsMade() { return statistics_.take().predictions_total; }

  struct Step {
    std::function<bool()> is_due;
    std::function<void()> run;
  };
  // Pushes a pose in a prediction. Then, in the guard's thread: each time the detector is asked, runs the next step if it is due.
  void pushInPredictionAndThen(std::vector<Step> steps) {
    push();
    passTheQueue();
    steps.insert(steps.begin(), {[this] { return inPrediction(); },
                                 [this] {
                                   predictions_before_ = predictionsMade();
                                   push();
                                 }});
    record_.asked = [this, steps = std::move(steps)] {
      if (begun_ < steps.size() && steps[begun_].is_due()) steps[begun_++].run();
    };
    push();
  }

  sweep_guard_core::Time stamp_;
  int pushed_ = 0;
  sweep_guard_core::FakeDetector::Record record_;
  std::thread::id shapes_made_by_;
  size_t begun_ = 0;  // steps; used by the guard's thread only, as the next two
  std::uint64_t predictions_before_ = 0;
  bool interrupted_ = false;  // a prediction
  ros::NodeHandle node_ = privateNode();
  LiveParameters parameters_{loadParameters(node_)};
  Supervisor supervisor_{Process::kShared};
  sweep_guard_core::WorkQueue queue_;
  sweep_guard_core::WarningMonitor monitor_{parameters_.initial().limits};
  sweep_guard_core::WorkpieceStore workpieces_{[this](const auto& workpieces) { monitor_.setWorkpieces(workpieces); }};
  WarningPublisher warnings_{node_, parameters_, monitor_};
  ScenePublisher scene_{node_, parameters_, monitor_, workpieces_};
  TouchesPublisher touches_{node_};
  sweep_guard_core::SweepStatistics statistics_{parameters_.initial().guard.cycle};
  sweep_guard_core::QuerySampler sampler_{/*every=*/0};
  sweep_guard_core::IntentionStore intentions_;
  GuardThread guard_thread_{
      node_,
      {parameters_, workpieces_, monitor_, statistics_, queue_, warnings_, scene_, touches_, sampler_, intentions_,
       /*frame_motions=*/nullptr,
       [this](const Parameters&) { return std::make_unique<sweep_guard_core::FakeDetector>(record_); },
       [this](const Parameters& parameters) {
         shapes_made_by_ = std::this_thread::get_id();
         return ToolShapes(parameters);
       }}};
};

// A pose comes during a prediction, so that another one follows. Two come during that. The first sweep takes longer than a prediction may be held up, so the second pose is left for the time after it.
TEST_F(GuardThreadTest, APoseThatIsLeftWhenAPredictionGoesOnIsSweptAfterIt) {
  pushInPredictionAndThen({{[&] { return inPrediction() && predictionsMade() > predictions_before_; },
                            [&] {
                              push();
                              push(/*frame_is_known=*/false);  // else the first one would not be swept alone
                            }},
                           {[&] { return !inPrediction(); },
                            [] { std::this_thread::sleep_for(milliseconds(60)); }}});  // the time that this sweep takes
  EXPECT_TRUE(await([&] { return begun_ == 3 && !queue_.waitingSince(); }));
  EXPECT_EQ(pushed_, 5);
  EXPECT_EQ(statistics_.take().sweeps_total, 5U);
  EXPECT_FALSE(queue_.waitingSince());
}

// The next prediction would be due after a second: the one before was slow.
TEST_F(GuardThreadTest, OtherTrianglesArePredictedAtOnce) {
  const auto patient = std::make_shared<Parameters>(*parameters_.get());
  patient->guard.cycle = std::chrono::seconds(20);
  parameters_.set(patient);
  bool slow = false;  // used by the guard's thread only
  record_.asked = [&] {
    if (!slow && inPrediction()) std::this_thread::sleep_for(milliseconds(200));
    slow = slow || inPrediction();
  };
  for (int i = 0; i < 3; ++i) push();
  std::uint64_t predictions = 0;
  ASSERT_TRUE(await([&] {
    predictions = predictionsMade();
    return slow;
  }));
  const auto begin = now().steady;
  workpieces_.set({"wavy", 2, now().stamp, begin, "world", sweep_guard_core::wavyHull(20, 30, 0.0)}, now().stamp);
  push();
  EXPECT_TRUE(await([&] { return predictionsMade() > predictions; }));
  EXPECT_LT(now().steady - begin, milliseconds(400));
}

TEST_F(GuardThreadTest, WhatWaitsWhenTimeJumpsIsSweptAndReported) {
  std::promise<void> go_on;
  std::future<void> busy = queue_.submit<void>([&] { go_on.get_future().wait(); });
  push();
  push();
  monitor_.timeJumped("time went back");
  go_on.set_value();
  busy.get();
  const auto is_reported = [&] {
    sweep_guard_core::Warning warning;
    monitor_.warning(now(), warning);
    return warning.level == sweep_guard_core::WarningLevel::kContact;
  };
  EXPECT_TRUE(await(is_reported));
}

TEST_F(GuardThreadTest, APredictionGoesOnAfterAPoseThatCameMeanwhileIsSwept) {
  pushInPredictionAndThen(
      {{[&] { return !inPrediction(); }, [] {}},
       {[&] { return inPrediction(); }, [&] { EXPECT_EQ(predictionsMade(), predictions_before_); }}});
  passTheQueue();
  EXPECT_EQ(begun_, 3U);
  EXPECT_EQ(statistics_.take().sweeps_total, 3U);
}

// The prediction has taken at least this time when the pose that came meanwhile is swept. No further pose comes.
TEST_F(GuardThreadTest, LeavesTimeBetweenPredictionsAndPredictsFromTheNewestPose) {
  constexpr milliseconds kTook(20);
  push();
  passTheQueue();
  std::vector<std::uint64_t> made;  // used by the guard's thread only, as the next one
  std::vector<sweep_guard_core::SteadyTime> begun;
  record_.asked = [&] {
    const std::uint64_t predictions = predictionsMade();
    if (!inPrediction() || (!made.empty() && made.back() == predictions)) return;
    made.push_back(predictions);
    begun.push_back(now().steady);
    if (made.size() > 1) return;
    push();
    std::this_thread::sleep_for(kTook);
  };
  push();
  EXPECT_TRUE(await([&] { return begun.size() == 2; }));
  EXPECT_GE(begun.at(1) - begun.at(0), 3 * kTook / 2);
  EXPECT_EQ(statistics_.take().sweeps_total, 3U);
}

// For a payload with many corners that takes longer than a cycle.
TEST_F(GuardThreadTest, TheSurfaceForOtherGuardsIsMadeByTheThreadThatExchangesTheTool) {
  const auto before = parameters_.get();
  guard_thread_.exchangeTool(before, std::make_shared<const Parameters>(*before), [] {});
  EXPECT_EQ(shapes_made_by_, std::this_thread::get_id());
  shapes_made_by_ = {};
  node_.setParam("tool/radius", 0.007);
  guard_thread_.apply(std::make_shared<const Parameters>(loadParameters(node_)));
  EXPECT_EQ(shapes_made_by_, std::this_thread::get_id());
  node_.deleteParam("tool");
}

// As after ~enable or a jump of time, which wait for no prediction.
TEST_F(GuardThreadTest, APredictionWhoseEpochEndedMeanwhileIsNotPublished) {
  std::vector<sweep_guard_core::Time> predicted_from;
  const ros::Subscriber predictions = node_.subscribe<sweep_guard::Prediction>(
      "prediction", 0, [&](const auto& prediction) { predicted_from.push_back(fromMsg(prediction->header.stamp)); });
  push();
  passTheQueue();
  record_.asked = [this] {
    if (interrupted_ || !inPrediction()) return;
    interrupted_ = true;
    monitor_.restart();
  };
  push();
  const sweep_guard_core::Time of_ended_epoch = stamp_;
  ASSERT_TRUE(await([&] { return interrupted_; }));
  const auto end = now().steady + std::chrono::seconds(20);
  while ((predicted_from.empty() || predicted_from.back() <= of_ended_epoch) && now().steady < end) {
    push();
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
  }
  ASSERT_FALSE(predicted_from.empty());
  EXPECT_GT(predicted_from.back(), of_ended_epoch);
  EXPECT_EQ(std::count(predicted_from.begin(), predicted_from.end(), of_ended_epoch), 0);
}

// A pose of the old tool comes meanwhile, too.
TEST_F(GuardThreadTest, AfterTheToolIsExchangedNothingIsPredictedFromPosesBefore) {
  push();
  passTheQueue();
  std::future<void> exchanged;
  std::promise<void> interrupted;
  std::atomic<bool> is_new = false;
  std::atomic<int> queries_of_old = 0;
  record_.asked = [&] {
    if (is_new && inPrediction()) ++queries_of_old;
    if (interrupted_ || !inPrediction()) return;
    interrupted_ = true;
    exchanged = std::async(std::launch::async, [&] {
      const auto before = parameters_.get();
      guard_thread_.exchangeTool(before, std::make_shared<const Parameters>(*before), [&] { is_new = true; });
    });
    while (!queue_.hasWork()) std::this_thread::yield();
    push();
    interrupted.set_value();
  };
  push();
  ASSERT_EQ(interrupted.get_future().wait_for(std::chrono::seconds(20)), std::future_status::ready);
  exchanged.get();
  ASSERT_TRUE(is_new);
  const auto due = now().steady + 2 * parameters_.get()->guard.cycle;
  ASSERT_TRUE(await([&] { return now().steady > due; }));
  EXPECT_EQ(queries_of_old, 0);
  EXPECT_THROW(guard_thread_.newestPose().get(), sweep_guard_core::Error);
}

}  // namespace
}  // namespace sweep_guard_ros
