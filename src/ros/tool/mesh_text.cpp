#include "ros/tool/mesh_text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace sweep_guard_ros {
namespace {

using std::string_view;

constexpr string_view kBlanks(" \t\r\n\v\f\0", 7);  // some files end with a null
constexpr string_view kByteOrderMark = "\xEF\xBB\xBF";

bool isOf(string_view text, string_view characters) { return text.find_first_not_of(characters) == string_view::npos; }

/// Takes the first word off the text; empty: there is none.
string_view nextWord(string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  const string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

template <typename Visit>
void forEachLine(string_view text, const Visit& visit) {
  while (!text.empty()) {
    const size_t end = std::min(text.find_first_of("\r\n"), text.size());
    visit(text.substr(0, end));
    text.remove_prefix(std::min(end + (text.substr(end, 2) == "\r\n" ? 2 : 1), text.size()));
  }
}

size_t linesThatBeginWith(string_view keyword, string_view text) {
  size_t count = 0;
  forEachLine(text, [&](string_view line) {
    if (nextWord(line) == keyword) ++count;
  });
  return count;
}

bool isBinaryStl(const std::string& bytes) {
  std::uint32_t facets = 0;
  if (bytes.size() < 84) return false;
  std::memcpy(&facets, &bytes[80], sizeof facets);
  return bytes.size() == 84 + 50 * std::uint64_t{facets};
}

char lowered(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

void blankMaterials(std::string& bytes) {
  forEachLine(bytes, [&bytes](string_view line) {
    string_view rest = line;
    const string_view keyword = nextWord(rest);
    if (keyword != "mtllib" && keyword != "usemtl") return;
    std::fill_n(&bytes[static_cast<size_t>(line.data() - bytes.data())], line.size(), ' ');
  });
}

bool isKeywordOfObj(string_view word) {
  for (const string_view known :
       {"v", "vt", "vn",    "vp",       "f",        "fo",  "l",      "p",      "g",          "o",
        "s", "mg", "bevel", "c_interp", "d_interp", "lod", "usemap", "maplib", "shadow_obj", "trace_obj"}) {
    if (word == known) return true;
  }
  return word.empty() || word.front() == '#';
}

void requireVertex(string_view numbers) {
  size_t count = 0;
  for (string_view word = nextWord(numbers); !word.empty(); word = nextWord(numbers), ++count) {
    if (!isOf(word, "0123456789+-.,einfaty")) throw std::runtime_error("a vertex has '" + std::string(word) + "'");
  }
  if (count == 3 || count == 4 || count == 6) return;
  throw std::runtime_error("a vertex has " + std::to_string(count) + " numbers, not 3, 4 or 6");
}

// assimp knows a vertex only at the very beginning of its line.
void requireReadableObj(string_view text) {
  bool continues = false;
  forEachLine(text, [&continues](string_view line) {
    string_view rest = line;
    const string_view keyword = nextWord(rest);
    if (!continues && !isKeywordOfObj(keyword)) {
      throw std::runtime_error("a line begins with '" + std::string(keyword) + "', which is not read");
    }
    if (keyword == "v" && line.front() != 'v') throw std::runtime_error("a vertex is indented");
    if (keyword == "v") requireVertex(rest);
    continues = !line.empty() && line.back() == '\\';
  });
}

struct Element {
  string_view attributes;
  string_view body;
};

template <typename Visit>
void forEachElement(string_view text, const std::string& name, const Visit& visit) {
  const std::string opening = "<" + name;
  for (size_t at = text.find(opening); at != string_view::npos; at = text.find(opening, at + 1)) {
    const string_view rest = text.substr(at + opening.size());
    if (rest.find_first_of("/> \t\r\n") != 0) continue;
    const string_view attributes = rest.substr(0, rest.find('>'));
    const bool is_empty = attributes.size() == rest.size() || (!attributes.empty() && attributes.back() == '/');
    const string_view inside = is_empty ? string_view() : rest.substr(attributes.size() + 1);
    visit(Element{attributes, inside.substr(0, inside.find("</" + name))});
  }
}

/// Empty where there is none.
string_view attribute(string_view attributes, string_view name) {
  for (size_t at = attributes.find(name); at != string_view::npos; at = attributes.find(name, at + 1)) {
    if (at == 0 || !isOf(attributes.substr(at - 1, 1), kBlanks)) continue;
    string_view rest = attributes.substr(at + name.size());
    const size_t quote = rest.find_first_of("\"'");
    if (quote == string_view::npos || !isOf(rest.substr(0, quote), "= \t\r\n")) continue;
    const string_view value = rest.substr(quote + 1);
    return value.substr(0, value.find(rest[quote]));
  }
  return {};
}

bool isLength(string_view text) {
  const std::string number(text);
  char* end = nullptr;
  const double length = std::strtod(number.c_str(), &end);
  return isOf(text, "0123456789+-.eE") && *end == '\0' && length > 0.0 && std::isfinite(length);
}

void requireUnit(string_view text) {
  forEachElement(text, "unit", [](const Element& unit) {
    const string_view metres = attribute(unit.attributes, "meter");
    if (metres.data() == nullptr || isLength(metres)) return;
    throw std::runtime_error("its unit is '" + std::string(metres) + "' metres, which is no length");
  });
}

// assimp takes a negative index for 0, and what is not counted for nothing.
void requireFaces(string_view text) {
  forEachElement(text, "p", [](const Element& indices) {
    if (!isOf(indices.body, "0123456789 \t\r\n")) throw std::runtime_error("a face has an index that is none");
  });
  for (const char* const faces : {"triangles", "polylist", "polygons", "lines", "linestrips", "trifans", "tristrips"}) {
    forEachElement(text, faces, [&](const Element& element) {
      if (!isOf(attribute(element.attributes, "count"), "0")) return;
      forEachElement(element.body, "p", [&](const Element& indices) {
        if (isOf(indices.body, kBlanks)) return;
        throw std::runtime_error(std::string("its <") + faces + "> are more than their count, 0");
      });
    });
  }
}

void requireReadableDae(string_view text) {
  requireUnit(text);
  requireFaces(text);
  for (const char* const unread : {"brep", "convex_mesh", "ph", "spline"}) {
    forEachElement(text, unread, [unread](const Element&) {
      throw std::runtime_error(std::string("it has a <") + unread + ">, which is not read");
    });
  }
}

}  // namespace

void simplify(std::string& bytes, const std::string& format) {
  if (format == "dae" || (format == "stl" && isBinaryStl(bytes))) return;
  if (bytes.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0) bytes.erase(0, kByteOrderMark.size());
  std::transform(bytes.begin(), bytes.end(), bytes.begin(), lowered);
  if (format == "obj") blankMaterials(bytes);
}

void requireReadable(const std::string& bytes, const std::string& format) {
  if (format == "obj") requireReadableObj(bytes);
  if (format == "dae") requireReadableDae(bytes);
}

std::size_t facesAnnounced(const std::string& bytes, const std::string& format) {
  if (format == "obj") return linesThatBeginWith("f", bytes);
  if (format != "stl" || isBinaryStl(bytes)) return 0;
  if (linesThatBeginWith("endsolid", bytes) != linesThatBeginWith("solid", bytes)) {
    throw std::runtime_error("its end is missing");
  }
  return linesThatBeginWith("facet", bytes);
}

}  // namespace sweep_guard_ros
