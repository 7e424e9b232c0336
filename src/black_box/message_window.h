#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// A message and what a MessageWindow has to know about it.
template <typename Content>
struct WindowMessage {
  Time received;     ///< on the clock that stamps
  std::size_t size;  ///< memory that it takes [bytes]
  std::string key;   ///< what it describes, or empty. See MessageWindow
  Content content;
};

/// Keeps the messages of the last seconds, in the order in which they were received, and of those before them the newest of
/// each key: what a listener that had come earlier would know at the begin of the window. A key may have a second part
/// behind a line feed, which says what it depends on: as "mesh" leaves the window, "mesh\nvertices" from before is forgotten.
///
/// The kept messages take at most `max_size` bytes: the oldest messages leave the window first, then the oldest that
/// are kept by their key. A message that is larger by itself is not kept. Not thread-safe.
template <typename Content>
class MessageWindow {
 public:
  using Message = WindowMessage<Content>;

  static constexpr std::size_t kMaxKeys = 4096;  ///< names are made by others
  /// Messages that are kept by their key are spread over this time before the first message of a snapshot, so that a
  /// large mesh is converted before vertices and poses follow.
  static constexpr Duration kLead = std::chrono::seconds(1);

  /// @param length    of the window, above 0
  /// @param max_size  [bytes]
  MessageWindow(Duration length, std::size_t max_size) : max_length_(length), max_size_(max_size) {}

  /// @returns whether the message is kept; if not, all others are
  bool add(Message message) {
    if (message.size > max_size_) return false;
    size_ += message.size;
    window_.push_back(std::move(message));
    while (window_.front().received < window_.back().received - max_length_) shift();
    while (size_ > max_size_ && window_.size() > 1) shift();
    while (size_ > max_size_) forgetOldest();
    return true;
  }

  /// Forgets all but the newest of each key, because later messages belong to another time.
  void startOver() {
    while (!window_.empty()) shift();
  }

  /// Returns what is kept as a recording: in order, with times above 0 that increase. Messages of the window keep theirs, but
  /// for equal ones, which are moved on by a nanosecond. The others are spread over kLead before.
  std::vector<Message> snapshot() const {
    std::vector<Message> all;
    all.reserve(before_.size() + window_.size());
    for (const auto& [key, message] : before_) all.push_back(message);
    std::sort(all.begin(), all.end(), [](const Message& a, const Message& b) { return a.received < b.received; });
    if (!window_.empty()) spreadBefore(window_.front().received, all);
    all.insert(all.end(), window_.begin(), window_.end());
    Time earliest(Duration(1));
    for (Message& message : all) {
      message.received = std::max(message.received, earliest);
      earliest = message.received + Duration(1);
    }
    return all;
  }

  /// Returns whether the window reaches over a moment.
  bool covers(Time time) const {
    return !window_.empty() && window_.front().received <= time && time <= window_.back().received;
  }
  /// Returns whether the size lets messages leave for one of this size, and a moment is in the older half of the window.
  bool isLeaving(Time time, std::size_t size) const {
    return size_ + size > max_size_ && covers(time) && time - window_.front().received < length() / 2;
  }
  Time newest() const { return window_.empty() ? Time() : window_.back().received; }  ///< when it was received; or 0

  /// Returns whether the clock has gone back since the newest message, so far that startOver() is due.
  bool hasGoneBack(Time now) const { return !window_.empty() && now < window_.back().received - kLead; }

  std::size_t size() const { return size_; }            ///< [bytes]
  std::size_t count() const { return window_.size(); }  ///< of messages in the window
  Duration length() const { return window_.empty() ? Duration(0) : window_.back().received - window_.front().received; }

 private:
  static void spreadBefore(Time begin, std::vector<Message>& messages) {
    const Duration lead = std::min(kLead, begin.time_since_epoch());
    const Duration step = lead / static_cast<Duration::rep>(std::max<std::size_t>(messages.size(), 1));
    Time time = begin - lead;
    for (Message& message : messages) {
      message.received = time;
      time += step;
    }
  }

  // The oldest message of the window leaves it.
  void shift() {
    Message message = std::move(window_.front());
    window_.pop_front();
    if (message.key.empty()) {
      size_ -= message.size;
      return;
    }
    const std::string key = message.key;
    forget(key);
    before_.insert_or_assign(key, std::move(message));
    if (before_.size() > kMaxKeys) forgetOldest();
  }

  void forget(const std::string& key) {
    const auto first = before_.lower_bound(key + '\n');
    const auto last = before_.lower_bound(key + static_cast<char>('\n' + 1));
    for (auto next = first; next != last; next = before_.erase(next)) size_ -= next->second.size;
    const auto same = before_.find(key);
    if (same != before_.end()) size_ -= same->second.size;
  }

  void forgetOldest() {
    const auto oldest = std::min_element(before_.begin(), before_.end(), [](const auto& a, const auto& b) {
      return a.second.received < b.second.received;
    });
    size_ -= oldest->second.size;
    before_.erase(oldest);
  }

  const Duration max_length_;
  const std::size_t max_size_;
  std::deque<Message> window_;
  std::map<std::string, Message> before_;  // by key
  std::size_t size_ = 0;
};

}  // namespace sweep_guard_core
