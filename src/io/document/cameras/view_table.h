#pragma once

#include <filesystem>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace ifov::io {

/// A column of a table of views.
struct ViewColumn {
  std::string_view name;  ///< in the heading
  double scale = 1.0;     ///< SI units or radians of one
  double lowest = -1e12, highest = 1e12;
  double otherwise =
      std::numeric_limits<double>::quiet_NaN();  ///< where a table has no such column; not a number: it must
};

/// Rows of a table of docs/formats/views.md, [row * columns + column], scaled. Throws InputError with file, line and column; SystemError
/// where it cannot be read.
std::vector<double> read_view_table(const std::filesystem::path& path, std::span<const ViewColumn> columns);

/// Nearest to the horizon that an area is looked at from.
inline constexpr double kMostZenith_deg = 89.0;

/// No more rows than this, in tables and in documents.
inline constexpr std::size_t kMostViews = 100000;

}  // namespace ifov::io
