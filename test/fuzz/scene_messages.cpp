// Messages of other programs for scene_input. An input is the type, the definition, both up to a byte 0, and then messages, each
// behind its length in two bytes.
#include <cmath>
#include <memory>
#include <vector>

#include "require.h"
#include "ros/scene/message_value.h"
#include "ros/scene/scene_reader.h"
#include "sweep_guard/common/error.h"
#include "target.h"

namespace sweep_guard_fuzz {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::SceneUpdate;
using sweep_guard_ros::MessageDefinition;
using sweep_guard_ros::MessageValue;
using sweep_guard_ros::SceneReader;
using sweep_guard_ros::Wire;

// What one change says is complete.
void check(const SceneUpdate& update) {
  for (const auto& change : update.changes) {
    const bool is_given = !change.object.surface_M.triangles.empty();
    require(!is_given || change.refused.empty(), "what is refused is not given");
    require(!is_given || !change.object.frame.empty(), "what is given has a frame");
  }
}

void readAll(const MessageDefinition& definition, const std::vector<std::string>& messages, SceneReader& reader) {
  sweep_guard_core::Time now(std::chrono::seconds(1));
  for (const std::string& bytes : messages) {
    now += std::chrono::milliseconds(100);
    try {
      const Wire wire{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
      check(reader.read(MessageValue(definition, wire), now));
    } catch (const InvalidInput&) {
    }
    check(reader.expire(now));
  }
  check(reader.restart());
  reader.leftOut();
}

std::vector<std::string> messagesIn(Input& input) {
  std::vector<std::string> messages;
  while (!input.atEnd() && messages.size() < 8) {
    std::string& message = messages.emplace_back();
    const auto length = input.raw<std::uint16_t>();
    for (size_t i = 0; i < length && !input.atEnd(); ++i) message += static_cast<char>(input.byte());
  }
  return messages;
}

// Files of this machine are another matter.
bool namesAFile(const std::vector<std::string>& messages) {
  for (const std::string& message : messages) {
    if (message.find("file:") != std::string::npos || message.find("package:") != std::string::npos) return true;
  }
  return false;
}

void run(Input input) {
  const std::string type = input.word();
  const std::string text = input.word();
  const std::vector<std::string> messages = messagesIn(input);
  if (namesAFile(messages)) return;
  try {
    const MessageDefinition definition(type, text);
    const auto reader = sweep_guard_ros::makeSceneReader(type, {"/topic", "id", "world"});
    readAll(definition, messages, *reader);
  } catch (const InvalidInput& error) {
    require(error.what()[0] != 0, "a refusal has words");
  }
}

const Target kSceneMessages("scene_messages", run);

}  // namespace
}  // namespace sweep_guard_fuzz
