#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ifov::sensor {

/// What single views are of, for the tables that hold their results: one row each.
struct ViewList {
  enum class Kind {
    directions,  ///< what leaves an area towards each
    hemisphere,  ///< the same of directions by chance, whose mean is the albedo
    points,      ///< what falls on a plane at each: an irradiance
    rays         ///< what comes along each
  };
  struct Column {
    std::string name, unit;  ///< "view_zenith_deg", "degree"
  };
  Kind kind = Kind::directions;
  std::vector<Column> columns;
  std::vector<double> values;  ///< [view * columns + column], in the document's coordinates

  std::size_t count() const { return columns.empty() ? 0 : values.size() / columns.size(); }
  double value(std::size_t view, std::size_t column) const { return values[view * columns.size() + column]; }
};

}  // namespace ifov::sensor
