#include "session/patient_call.h"

#include <gtest/gtest.h>

#include <memory>

namespace sweep_guard_session {
namespace {

TEST(PatientCallTest, HasTheAnswerOnceItReturns) {
  for (const bool expected : {true, false}) {
    std::future<bool> call = startCall([expected] { return expected; });
    call.wait();
    EXPECT_TRUE(hasReturned(call));
    EXPECT_EQ(call.get(), expected);
  }
}

TEST(PatientCallTest, KeepsNobodyWhileItDoesNotReturn) {
  const auto release = std::make_shared<std::promise<bool>>();
  const std::shared_future<bool> released = release->get_future().share();
  std::future<bool> call = startCall([released] { return released.get(); });
  const auto discard = [released] { startCall([released] { return released.get(); }); };
  const std::future<void> discarded = std::async(std::launch::async, discard);
  EXPECT_EQ(discarded.wait_for(std::chrono::seconds(20)), std::future_status::ready);
  EXPECT_FALSE(hasReturned(call));
  release->set_value(true);
  EXPECT_TRUE(call.get());
}

}  // namespace
}  // namespace sweep_guard_session
