// Of eight calls of a service, of which the first one lasts, one runs, four wait, and three are answered at once.
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
  explicit Call(std::promise<std::string>& refused) : refused_(refused) {}
  CallResult call() override {
    refused_.set_value(refusal<sweep_guard_core::Error>(LimitedCalls::throwIfBusy));
    return Success;
  }

 private:
  std::promise<std::string>& refused_;
};

TEST(LimitedCallsTest, CallsThatCameBeforeTheStartAreRefusedLikeLaterOnes) {
  Supervisor supervisor{Process::kShared};
  LimitedCalls calls("calls");
  std::array<std::promise<std::string>, kCalls> refused;
  for (auto& one : refused) calls.addCallback(boost::make_shared<Call>(one), /*owner=*/0);
  calls.start(supervisor);
  int count = 0;
  for (auto& one : refused) count += has(one.get_future().get(), "BUSY: 4 calls wait already") ? 1 : 0;
  EXPECT_EQ(count, kBusy);
}

// The services of a guard that answers none before it is released.
class LimitedServicesTest : public testing::Test {
 protected:
  LimitedServicesTest() {
    controls_.start(supervisor_);
    predict_.start(supervisor_);
    reconfigure_server_.start(supervisor_);
    spinner_.start();
  }
  ~LimitedServicesTest() override { release(); }

  void release() {
    if (!std::exchange(released_, true)) release_.set_value();
  }

  // Asks eight times at once, and releases the guard when three are answered. Returns how many the text was said to.
  int countOf(const std::string& text, const std::function<std::string()>& ask) {
    std::vector<std::future<std::string>> answers;
    for (int i = 0; i < kCalls; ++i) {
      answers.push_back(std::async(std::launch::async, [&] {
        const std::string answer = ask();
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
  sweep_guard_core::WorkpieceStore workpieces_;
  sweep_guard_core::WarningMonitor monitor_{parameters_.initial().limits};
  Controls controls_{node_,
                     parameters_,
                     monitor_,
                     workpieces_,
                     {[this] { stuck_.wait(); },
                      [this](const std::string& id) {
                        stuck_.wait();
                        return id;
                      },
                      [] {}}};
  PredictService predict_{node_, parameters_, workpieces_, [this](auto) -> std::future<PredictService::Motion> {
                            stuck_.wait();
                            throw sweep_guard_core::Error("no tool pose yet");
                          }};
  ReconfigureServer reconfigure_server_{node_, parameters_, [this](const auto& next) {
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
