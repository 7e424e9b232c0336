#include "ros/tool/ply_facets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "ros/tool/mesh_wire.h"

namespace sweep_guard_ros {
namespace {

using std::string_view;

constexpr string_view kPlyBlanks(" \t\r\n\0", 5);

struct PlyType {
  size_t size;  // [byte]
  double (*value)(const char*);
};

enum class PlyUse { kX, kY, kZ, kCorners, kNone };

struct PlyProperty {
  PlyType type;
  std::optional<PlyType> length;  // of a list
  PlyUse use;
};

struct PlyElement {
  std::string name;
  size_t count;
  std::vector<PlyProperty> properties;

  bool has(PlyUse use) const {
    return std::any_of(properties.begin(), properties.end(), [use](const PlyProperty& own) { return own.use == use; });
  }
};

[[noreturn]] void refusePly(const std::string& reason) { throw std::runtime_error(reason); }

std::string inQuotes(string_view word) { return "'" + std::string(word.substr(0, 40)) + "'"; }

bool isBlank(string_view text) { return text.find_first_not_of(kPlyBlanks) == string_view::npos; }

string_view takePlyWord(string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kPlyBlanks), line.size()));
  const string_view word = line.substr(0, line.find_first_of(kPlyBlanks));
  line.remove_prefix(word.size());
  return word;
}

std::optional<double> plyNumber(const std::string& word) {
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0' || word.find_first_of("xX") != std::string::npos) return {};
  return number;
}

// Empty: it is not a whole number of 32 bits.
std::optional<size_t> wholeOf(double number) {
  if (!(number >= 0.0 && number <= 4294967295.0 && number == std::floor(number))) return {};
  return static_cast<size_t>(number);
}

template <typename Number>
PlyType plyType() {
  return {sizeof(Number), [](const char* bytes) {
            Number number{};
            std::memcpy(&number, bytes, sizeof number);
            return static_cast<double>(number);
          }};
}

PlyType plyTypeOf(string_view name) {
  static const std::map<string_view, PlyType> kTypes = {
      {"char", plyType<std::int8_t>()},     {"int8", plyType<std::int8_t>()},     {"uchar", plyType<std::uint8_t>()},
      {"uint8", plyType<std::uint8_t>()},   {"short", plyType<std::int16_t>()},   {"int16", plyType<std::int16_t>()},
      {"ushort", plyType<std::uint16_t>()}, {"uint16", plyType<std::uint16_t>()}, {"int", plyType<std::int32_t>()},
      {"int32", plyType<std::int32_t>()},   {"uint", plyType<std::uint32_t>()},   {"uint32", plyType<std::uint32_t>()},
      {"float", plyType<float>()},          {"float32", plyType<float>()},        {"double", plyType<double>()},
      {"float64", plyType<double>()}};
  const auto known = kTypes.find(name);
  if (known == kTypes.end()) refusePly("a property has the unknown type " + inQuotes(name));
  return known->second;
}

PlyUse useOf(string_view property, const std::string& element, bool list) {
  const bool corners = property == "vertex_index" || property == "vertex_indices";
  if (list) return corners && element == "face" ? PlyUse::kCorners : PlyUse::kNone;
  const size_t axis = property.size() == 1 && element == "vertex" ? string_view("xyz").find(property) : 3;
  return axis < 3 ? static_cast<PlyUse>(axis) : PlyUse::kNone;
}

PlyProperty plyProperty(string_view line, const std::string& element) {
  std::optional<PlyType> length;
  string_view type = takePlyWord(line);
  if (type == "list") {
    length = plyTypeOf(takePlyWord(line));
    type = takePlyWord(line);
  }
  return {plyTypeOf(type), length, useOf(takePlyWord(line), element, length.has_value())};
}

PlyElement plyElement(string_view line) {
  const std::string name(takePlyWord(line));
  const auto count = wholeOf(plyNumber(std::string(takePlyWord(line))).value_or(-1.0));
  if (!count) refusePly("element " + inQuotes(name) + " has no count");
  return {name, *count, {}};
}

void requireSurface(const std::vector<PlyElement>& elements) {
  size_t faces = 0;
  for (const PlyElement& element : elements) {
    if (element.count == 0) continue;
    if (element.name == "tristrips" || element.name == "range_grid") refusePly(element.name + " is not supported");
    if (element.name == "vertex" && !(element.has(PlyUse::kX) && element.has(PlyUse::kY) && element.has(PlyUse::kZ)))
      refusePly("vertices have no x, y and z");
    if (element.name != "face") continue;
    if (!element.has(PlyUse::kCorners)) refusePly("faces have no vertex_indices");
    faces += element.count;
  }
  if (faces == 0) refusePly("no faces: a point cloud is no surface; make a mesh of it");
}

class PlyFile {
 public:
  explicit PlyFile(string_view bytes) : rest_(bytes) {}

  std::vector<Facet> read() {
    readHeader();
    for (const PlyElement& element : elements_) readElement(element);
    if (!isBlank(rest_)) refusePly("data follow the last element");
    return std::move(facets_);
  }

 private:
  [[noreturn]] void refuseHere(const std::string& what) const {
    refusePly(here_ + std::to_string(number_) + " " + what);
  }

  void readHeader() {
    const size_t end = rest_.find_first_of("\r\n");
    if (rest_.substr(0, end) != "ply") refusePly("the first line is not 'ply'");
    if (end != string_view::npos && rest_.substr(end, 2) != "\r\n") line_end_ = rest_[end];
    for (string_view word; word != "end_header"; ++number_) {
      string_view line = takeLine();
      word = takePlyWord(line);
      if (word == "format") format_ = takePlyWord(line);
      if (word == "element") elements_.push_back(plyElement(line));
      if (word == "property" && !elements_.empty())
        elements_.back().properties.push_back(plyProperty(line, elements_.back().name));
    }
    if (format_ != "ascii" && format_ != "binary_little_endian" && format_ != "binary_big_endian")
      refusePly("unknown format " + inQuotes(format_));
    requireSurface(elements_);
  }

  string_view takeLine() {
    if (rest_.empty()) refuseHere("is cut off: the file ends there");
    const string_view line = rest_.substr(0, rest_.find(line_end_));
    rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
    return line;
  }

  void readElement(const PlyElement& element) {
    if (element.properties.empty()) return;
    here_ = element.name.substr(0, 40) + " ";
    for (number_ = 0; number_ < element.count; ++number_) {
      for (line_ = {}; format_ == "ascii" && isBlank(line_);) line_ = takeLine();
      readInstance(element);
      if (!isBlank(line_)) refuseHere("has more numbers than the header names");
    }
  }

  void readInstance(const PlyElement& element) {
    Facet::value_type p{};
    for (const PlyProperty& property : element.properties) {
      readValues(property);
      if (property.use == PlyUse::kCorners) addFace();
      if (property.use < PlyUse::kCorners) p[static_cast<size_t>(property.use)] = values_[0];
    }
    if (element.name == "vertex") vertices_.push_back(p);
  }

  void readValues(const PlyProperty& property) {
    values_.clear();
    const auto length = wholeOf(property.length ? readValue(*property.length) : 1.0);
    if (!length) refuseHere("has a list of no length");
    for (size_t i = 0; i < *length; ++i) values_.push_back(readValue(property.type));
  }

  double readValue(const PlyType& type) {
    if (format_ == "ascii") return readWord();
    if (rest_.size() < type.size) refuseHere("is cut off: the file ends there");
    std::array<char, sizeof(double)> raw{};
    std::copy_n(rest_.begin(), type.size, raw.begin());
    rest_.remove_prefix(type.size);
    if (format_ == "binary_big_endian") std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(type.size));
    return type.value(raw.data());
  }

  double readWord() {
    const std::string word(takePlyWord(line_));
    const std::optional<double> number = plyNumber(word);
    if (!number) refuseHere(word.empty() ? "has too few numbers" : "has " + inQuotes(word) + " in place of a number");
    return *number;
  }

  void addFace() {
    if (values_.empty()) refuseHere("has no corners");
    while (values_.size() < 3) values_.push_back(values_.back());
    for (size_t i = 2; i < values_.size(); ++i) {
      if (facets_.size() == kMaxMeshTriangles) refusePly("more than a million triangles");
      facets_.push_back({corner(values_[0]), corner(values_[i - 1]), corner(values_[i])});
    }
  }

  const Facet::value_type& corner(double index) const {
    const auto vertex = wholeOf(index);
    if (!vertex || *vertex >= vertices_.size()) refuseHere("names a missing vertex");
    return vertices_[*vertex];
  }

  string_view rest_;
  char line_end_ = '\n';
  std::string format_;
  std::vector<PlyElement> elements_;
  std::string here_ = "header line ";
  size_t number_ = 1;  // of what is read
  string_view line_;   // what is left of it, of a text
  std::vector<double> values_;
  std::vector<Facet::value_type> vertices_;
  std::vector<Facet> facets_;
};

}  // namespace

std::vector<Facet> readPlyFacets(string_view bytes) { return PlyFile(bytes).read(); }

}  // namespace sweep_guard_ros
