#include "io/atmosphere/uvspec.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/atmosphere/format_guess.h"
#include "io/atmosphere/spectral_table.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

using Q = atmosphere::PathQuantity;

constexpr std::size_t kMostPaths = 10000;

class Reader {
 public:
  Reader(const TextFile& file, const UvspecInput& input) : file_(file), input_(input) {
    const auto& columns = input.columns;
    const auto lambda = std::find(columns.begin(), columns.end(), "lambda");
    unit_ = lambda != columns.end() ? WavelengthUnit::nanometres : WavelengthUnit::wavenumber_per_cm;
    spectral_ = static_cast<std::size_t>(
        (lambda != columns.end() ? lambda : std::find(columns.begin(), columns.end(), "wavenumber")) -
        columns.begin());
    in_columns_ = std::find(columns.begin(), columns.end(), "uu") != columns.end();
    levels_ = std::max<std::size_t>(1, input.altitude_km.size());
    phis_ = std::max<std::size_t>(1, input.phi_deg.size());
    if (levels_ * std::max<std::size_t>(1, input.umu.size()) * phis_ > kMostPaths)
      throw InputError(format("{}: found more than {} angles and altitudes", input.name, kMostPaths));
  }

  std::vector<atmosphere::ImportedPath> read() {
    std::vector<SpectralTable> tables(levels_, SpectralTable(file_, unit_, names()));
    if (next_line() == 0) file_.fail(0, 0, "found an empty file; expected the output of uvspec");
    while (next_line() != 0)
      for (SpectralTable& table : tables) read_block(table);
    std::vector<atmosphere::ImportedPath> paths;
    for (std::size_t level = 0; level < levels_; ++level) add_paths(tables[level], level, paths);
    return paths;
  }

 private:
  /// Number of the next line that is not blank; 0 at the end.
  int next_line() {
    while (line_ <= file_.line_count() && is_blank(file_.line(line_))) ++line_;
    return line_ <= file_.line_count() ? line_ : 0;
  }

  /// The next line, which has `count` numbers.
  std::vector<Field> numbers(std::size_t count, const std::string& what) {
    if (next_line() == 0) file_.fail(file_.line_count(), 0, format("the file ends here; expected {}", what));
    std::vector<Field> fields = split(file_.line(line_), ' ');
    for (const Field& field : fields)
      if (!fortran_number(field.text))
        file_.fail(line_, field.column,
                   format("found '{}'; expected {}", field.text, what) + looks_like(file_, "uvspec"));
    if (fields.size() != count)
      file_.fail(line_, 0,
                 format("found {} numbers; expected {}, as {} asks for", fields.size(), what, input_.name));
    ++line_;
    return fields;
  }

  std::string expected_columns() const {
    std::string list;
    for (const std::string& column : input_.columns) list += format("{}{}", list.empty() ? "" : " ", column);
    return format("{} ({})", input_.columns.size(), list);
  }

  bool has_angle_rows() const { return !input_.umu.empty() && !in_columns_; }

  static std::string radiance_name(std::size_t umu, std::size_t phi) { return format("uu {} {}", umu, phi); }

  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < input_.columns.size(); ++i)
      if (i != spectral_) result.push_back(input_.columns[i]);
    if (has_angle_rows())
      for (std::size_t u = 0; u < input_.umu.size(); ++u)
        for (std::size_t p = 0; p < phis_; ++p) result.push_back(radiance_name(u, p));
    return result;
  }

  void read_block(SpectralTable& table) {
    std::vector<Field> cells = numbers(input_.columns.size(), expected_columns());
    const int first = line_ - 1;
    const Field x = cells[spectral_];
    cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(spectral_));
    if (has_angle_rows()) {
      if (!input_.phi_deg.empty()) {
        const std::vector<Field> phis = numbers(phis_, format("{} azimuths (phi)", phis_));
        for (std::size_t p = 0; p < phis_; ++p) same(phis[p], input_.phi_deg[p], 0.01, "phi");
      }
      for (const double umu : input_.umu) {
        // The angle, the mean over azimuths, then each azimuth.
        const std::size_t count = input_.phi_deg.empty() ? 2 : 2 + phis_;
        const std::vector<Field> row = numbers(count, format("{} (umu and radiances)", count));
        same(row[0], umu, 1e-3, "umu");
        cells.insert(cells.end(), row.end() - static_cast<std::ptrdiff_t>(phis_), row.end());
      }
    }
    table.add(first, x, cells);
  }

  void same(const Field& field, double asked, double tolerance, std::string_view what) const {
    if (std::abs(*fortran_number(field.text) - asked) > tolerance)
      file_.fail(line_ - 1, field.column,
                 format("found {} {}; expected {:g}, as {} asks for", what, field.text, asked, input_.name));
  }

  void add_paths(const SpectralTable& table, std::size_t level,
                 std::vector<atmosphere::ImportedPath>& paths) const {
    const std::size_t umus = std::max<std::size_t>(1, input_.umu.size());
    for (std::size_t u = 0; u < umus; ++u)
      for (std::size_t p = 0; p < phis_; ++p) {
        std::string source = file_.name();
        if (!input_.altitude_km.empty()) source += format(", {:g} km", input_.altitude_km[level]);
        if (!input_.umu.empty()) source += format(", umu {:g}", input_.umu[u]);
        if (!input_.phi_deg.empty()) source += format(", phi {:g}", input_.phi_deg[p]);
        atmosphere::ImportedPath path(source, table.wavelength_um());
        path.geometry.sun_zenith_rad = input_.sun_zenith_deg * math::kDegree;
        if (!input_.altitude_km.empty()) path.geometry.sensor_altitude_km = input_.altitude_km[level];
        if (!input_.umu.empty()) path.geometry.zenith_rad = std::acos(std::clamp(-input_.umu[u], -1.0, 1.0));
        if (!input_.phi_deg.empty()) path.geometry.azimuth_rad = input_.phi_deg[p] * math::kDegree;
        if (input_.transmittance) {
          set_transmittances(table, path);
        } else {
          set(table, path, Q::direct_irradiance, "edir");
          set(table, path, Q::diffuse_irradiance, "edn");
          set(table, path, Q::global_irradiance, "eglo");
          set(table, path, Q::upward_irradiance, "eup");
          set(table, path, Q::total_radiance, in_columns_ ? "uu" : radiance_name(u, p));
        }
        paths.push_back(std::move(path));
      }
  }

  void set(const SpectralTable& table, atmosphere::ImportedPath& path, Q quantity,
           const std::string& name) const {
    std::vector<double> values = table.column(name);
    const auto um = path.wavelength_um();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double per_um = input_.density == UvspecInput::Density::per_cm ? 1e4 / (um[i] * um[i]) : 1e3;
      values[i] *= per_um * (input_.thermal ? 1.0 : 1e-3);
    }
    path.set(quantity, std::move(values));
  }

  void set_transmittances(const SpectralTable& table, atmosphere::ImportedPath& path) const {
    const double scale = 1.0 / std::cos(input_.sun_zenith_deg * math::kDegree);
    std::vector<double> direct = table.column("edir"), global = table.column("eglo");
    const std::vector<double> diffuse = table.column("edn");
    if (global.empty() && !direct.empty() && !diffuse.empty()) {
      global = direct;
      for (std::size_t i = 0; i < global.size(); ++i) global[i] += diffuse[i];
    }
    for (double& value : direct) value *= scale;
    for (double& value : global) value *= scale;
    path.set(Q::direct_sun_ground_transmittance, std::move(direct));
    path.set(Q::sun_ground_transmittance, std::move(global));
  }

  const TextFile& file_;
  const UvspecInput& input_;
  WavelengthUnit unit_ = WavelengthUnit::nanometres;
  std::size_t spectral_ = 0, levels_ = 1, phis_ = 1;
  bool in_columns_ = false;
  int line_ = 1;
};

}  // namespace

std::vector<atmosphere::ImportedPath> read_uvspec(const std::filesystem::path& output,
                                                  const std::filesystem::path& input) {
  return parse_uvspec(TextFile(output), read_uvspec_input(input));
}

std::vector<atmosphere::ImportedPath> parse_uvspec(const TextFile& output, const UvspecInput& input) {
  return Reader(output, input).read();
}

}  // namespace ifov::io
