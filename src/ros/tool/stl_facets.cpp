#include "ros/tool/stl_facets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace sweep_guard_ros {
namespace {

using std::string_view;

constexpr size_t kCountAt = 80;  // [byte]
constexpr size_t kFacetsAt = 84;
constexpr size_t kFacetSize = 50;
constexpr size_t kNormalSize = 12;
constexpr float kMaxStray = 1000.0F;  // of a triangle that was not counted, relative to those that were
constexpr size_t kMaxWordShown = 40;
static_assert(sizeof(StlFacet) == 36);

[[noreturn]] void refuse(const std::string& reason) { throw std::runtime_error(reason); }

std::uint32_t facetsInHeader(string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, &bytes[kCountAt], sizeof count);
  return count;
}

size_t roomFor(string_view bytes) { return (bytes.size() - kFacetsAt) / kFacetSize; }

std::vector<StlFacet> facetsIn(string_view bytes, size_t begin, size_t end) {
  std::vector<StlFacet> facets(end - begin);
  const char* from = bytes.data() + kFacetsAt + begin * kFacetSize + kNormalSize;
  for (StlFacet& facet : facets) {
    std::memcpy(&facet, from, sizeof facet);
    from += kFacetSize;
  }
  return facets;
}

float largestCoordinate(const std::vector<StlFacet>& facets) {
  float largest = 0.0F;
  for (const StlFacet& facet : facets) {
    for (const auto& corner : facet) {
      for (const float coordinate : corner) largest = std::fmax(largest, std::abs(coordinate));
    }
  }
  return largest;
}

bool couldBeTriangle(const StlFacet& facet, float largest) {
  const auto& [a, b, c] = facet;
  if (a == b || b == c || c == a) return false;
  for (const auto& corner : facet) {
    for (const float coordinate : corner) {
      if (!(std::abs(coordinate) <= largest)) return false;
    }
  }
  return true;
}

// Some programs append text or zeros. Triangles that the header does not count must not get lost.
bool isPadding(string_view bytes, const std::vector<StlFacet>& counted) {
  const string_view rest = bytes.substr(kFacetsAt + counted.size() * kFacetSize);
  if (rest.find_first_not_of('\0') == string_view::npos) return true;
  if (rest.size() % kFacetSize == 0) return false;
  const std::vector<StlFacet> uncounted = facetsIn(bytes, counted.size(), roomFor(bytes));
  const float largest = counted.empty() ? std::numeric_limits<float>::max() : kMaxStray * largestCoordinate(counted);
  return std::none_of(uncounted.begin(), uncounted.end(),
                      [largest](const StlFacet& facet) { return couldBeTriangle(facet, largest); });
}

std::vector<StlFacet> readBinary(string_view bytes) {
  const size_t count = facetsInHeader(bytes);
  const size_t room = roomFor(bytes);
  if (count <= room) {
    std::vector<StlFacet> facets = facetsIn(bytes, 0, count);
    if (isPadding(bytes, facets)) return facets;
  }
  refuse("header says " + std::to_string(count) + " triangles, the file has room for " + std::to_string(room));
}

char lowerCase(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

class StlWords {
 public:
  explicit StlWords(string_view text) : text_(text) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3);  // byte order mark
    skip();
  }

  string_view next() const { return next_; }  // empty: the text has ended
  bool nextIs(string_view word) const {
    return std::equal(next_.begin(), next_.end(), word.begin(), word.end(),
                      [](char a, char b) { return lowerCase(a) == b; });
  }
  // Moves on to the next word.
  void skip() {
    text_.remove_prefix(std::min(text_.find_first_not_of(kBetween), text_.size()));
    next_ = text_.substr(0, text_.find_first_of(kBetween));
    text_.remove_prefix(next_.size());
  }
  // Moves on to the first word of the next line. `next` is in this line.
  void skipLine() {
    const string_view rest(next_.data(), next_.size() + text_.size());
    text_ = rest.substr(std::min(rest.find_first_of("\r\n"), rest.size()));
    skip();
  }
  bool take(string_view word) {
    const bool taken = nextIs(word);
    if (taken) skip();
    return taken;
  }

 private:
  static constexpr string_view kBetween = string_view(" \t\r\n\v\f\0", 7);  // some files end with a null character

  string_view text_;  // behind the next word
  string_view next_;
};

// Reads a text STL; a name is the rest of its line.
class StlText {
 public:
  explicit StlText(string_view text) : words_(text) {}

  bool begins() {
    if (!words_.nextIs("solid")) return false;
    StlWords ahead = words_;
    ahead.skipLine();
    return ahead.nextIs("facet") || ahead.nextIs("endsolid") || ahead.nextIs("end");
  }

  std::vector<StlFacet> read() {
    while (words_.nextIs("solid")) {
      words_.skipLine();
      while (words_.take("facet")) readFacet();
      readEndOfSolid();
    }
    return std::move(facets_);
  }

 private:
  [[noreturn]] void refuseNext(const std::string& expected) const {
    const std::string at = "triangle " + std::to_string(facets_.size() + 1);
    if (words_.next().empty()) refuse("the file ends in " + at);
    refuse(at + " has '" + std::string(words_.next().substr(0, kMaxWordShown)) + "' in place of " + expected);
  }

  void require(const std::string& word) {
    if (!words_.take(word)) refuseNext("'" + word + "'");
  }

  bool takeEnd(const std::string& of) {
    if (words_.take("end" + of)) return true;
    return words_.take("end") && words_.take(of);
  }

  void skipNormal() {
    while (!words_.nextIs("outer")) {
      if (words_.next().empty() || words_.nextIs("vertex") || words_.nextIs("endfacet")) refuseNext("'outer loop'");
      words_.skip();
    }
  }

  void readFacet() {
    StlFacet facet;
    skipNormal();
    require("outer");
    require("loop");
    for (auto& corner : facet) {
      require("vertex");
      for (float& coordinate : corner) coordinate = readNumber();
    }
    if (!takeEnd("loop")) refuseNext("'endloop'");
    if (!takeEnd("facet")) refuseNext("'endfacet'");
    facets_.push_back(facet);
  }

  float readNumber() {
    const std::string word(words_.next());
    char* end = nullptr;
    const float number = std::strtof(word.c_str(), &end);
    if (word.empty() || *end != '\0' || word.find_first_of("xX") != std::string::npos) refuseNext("a number");
    words_.skip();
    return number;
  }

  void readEndOfSolid() {
    if (words_.next().empty())
      refuse("end is missing: no 'endsolid' after " + std::to_string(facets_.size()) + " triangles");
    const bool in_two_words = words_.take("end");
    if (!words_.nextIs(in_two_words ? "solid" : "endsolid")) refuseNext("'facet' or 'endsolid'");
    words_.skipLine();
    while (!words_.next().empty() && !words_.nextIs("solid")) {
      if (words_.nextIs("facet")) refuse("triangles follow the end of the solid");
      words_.skip();
    }
  }

  StlWords words_;
  std::vector<StlFacet> facets_;
};

bool isTextCharacter(char c) { return static_cast<unsigned char>(c) >= ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

// Four characters of a text, taken for a number, are more triangles than a file has room for.
std::vector<StlFacet> readStlFacets(string_view bytes) {
  const bool can_be_binary = bytes.size() >= kFacetsAt;
  if (can_be_binary && facetsInHeader(bytes) <= roomFor(bytes)) return readBinary(bytes);
  if (StlText text(bytes); text.begins()) return text.read();
  if (std::all_of(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), kFacetsAt)),
                  isTextCharacter)) {
    refuse("text that does not begin with 'solid' and 'facet'");
  }
  if (!can_be_binary) refuse("binary, but shorter than the 84 bytes before the first triangle");
  return readBinary(bytes);
}

}  // namespace sweep_guard_ros
