// Of eight calls of a service, of which the first one lasts, one runs, four wait, and three are answered at once. Calls of
// other services that have another thread do not wait for it.
#include "ros/service/limited_calls.h"

#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <boost/make_shared.hpp>
#include <functional>
#include <future>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "refusal.h"
#include "ros/parameters/reconfigure_server.h"
#include "ros/service/controls.h"
#include "ros/service/predict.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

constexpr int kCalls = 8;
constexpr int kBusy = kCalls - 1 - LimitedCalls::kMaxWaiting;

class Call : public ros::CallbackInterface {
 public:
  Call(const LimitedCalls& calls, std::promise<std::string>& refused) : calls_(calls), refused_(refused) {}
  CallResult call() override {
    refused_.set_value(refusal<sweep_guard_core::Error>([this] { calls_.throwIfBusy(); }));
    return Success;
  }

 private:
  const LimitedCalls& calls_;
  std::promise<std::string>& refused_;
};

TEST(LimitedCallsTest, CallsThatCameBeforeTheStartAreRefusedLikeLaterOnes) {
  Supervisor supervisor{Process::kShared};
  ServiceThreads threads;
  LimitedCalls calls(threads.brief, threads.refusals);
  std::array<std::promise<std::string>, kCalls> refused;
  for (auto& one : refused) calls.addCallback(boost::make_shared<Call>(calls, one), /*owner=*/0);
  threads.start(supervisor);
  int count = 0;
  for (auto& one : refused) count += has(one.get_future().get(), "BUSY: 4 calls wait already") ? 1 : 0;
  EXPECT_EQ(count, kBusy);
  threads.stop();
}

// Lasts until it is released.
class LongCall : public ros::CallbackInterface {
 public:
  CallResult call() override {
    begun_.set_value();
    released_.get_future().wait();
    return Success;
  }
  void awaitBegin() { begun_.get_future().wait(); }
  void release() { released_.set_value(); }

 private:
  std::promise<void> begun_;
  std::promise<void> released_;
};

TEST(LimitedCallsTest, ALongCallHoldsUpNeitherBriefCallsNorRefusals) {
  Supervisor supervisor{Process::kShared};
  ServiceThreads threads;
  threads.start(supervisor);
  LimitedCalls lasting(threads.lasting, threads.refusals);
  LimitedCalls brief(threads.brief, threads.refusals);
  const auto held = boost::make_shared<LongCall>();
  lasting.addCallback(held, /*owner=*/0);
  held->awaitBegin();
  std::promise<std::string> answered;
  brief.addCallback(boost::make_shared<Call>(brief, answered), /*owner=*/1);
  EXPECT_EQ(answered.get_future().get(), "");
  std::array<std::promise<std::string>, LimitedCalls::kMaxWaiting> waiting;
  for (auto& one : waiting) lasting.addCallback(boost::make_shared<Call>(lasting, one), /*owner=*/0);
  std::promise<std::string> refused;
  lasting.addCallback(boost::make_shared<Call>(lasting, refused), /*owner=*/0);
  EXPECT_TRUE(has(refused.get_future().get(), "BUSY: 4 calls wait already"));
  held->release();
  for (auto& one : waiting) EXPECT_EQ(one.get_future().get(), "");
  threads.stop();
}

// Each service has a limit of its own, also where they share a thread.
TEST(LimitedCallsTest, ABusyServiceLeavesRoomForAnother) {
  Supervisor supervisor{Process::kShared};
  ServiceThreads threads;
  LimitedCalls busy(threads.brief, threads.refusals);
  LimitedCalls other(threads.brief, threads.refusals);
  std::array<std::promise<std::string>, kCalls> refused;
  for (auto& one : refused) busy.addCallback(boost::make_shared<Call>(busy, one), /*owner=*/0);
  std::promise<std::string> answered;
  other.addCallback(boost::make_shared<Call>(other, answered), /*owner=*/1);
  threads.start(supervisor);
  EXPECT_EQ(answered.get_future().get(), "");
  for (auto& one : refused) one.get_future().wait();
  threads.stop();
}

// The services of a guard that answers none before it is released.
class LimitedServicesTest : public testing::Test {
 protected:
  LimitedServicesTest() {
    threads_.start(supervisor_);
    spinner_.start();
  }
  ~LimitedServicesTest() override {
    release();
    threads_.stop();
  }

  void release() {
    if (!std::exchange(released_, true)) release_.set_value();
  }

  // Asks eight times at once, and releases the guard when three are answered. Returns how many the text was said to.
  int countOf(const std::string& text, const std::function<std::string()>& ask) {
    std::vector<std::future<std::string>> answers;
    answers.reserve(kCalls);
    for (int i = 0; i < kCalls; ++i) {
      answers.push_back(std::async(std::launch::async, [&] {
        std::string answer = ask();
        ++answered_;
        return answer;
      }));
    }
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (answered_ < kBusy && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    release();
    int count = 0;
    for (auto& answer : answers) count += answer.get() == text ? 1 : 0;
    return count;
  }

  template <typename Service>
  int busyCallsOf(const std::string& name) {
    return countOf("BUSY: 4 calls wait already; ask again", [this, name] {
      Service service;
      EXPECT_TRUE(node_.serviceClient<Service>(name, /*persistent=*/true).call(service));
      return service.response.success ? "" : service.response.message;
    });
  }

  std::string changeHoldTime() {
    dynamic_reconfigure::Reconfigure change;
    change.request.config.doubles.resize(1);
    change.request.config.doubles[0].name = "warning/hold_time";
    change.request.config.doubles[0].value = 2.0;
    auto client = node_.serviceClient<dynamic_reconfigure::Reconfigure>("set_parameters", /*persistent=*/true);
    return client.call(change) ? "changed" : "refused";
  }

  ros::NodeHandle node_{"~limited"};
  std::promise<void> release_;
  bool released_ = false;
  const std::shared_future<void> stuck_ = release_.get_future().share();
  std::atomic<int> answered_ = 0;
  LiveParameters parameters_{loadParameters(node_)};
  Supervisor supervisor_{Process::kShared};
  ServiceThreads threads_;
  MasterThread master_thread_;
  sweep_guard_core::WorkpieceStore workpieces_;
  sweep_guard_core::WarningMonitor monitor_{parameters_.initial().limits};
  Controls controls_{node_,
                     parameters_,
                     monitor_,
                     workpieces_,
                     threads_,
                     {[this] { stuck_.wait(); },
                      [this](const std::string& id) {
                        stuck_.wait();
                        return id;
                      },
                      [] {}}};
  PredictService predict_{node_, threads_, parameters_, workpieces_,
                          [this](auto) -> std::future<PredictService::Motion> {
                            stuck_.wait();
                            throw sweep_guard_core::Error("no tool pose yet");
                          }};
  ReconfigureServer reconfigure_server_{node_, threads_, master_thread_, parameters_, [this](const auto& next) {
                                          stuck_.wait();
                                          parameters_.set(next);
                                        }};
  ros::AsyncSpinner spinner_{1};
};

TEST_F(LimitedServicesTest, OfEightResetsThreeAreBusyAtOnce) {
  EXPECT_EQ(busyCallsOf<std_srvs::Trigger>("reset"), kBusy);
}

TEST_F(LimitedServicesTest, OfEightAcknowledgementsThreeAreBusyAtOnce) {
  EXPECT_EQ(busyCallsOf<sweep_guard::Acknowledge>("acknowledge"), kBusy);
}

TEST_F(LimitedServicesTest, OfEightPredictionsThreeAreBusyAtOnce) {
  EXPECT_EQ(busyCallsOf<sweep_guard::Predict>("predict"), kBusy);
}

TEST_F(LimitedServicesTest, OfEightChangesOfParametersThreeAreRefusedAtOnce) {
  EXPECT_EQ(countOf("refused", [this] { return changeHoldTime(); }), kBusy);
}

}  // namespace
}  // namespace sweep_guard_ros
