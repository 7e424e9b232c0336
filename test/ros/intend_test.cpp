// ~intend, ~intend_updates and ~intended of a running guard. Part of node_test.
#include <sweep_guard/Intended.h>
#include <sweep_guard/SetIntent.h>

#include <condition_variable>
#include <mutex>

#include "node_fixture.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Intend;
using sweep_guard::Intended;
using sweep_guard::Warning;

class IntendTest : public NodeTest {
 protected:
  void SetUp() override {
    NodeTest::SetUp();
    subscriber_ = node_.subscribe<Intended>("/sweep_guard/intended", 100, [this](const Intended::ConstPtr& intended) {
      const std::lock_guard lock(mutex_);
      newest_ = *intended;
      changed_.notify_all();
    });
    updates_ = node_.advertise<Intend>("/sweep_guard/intend_updates", 10,
                                       [this](const ros::SingleSubscriberPublisher&) { changed_.notify_all(); });
    awaitSubscriber();
    awaitIntended([](const Intended& intended) { return intended.intentions.empty(); });
  }

  void awaitSubscriber() {
    std::unique_lock lock(mutex_);
    const bool came =
        changed_.wait_for(lock, std::chrono::seconds(20), [&] { return updates_.getNumSubscribers() > 0; });
    if (!came) throw std::runtime_error("nobody listens to ~intend_updates");
  }

  Intended awaitIntended(const std::function<bool(const Intended&)>& fits) {
    std::unique_lock lock(mutex_);
    const bool came = changed_.wait_for(lock, std::chrono::seconds(20), [&] { return newest_ && fits(*newest_); });
    if (!came) throw std::runtime_error("no such ~intended");
    return *newest_;
  }

  sweep_guard::SetIntent::Response intend(const std::vector<Intend>& intends) {
    sweep_guard::SetIntent service;
    service.request.intends = intends;
    EXPECT_TRUE(ros::service::call("/sweep_guard/intend", service));
    return service.response;
  }

  static Intend wholeSquare(double depth = 0.02) {
    Intend intend;
    intend.mesh_id = "square";
    intend.triangles = {1, 0};
    intend.depth = depth;
    return intend;
  }

  ros::NodeHandle node_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Intended> newest_;
  ros::Subscriber subscriber_;  // its callback uses those before
  ros::Publisher updates_;
};

TEST_F(IntendTest, ContactThatIsMeantIsNoContactAndTheMessagesSaySo) {
  placeSquare("square", {0.0, 0.0, 0.0});
  const auto response = intend({wholeSquare()});
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_EQ(response.message, "contact is meant in 1 region(s) of 2 triangle(s) in all");
  const Intended intended = awaitIntended([](const Intended& next) { return next.intentions.size() == 1; });
  EXPECT_EQ(intended.intentions[0].triangles, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(intended.intentions[0].depth, 0.02);
  EXPECT_TRUE(intended.intentions[0].until.isZero());
  moveTo({0.0, 0.0, 0.05});
  const sweep_guard::Contacts contacts = moveTo({0.0, 0.0, -0.01});
  ASSERT_EQ(contacts.objects.size(), 1U);
  EXPECT_FALSE(contacts.objects[0].intended.empty());
  const Warning warning = probe().awaitWarning([](const Warning& next) { return next.intended != 0; });
  EXPECT_NE(warning.level, Warning::CONTACT);
  EXPECT_TRUE(has(warning.text, "intended contact with 'square'"));
  moveTo({0.0, 0.0, -0.03});
  probe().awaitWarning([](const Warning& next) { return next.contact != 0; });
}

TEST_F(IntendTest, AnUpdateHasTheSameEffectAndIsTakenBack) {
  placeSquare("square", {0.0, 0.0, 0.0});
  Intend painted;
  painted.mesh_id = "square";
  painted.frame_id = "world";
  painted.radius = 1.0;
  painted.depth = 0.01;
  updates_.publish(painted);
  const Intended intended = awaitIntended([](const Intended& next) { return next.intentions.size() == 1; });
  EXPECT_EQ(intended.intentions[0].triangles.size(), 2U);
  EXPECT_EQ(intended.refusal, "");
  Intend nothing;
  nothing.mesh_id = "square";
  updates_.publish(nothing);
  awaitIntended([](const Intended& next) { return next.intentions.empty(); });
}

TEST_F(IntendTest, ARefusedUpdateIsReported) {
  Intend unknown = wholeSquare();
  unknown.mesh_id = "liver";
  updates_.publish(unknown);
  const Intended intended = awaitIntended([](const Intended& next) { return !next.refusal.empty(); });
  EXPECT_EQ(intended.refusal, "there is no workpiece 'liver'");
  placeSquare("square", {0.0, 0.0, 0.0});
  updates_.publish(wholeSquare());
  awaitIntended([](const Intended& next) { return next.refusal.empty() && next.intentions.size() == 1; });
}

TEST_F(IntendTest, TheServiceRefusesWithPlainText) {
  placeSquare("square", {0.0, 0.0, 0.0});
  const auto refusal = [&](const Intend& wrong) {
    const auto response = intend({wholeSquare(), wrong});
    EXPECT_FALSE(response.success);
    return response.message;
  };
  Intend wrong = wholeSquare();
  wrong.tool_links = {"shaft"};
  EXPECT_EQ(refusal(wrong), "the tool has no link 'shaft'");
  wrong = wholeSquare();
  wrong.triangles = {2};
  EXPECT_EQ(refusal(wrong), "'square' has no triangle 2");
  wrong = wholeSquare(0.0);
  EXPECT_EQ(refusal(wrong), "depth must be above 0 and at most 0.5 m");
  wrong = wholeSquare();
  wrong.mesh_id = "";
  EXPECT_EQ(refusal(wrong), "mesh_id is no name");
  wrong = wholeSquare();
  wrong.radius = 0.001;
  wrong.frame_id = "nowhere";
  EXPECT_TRUE(has(refusal(wrong), "nowhere"));
  EXPECT_EQ(intend(std::vector<Intend>(65, wholeSquare())).message, "send at most 64 regions at once");
  EXPECT_TRUE(newest_->intentions.empty());
}

TEST_F(IntendTest, EndsAfterItsDurationWhenTheMeshIsReplacedAndWithAReset) {
  placeSquare("square", {0.0, 0.0, 0.0});
  Intend brief = wholeSquare();
  brief.duration = ros::Duration(0.2);
  const auto is_there = [](const Intended& next) { return next.intentions.size() == 1; };
  const auto is_over = [](const Intended& next) { return next.intentions.empty(); };
  ASSERT_TRUE(intend({brief}).success);
  EXPECT_FALSE(awaitIntended(is_there).intentions[0].until.isZero());
  awaitIntended(is_over);

  ASSERT_TRUE(intend({wholeSquare()}).success);
  awaitIntended(is_there);
  auto other = squareAt("square", {0.0, 0.0, 0.0}, probe().time());
  other.revision = 2;
  other.mesh.triangles.pop_back();
  probe().place(other);
  awaitIntended(is_over);

  placeSquare("square", {0.0, 0.0, 0.0});
  ASSERT_TRUE(intend({wholeSquare()}).success);
  awaitIntended(is_there);
  ASSERT_TRUE(probe().reset().success);
  awaitIntended(is_over);
}

}  // namespace
}  // namespace sweep_guard_ros
