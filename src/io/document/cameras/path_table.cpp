#include "io/document/cameras/path_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/names.h"
#include "io/document/platform_document.h"
#include "io/tables/text_table.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

struct Column {
  std::string_view name;
  double* (*of)(PathRow& row);
  double scale = 1.0, lowest = -1e12, highest = 1e12;
};

constexpr double kRound = 1e4;  // degrees that count on

const std::array<Column, 3> kMetres{{{"x_m", [](PathRow& r) { return &r.place[0]; }},
                                     {"y_m", [](PathRow& r) { return &r.place[1]; }},
                                     {"z_m", [](PathRow& r) { return &r.place[2]; }}}};
const std::array<Column, 3> kGeodetic{
    {{"longitude_deg", [](PathRow& r) { return &r.place[0]; }, math::kDegree, -360.0, 360.0},
     {"latitude_deg", [](PathRow& r) { return &r.place[1]; }, math::kDegree, -90.0, 90.0},
     {"height_m", [](PathRow& r) { return &r.place[2]; }, 1.0, -1e5, 1e9}}};
const std::array<Column, 3> kMap{{{"easting_m", [](PathRow& r) { return &r.place[0]; }},
                                  {"northing_m", [](PathRow& r) { return &r.place[1]; }},
                                  {"height_m", [](PathRow& r) { return &r.place[2]; }, 1.0, -1e5, 1e9}}};
const std::array<Column, 3> kAngles{
    {{"yaw_deg", [](PathRow& r) { return &r.angles.yaw_rad; }, math::kDegree, -kRound, kRound},
     {"pitch_deg", [](PathRow& r) { return &r.angles.pitch_rad; }, math::kDegree, -90.0, 90.0},
     {"roll_deg", [](PathRow& r) { return &r.angles.roll_rad; }, math::kDegree, -kRound, kRound}}};
const std::array<Column, 4> kQuaternion{{{"qw", [](PathRow& r) { return &r.rotation.w; }},
                                         {"qx", [](PathRow& r) { return &r.rotation.x; }},
                                         {"qy", [](PathRow& r) { return &r.rotation.y; }},
                                         {"qz", [](PathRow& r) { return &r.rotation.z; }}}};
const Column kTime{"time_s", [](PathRow& r) { return &r.time_s; }};

struct Heading {
  std::vector<const Column*> columns;  // of each field
  PathRows::Attitude attitude = PathRows::Attitude::none;
};

/// `places`: names of the columns of positions; none: a table of angles alone.
Heading read_heading(const TextFile& file, int line, std::span<const Column> places) {
  std::vector<const Column*> known{&kTime};
  std::vector<std::string> choices;
  for (const std::span<const Column> some :
       {places, std::span<const Column>(kAngles),
        places.empty() ? std::span<const Column>() : std::span<const Column>(kQuaternion)})
    for (const Column& column : some) known.push_back(&column);
  for (const Column* column : known) choices.emplace_back(column->name);
  Heading heading;
  const auto has = [&](const Column& column) {
    return std::find(heading.columns.begin(), heading.columns.end(), &column) != heading.columns.end();
  };
  for (const Field& field : split(file.line(line), ',')) {
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const Column* c) { return c->name == field.text; });
    if (found == known.end())
      file.fail(line, field.column,
                format("found the heading '{}'; expected {}{}", field.text, list_names(choices),
                       did_you_mean(field.text, choices)));
    if (has(**found)) file.fail(line, field.column, format("'{}' is there twice", field.text));
    heading.columns.push_back(*found);
  }
  const auto count = [&](std::span<const Column> some) {
    return std::count_if(some.begin(), some.end(), has);
  };
  const auto require = [&](std::span<const Column> some) {
    for (const Column& column : some)
      if (!has(column)) file.fail(line, 0, format("the table has no column '{}'", column.name));
  };
  require({&kTime, 1});
  require(places);
  if (count(kAngles) > 0 && count(kQuaternion) > 0)
    file.fail(line, 0, "found angles and quaternions; expected one of both");
  if (count(kAngles) > 0 || places.empty()) require(kAngles), heading.attitude = PathRows::Attitude::angles;
  if (count(kQuaternion) > 0) require(kQuaternion), heading.attitude = PathRows::Attitude::quaternions;
  return heading;
}

PathRow read_row(const TextFile& file, int line, const Heading& heading) {
  const std::vector<Field> fields = row_of(file, line, heading.columns.size());
  PathRow row;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const Column& column = *heading.columns[k];
    *column.of(row) =
        number_of(file, line, fields[k], {column.name, column.lowest, column.highest}) * column.scale;
  }
  if (heading.attitude == PathRows::Attitude::quaternions) {
    constexpr double kOff = 1e-6;
    const double length = platform::length(row.rotation);
    if (!(std::abs(length - 1.0) <= kOff))
      file.fail(line, 0, format("found a quaternion of length {:.7g}; expected 1 within {:g}", length, kOff));
  }
  return row;
}

PathRows read_rows(const std::filesystem::path& path, std::span<const Column> places, const char* what) {
  const TextFile file(path);
  PathRows table;
  std::optional<Heading> heading;
  for (int line = 1; line <= file.line_count(); ++line) {
    if (is_blank(file.line(line)) || is_comment(file.line(line))) continue;
    if (!heading) {
      heading = read_heading(file, line, places);
      continue;
    }
    PathRow row = read_row(file, line, *heading);
    if (!table.rows.empty() && !(row.time_s > table.rows.back().time_s))
      file.fail(line, 0,
                format("found the time {:g} s after {:g} s; expected times that increase", row.time_s,
                       table.rows.back().time_s));
    table.rows.push_back(row);
  }
  if (!heading) file.fail(0, 0, format("found an empty file; expected a table of {}", what));
  if (table.rows.empty()) file.fail(0, 0, "found a heading without rows; expected one row at least");
  table.attitude = heading->attitude;
  return table;
}

}  // namespace

PathRows read_path_table(const std::filesystem::path& path, PathFrame frame) {
  return read_rows(path,
                   frame == PathFrame::geodetic ? kGeodetic
                   : frame == PathFrame::map    ? kMap
                                                : kMetres,
                   "a path");
}

PathRows read_turn_table(const std::filesystem::path& path) {
  return read_rows(path, {}, "a mount's angles");
}

}  // namespace ifov::io
