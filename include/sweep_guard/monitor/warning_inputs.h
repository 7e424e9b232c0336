#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/monitor/predicted_contact.h"
#include "sweep_guard/monitor/reason.h"

namespace sweep_guard_core {

/// Holds the inputs of computeWarning().
struct WarningInputs {
  /// A workpiece.
  struct Object {
    std::string id;
    Timestamps timestamps;  ///< of the newest update
    bool swept = false;     ///< swept at the newest pose, with these triangles and frame; maybe with older vertices
    /// The pose at which the last sweep began is older by this than the oldest update that is still kept: how the
    /// workpiece moved in between was not tested, and `swept` is false. 0: nothing was left out.
    Duration behind = {};
    bool dropped = false;   ///< an update was dropped unread, and no later one has been swept
    bool ages = true;       ///< false: of another tool
    size_t open_edges = 0;  ///< borders of its surface, TriangleMesh::openEdges()
    /// Until when other triangles, which were swept at the newest pose, count for these, which replaced them; empty: they do not.
    std::optional<SteadyTime> stands_in_until = {};
  };
  /// Another tool that is watched, too.
  struct OtherTool {
    std::string name;                  ///< of its guard
    std::optional<Timestamps> newest;  ///< of its newest pose that counts
    std::string problem;               ///< why its newest pose does not count; empty: it does
  };
  /// A frame of workpieces that moves, as transforms tell.
  struct Frame {
    std::string name;
    Timestamps newest;                     ///< of its newest transform
    Duration period{};                     ///< between its transforms, as a rule
    Duration late{};                       ///< its age when it was last found to be late
    std::optional<SteadyTime> found = {};  ///< when that was; empty: never
    std::vector<Duration> intervals = {};  ///< the newest ones between its transforms
  };
  /// A workpiece that the tool touches.
  struct Contact {
    std::string id;
    std::vector<std::uint32_t> triangles;   ///< those not ruled out: ascending, each once; may be empty if `inside`
    SteadyTime found;                       ///< when a sweep last met it, or detectors last disagreed about a sweep
    bool lasting = false;                   ///< the newest sweep has met it, or could not test it
    bool inside = false;                    ///< the tool is inside the workpiece
    std::optional<size_t> tool_piece = {};  ///< convex piece that touched first, if the narrow phase knows
  };
  /// A warning whose prediction has ended, or was replaced by a newer one.
  struct Alarm {
    PredictedContact contact;
    SteadyTime ended;
  };
  /// What is predicted for one workpiece, and what was.
  struct WorkpieceWarning {
    std::string id = {};
    std::optional<PredictedContact> predicted = {};     ///< from the newest prediction of the workpiece
    std::optional<Alarm> reflex = {};                   ///< newest reflex warning that has ended
    std::optional<Alarm> considered = {};               ///< newest considered warning that has ended
    std::optional<SteadyTime> acknowledged_until = {};  ///< end of an acknowledgement; may have passed
    std::uint32_t acknowledged_revision = 0;            ///< of the mesh that was acknowledged
  };
  /// When cameras saw too little of the predicted path, and how much.
  struct Unseen {
    double share;
    SteadyTime found;
  };
  /// Something that is reported for a while after `found`.
  struct Event {
    std::string message;
    SteadyTime found;
  };
  /// An exception that ended a piece of work. Kept without memory from the heap: there may be none.
  struct Failure {
    Reason reason;
    std::array<char, 160> message;  ///< ends with 0
    SteadyTime found;
    bool lasting = false;  ///< until a restart
  };

  std::optional<Timestamps> pose;  ///< newest pose that has been swept
  std::vector<Object> objects;     ///< ascending by id, each once
  std::vector<OtherTool> other_tools;
  std::vector<Frame> frames;               ///< ascending by name, each once
  std::vector<std::string> links;          ///< of the tool's convex pieces; empty where they have none
  std::optional<Contact> contact;          ///< newest contact; of several in one sweep, the first reported
  std::vector<std::string> intended;       ///< workpieces that the newest sweep met as intended (Intention)
  std::vector<WorkpieceWarning> warnings;  ///< each workpiece once
  WorkpieceWarning removed;                ///< newest alarms of workpieces that are gone
  Time covered_until;                  ///< every workpiece is tested up to here, measured or predicted; epoch: never
  std::optional<double> seen;          ///< of the newest prediction, see Prediction::seen
  std::optional<Unseen> unseen;        ///< newest one
  std::optional<SteadyTime> overload;  ///< when poses were last swept at once that had waited beyond the limit
  Duration backlog{};                  ///< how long the first of these had waited
  std::optional<Event> pose_loss;      ///< newest poses that were sent and did not arrive
  std::optional<Event> jump;           ///< newest motion that is too fast to be believed, in words
  std::optional<Event> unread;         ///< newest message on a mesh topic that belongs to no workpiece
  std::vector<std::string> required;   ///< ids of the workpieces that must be there: ascending
  std::optional<SteadyTime> waiting_since;  ///< when the oldest pose that is not yet swept was received
  Duration look_ahead{};                    ///< time that computing the newest prediction took
  std::map<Reason, std::string> faults;     ///< current faults, each with a message for people
  std::optional<Failure> failure;           ///< newest one
  const char* hung = nullptr;               ///< thread that has work and makes no progress, not owned; null: none
  std::optional<std::string> disabled_by;   ///< caller that disabled the guard; then nothing else counts
  bool ended = false;                       ///< the guard is shutting down; then nothing else counts
};

}  // namespace sweep_guard_core
