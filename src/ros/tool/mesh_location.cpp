#include <rospack/rospack.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <system_error>

#include "ros/tool/percent_decoding.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_ros {
namespace {

using std::filesystem::path;
using sweep_guard_core::InvalidInput;

const std::string kPackageScheme = "package://";
const std::string kFileScheme = "file:";
const std::string kModelScheme = "model://";
const std::string kLocalHost = "//localhost/";
constexpr size_t kMaxUriShown = 200;  // [byte]

bool startsWith(const std::string& text, const std::string& start) { return text.compare(0, start.size(), start) == 0; }

// Resolves symbolic links; empty if there is no such file.
path real(const path& file) {
  std::error_code error;
  path found = std::filesystem::canonical(file, error);
  return error ? path() : found;
}

bool inside(const path& file, const path& folder) {
  if (folder.empty()) return false;
  const path below = file.lexically_relative(folder);
  return !below.empty() && *below.begin() != ".." && *below.begin() != ".";
}

std::vector<path> packagePath() {
  const char* const entries = std::getenv("ROS_PACKAGE_PATH");
  std::istringstream list(entries == nullptr ? "" : entries);
  std::vector<path> folders;
  for (std::string entry; std::getline(list, entry, ':');) {
    if (const path folder = real(entry); !entry.empty() && !folder.empty()) folders.push_back(folder);
  }
  return folders;
}

// ros::package::getPath() prints a line if there is no such package.
std::string knownFolder(const std::string& package) {
  rospack::Rospack rospack;
  rospack.setQuiet(true);
  std::vector<std::string> folders;
  std::string folder;
  if (!rospack.getSearchPathFromEnv(folders)) return "";
  rospack.crawl(folders, false);
  return rospack.find(package, folder) ? folder : "";
}

path packageFolder(const std::string& package) {
  if (const std::string known = knownFolder(package); !known.empty()) return real(known);
  for (const path& entry : packagePath()) {
    if (std::error_code error; std::filesystem::is_directory(entry / package, error)) return real(entry / package);
  }
  return {};
}

bool insidePackage(const path& file) {
  for (const path& entry : packagePath()) {
    const auto within = [&entry](const path& folder) { return folder == entry || inside(folder, entry); };
    for (path folder = file.parent_path(); folder.has_relative_path() && within(folder);
         folder = folder.parent_path()) {
      if (std::error_code error; std::filesystem::exists(folder / "package.xml", error)) return true;
    }
  }
  return false;
}

bool equalButForCase(const std::string& a, const std::string& b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

// Returns the name of an entry that differs in upper and lower case alone; empty: none.
path inOtherCase(const path& folder, const path& name) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (equalButForCase(entry.path().filename().string(), name.string())) return entry.path().filename();
  }
  return {};
}

// Returns the path below the folder that differs from `name` in upper and lower case alone; empty: none.
path similarPath(const path& folder, const path& name) {
  path similar;
  for (const path& part : name) {
    std::error_code error;
    const bool exists = std::filesystem::exists(folder / similar / part, error);
    const path there = exists ? part : inOtherCase(folder / similar, part);
    if (there.empty()) return {};
    similar /= there;
  }
  return similar;
}

std::string withoutLeadingSlashes(const std::string& name) {
  return name.substr(std::min(name.find_first_not_of('/'), name.size()));
}

std::string printableName(const std::string& uri) { return sweep_guard_core::printable(uri, kMaxUriShown); }

[[noreturn]] void refuseUri(const std::string& uri, const std::string& reason) {
  throw InvalidInput(printableName(uri) + ": " + reason);
}

// A URI and where its name leads.
struct Lookup {
  const std::string& uri;
  path folder;
  std::string name;  // below the folder, as the URI has it
};

// The name as it is goes first, so that no file of another name is loaded.
path fileOf(const Lookup& lookup) {
  if (path file = real(lookup.folder / lookup.name); !file.empty()) return file;
  try {
    const std::string decoded = percentDecoded(lookup.name);
    return decoded == lookup.name ? path() : real(lookup.folder / decoded);
  } catch (const InvalidInput& error) {
    refuseUri(lookup.uri, error.what());
  }
}

// @param allowed  returns whether the file may be named
template <typename Allowed>
std::string remedyForMissing(const Lookup& lookup, const Allowed& allowed) {
  const path similar = similarPath(lookup.folder, percentDecoded(lookup.name));
  if (similar.empty() || !allowed(real(lookup.folder / similar))) return "; add it";
  return "; upper and lower case count: there is " + printableName((lookup.folder / similar).string());
}

path locateInPackage(const std::string& uri) {
  const std::string rest = uri.substr(kPackageScheme.size());
  const std::string package = rest.substr(0, rest.find('/'));
  const std::string name = withoutLeadingSlashes(rest.substr(package.size()));
  if (package.empty() || package == "." || package == ".." || name.empty()) {
    refuseUri(uri, "must be package://NAME/PATH");
  }
  const Lookup lookup{uri, packageFolder(package), name};
  if (lookup.folder.empty()) {
    refuseUri(uri, "no package '" + printableName(package) + "'; add its folder to ROS_PACKAGE_PATH");
  }
  const std::string folder = lookup.folder.string();
  const auto allowed = [&lookup](const path& file) { return inside(file, lookup.folder); };
  path file = fileOf(lookup);
  if (file.empty()) refuseUri(uri, "no such file in " + folder + remedyForMissing(lookup, allowed));
  if (!allowed(file)) refuseUri(uri, "leads out of the package's folder " + folder + "; put the file into it");
  return file;
}

// Returns the path in file:///PATH, file:/PATH or file://localhost/PATH, without slashes at its begin; empty if it is relative or
// on another host.
std::string pathIn(const std::string& uri) {
  std::string rest = uri.substr(kFileScheme.size());
  if (startsWith(rest, kLocalHost)) {
    rest.erase(0, kLocalHost.size() - 1);
  } else if (startsWith(rest, "//")) {
    rest.erase(0, 2);
  }
  return startsWith(rest, "/") ? withoutLeadingSlashes(rest) : "";
}

bool isAllowed(const path& file, const std::vector<std::string>& roots) {
  const auto contains = [&file](const std::string& root) { return inside(file, real(root)); };
  return std::any_of(roots.begin(), roots.end(), contains) || insidePackage(file);
}

path locateFile(const std::string& uri, const std::vector<std::string>& roots) {
  const Lookup lookup{uri, "/", pathIn(uri)};
  if (lookup.name.empty()) refuseUri(uri, "must be file:///PATH with an absolute path on this host");
  const auto allowed = [&roots](const path& file) { return isAllowed(file, roots); };
  path file = fileOf(lookup);
  if (file.empty()) refuseUri(uri, "no such file" + remedyForMissing(lookup, allowed));
  if (allowed(file)) return file;
  refuseUri(uri, "is neither in a package on ROS_PACKAGE_PATH nor in one of tool/mesh_roots; add its folder");
}

// A robot description has no folder that a path could be relative to.
std::string whatToWrite(const std::string& uri) {
  if (startsWith(uri, kModelScheme)) {
    return "write " + printableName(kPackageScheme + uri.substr(kModelScheme.size())) +
           ", and add the folder to ROS_PACKAGE_PATH";
  }
  if (uri.find("://") != std::string::npos) return "write package://NAME/PATH";
  if (startsWith(uri, "/")) return "write " + printableName("file://" + uri);
  return "write " + printableName("package://NAME/" + (startsWith(uri, "./") ? uri.substr(2) : uri));
}

}  // namespace

path locateMesh(const std::string& uri, const std::vector<std::string>& roots) {
  if (uri.find('\0') != std::string::npos) throw InvalidInput("the name of a mesh has a null character");
  if (startsWith(uri, kPackageScheme)) return locateInPackage(uri);
  if (startsWith(uri, kFileScheme)) return locateFile(uri, roots);
  refuseUri(uri, "only package:// and file:// are supported; " + whatToWrite(uri));
}

}  // namespace sweep_guard_ros
