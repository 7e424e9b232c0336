#pragma once

#include <filesystem>
#include <string>

namespace sweep_guard_session {

/// Writes a file of a report.
/// @throws sweep_guard_core::InvalidInput if that fails
void write(const std::filesystem::path& path, const std::string& text);

/// Removes the pictures of an earlier report into the same folder: they do not belong to the new tables.
void removePictures(const std::filesystem::path& folder);

/// Draws the CSV files of a report by plot.py, which stands beside this program and says what it lacks.
/// @param name  of the session, for the titles
/// @returns whether there are pictures
bool drawPictures(std::string folder, std::string name);

}  // namespace sweep_guard_session
