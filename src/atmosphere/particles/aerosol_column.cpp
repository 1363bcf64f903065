#include "atmosphere/particles/aerosol_column.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "atmosphere/particles/aerosol_description.h"
#include "atmosphere/particles/aerosol_height.h"
#include "atmosphere/particles/aerosol_types.h"
#include "atmosphere/particles/particle_layer.h"
#include "atmosphere/particles/particles.h"
#include "atmosphere/profile/column_integral.h"
#include "core/error.h"
#include "core/names.h"

namespace ifov::atmosphere {
namespace {

constexpr double kClearestKm = 300.0;  ///< beyond, air alone limits the view (3.912 / 0.01159 km-1)
constexpr double kThickestKm = 0.05;
constexpr double kTroposphereHumidity = 70.0;

template <class Rows>
const auto& row_named(const Rows& rows, const std::string& name, std::string_view what,
                      const std::vector<std::string>& choices) {
  for (const auto& row : rows)
    if (row.name == name) return row;
  throw InputError(
      format("'{}' is no {}; expected {}{}", name, what, list_names(choices), did_you_mean(name, choices)));
}

bool is_spring_summer(const std::string& season, std::string_view model) {
  if (season.empty()) return !model.ends_with("winter");
  static const std::vector<std::string> seasons{"spring-summer", "autumn-winter"};
  if (season != seasons[0] && season != seasons[1])
    throw InputError(format("'{}' is no season; expected {}{}", season, list_names(seasons),
                            did_you_mean(season, seasons)));
  return season == seasons[0];
}

double total_thickness(const AerosolHeights& heights) {
  double sum = 0.0;
  for (const std::vector<double>& extinction : heights.extinction_km)
    sum += column_integral(heights.altitude_km, extinction, heights.altitude_km.front(),
                           heights.altitude_km.back());
  return sum;
}

/// The visibility at which the column has this optical thickness, if there is one.
double visibility_for(double aot550, const auto& heights_at) {
  double clear = 1.0 / kClearestKm, thick = 1.0 / kThickestKm;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (clear + thick);
    (total_thickness(heights_at(1.0 / middle)) < aot550 ? clear : thick) = middle;
  }
  return 1.0 / clear;
}

double mean_humidity(const Profile& profile, const std::vector<double>& altitude,
                     const std::vector<double>& extinction) {
  std::vector<double> weight, logarithm;
  for (std::size_t i = 0; i < profile.levels(); ++i) {
    const double z = profile.altitude_km[i];
    weight.push_back(z < altitude.back() ? density_at(altitude, extinction, z) : 0.0);
    logarithm.push_back(weight.back() *
                        std::log(100.0 - std::min(profile.relative_humidity_percent(i), 99.0)));
  }
  const double low = profile.ground_km(), high = profile.altitude_km.back();
  const double sum = column_integral(profile.altitude_km, weight, low, high);
  return sum > 0.0 ? 100.0 - std::exp(column_integral(profile.altitude_km, logarithm, low, high) / sum) : 0.0;
}

}  // namespace

const std::vector<std::string>& stratosphere_states() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const StratosphereState& state : stratosphere_table()) all.push_back(state.name);
    return all;
  }();
  return names;
}

AerosolColumn::AerosolColumn(const AerosolDescription& description, const Profile& profile,
                             std::string_view model) {
  if (description.type != "none") add_haze(description, profile, model);
  first_cloud_ = regions_.size();
  for (const std::shared_ptr<const ParticleLayer>& cloud : description.clouds)
    add_cloud(*cloud, profile.ground_km());
}

void AerosolColumn::add_haze(const AerosolDescription& description, const Profile& profile,
                             std::string_view model) {
  const AerosolType& type = aerosol_type(description.type);
  const StratosphereState& state = row_named(stratosphere_table(), description.stratosphere,
                                             "state of the stratosphere", stratosphere_states());
  const bool spring_summer = is_spring_summer(description.season, model);
  if (description.visibility_km && description.aot550)
    throw InputError("an aerosol has a visibility or an optical thickness at 550 nm, not both");
  if (!description.own.empty() && (description.visibility_km || description.aot550))
    throw InputError(format("haze of one's own has an optical depth of its own, no {}",
                            description.aot550 ? "optical thickness at 550 nm" : "visibility"));
  const auto heights_at = [&](double visibility) {
    return aerosol_heights(visibility, spring_summer, state, profile.ground_km());
  };
  visibility_km_ = description.visibility_km.value_or(type.visibility_km);
  if (!(visibility_km_ >= kThickestKm && visibility_km_ <= kClearestKm))
    throw InputError(
        format("visibility of {} km: expected {} to {} km", visibility_km_, kThickestKm, kClearestKm));
  double factor = 1.0;
  if (description.aot550) {
    if (!(*description.aot550 >= 0.0 && *description.aot550 <= 10.0))
      throw InputError(format("optical thickness {} at 550 nm: expected 0 to 10", *description.aot550));
    visibility_km_ = visibility_for(*description.aot550, heights_at);
    factor = *description.aot550 / total_thickness(heights_at(visibility_km_));
  }
  AerosolHeights heights = heights_at(visibility_km_);
  for (std::vector<double>& extinction : heights.extinction_km)
    for (double& value : extinction) value *= factor;
  if (!description.own.empty()) {
    visibility_km_ = 0.0;
    for (const std::size_t region : {0, 1})
      std::fill_n(heights.extinction_km[region].begin(), heights.altitude_km.size(), 0.0);
  }
  humidity_percent_ = mean_humidity(profile, heights.altitude_km, heights.extinction_km[0]);
  const std::array<std::shared_ptr<const Particles>, kRegions> kinds{
      particles_of(type, humidity_percent_), tabulated_particles("tropospheric", kTroposphereHumidity),
      tabulated_particles(state.optics, 0.0), tabulated_particles("meteoric_dust", 0.0)};
  for (std::size_t r = 0; r < kRegions; ++r)
    regions_.push_back({heights.altitude_km, heights.extinction_km[r], kinds[r]});
  constexpr double kThickest = 10.0;
  for (const std::shared_ptr<const ParticleLayer>& layer : description.own)
    add(*layer, kThickest, profile.ground_km());
}

std::shared_ptr<const LayerHeights> AerosolColumn::add(const ParticleLayer& layer, double thickest,
                                                       double ground_km) {
  if (!(layer.optical_depth >= 0.0 && layer.optical_depth <= thickest))
    throw InputError(format("optical depth {:g} of the {}: expected 0 to {:g}", layer.optical_depth,
                            layer.name, thickest));
  const auto heights = std::make_shared<const LayerHeights>(layer, ground_km);
  const double thickness_550 =
      layer.optical_depth / layer.particles->properties(layer.wavelength_um).extinction;
  regions_.push_back({{}, {}, layer.particles, heights, thickness_550});
  const std::vector<double> boundaries = heights->boundaries_km();
  boundaries_km_.insert(boundaries_km_.end(), boundaries.begin(), boundaries.end());
  return heights;
}

void AerosolColumn::add_cloud(const ParticleLayer& layer, double ground_km) {
  const auto heights = add(layer, kThickestCloud, ground_km);
  cloud_top_km_ = std::max(cloud_top_km_, heights->top_km());
  const double thickness_km = heights->top_km() - heights->base_km();
  constexpr double kFirstStep = 0.25;
  for (double step = kFirstStep, at = step; at < 0.5 * layer.optical_depth; step *= 2.0, at += step) {
    const double from_side_km = thickness_km * at / layer.optical_depth;
    boundaries_km_.insert(boundaries_km_.end(),
                          {heights->base_km() + from_side_km, heights->top_km() - from_side_km});
  }
}

double AerosolColumn::thickness_550(std::size_t region, double first_km, double last_km) const {
  if (empty()) return 0.0;
  const Region& here = regions_[region];
  if (here.heights) return here.thickness_550 * here.heights->share(first_km, last_km);
  return column_integral(here.altitude_km, here.extinction_km, first_km, last_km);
}

double AerosolColumn::thickness_550(double first_km, double last_km) const {
  double sum = 0.0;
  for (std::size_t r = 0; r < first_cloud_; ++r) sum += thickness_550(r, first_km, last_km);
  return sum;
}

double AerosolColumn::extinction_550_km(std::size_t region, double altitude) const {
  if (empty()) return 0.0;
  const Region& here = regions_[region];
  if (here.heights) return here.thickness_550 * here.heights->density(altitude);
  return density_at(here.altitude_km, here.extinction_km, altitude);
}

AerosolProperties AerosolColumn::properties(std::size_t region, double wavelength_um) const {
  return regions_[region].particles->properties(wavelength_um);
}

PhaseFunction AerosolColumn::phase_function(std::size_t region, double wavelength_um) const {
  return regions_[region].particles->phase_function(wavelength_um);
}

}  // namespace ifov::atmosphere
