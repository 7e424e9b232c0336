#include "ros/tool/mesh_text.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <stdexcept>
#include <string_view>

namespace sweep_guard_ros {
namespace {

using std::string_view;
using tinyxml2::XMLElement;

constexpr string_view kBlanks(" \t\r\n\v\f\0", 7);  // some files end with a null character
constexpr string_view kByteOrderMark = "\xEF\xBB\xBF";

bool isOf(string_view text, string_view characters) { return text.find_first_not_of(characters) == string_view::npos; }

// Removes the first word from the text and returns it; empty: none left.
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

char lowered(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

void blankMaterials(std::string& bytes) {
  forEachLine(bytes, [&bytes](string_view line) {
    string_view rest = line;
    const string_view keyword = nextWord(rest);
    if (keyword != "mtllib" && keyword != "usemtl") return;
    std::fill_n(&bytes[static_cast<size_t>(line.data() - bytes.data())], line.size(), ' ');
  });
}

bool isOneOf(std::initializer_list<string_view> words, string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool isKeywordOfObj(string_view word) {
  return word.empty() || word.front() == '#' ||
         isOneOf({"v", "vt", "vn",    "vp",       "f",        "fo",  "l",      "p",      "g",          "o",
                  "s", "mg", "bevel", "c_interp", "d_interp", "lod", "usemap", "maplib", "shadow_obj", "trace_obj"},
                 word);
}

void requireVertex(string_view numbers) {
  size_t count = 0;
  for (string_view word = nextWord(numbers); !word.empty(); word = nextWord(numbers), ++count) {
    if (!isOf(word, "0123456789+-.,einfaty")) throw std::runtime_error("a vertex has '" + std::string(word) + "'");
  }
  if (count == 3 || count == 4 || count == 6) return;
  throw std::runtime_error("a vertex has " + std::to_string(count) + " numbers, not 3, 4 or 6");
}

// assimp ignores a vertex that does not begin its line.
void requireReadableObj(string_view text) {
  bool continues = false;
  forEachLine(text, [&continues](string_view line) {
    string_view rest = line;
    const string_view keyword = nextWord(rest);
    if (!continues && !isKeywordOfObj(keyword)) {
      throw std::runtime_error("a line begins with '" + std::string(keyword) + "', which is not supported");
    }
    if (keyword == "v" && line.front() != 'v') throw std::runtime_error("a vertex is indented");
    if (keyword == "v") requireVertex(rest);
    continues = !line.empty() && line.back() == '\\';
  });
}

bool isLength(const std::string& text) {
  char* end = nullptr;
  const double length = std::strtod(text.c_str(), &end);
  return isOf(text, "0123456789+-.eE") && *end == '\0' && length > 0.0 && std::isfinite(length);
}

void requireUnit(const XMLElement& unit) {
  const char* const meters = unit.Attribute("meter");
  if (meters == nullptr || isLength(meters)) return;
  throw std::runtime_error("unit of '" + std::string(meters) + "' meters is not a length");
}

// assimp reads a negative index as 0.
void requireIndices(const XMLElement& indices) {
  if (indices.NoChildren()) return;
  const char* const text = indices.FirstChild() == indices.LastChild() ? indices.GetText() : nullptr;
  if (text == nullptr || !isOf(text, "0123456789 \t\r\n")) throw std::runtime_error("a face has an invalid index");
}

// assimp omits faces beyond their count.
void requireCount(const XMLElement& faces) {
  const char* const count = faces.Attribute("count");
  if (count != nullptr && !isOf(count, "0")) return;
  for (const XMLElement* p = faces.FirstChildElement("p"); p != nullptr; p = p->NextSiblingElement("p")) {
    if (!p->NoChildren()) throw std::runtime_error(std::string("<") + faces.Name() + "> has faces, but count 0");
  }
}

// Ends: tinyxml2 limits the depth of nested elements.
void requireReadableBelow(const tinyxml2::XMLNode& parent) {
  for (const XMLElement* element = parent.FirstChildElement(); element; element = element->NextSiblingElement()) {
    const string_view name = element->Name();
    if (name == "unit") requireUnit(*element);
    if (name == "p") requireIndices(*element);
    if (isOneOf({"triangles", "polylist", "polygons", "lines", "linestrips", "trifans", "tristrips"}, name)) {
      requireCount(*element);
    }
    if (isOneOf({"brep", "convex_mesh", "ph", "spline"}, name)) {
      throw std::runtime_error("<" + std::string(name) + "> is not supported");
    }
    requireReadableBelow(*element);
  }
}

void requireReadableDae(const std::string& text) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw std::runtime_error(std::string("not XML: ") + document.ErrorStr());
  }
  requireReadableBelow(document);
}

}  // namespace

void simplify(std::string& bytes, const std::string& format) {
  if (format != "obj") return;
  if (bytes.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0) bytes.erase(0, kByteOrderMark.size());
  std::transform(bytes.begin(), bytes.end(), bytes.begin(), lowered);
  blankMaterials(bytes);
}

void requireReadable(const std::string& bytes, const std::string& format) {
  if (format == "obj") requireReadableObj(bytes);
  if (format == "dae") requireReadableDae(bytes);
}

std::size_t expectedFaces(const std::string& bytes, const std::string& format) {
  return format == "obj" ? linesThatBeginWith("f", bytes) : 0;
}

}  // namespace sweep_guard_ros
