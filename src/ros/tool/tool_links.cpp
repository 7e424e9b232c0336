#include "ros/tool/tool_links.h"

#include <algorithm>
#include <set>

namespace sweep_guard_ros {

bool hasLink(const sweep_guard_core::Tool& tool, const std::string& link) {
  return std::any_of(tool.pieces().begin(), tool.pieces().end(),
                     [&](const sweep_guard_core::ConvexPiece& piece) { return piece.link == link; });
}

std::string linksOf(const sweep_guard_core::Tool& tool) {
  std::set<std::string> links;
  for (const sweep_guard_core::ConvexPiece& piece : tool.pieces()) links.insert(piece.link);
  if (links == std::set<std::string>{""}) return "a cylinder has one link, without a name";
  std::string list;
  for (const std::string& link : links) list += (list.empty() ? "it has '" : ", '") + link + "'";
  return list;
}

}  // namespace sweep_guard_ros
