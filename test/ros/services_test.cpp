// Services of a guard that is stuck, busy, or without a master: each answers in time. The guard's parts run in this
// process.
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <ros/master.h>
#include <rosgraph_msgs/Log.h>
#include <signal.h>
#include <sweep_guard/CheckSweep.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <future>
#include <limits>
#include <thread>

#include "guard/fake_detector.h"
#include "guard_probe.h"
#include "refusal.h"
#include "ros/guard/cross_check_thread.h"
#include "ros/guard/guard_thread.h"
#include "ros/parameters/reconfigure_server.h"
#include "ros/service/check_sweep.h"
#include "ros/service/controls.h"
#include "scenes.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using dynamic_reconfigure::Reconfigure;
using std::chrono::milliseconds;
using sweep_guard::CheckSweep;

constexpr double kDeadline = 0.5;  // [s]

// How many threads of this process have this nice value.
int threadsOfNice(int nice) {
  int count = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream stat(task.path() / "stat");
    std::string field;
    for (int i = 0; i < 19; ++i) stat >> field;  // names of threads have no blank here
    count += std::stoi(field) == nice ? 1 : 0;
  }
  return count;
}

class ServicesTest : public ::testing::Test {
 protected:
  explicit ServicesTest(const std::string& self_test = "unknown", std::uint32_t drop_every = 0,
                        double deadline = kDeadline)
      : detector_record_{{}, 0, 0.0, 0.0, drop_every}, node_(privateNode(self_test, deadline)) {
    guard_thread_.start(supervisor_);
    path_tests_.start(supervisor_);
    service_threads_.start(supervisor_);
    master_thread_.start(supervisor_);
    cross_check_.start(supervisor_);
    spinner_.start();
  }
  ~ServicesTest() override {
    guard_thread_.stop();
    path_tests_.stop();
    service_threads_.stop();
    master_thread_.stop();
  }

  static ros::NodeHandle privateNode(const std::string& self_test, double deadline) {
    ros::NodeHandle node("~");
    node.setParam("check_sweep/deadline", deadline);
    node.setParam("self_test", self_test);
    node.setParam("detector", "select");
    node.setParam("cross_check", 1);
    node.setParam("timing/mesh_timeout", std::numeric_limits<double>::infinity());
    return node;
  }

  // A connection that lasts needs no master.
  template <typename Service>
  ros::ServiceClient clientOf(const std::string& name) {
    return node_.serviceClient<Service>(name, /*persistent=*/true);
  }

  static Reconfigure::Request hold(double seconds) {
    Reconfigure::Request request;
    request.config.doubles.resize(1);
    request.config.doubles[0].name = "warning/hold_time";
    request.config.doubles[0].value = seconds;
    return request;
  }
  double holdTime() const { return sweep_guard_core::toSeconds(parameters_.get()->limits.hold_time); }

  void placeWorkpiece(int rings) {
    workpieces_.set({"wavy", 1, now().stamp, now().steady, "world", sweep_guard_core::wavyHull(rings, 2 * rings, 0.0)},
                    now().stamp);
  }

  void sweepTo(double height) {
    sweep_guard_core::PoseWithFrames pose;
    pose.stamp = now().stamp;
    pose.received = now().steady;
    pose.X_WT.translation().z() = height;
    pose.bodies = {{pose.X_WT}};
    pose.X_WM["world"] = Eigen::Isometry3d::Identity();
    queue_.push({pose, monitor_.checkpoint()});
  }

  sweep_guard_core::Warning warning() const {
    sweep_guard_core::Warning warning;
    monitor_.warning(now(), warning);
    return warning;
  }

  // To and fro through a workpiece.
  CheckSweep::Request path(size_t poses) {
    CheckSweep::Request request;
    request.path.resize(poses);
    for (size_t i = 0; i < request.path.size(); ++i) {
      request.path[i].header.frame_id = "world";
      request.path[i].pose.position.x = i % 2 == 0 ? -0.2 : 0.2;
      request.path[i].pose.orientation.w = 1.0;
    }
    return request;
  }

  // Takes much longer than the deadline.
  CheckSweep::Request longPath() {
    placeWorkpiece(100);
    CheckSweep::Request request = path(1024);
    request.fine = true;
    return request;
  }

  GuardThreadDependencies dependenciesWith(LiveParameters& parameters) {
    return {parameters,
            workpieces_,
            monitor_,
            statistics_,
            queue_,
            warnings_,
            scene_,
            touches_,
            cross_check_.sampler(),
            intentions_,
            /*frame_motions=*/nullptr,
            [this](const Parameters&) { return std::make_unique<sweep_guard_core::FakeDetector>(detector_record_); }};
  }

  CheckSweep::Response checkSweep(CheckSweep::Request request) {
    CheckSweep::Response response;
    EXPECT_TRUE(clientOf<CheckSweep>("check_sweep").call(request, response));
    return response;
  }

  sweep_guard_core::FakeDetector::Record detector_record_;
  sweep_guard_core::IntentionStore intentions_;
  sweep_guard_core::FakeDetector::Record path_detector_record_;  // of ~check_sweep
  ros::NodeHandle node_;
  LiveParameters parameters_{loadParameters(node_)};
  Supervisor supervisor_{Process::kShared};
  ServiceThreads service_threads_;
  MasterThread master_thread_;
  sweep_guard_core::WorkQueue queue_;
  sweep_guard_core::WorkpieceStore workpieces_{[this](const auto& workpieces) { monitor_.setWorkpieces(workpieces); }};
  sweep_guard_core::WarningMonitor monitor_{parameters_.initial().limits};
  WarningPublisher warnings_{node_, parameters_, monitor_};
  ScenePublisher scene_{node_, parameters_, monitor_, workpieces_};
  TouchesPublisher touches_{node_};
  sweep_guard_core::SweepStatistics statistics_{parameters_.initial().guard.cycle};
  Frames frames_{ros::NodeHandle(), parameters_.initial().max_message_size, [](const auto&, const auto&) {}};
  CrossCheckThread cross_check_{parameters_, monitor_};
  GuardThread guard_thread_{node_, dependenciesWith(parameters_)};
  PathTests path_tests_{{parameters_, frames_, workpieces_, monitor_},
                        /*frame_motions=*/nullptr,
                        [this](const auto& /*name*/, const auto& /*options*/) {
                          return std::make_unique<sweep_guard_core::FakeDetector>(path_detector_record_);
                        }};
  PathService check_sweep_{node_, "check_sweep", service_threads_, path_tests_, sweep_guard_ros::checkSweep};
  Controls controls_{
      node_,
      parameters_,
      monitor_,
      workpieces_,
      service_threads_,
      {[this] { guard_thread_.reset(); }, [this](const std::string& id) { return guard_thread_.acknowledge(id); },
       [this] { touches_.reset(); }}};
  ReconfigureServer reconfigure_server_{node_, service_threads_, master_thread_, parameters_,
                                        [this](const auto& next) { guard_thread_.apply(next); }};
  ros::AsyncSpinner spinner_{1};
};

TEST_F(ServicesTest, BehindAStuckSweepNothingIsResetOrChangedAndTheAnswerSaysSo) {
  std::promise<void> release;
  const auto stuck = queue_.submit<void>([released = release.get_future().share()] { released.wait(); });
  monitor_.fault(sweep_guard_core::kDetectorFault, "before the reset");
  const auto epoch = monitor_.checkpoint().epoch;
  const double hold_before = holdTime();

  const auto begin = std::chrono::steady_clock::now();
  std_srvs::Trigger reset;
  auto reset_client = clientOf<std_srvs::Trigger>("reset");
  ASSERT_TRUE(reset_client.call(reset));
  Reconfigure::Response response;
  auto reconfigure_client = clientOf<Reconfigure>("set_parameters");
  Reconfigure::Request request = hold(7.0);
  EXPECT_FALSE(reconfigure_client.call(request, response));
  EXPECT_LT(secondsSince(begin), 2.0);
  EXPECT_FALSE(reset.response.success);
  EXPECT_TRUE(has(reset.response.message, "stuck in a sweep: nothing was reset"));
  EXPECT_TRUE(has(reconfigure_server_.history().last_refusal, "stuck in a sweep: no parameter was changed"));

  release.set_value();  // what was given up does not happen later
  queue_.submit<void>([] {}).get();
  EXPECT_EQ(monitor_.checkpoint().epoch, epoch);
  EXPECT_EQ(holdTime(), hold_before);
  ASSERT_TRUE(reset_client.call(reset));
  EXPECT_TRUE(reset.response.success) << reset.response.message;
  EXPECT_NE(monitor_.checkpoint().epoch, epoch);
}

TEST_F(ServicesTest, APoseThatFailsEachTimeIsGivenUpByAReset) {
  placeWorkpiece(3);
  struct NotOfADetector {};  // not reported for one workpiece: ends the whole sweep
  const auto tries = std::make_shared<std::atomic<int>>(0);
  detector_record_.asked = [tries] {
    ++*tries;
    throw NotOfADetector();
  };
  sweepTo(0.0);
  while (*tries < 3) std::this_thread::yield();

  std_srvs::Trigger reset;
  ASSERT_TRUE(clientOf<std_srvs::Trigger>("reset").call(reset));
  EXPECT_TRUE(reset.response.success) << reset.response.message;
  queue_.submit<void>([] {}).get();
  EXPECT_FALSE(queue_.waitingSince());
}

// Stopped, a master accepts connections and answers none.
TEST_F(ServicesTest, WithoutAMasterAChangeIsAppliedAndTheAnswerSaysWhatIsMissing) {
  Reconfigure::Request first = hold(1.0);
  Reconfigure::Request second = hold(2.0);
  Reconfigure::Response response;
  auto client = clientOf<Reconfigure>("set_parameters");
  auto reset_client = clientOf<std_srvs::Trigger>("reset");
  std_srvs::Trigger reset;
  ASSERT_TRUE(client.call(first, response));
  ASSERT_TRUE(reset_client.call(reset));
  XmlRpc::XmlRpcValue name = ros::this_node::getName();
  XmlRpc::XmlRpcValue result;
  XmlRpc::XmlRpcValue master;
  ASSERT_TRUE(ros::master::execute("getPid", name, result, master, /*wait_for_master=*/false));

  ASSERT_EQ(kill(static_cast<int>(master), SIGSTOP), 0);
  const auto begin = std::chrono::steady_clock::now();
  const bool answered_well = client.call(second, response);
  const bool reset_answered = reset_client.call(reset);
  const double took = secondsSince(begin);
  kill(static_cast<int>(master), SIGCONT);

  EXPECT_LT(took, 2.0);
  EXPECT_FALSE(answered_well);
  EXPECT_TRUE(reset_answered && reset.response.success) << reset.response.message;
  EXPECT_EQ(holdTime(), 2.0);
  const std::string refusal = reconfigure_server_.history().last_refusal;
  EXPECT_TRUE(has(refusal, "applied: warning/hold_time from 1 to 2"));
  EXPECT_TRUE(has(refusal, "parameter server does not answer"));
  double written = 0.0;
  while (ros::ok() && written != 2.0) node_.getParam("warning/hold_time", written);  // once it answers
}

// Eight calls, of which the first one lasts: as many as may wait do, the others are refused before it ends.
TEST_F(ServicesTest, FourCallsWaitAndTheOthersAreBusyAtOnce) {
  const CheckSweep::Request request = longPath();
  struct Answer {
    CheckSweep::Response response;
    double took;
  };
  std::vector<std::future<Answer>> answers;
  answers.reserve(8);
  for (int i = 0; i < 8; ++i) {
    answers.push_back(std::async(std::launch::async, [this, asked = request]() mutable {
      auto client = clientOf<CheckSweep>("check_sweep");
      Answer answer;
      const auto begin = std::chrono::steady_clock::now();
      EXPECT_TRUE(client.call(asked, answer.response));
      answer.took = secondsSince(begin);
      return answer;
    }));
  }
  int busy = 0;
  for (std::future<Answer>& future : answers) {
    const Answer answer = future.get();
    EXPECT_FALSE(answer.response.success || answer.response.clear);
    if (!has(answer.response.message, "BUSY: 4 calls wait already")) continue;
    ++busy;
    EXPECT_LT(answer.took, kDeadline);
  }
  EXPECT_EQ(busy, 3);
  EXPECT_EQ(threadsOfNice(10), 1);
}

// The second one waits as long as the first one runs.
TEST_F(ServicesTest, ACallIsGivenUpAtTheDeadlineThatBeganWhenItCame) {
  const CheckSweep::Request request = longPath();
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::future<CheckSweep::Response>> answers;
  answers.reserve(4);
  for (int i = 0; i < 4; ++i) answers.push_back(std::async(std::launch::async, [&] { return checkSweep(request); }));
  for (auto& answer : answers) EXPECT_TRUE(has(answer.get().message, "not tested within 0.5 s"));
  EXPECT_LT(secondsSince(begin), 2.0 * kDeadline);
}

class PatientServicesTest : public ServicesTest {
 protected:
  PatientServicesTest() : ServicesTest("unknown", /*drop_every=*/0, /*deadline=*/20.0) {}
};

TEST_F(PatientServicesTest, AMeshThatIsRefusedWhileAPathIsTestedIsDoubted) {
  placeWorkpiece(10);
  CheckSweep::Request request = path(2);
  for (auto& pose : request.path) pose.pose.position.z = 1.0;
  EXPECT_TRUE(checkSweep(request).clear);
  path_detector_record_.asked = [this] { monitor_.meshRefused("wavy", "vertex 3 is NaN", now().steady); };
  const CheckSweep::Response response = checkSweep(request);
  EXPECT_TRUE(response.success);
  EXPECT_FALSE(response.clear || response.collision);
  EXPECT_TRUE(has(response.message, "vertex 3 is NaN"));
}

TEST_F(PatientServicesTest, AWorkpieceThatIsRemovedWhileAPathIsTestedIsStillAnsweredFor) {
  placeWorkpiece(10);
  CheckSweep::Request request = path(2);
  request.mesh_ids = {"wavy"};
  checkSweep(request);
  path_detector_record_.asked = [this] { workpieces_.remove("wavy", now().stamp); };
  const CheckSweep::Response response = checkSweep(request);
  EXPECT_TRUE(response.success) << response.message;
  EXPECT_TRUE(response.collision);
}

TEST_F(PatientServicesTest, ADetectorThatFailsItsTestAnswersNoPath) {
  placeWorkpiece(10);
  path_detector_record_.drop_every = 10;
  const CheckSweep::Response response = checkSweep(path(2));
  EXPECT_FALSE(response.success || response.clear);
  EXPECT_TRUE(has(response.message, "failed its self-test: "));
}

TEST_F(ServicesTest, APathIsGivenUpAtItsDeadline) {
  const auto begin = std::chrono::steady_clock::now();
  const CheckSweep::Response response = checkSweep(longPath());
  const double took = secondsSince(begin);
  EXPECT_FALSE(response.success || response.clear || response.collision);
  EXPECT_TRUE(has(response.message, "not tested within 0.5 s (check_sweep/deadline): given up "));
  EXPECT_GE(took, kDeadline);
  EXPECT_LT(took, 2.0 * kDeadline);
}

class BiasedDetectorTest : public ServicesTest {
 protected:
  BiasedDetectorTest() : ServicesTest("unknown", /*drop_every=*/10) {}
};

TEST_F(BiasedDetectorTest, IsNeverClearUntilItIsExchangedForAGoodOne) {
  EXPECT_NE(warning().reasons & sweep_guard_core::kSelftest, 0U);
  EXPECT_TRUE(has(warning().text, "failed its self-test: "));
  Reconfigure::Request request;
  request.config.strs.resize(1);
  request.config.strs[0].name = "detector";
  request.config.strs[0].value = "halfspace";
  Reconfigure::Response response;
  auto client = clientOf<Reconfigure>("set_parameters");
  EXPECT_FALSE(client.call(request, response));
  EXPECT_TRUE(has(reconfigure_server_.history().last_refusal, "no parameter was changed"));
  EXPECT_EQ(parameters_.get()->detector.name, "select");
  detector_record_.drop_every = 0;
  EXPECT_TRUE(clientOf<Reconfigure>("set_parameters").call(request, response));
  EXPECT_EQ(parameters_.get()->detector.name, "halfspace");
  EXPECT_EQ(warning().reasons & sweep_guard_core::kSelftest, 0U);
}

TEST_F(BiasedDetectorTest, EndsTheNodeIfAsked) {
  node_.setParam("self_test", "exit");
  LiveParameters exits(loadParameters(node_));
  EXPECT_THROW(GuardThread(node_, dependenciesWith(exits)), sweep_guard_core::DeviceError);
}

// Only the next pose says that the way is free.
TEST_F(BiasedDetectorTest, WhatItSweptDoesNotCountOnceItIsExchanged) {
  placeWorkpiece(10);
  sweepTo(2.0);
  while (ros::ok() && (warning().reasons & sweep_guard_core::kNoPose) != 0) std::this_thread::yield();
  detector_record_.drop_every = 0;
  Reconfigure::Request request;
  request.config.strs.resize(1);
  request.config.strs[0].name = "detector";
  request.config.strs[0].value = "halfspace";
  Reconfigure::Response response;
  ASSERT_TRUE(clientOf<Reconfigure>("set_parameters").call(request, response));
  EXPECT_NE(warning().reasons & sweep_guard_core::kNoPose, 0U);
  EXPECT_EQ(warning().covered_until, sweep_guard_core::Time());
}

class UntestedDetectorTest : public ServicesTest {
 protected:
  UntestedDetectorTest() : ServicesTest("none", /*drop_every=*/1) {}
};

// The guard's detector finds nothing. The other one does, in spare time.
TEST_F(UntestedDetectorTest, ADisagreementIsAContactAndIsLoggedAndStaysUntilReset) {
  using sweep_guard_core::kCrosscheck;
  std::atomic<bool> logged{false};
  const auto hear = [&](const rosgraph_msgs::Log::ConstPtr& line) {
    if (has(line->msg, "CROSSCHECK: detectors disagree about 'wavy'") && has(line->msg, "mesh 'wavy' revision 1 at "))
      logged = true;
  };
  const ros::Subscriber log = ros::NodeHandle().subscribe<rosgraph_msgs::Log>("/rosout", 100, hear);
  placeWorkpiece(10);
  sweepTo(0.2);
  sweepTo(0.05);
  while (ros::ok() && (warning().reasons & kCrosscheck) == 0) std::this_thread::yield();
  const sweep_guard_core::Warning found = warning();
  EXPECT_EQ(found.level, sweep_guard_core::WarningLevel::kContact);
  EXPECT_EQ(found.mesh_id, "wavy");
  EXPECT_FALSE(found.triangles.empty());
  EXPECT_TRUE(has(found.text, "detectors disagree about 'wavy'"));
  while (ros::ok() && !logged) std::this_thread::yield();

  detector_record_.drop_every = 0;
  std_srvs::Trigger reset;
  ASSERT_TRUE(clientOf<std_srvs::Trigger>("reset").call(reset));
  EXPECT_TRUE(reset.response.success);
  EXPECT_EQ(warning().reasons & kCrosscheck, 0U);
}

}  // namespace
}  // namespace sweep_guard_ros
