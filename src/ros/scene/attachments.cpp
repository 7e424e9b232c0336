#include "ros/scene/attachments.h"

#include <sweep_guard/Attach.h>

#include <utility>

namespace sweep_guard_ros {
namespace {

constexpr auto kPeriod = std::chrono::milliseconds(500);

bool holds(const std::map<std::string, std::string>& links, const std::string& id, const std::string& link) {
  const auto found = links.find(id);
  return found == links.end() ? link.empty() : found->second == link;
}

}  // namespace

Attachments::Attachments(const ros::NodeHandle& node, const std::string& guard, Report report)
    : report_(std::move(report)), attach_(ros::NodeHandle(node).serviceClient<sweep_guard::Attach>(guard + "/attach")) {
  thread_.every(kPeriod, [this] { exchange(); });
}

void Attachments::start(Supervisor& supervisor) {
  thread_.start(supervisor, {"attachments", sweep_guard_core::Stage::kOther, /*watched=*/false});
}

bool Attachments::setLink(const std::string& id, const std::string& link) {
  const sweep_guard_core::Lock lock(mutex_);
  if (link.empty()) {
    wanted_.erase(id);
  } else {
    wanted_[id] = link;
  }
  return holds(done_, id, link) && (!link.empty() || doubted_.count(id) == 0);
}

// It may be another guard, or somebody else beside the one that holds them.
void Attachments::beginAnew() {
  const sweep_guard_core::Lock lock(mutex_);
  doubted_.insert(done_.begin(), done_.end());
  done_.clear();
}

// One that changes its link is detached first.
void Attachments::exchange() {
  Links wanted;
  Links done;
  Links held;  // maybe
  {
    const sweep_guard_core::Lock lock(mutex_);
    wanted = wanted_;
    done = done_;
    held = doubted_;
  }
  held.insert(done.begin(), done.end());
  for (const auto& [id, link] : held) {
    if (!holds(wanted, id, link) && !detach(id)) wanted.erase(id);
  }
  for (const auto& [id, link] : wanted) {
    if (done.count(id) == 0) attach(id, link);
  }
}

void Attachments::attach(const std::string& id, const std::string& link) {
  std::string why = ask(id, link);
  if (why.find("attached already") != std::string::npos) why.clear();  // by the scene_input before
  if (why.empty()) {
    const sweep_guard_core::Lock lock(mutex_);
    done_[id] = link;
    doubted_.erase(id);
  }
  report_(id, why.empty() ? "" : "held by the link '" + link + "', and not attached: " + why);
}

// Returns whether it is done.
bool Attachments::detach(const std::string& id) {
  std::string why = ask(id, "");
  if (why.find("is not attached") != std::string::npos) why.clear();  // by a guard that is new
  if (why.empty()) {
    const sweep_guard_core::Lock lock(mutex_);
    done_.erase(id);
    doubted_.erase(id);
  }
  report_(id, why.empty() ? "" : "not detached: " + why);
  return why.empty();
}

// Returns why the guard has not done it.
std::string Attachments::ask(const std::string& id, const std::string& link) {
  sweep_guard::Attach call;
  call.request.mesh_id = id;
  call.request.link = link;
  call.request.attach = static_cast<std::uint8_t>(!link.empty());
  if (!attach_.call(call)) return "no answer from " + attach_.getService();
  return call.response.success != 0 ? std::string() : call.response.message;
}

}  // namespace sweep_guard_ros
