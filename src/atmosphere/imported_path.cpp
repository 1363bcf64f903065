#include "atmosphere/imported_path.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/names.h"

namespace ifov::atmosphere {
namespace {

constexpr double kRounding = 1e-3;

constexpr std::string_view kRadiance = "W m-2 sr-1 um-1", kIrradiance = "W m-2 um-1", kRatio = "";

struct Description {
  std::string_view name, unit;
};

// In the order of PathQuantity.
constexpr std::array<Description, kPathQuantities> kDescriptions{{
    {"ground_sensor_transmittance", kRatio},
    {"diffuse_ground_sensor_transmittance", kRatio},
    {"sun_ground_transmittance", kRatio},
    {"direct_sun_ground_transmittance", kRatio},
    {"two_way_transmittance", kRatio},
    {"total_radiance", kRadiance},
    {"solar_path_radiance", kRadiance},
    {"single_scatter_path_radiance", kRadiance},
    {"thermal_path_radiance", kRadiance},
    {"surface_emission", kRadiance},
    {"ground_reflected_radiance", kRadiance},
    {"direct_reflected_radiance", kRadiance},
    {"direct_irradiance", kIrradiance},
    {"diffuse_irradiance", kIrradiance},
    {"global_irradiance", kIrradiance},
    {"upward_irradiance", kIrradiance},
    {"sun_at_sensor", kIrradiance},
    {"solar_irradiance", kIrradiance},
    {"spherical_albedo", kRatio},
    {"surface_emissivity", kRatio},
}};

const Description& description(PathQuantity quantity) {
  return kDescriptions[static_cast<std::size_t>(quantity)];
}

}  // namespace

std::string_view name_of(PathQuantity quantity) { return description(quantity).name; }
std::string_view unit_of(PathQuantity quantity) { return description(quantity).unit; }

std::optional<PathQuantity> path_quantity(std::string_view name) {
  for (std::size_t i = 0; i < kPathQuantities; ++i)
    if (kDescriptions[i].name == name) return static_cast<PathQuantity>(i);
  return std::nullopt;
}

std::vector<std::string> path_quantity_names() {
  std::vector<std::string> names;
  for (const Description& each : kDescriptions) names.emplace_back(each.name);
  return names;
}

ImportedPath::ImportedPath(std::string source, std::vector<double> wavelength_um)
    : source_(std::move(source)), wavelength_um_(std::move(wavelength_um)) {
  for (std::size_t i = 0; i < wavelength_um_.size(); ++i)
    if (!(wavelength_um_[i] > (i == 0 ? 0.0 : wavelength_um_[i - 1])) || !std::isfinite(wavelength_um_[i]))
      throw InputError(format("{}: wavelengths do not rise at {:g} um", source_, wavelength_um_[i]));
}

void ImportedPath::set(PathQuantity quantity, std::vector<double> values) {
  if (!values.empty() && values.size() != wavelength_um_.size())
    throw InputError(format("{}: found {} values of {} at {} wavelengths", source_, values.size(),
                            name_of(quantity), wavelength_um_.size()));
  const bool ratio = unit_of(quantity).empty();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]))
      throw InputError(format("{}: found a {} at {:g} um that is no number", source_, name_of(quantity),
                              wavelength_um_[i]));
    if (!ratio) continue;
    if (values[i] < -kRounding || values[i] > 1.0 + kRounding)
      throw InputError(format("{}: found a {} of {:g} at {:g} um; expected 0 to 1", source_,
                              name_of(quantity), values[i], wavelength_um_[i]));
    values[i] = std::clamp(values[i], 0.0, 1.0);
  }
  columns_[static_cast<std::size_t>(quantity)] = std::move(values);
}

std::span<const double> ImportedPath::need(PathQuantity quantity) const {
  if (has(quantity)) return column(quantity);
  std::vector<std::string> names;
  for (const PathQuantity each : quantities()) names.emplace_back(name_of(each));
  throw InputError(
      format("{}: has no {}; there are {}", source_, name_of(quantity), list_names(names, "and")));
}

radiometry::Spectrum ImportedPath::spectrum(PathQuantity quantity) const {
  const std::span<const double> values = need(quantity);
  return {wavelength_um_,
          {values.begin(), values.end()},
          radiometry::OutsideRange::error,
          format("{} of {}", name_of(quantity), source_)};
}

std::vector<PathQuantity> ImportedPath::quantities() const {
  std::vector<PathQuantity> found;
  for (std::size_t i = 0; i < kPathQuantities; ++i)
    if (has(static_cast<PathQuantity>(i))) found.push_back(static_cast<PathQuantity>(i));
  return found;
}

std::optional<double> ImportedPath::surface_albedo() const {
  const std::span<const double> emissivity = column(PathQuantity::surface_emissivity);
  if (emissivity.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(emissivity.begin(), emissivity.end());
  if (*high - *low > kRounding) return std::nullopt;
  return 1.0 - 0.5 * (*low + *high);
}

}  // namespace ifov::atmosphere
