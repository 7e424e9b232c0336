// Compares the documents to a running guard and the sources: topics, services, parameters, arguments of launch files
// and scripts, quoted messages, links. With SWEEP_GUARD_WRITE_DOCUMENTS set it writes the tables that follow from the
// sources.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <ros/topic.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "ros/black_box/recorded_topics.h"
#include "ros/haptics/haptics_parameters.h"
#include "ros/motion/motion_parameters.h"
#include "ros/parameter_documents.h"
#include "ros/parameters/parameters.h"
#include "sweep_guard/Warning.h"

namespace sweep_guard_ros {
namespace {

using Names = std::set<std::string>;
using Row = std::vector<std::string>;

const std::filesystem::path kRoot = SWEEP_GUARD_SOURCE_DIR;
const std::filesystem::path kInterface = kRoot / "doc" / "interface.md";
const std::string kGuard = "/sweep_guard";

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file);
  EXPECT_TRUE(stream) << file;
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<std::string> lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> all;
  for (std::string line; std::getline(stream, line);) all.push_back(line);
  return all;
}

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  size_t begin = 0;
  for (size_t end; (end = text.find(separator, begin)) != std::string::npos; begin = end + separator.size()) {
    parts.push_back(text.substr(begin, end - begin));
  }
  parts.push_back(text.substr(begin));
  return parts;
}

// Returns the cells, from 1 on, of the tables that begin with this line.
std::vector<Row> table(const std::string& document, const std::string& head) {
  std::vector<Row> rows;
  bool inside = false;
  for (const std::string& line : lines(document)) {
    if (inside && line.rfind("|---", 0) != 0 && !line.empty()) rows.push_back(split(line, "|"));
    inside = line == head || (inside && !line.empty());
  }
  EXPECT_FALSE(rows.empty()) << "no table " << head;
  return rows;
}

std::string joined(const std::vector<std::string>& parts, const std::string& separator) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
  return text;
}

// Replaces the rows of the table that begins with the line `head`.
std::string withRows(const std::string& document, const std::string& head, const std::vector<std::string>& rows) {
  const size_t begin = document.find("\n" + head + "\n|---");
  EXPECT_NE(begin, std::string::npos) << "no table " << head;
  if (begin == std::string::npos) return document;
  const size_t first_row = document.find('\n', begin + head.size() + 2) + 1;
  const size_t end = std::min(document.find("\n\n", begin), document.size() - 1);
  return document.substr(0, first_row) + joined(rows, "\n") + document.substr(end);
}

void expectContents(const std::filesystem::path& file, const std::string& expected) {
  if (std::getenv("SWEEP_GUARD_WRITE_DOCUMENTS") != nullptr) std::ofstream(file) << expected;
  EXPECT_EQ(contents(file), expected) << "SWEEP_GUARD_WRITE_DOCUMENTS=1 scripts/test -R documents writes it again";
}

// Returns the texts in `code`.
std::vector<std::string> codes(const std::string& cell) {
  const std::vector<std::string> parts = split(cell, "`");
  std::vector<std::string> codes;
  for (size_t i = 1; i < parts.size(); i += 2) codes.push_back(parts[i]);
  return codes;
}

std::string trimmed(const std::string& cell) {
  const size_t first = cell.find_first_not_of(" `");
  return first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(" `") - first + 1);
}

std::string resolved(const std::string& name) {
  return name[0] == '~' ? kGuard + "/" + name.substr(1) : name[0] == '/' ? name : "/" + name;
}

XmlRpc::XmlRpcValue askMaster(const std::string& what) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue answer;
  request[0] = "documents_test";
  EXPECT_TRUE(ros::master::execute(what, request, response, answer, true));
  return answer;
}

enum Graph { kPublished, kSubscribed, kServed };

Names namesOfTheGuard(Graph part) {
  // The first warning may tell of the self-test. The second one is periodic: the guard has started.
  for (int i = 0; i < 2; ++i) ros::topic::waitForMessage<sweep_guard::Warning>(kGuard + "/warning");
  XmlRpc::XmlRpcValue entries = askMaster("getSystemState")[part];
  Names names;
  for (int i = 0; i < entries.size(); ++i) {
    for (int j = 0; j < entries[i][1].size(); ++j) {
      if (static_cast<std::string>(entries[i][1][j]) == kGuard) names.insert(entries[i][0]);
    }
  }
  for (const char* const of_every_node : {"/rosout", "/sweep_guard/get_loggers", "/sweep_guard/set_logger_level"}) {
    names.erase(of_every_node);
  }
  return names;
}

// Returns the topics of the table, each with its type.
Names topicsOfTheGuard(Graph part) {
  const Names names = namesOfTheGuard(part);
  XmlRpc::XmlRpcValue types = askMaster("getTopicTypes");
  Names typed;
  for (int i = 0; i < types.size(); ++i) {
    if (names.count(types[i][0]) != 0) {
      typed.insert(static_cast<std::string>(types[i][0]) + " " + static_cast<std::string>(types[i][1]));
    }
  }
  EXPECT_EQ(typed.size(), names.size());
  return typed;
}

Names topicsListed(const std::string& head) {
  Names listed;
  for (const Row& row : table(contents(kInterface), head)) {
    for (const std::string& name : codes(row.at(1))) listed.insert(resolved(name) + " " + trimmed(row.at(2)));
  }
  return listed;
}

TEST(DocumentsTest, ListEachTopicAndItsType) {
  EXPECT_EQ(topicsListed("| in | type | meaning |"), topicsOfTheGuard(kSubscribed));
  EXPECT_EQ(topicsListed("| out | type | when |"), topicsOfTheGuard(kPublished));
}

Names recordedNames(const BlackBoxParameters& parameters) {
  Names names;
  for (const RecordedTopic& topic : recordedTopics(ros::NodeHandle(), parameters)) names.insert(topic.topic);
  return names;
}

// ~markers and ~view draw what the others say, ~surface and ~bodies are for the guards of other tools; the tool of this guard
// has no joints.
TEST(DocumentsTest, TheBlackBoxRecordsWhatTheGuardHearsAndPublishes) {
  Names heard = namesOfTheGuard(kSubscribed);
  heard.merge(namesOfTheGuard(kPublished));
  heard.insert("/joint_states");
  for (const char* const again : {"/markers", "/view", "/surface", "/bodies"})
    EXPECT_EQ(heard.erase(kGuard + again), 1U) << again;
  BlackBoxParameters parameters = loadBlackBoxParameters(ros::NodeHandle("/nothing_is_set"));
  parameters.proximity = parameters.interaction = true;
  EXPECT_EQ(recordedNames(parameters), heard);
  parameters.proximity = parameters.interaction = false;
  for (const char* const chosen : {"/proximity", "/interaction"}) EXPECT_EQ(heard.erase(kGuard + chosen), 1U) << chosen;
  EXPECT_EQ(recordedNames(parameters), heard);
}

TEST(DocumentsTest, ListEachService) {
  Names listed;
  for (const Row& row : table(contents(kInterface), "| service | type | what it does | try |")) {
    listed.insert(resolved(trimmed(row.at(1))));
  }
  EXPECT_EQ(listed, namesOfTheGuard(kServed));
}

TEST(DocumentsTest, ListEachMessage) {
  Names listed;
  for (const Row& row : table(contents(kInterface), "| message | carries |")) {
    for (const std::string& name : codes(row.at(1))) listed.insert(name);
  }
  Names there;
  for (const char* const folder : {"msg", "srv"}) {
    for (const auto& file : std::filesystem::directory_iterator(kRoot / folder)) there.insert(file.path().stem());
  }
  EXPECT_EQ(listed, there);
}

void expectParameters(const std::filesystem::path& document, const std::string& column,
                      const std::vector<ParameterInfo>& described) {
  const std::string head = "| " + column + " | default | type, unit, range | effect |";
  expectContents(document, withRows(contents(document), head, parameterRows(described)));
}

TEST(DocumentsTest, ListEachParameter) {
  const auto described = loadParameters(ros::NodeHandle("/nothing_is_set")).described;
  expectParameters(kInterface, "parameter", described);
  expectContents(kRoot / "config" / "sweep_guard.yaml", configurationFile(described));
}

TEST(DocumentsTest, ListEachParameterOfMotionGuard) {
  const auto described = loadMotionParameters(ros::NodeHandle("/nothing_is_set")).described;
  expectParameters(kInterface, "key", described);
  expectContents(kRoot / "config" / "motion_guard.yaml", motionConfigurationFile(described));
}

TEST(DocumentsTest, ListEachParameterOfTheBlackBox) {
  const auto described = loadBlackBoxParameters(ros::NodeHandle("/nothing_is_set")).described;
  expectParameters(kRoot / "doc" / "black_box.md", "parameter", described);
  expectContents(kRoot / "config" / "black_box.yaml", blackBoxConfigurationFile(described));
}

TEST(DocumentsTest, ListEachParameterOfHaptics) {
  const auto described = loadHapticsParameters(ros::NodeHandle("/nothing_is_set")).described;
  expectParameters(kRoot / "doc" / "haptics.md", "parameter", described);
  expectContents(kRoot / "config" / "haptics.yaml", hapticsConfigurationFile(described));
}

std::string argumentLine(const tinyxml2::XMLElement& argument) {
  const char* const value = argument.Attribute("default");
  std::string fallback = value == nullptr ? "(none)" : value;
  if (fallback.find("$(eval") != std::string::npos || fallback.find("$(arg") != std::string::npos) {
    fallback = "*follows*";
  } else if (value != nullptr && !fallback.empty()) {
    fallback = "`" + std::regex_replace(fallback, std::regex("\\$\\(find sweep_guard\\)/"), "") + "`";
  }
  const char* const meaning = argument.Attribute("doc");
  return std::string("| `") + argument.Attribute("name") + "` | " + fallback + (fallback.empty() ? "| " : " | ") +
         (meaning == nullptr ? "?" : meaning) + " |";
}

using Meanings = std::map<std::string, std::string>;

// Returns the meaning of each argument that several launch files have.
Meanings sharedArguments(const std::string& document) {
  Meanings shared;
  for (const Row& row : table(document, "| argument of several files | default | meaning |"))
    shared[trimmed(row.at(1))] = trimmed(row.at(3));
  return shared;
}

// Returns the rows of one launch file. Arguments that mean what `shared` says are only named; those that are seldom needed are
// left out.
std::vector<std::string> argumentLines(const std::filesystem::path& file, const Meanings& shared) {
  std::vector<std::string> rows;
  std::vector<std::string> as_shared;
  tinyxml2::XMLDocument launch;
  EXPECT_EQ(launch.LoadFile(file.c_str()), tinyxml2::XML_SUCCESS) << file;
  for (const auto* argument = launch.RootElement()->FirstChildElement("arg"); argument != nullptr;
       argument = argument->NextSiblingElement("arg")) {
    const char* const doc = argument->Attribute("doc");
    const std::string meaning = doc == nullptr ? "" : doc;
    const std::string name = argument->Attribute("name");
    if (meaning.rfind("(seldom) ", 0) == 0) continue;
    const auto found = shared.find(std::regex_replace(name, std::regex("^(left|right)_"), ""));
    if (found != shared.end() && found->second == meaning) {
      as_shared.push_back("`" + name + "`");
    } else {
      rows.push_back(argumentLine(*argument));
    }
  }
  if (!as_shared.empty()) rows.push_back("| " + joined(as_shared, ", ") + " | | as above |");
  return rows;
}

TEST(DocumentsTest, ListTheArgumentsOfEachLaunchFile) {
  const std::filesystem::path document = kRoot / "doc" / "launch.md";
  std::vector<std::string> chapters = split(contents(document), "\n## ");
  const Meanings shared = sharedArguments(chapters.front());
  Names listed;
  for (size_t i = 1; i < chapters.size(); ++i) {
    const std::string file = lines(chapters[i]).front();
    chapters[i] =
        withRows(chapters[i], "| argument | default | meaning |", argumentLines(kRoot / "launch" / file, shared));
    listed.insert(file);
  }
  expectContents(document, joined(chapters, "\n## "));
  Names there;
  for (const auto& file : std::filesystem::directory_iterator(kRoot / "launch")) there.insert(file.path().filename());
  EXPECT_EQ(listed, there);
}

std::string sources(const std::vector<std::string>& folders) {
  std::string all;
  for (const std::string& folder : folders) {
    for (const auto& file : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      if (file.path().extension() == ".cpp" || file.path().extension() == ".h") all += contents(file.path());
    }
  }
  return std::regex_replace(all, std::regex("\"\\s*\n\\s*\""), "");  // texts that continue on the next line
}

// A launch group then needs no argument for it. What is recorded has absolute names.
TEST(DocumentsTest, NothingLooksForTheGuardAtTheRoot) {
  std::string launched;
  for (const auto& file : std::filesystem::directory_iterator(kRoot / "launch")) launched += contents(file.path());
  const std::regex found("name=\"(guard|warning)\"( type=\"str\")? (default|value)=\"([^\"]*)\"");
  int places = 0;
  for (std::sregex_iterator one(launched.begin(), launched.end(), found), end; one != end; ++one, ++places) {
    EXPECT_NE((*one)[4].str().front(), '/') << one->str();
  }
  EXPECT_GE(places, 19);
  for (const std::filesystem::path folder : {"src", "config", "python"}) {
    for (const auto& file : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      const bool of_recordings = file.path().stem() == "recorded_topics" || file.path().stem() == "session_bag";
      if (file.is_directory() || of_recordings) continue;
      for (const char* const before : {"\"", "'", ": "})
        EXPECT_EQ(contents(file.path()).find(before + kGuard), std::string::npos) << file.path();
    }
  }
}

TEST(DocumentsTest, TroubleshootingQuotesWhatTheCodeSays) {
  const std::string said = sources({"src"});
  size_t quotes = 0;
  const std::string document = contents(kRoot / "doc" / "troubleshooting.md");
  for (const Row& row : table(document, "| symptom | what it says | what to do |")) {
    for (const std::string& quote : codes(row.at(2))) {
      for (const std::string& part : split(quote, "…")) {
        if (trimmed(part).empty()) continue;
        EXPECT_NE(said.find(trimmed(part)), std::string::npos) << "nothing says '" << trimmed(part) << "'";
        ++quotes;
      }
    }
  }
  EXPECT_GT(quotes, 40U);
}

std::vector<std::filesystem::path> documents() {
  std::vector<std::filesystem::path> documents;
  for (const auto& folder : {kRoot, kRoot / "doc"}) {
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
      if (file.path().extension() == ".md") documents.push_back(file.path());
    }
  }
  return documents;
}

// Returns the anchor of a heading in a link.
std::string anchor(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto character = static_cast<unsigned char>(c);
    if (c == ' ') anchor += '-';
    if (std::isalnum(character) != 0 || c == '-' || c == '_') anchor += static_cast<char>(std::tolower(character));
  }
  return anchor;
}

bool hasAnchor(const std::string& document, const std::string& wanted) {
  const std::vector<std::string> all = lines(document);
  return std::any_of(all.begin(), all.end(), [&](const std::string& line) {
    return line[0] == '#' && anchor(line.substr(std::min(line.find(' '), line.size() - 1) + 1)) == wanted;
  });
}

void expectLinksToLeadSomewhere(const std::filesystem::path& file) {
  const std::string text = contents(file);
  const std::regex link(R"(\]\(([^)#]*)#?([^)]*)\))");
  for (std::sregex_iterator found(text.begin(), text.end(), link), end; found != end; ++found) {
    const std::string path = (*found)[1];
    const std::string place = (*found)[2];
    if (path.find("://") != std::string::npos) continue;
    const std::filesystem::path target = path.empty() ? file : file.parent_path() / path;
    EXPECT_TRUE(std::filesystem::exists(target)) << file << " links to " << path;
    if (place.empty()) continue;
    EXPECT_TRUE(hasAnchor(contents(target), place)) << file << " links to " << path << "#" << place;
  }
}

TEST(DocumentsTest, LinksLeadSomewhere) {
  for (const auto& file : documents()) expectLinksToLeadSomewhere(file);
}

TEST(DocumentsTest, NameParametersThatThereAre) {
  const auto settings = loadParameters(ros::NodeHandle("/nothing_is_set")).settings;
  const std::regex key("^((tool|prediction|horizon|warning|timing|markers|limits)/[a-z_]+)(?![a-z_.])");  // no files
  const std::string replaced = "warning/min_probability";  // is refused by this name
  size_t named = 0;
  for (const auto& file : documents()) {
    for (const std::string& code : codes(contents(file))) {
      std::smatch found;
      if (!std::regex_search(code, found, key)) continue;
      EXPECT_TRUE(settings.count(found[1]) == 1 || found[1] == replaced) << file << " names " << found[1];
      ++named;
    }
  }
  EXPECT_GT(named, 60U);
}

// Ignores a longer option that begins like this.
bool hasOption(const std::string& text, const std::string& option) {
  for (size_t at = text.find(option); at != std::string::npos; at = text.find(option, at + 1)) {
    const char next = text.c_str()[at + option.size()];
    if (std::islower(static_cast<unsigned char>(next)) == 0 && next != '-') return true;
  }
  return false;
}

// Searches the script, and the programs that it passes its arguments to.
bool takes(const std::filesystem::path& script, const std::string& option) {
  static const std::string programs = sources({"src", "test", "evaluation", "benchmark"});
  return hasOption(contents(script), option) || hasOption(programs, option);
}

TEST(DocumentsTest, NameScriptsAndOptionsThatThereAre) {
  const std::regex call("scripts/([a-z_]+)(?![-.a-z_])( [^`\n#]*)?");
  const std::regex option("--[a-z-]+");
  for (const auto& file : documents()) {
    const std::string text = contents(file);
    for (std::sregex_iterator found(text.begin(), text.end(), call), end; found != end; ++found) {
      const std::filesystem::path script = kRoot / "scripts" / (*found)[1].str();
      if (std::filesystem::exists(script.string() + ".txt")) continue;
      ASSERT_TRUE(std::filesystem::exists(script)) << file << " names " << script;
      const std::string arguments = (*found)[2];
      for (std::sregex_iterator each(arguments.begin(), arguments.end(), option); each != end; ++each) {
        EXPECT_TRUE(takes(script, each->str())) << file << ": " << script << " does not know " << each->str();
      }
    }
  }
}

}  // namespace
}  // namespace sweep_guard_ros
