#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "geodesy/attitude.h"
#include "platform/quaternion.h"

namespace ifov::io {

enum class PathFrame;

/// A row of a table of a path, as it stands there.
struct PathRow {
  double time_s = 0.0;
  std::array<double, 3> place{};  ///< metres; geodetic: longitude and latitude in radians, height
  geodesy::Attitude angles;       ///< where the table has them
  platform::Quaternion rotation;  ///< likewise; takes the body to the table's frame
};
struct PathRows {
  enum class Attitude { none, angles, quaternions } attitude = Attitude::none;
  std::vector<PathRow> rows;  ///< at least one; times increase
};

/// A table of docs/formats/paths.md. Throws InputError with file, line and column; SystemError where it cannot be read.
PathRows read_path_table(const std::filesystem::path& path, PathFrame frame);

/// Likewise of angles alone.
PathRows read_turn_table(const std::filesystem::path& path);

}  // namespace ifov::io
