#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace sweep_guard_fuzz {

/// Judges warnings by what the monitor was given. Written from doc/failure-modes.md, doc/interface.md and the headers of the
/// monitor; shares no code with it. Times are in milliseconds.
class MonitorModel {
 public:
  static constexpr int kIds = 3;
  using Level = int;  ///< as in msg/Warning.msg

  struct Clock {
    std::int64_t stamp = 0;
    std::int64_t steady = 0;
  };
  struct Checkpoint {
    int epoch = 0;
    int event = 0;
  };
  /// What a sweep or a prediction says about one workpiece.
  struct Tested {
    bool present = false;
    int mesh = 0;             ///< triangles and frame
    std::int64_t received{};  ///< of the snapshot
    bool behind = false;      ///< updates were left out
    bool contact = false;
    std::int64_t from = 0;  ///< of a prediction: when contact begins, after its pose
  };
  struct Report {
    std::array<Tested, kIds> tested;
    std::array<bool, kIds> missing{};  ///< unplaced or failed
    bool failed = false;               ///< one of the missing
    Clock pose;
    Checkpoint checkpoint;
    std::int64_t length = 0;  ///< of a predicted path; 0: none
    std::int64_t took = 0;
    std::int64_t backlog = 0;
  };

  int event() { return ++event_; }
  Checkpoint checkpoint() const { return {epoch_, event_}; }

  void place(int id, int mesh, const Clock& times);
  void remove(int id);
  void require(int id, bool required) { required_[at(id)] = required; }
  void fault() { fault_ = event(); }
  void fail(std::int64_t now, bool lasting);
  void refuseMesh(int id, std::int64_t received) { refused_meshes_[at(id)] = received; }
  void refuseVertices(int id, std::int64_t received) { refused_vertices_[at(id)] = received; }
  void acceptMesh(int id, std::int64_t received);
  void acceptVertices(int id, std::int64_t received);
  void unread(std::int64_t now) { unread_ = now; }
  void drop(int id, std::int64_t received);
  void selfTest(bool passed);
  void disagree(int id, int mesh, bool missed, const Checkpoint& asked, std::int64_t now);
  void jump();
  void restart();
  void disable();
  void enable();
  void end();
  void hang(bool hung) { hung_ = hung; }
  void wait(std::optional<std::int64_t> since) { waiting_ = since; }
  void sweep(const Report& report, std::int64_t now);
  void predict(const Report& report, const Clock& now);

  Level level(const Clock& now) const;
  std::string whyNotClear(const Clock& now) const;  ///< empty: the level is CLEAR unless there is a warning
  bool known(int id) const { return workpieces_[at(id)].has_value(); }
  bool disabled() const { return disabled_; }
  bool ended() const { return ended_; }

 private:
  struct Workpiece {
    int mesh;
    Clock times;
    std::optional<int> swept;                // mesh
    std::optional<std::int64_t> dropped;     // received
    std::map<int, std::int64_t> replaced{};  // meshes before this one: when the next came
  };
  struct Contact {
    int id;
    std::int64_t found;
    bool lasts;
  };
  struct Failure {
    int event;
    std::int64_t found;
    bool lasts;
  };
  struct Expected {
    Clock pose;
    std::int64_t from;
    std::int64_t length;
  };
  struct Alarm {
    Level level;
    std::int64_t ended;
  };
  struct Coverage {
    Report report;
    std::int64_t until;
  };

  static size_t at(int id) { return static_cast<size_t>(id); }
  static bool counts(const std::optional<int>& tested, const Workpiece& workpiece, const Clock& now);
  static void keepAlarm(std::optional<Alarm>& kept, const Alarm& alarm);  // the one that ended later
  void newEpoch();
  void sweepBeforeJump(const Report& report, std::int64_t now);
  void endExpected(int id, const Clock& now);
  std::string whyNotSwept(const Clock& now) const;
  std::string whyNotCovered(const Clock& now) const;
  Level warned(const Clock& now) const;

  int epoch_ = 0;
  int first_epoch_ = 0;  // from this one on, only jumps of time began epochs
  int event_ = 0;
  bool disabled_ = false;
  bool ended_ = false;
  bool hung_ = false;
  bool self_test_failed_ = false;
  bool disagreed_ = false;
  int fault_ = 0;  // newest event; 0: over
  std::optional<Failure> failure_;
  std::optional<std::int64_t> waiting_;
  std::optional<std::int64_t> unread_;
  std::array<std::optional<Workpiece>, kIds> workpieces_;
  std::array<bool, kIds> required_{};
  std::array<std::optional<std::int64_t>, kIds> refused_meshes_;
  std::array<std::optional<std::int64_t>, kIds> refused_vertices_;
  std::optional<Clock> pose_;  // swept
  std::optional<Contact> contact_;
  std::array<std::optional<Expected>, kIds> expected_;
  std::array<std::array<std::optional<Alarm>, 2>, kIds> alarms_;
  std::int64_t swept_until_ = 0;
  std::optional<Coverage> coverage_;
  std::int64_t took_ = 0;
};

}  // namespace sweep_guard_fuzz
