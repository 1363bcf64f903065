#include "io/document/cameras/lens_tables.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "io/document/cameras/image_size.h"
#include "io/document/schema/record.h"
#include "io/tables/number_table.h"
#include "math/angle.h"
#include "sensor/lens/distortion.h"
#include "sensor/lens/element_map.h"
#include "sensor/lens/lens_table.h"

namespace ifov::io {

SchemaType<DocumentFile> table_file_type(const char* name, const char* doc) {
  Record<DocumentFile> record(name, doc);
  record.required("file",
                  via([](DocumentFile& at, DocumentFile read) { at = std::move(read); },
                      [](const DocumentFile& at) { return std::optional(at); }),
                  file(), "the table, CSV");
  return record.type();
}

SchemaType<DistortionDocument> distortion_type() {
  using Terms = sensor::Distortion::Terms;
  using Document = DistortionDocument;
  Record<Document> record(
      "lens distortion",
      "How far beside their places directions appear (Brown 1966), with the terms and signs of OpenCV's camera model: x (1 + k1 r^2 + k2 r^4 + k3 "
      "r^6) + 2 p1 x y + p2 (r^2 + 2 x^2), and y likewise with p1 and p2 exchanged; x right and y down, in focal lengths. Or a table of radii.");
  record
      .with_default("k1", path(&Document::terms, &Terms::k1), number(), "0",
                    "along the radius; below 0 the image is a barrel")
      .with_default("k2", path(&Document::terms, &Terms::k2), number(), "0", "likewise, of the fourth power")
      .with_default("k3", path(&Document::terms, &Terms::k3), number(), "0", "likewise, of the sixth")
      .with_default("p1", path(&Document::terms, &Terms::p1), number(), "0",
                    "of lenses that are not centred, downwards")
      .with_default("p2", path(&Document::terms, &Terms::p2), number(), "0", "likewise, to the right")
      .optional("table", &Document::table,
                table_file_type("distortion table",
                                "Radii without and with distortion from a table (docs/formats/elements.md)."),
                "instead of terms: radii from a file")
      .check([](const Document& read, const DocumentNode& node) {
        if (read.table && !read.terms.none())
          node.given("table").fail_at_key(
              "a lens is distorted by terms or by a 'table', and this one has both: leave one out");
      });
  return record.type();
}

SchemaType<DocumentFile> elements_type() {
  return table_file_type(
      "table of elements",
      "Where detector elements look, and how wide, from a table (docs/formats/elements.md).");
}

double FocalPlane::corner_px() const { return 0.5 * std::hypot(width_px, line ? 0 : height_px); }

LensSettings LensSettings::of(const ImageSize& size) const {
  LensSettings same = *this;
  if (elements && columns == 0) same.columns = size.width_px, same.rows = size.height_px;
  return same;
}

namespace {

std::shared_ptr<const sensor::Lens> read_distortion(const DocumentFile& from, const FocalPlane& plane) {
  constexpr double kFarthest_mm = 1e5, kLeast_mm = 1e-9;
  if (!plane.focal_length_m)
    throw InputError(
        "the distortion's table tells millimetres on the focal plane, and nothing says the focal length: give 'focal_length' and 'pitch' in "
        "place of 'field_of_view'");
  const NumberColumn columns[] = {{{"radius_mm", 0.0, kFarthest_mm}}, {{"displaced_mm", 0.0, kFarthest_mm}}};
  const NumberTable table = read_number_table(from.path, columns, "a lens's distortion");
  for (std::size_t k = 0; k < 2; ++k)
    if (!table.has(k)) table.file.fail(0, 0, format("the table has no column '{}'", columns[k].range.name));
  std::vector<sensor::LensTable::Row> rows;
  double before[2] = {0.0, 0.0};
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const double radius = table.rows[r][0], displaced = table.rows[r][1];
    if (rows.empty() && radius == 0.0 && displaced == 0.0) continue;  // the axis
    if (!(radius > before[0] + kLeast_mm) || !(displaced > before[1] + kLeast_mm))
      table.fail(r, format("found {:g} mm that appear at {:g} mm after {:g} mm at {:g} mm; expected both to "
                           "increase from the axis on",
                           radius, displaced, before[0], before[1]));
    before[0] = radius, before[1] = displaced;
    const double per_mm = 1e-3 / *plane.focal_length_m;
    rows.push_back({radius * per_mm, displaced * per_mm});
  }
  if (rows.empty()) table.file.fail(0, 0, "found the axis alone; expected radii above 0");
  const double corner_mm = 1e3 * plane.step * *plane.focal_length_m * plane.corner_px();
  if (before[1] < corner_mm * (1.0 - 1e-6))
    table.fail(
        table.rows.size() - 1,
        format("the table ends at {:g} mm of the image, whose {} lie at {:.4g} mm; expected rows up to there",
               before[1], plane.line ? "ends" : "corners", corner_mm));
  return std::make_shared<const sensor::LensTable>(rows);
}

struct Elements {
  NumberTable table;
  std::vector<double> columns, rows;  // numbers, from 1, rising
  std::vector<std::size_t> row_of;    // of the table, by node
  std::shared_ptr<const sensor::ElementMap> map;
};

enum Asked : std::size_t {
  kColumn,
  kRow,
  kAcrossDeg,
  kAlongDeg,
  kAcrossMrad,
  kAlongMrad,
  kIfovDeg,
  kIfovMrad
};

std::vector<double> distinct(const NumberTable& table, std::size_t column, int most, const char* what) {
  std::vector<double> found;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const double number = table.rows[r][column];
    if (number != std::floor(number))
      table.fail(r, format("found the {} {:g}; expected a whole number", what, number));
    if (number > most)
      table.fail(r,
                 format("found the {} {:g}; expected 1 to {}, as many as the image has", what, number, most));
    found.push_back(number);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  if (found.front() != 1.0 || found.back() != most)
    table.file.fail(
        0, 0,
        format("found {0}s {1:g} to {2:g}; expected the outermost ones, {0}s 1 and {3}, and any between",
               what, found.front(), found.back(), most));
  return found;
}

Elements read_elements(const DocumentFile& from, const FocalPlane& plane) {
  constexpr double kMost = 1e6, kWidest_deg = 89.0, kWidest_mrad = 1550.0, kMrad = 1e-3;
  const NumberColumn columns[] = {{{"column", 1.0, kMost}},
                                  {{"row", 1.0, kMost}},
                                  {{"across_deg", -kWidest_deg, kWidest_deg}, math::kDegree},
                                  {{"along_deg", -kWidest_deg, kWidest_deg}, math::kDegree},
                                  {{"across_mrad", -kWidest_mrad, kWidest_mrad}, kMrad},
                                  {{"along_mrad", -kWidest_mrad, kWidest_mrad}, kMrad},
                                  {{"ifov_deg", 1e-9, kWidest_deg}, math::kDegree},
                                  {{"ifov_mrad", 1e-9, kWidest_mrad}, kMrad}};
  Elements read{read_number_table(from.path, columns, "elements"), {}, {}, {}, {}};
  const NumberTable& table = read.table;
  if (!table.has(kColumn)) table.file.fail(0, 0, "the table has no column 'column'");
  if (plane.line && table.has(kRow))
    table.file.fail(0, 0, "found a column 'row'; expected none, the elements are one line");
  if (!plane.line && !table.has(kRow)) table.file.fail(0, 0, "the table has no column 'row'");
  const auto one_of = [&](Asked degrees, Asked mrad) {
    if (table.has(degrees) == table.has(mrad))
      table.file.fail(
          0, 0,
          format("the table has {} of '{}' and '{}'; expected one of them", table.has(mrad) ? "both" : "none",
                 columns[degrees].range.name, columns[mrad].range.name));
    return table.has(degrees) ? degrees : mrad;
  };
  const Asked across = one_of(kAcrossDeg, kAcrossMrad), along = one_of(kAlongDeg, kAlongMrad);
  if (table.has(kIfovDeg) && table.has(kIfovMrad)) one_of(kIfovDeg, kIfovMrad);
  read.columns = distinct(table, kColumn, plane.width_px, "column");
  read.rows = plane.line ? std::vector<double>{1.0} : distinct(table, kRow, plane.height_px, "row");
  if (read.columns.size() < 2) table.file.fail(0, 0, "found one column of elements; expected two at least");

  constexpr auto kNone = static_cast<std::size_t>(-1);
  read.row_of.assign(read.columns.size() * read.rows.size(), kNone);
  std::vector<sensor::Lens::Place> directions(read.row_of.size());
  const auto index = [](const std::vector<double>& numbers, double number) {
    return static_cast<std::size_t>(std::lower_bound(numbers.begin(), numbers.end(), number) -
                                    numbers.begin());
  };
  const auto name = [&](std::size_t node) {
    const double column = read.columns[node % read.columns.size()],
                 row = read.rows[node / read.columns.size()];
    return plane.line ? format("element {:g}", column)
                      : format("the element of column {:g}, row {:g},", column, row);
  };
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::vector<double>& row = table.rows[r];
    const std::size_t node = index(read.columns, row[kColumn]) +
                             (plane.line ? 0 : index(read.rows, row[kRow]) * read.columns.size());
    if (read.row_of[node] != kNone)
      table.fail(r,
                 format("{} is there twice: first in line {}", name(node), table.lines[read.row_of[node]]));
    read.row_of[node] = r;
    directions[node] = {std::tan(row[across]), std::tan(row[along])};
  }
  for (std::size_t node = 0; node < read.row_of.size(); ++node)
    if (read.row_of[node] == kNone)
      table.file.fail(0, 0,
                      format("{} is missing; expected all of {} columns and {} rows, which others have",
                             name(node), read.columns.size(), read.rows.size()));
  const auto places = [&](const std::vector<double>& numbers, int count) {
    std::vector<double> at;
    for (const double number : numbers) at.push_back((number - 0.5 - 0.5 * count) * plane.step);
    return at;
  };
  auto map = std::make_shared<const sensor::ElementMap>(
      places(read.columns, plane.width_px),
      plane.line ? std::vector<double>{0.0} : places(read.rows, plane.height_px), directions);
  if (const auto fold = map->first_fold())
    table.fail(
        read.row_of[*fold],
        format(
            "{} and the next look across each other; expected angles across that increase from column to column, and "
            "angles along from row to row",
            name(*fold)));
  read.map = std::move(map);
  return read;
}

/// That the table of elements is of.
FocalPlane plane_of_table(const LensSettings& settings, const FocalPlane& plane) {
  FocalPlane own = plane;
  if (settings.columns == 0) return own;
  own.step *= static_cast<double>(plane.width_px) / settings.columns;
  own.width_px = settings.columns, own.height_px = settings.rows;
  return own;
}

}  // namespace

std::shared_ptr<const sensor::Lens> lens_of(const LensSettings& settings, const FocalPlane& plane) {
  if (settings.elements) return read_elements(*settings.elements, plane_of_table(settings, plane)).map;
  if (!settings.distortion) return nullptr;
  if (settings.distortion->table) return read_distortion(*settings.distortion->table, plane);
  if (settings.distortion->terms.none()) return nullptr;
  return std::make_shared<const sensor::Distortion>(settings.distortion->terms,
                                                    plane.step * plane.corner_px());
}

std::optional<SensitiveSide> sensitive_side(const LensSettings& settings, const FocalPlane& plane) {
  if (!settings.elements) return std::nullopt;
  constexpr double kMostApart = 0.05, kWidest = 4.0;
  const FocalPlane own = plane_of_table(settings, plane);
  const Elements read = read_elements(*settings.elements, own);
  const std::size_t ifov = read.table.has(kIfovDeg) ? kIfovDeg : kIfovMrad;
  if (!read.table.has(ifov)) return std::nullopt;
  const std::size_t across = read.table.has(kAcrossDeg) ? kAcrossDeg : kAcrossMrad,
                    along = read.table.has(kAlongDeg) ? kAlongDeg : kAlongMrad;
  std::vector<double> sides;
  double sum = 0.0;
  for (std::size_t node = 0; node < read.row_of.size(); ++node) {
    const std::vector<double>& row = read.table.rows[read.row_of[node]];
    const sensor::Lens::Place at{
        (read.columns[node % read.columns.size()] - 0.5 - 0.5 * own.width_px) * own.step,
        own.line ? 0.0 : (read.rows[node / read.columns.size()] - 0.5 - 0.5 * own.height_px) * own.step};
    const auto width = [&](double angle) {
      return std::tan(angle + 0.5 * row[ifov]) - std::tan(angle - 0.5 * row[ifov]);
    };
    sides.push_back(own.line ? width(row[across]) / (read.map->stretch(at) * own.step)
                             : std::sqrt(width(row[across]) * width(row[along]) /
                                         (read.map->area(at) * own.step * own.step)));
    sum += sides.back();
  }
  SensitiveSide found{sum / static_cast<double>(sides.size()), 0.0};
  for (std::size_t node = 0; node < sides.size(); ++node) {
    const double apart = std::abs(sides[node] / found.side - 1.0);
    if (apart > kMostApart || !(sides[node] <= kWidest))
      read.table.fail(
          read.row_of[node],
          format(
              "the element sees {:.4g} of its distance to its neighbours, and all {:.4g} in the mean; expected at most {:g} "
              "times that distance, and the same of all within {:g} %",
              sides[node], found.side, kWidest, 100.0 * kMostApart));
    found.spread = std::max(found.spread, apart);
  }
  return found;
}

std::vector<std::array<double, 2>> read_vignetting(const DocumentFile& from, const FocalPlane& plane,
                                                   double pitch_m) {
  constexpr double kFarthest_mm = 1e5, kDarkest = 0.01, kBrightest = 2.0, kAlike = 1e-6;
  const NumberColumn columns[] = {{{"height_mm", 0.0, kFarthest_mm}}, {{"share", kDarkest, kBrightest}}};
  const NumberTable table = read_number_table(from.path, columns, "vignetting");
  for (std::size_t k = 0; k < 2; ++k)
    if (!table.has(k)) table.file.fail(0, 0, format("the table has no column '{}'", columns[k].range.name));
  std::vector<std::array<double, 2>> rows;
  double before_mm = -1.0;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const double height_mm = table.rows[r][0], share = table.rows[r][1];
    if (r == 0 && (height_mm != 0.0 || std::abs(share - 1.0) > kAlike))
      table.fail(r,
                 format("found a share of {:g} at a height of {:g} mm; expected the middle first, 1 at 0 mm",
                        share, height_mm));
    if (!(height_mm > before_mm))
      table.fail(r, format("found the height {:g} mm after {:g} mm; expected heights that increase",
                           height_mm, before_mm));
    before_mm = height_mm;
    rows.push_back({1e-3 * height_mm / pitch_m, share});
  }
  if (rows.back()[0] < plane.corner_px() * (1.0 - kAlike))
    table.fail(
        table.rows.size() - 1,
        format("the table ends at {:g} mm of the image, whose {} lie at {:.4g} mm; expected rows up to there",
               before_mm, plane.line ? "ends" : "corners", 1e3 * pitch_m * plane.corner_px()));
  return rows;
}

}  // namespace ifov::io
