#include <rospack/rospack.h>

#include <cstdlib>
#include <sstream>
#include <system_error>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_ros {
namespace {

using std::filesystem::path;
using sweep_guard_core::InvalidInput;

const std::string kPackageScheme = "package://";
const std::string kFileScheme = "file://";

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

path locateInPackage(const std::string& uri) {
  const std::string rest = uri.substr(kPackageScheme.size());
  const std::string package = rest.substr(0, rest.find('/'));
  if (package.empty() || package == "." || package == ".." || package.size() == rest.size()) {
    throw InvalidInput(uri + ": must be package://NAME/PATH");
  }
  const path folder = packageFolder(package);
  if (folder.empty()) {
    throw InvalidInput(uri + ": no package '" + package + "'; add its folder to ROS_PACKAGE_PATH");
  }
  path file = real(folder / rest.substr(package.size() + 1));
  if (file.empty()) throw InvalidInput(uri + ": no such file in " + folder.string() + "; add it");
  if (!inside(file, folder)) {
    throw InvalidInput(uri + ": leads out of the package's folder " + folder.string() + "; put the file into it");
  }
  return file;
}

path locateFile(const std::string& uri, const std::vector<std::string>& roots) {
  const path named = uri.substr(kFileScheme.size());
  if (!named.is_absolute()) throw InvalidInput(uri + ": must be file:///PATH");
  path file = real(named);
  if (file.empty()) throw InvalidInput(uri + ": no such file");
  for (const std::string& root : roots) {
    if (inside(file, real(root))) return file;
  }
  if (insidePackage(file)) return file;
  throw InvalidInput(uri +
                     ": is neither in a package on ROS_PACKAGE_PATH nor in one of tool/mesh_roots; add its folder");
}

}  // namespace

path locateMesh(const std::string& uri, const std::vector<std::string>& roots) {
  if (uri.find('\0') != std::string::npos) throw InvalidInput("the name of a mesh has a null character");
  if (startsWith(uri, kPackageScheme)) return locateInPackage(uri);
  if (startsWith(uri, kFileScheme)) return locateFile(uri, roots);
  throw InvalidInput(uri + ": only package:// and file:// are supported");
}

}  // namespace sweep_guard_ros
