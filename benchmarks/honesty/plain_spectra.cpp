#include "honesty/plain_spectra.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/bsdf/bsdf.h"

namespace ifov::benchmarks {

namespace {

constexpr double kWidestStep = 0.04;  // of the wavelength

/// Planck's law with the exact constants of CODATA 2018, W m-2 sr-1 um-1.
double planck_law(double um, double temperature_k) {
  if (!(temperature_k > 0.0)) return 0.0;
  const double exponent = 14387.768775039337 / (um * temperature_k);
  return exponent > 700.0 ? 0.0 : 1.191042972397188e8 / (std::pow(um, 5) * std::expm1(exponent));
}

/// Whether all these are one number between two wavelengths.
bool colourless(const std::vector<const radiometry::Spectrum*>& spectra, double first_um, double last_um) {
  for (const radiometry::Spectrum* spectrum : spectra) {
    const double value = spectrum->at(first_um);
    if (spectrum->at(last_um) != value) return false;
    for (std::size_t k = 0; k < spectrum->wavelength_um().size(); ++k)
      if (spectrum->wavelength_um()[k] > first_um && spectrum->wavelength_um()[k] < last_um &&
          spectrum->values()[k] != value)
        return false;
  }
  return true;
}

}  // namespace

PlainSpectra::PlainSpectra(const scene::Scene& scene, std::span<const radiometry::Channel> channels)
    : channel_count_(channels.size()) {
  std::vector<const radiometry::Spectrum*> factors, sources;
  for (const materials::Material& material : scene.materials) {
    factors.push_back(&material.reflectance);
    if (material.transmittance) factors.push_back(&*material.transmittance);
    if (material.bsdf->is_separable()) continue;
    for (const radiometry::Spectrum& spectrum : material.bsdf->spectra()) factors.push_back(&spectrum);
    if (material.bsdf->absorption() != nullptr) factors.push_back(material.bsdf->absorption());
  }
  if (scene.view_path.transmittance) factors.push_back(&*scene.view_path.transmittance);
  if (scene.sun) {
    sources.push_back(&scene.sun->irradiance);
    sources.push_back(&scene.sun->transmittance);
  }
  if (scene.sky.radiance) sources.push_back(&*scene.sky.radiance);
  if (scene.view_path.radiance) sources.push_back(&*scene.view_path.radiance);

  by_channel_ = true;
  for (const radiometry::Channel& channel : channels) {
    std::vector<Point>& points = points_.emplace_back();
    if (channel.is_monochromatic()) {
      points.push_back({channel.centre_um, 1.0});
      continue;
    }
    const double first = channel.response.first_um(), last = channel.response.last_um();
    by_channel_ = by_channel_ && colourless(factors, first, last);
    std::vector<const radiometry::Spectrum*> all{&channel.response};
    all.insert(all.end(), factors.begin(), factors.end());
    all.insert(all.end(), sources.begin(), sources.end());
    const std::vector<double> borders = radiometry::merged_wavelengths_um(all, first, last);
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
      const double ratio = borders[k + 1] / borders[k];
      const int steps = std::max(1, static_cast<int>(std::ceil(std::log(ratio) / kWidestStep)));
      for (int step = 0; step < steps; ++step) {
        const double from = borders[k] * std::pow(ratio, static_cast<double>(step) / steps);
        const double to = borders[k] * std::pow(ratio, static_cast<double>(step + 1) / steps);
        for (const double side : {-1.0, 1.0}) {
          const double um = 0.5 * (from + to) + side * 0.5 * (to - from) / std::numbers::sqrt3;
          points.push_back({um, 0.5 * (to - from) * channel.response.at(um)});
          sum += points.back().weight;
        }
      }
    }
    for (Point& point : points) point.weight /= sum;
  }
  for (const auto& points : points_) column_count_ += by_channel_ ? 1 : points.size();

  const auto of = [&](const radiometry::Spectrum& spectrum) { return columns_of(spectrum); };
  const std::vector<double> none(column_count_, 0.0), all(column_count_, 1.0);
  for (const materials::Material& material : scene.materials) {
    reflectance_.push_back(of(material.reflectance));
    transmittance_.push_back(material.transmittance ? of(*material.transmittance) : none);
  }
  sun_ = scene.sun ? column_values([&](double um) {
    return scene.sun->irradiance.at(um) * scene.sun->transmittance.at(um);
  })
                   : none;
  sky_ = scene.sky.radiance        ? of(*scene.sky.radiance)
         : scene.sky.temperature_k ? planck(*scene.sky.temperature_k)
                                   : none;
  view_transmittance_ = scene.view_path.transmittance ? of(*scene.view_path.transmittance) : all;
  view_radiance_ = scene.view_path.radiance ? of(*scene.view_path.radiance) : none;
  for (const scene::SurfaceState& state : scene.states)
    if (state.temperature_k > 0.0)
      kept_planck_.emplace_back(state.temperature_k, planck(state.temperature_k));

  // An open, level plain around the scene.
  surroundings_ = none;
  add_emission(scene.surroundings.material, scene.surroundings.temperature_k, 1.0, all, surroundings_);
  const double slope = scene.sun ? std::max(0.0, scene.sun->direction.z) / std::numbers::pi : 0.0;
  for (std::size_t c = 0; c < column_count_; ++c)
    surroundings_[c] += reflectance_[scene.surroundings.material][c] * (sun_[c] * slope + sky_[c]);
}

template <class Function>
std::vector<double> PlainSpectra::column_values(const Function& value) const {
  std::vector<double> columns;
  columns.reserve(column_count_);
  for (const std::vector<Point>& points : points_) {
    double mean = 0.0;
    for (const Point& point : points)
      if (by_channel_)
        mean += point.weight * value(point.um);
      else
        columns.push_back(value(point.um));
    if (by_channel_) columns.push_back(mean);
  }
  return columns;
}

std::vector<double> PlainSpectra::columns_of(const radiometry::Spectrum& spectrum) const {
  return column_values([&](double um) { return spectrum.at(um); });
}

std::vector<double> PlainSpectra::planck(double temperature_k) const {
  return column_values([&](double um) { return planck_law(um, temperature_k); });
}

void PlainSpectra::add_emission(std::uint32_t material, double temperature_k, double weight,
                                std::span<const double> throughput, std::span<double> sum) const {
  if (!(temperature_k > 0.0)) return;
  const auto kept = std::find_if(kept_planck_.begin(), kept_planck_.end(),
                                 [&](const auto& entry) { return entry.first == temperature_k; });
  const std::vector<double> own = kept == kept_planck_.end() ? planck(temperature_k) : std::vector<double>();
  const std::vector<double>& radiance = kept == kept_planck_.end() ? own : kept->second;
  for (std::size_t c = 0; c < column_count_; ++c)
    sum[c] += weight * throughput[c] * (1.0 - reflectance_[material][c] - transmittance_[material][c]) *
              radiance[c];
}

std::vector<double> PlainSpectra::at_sensor(std::span<const double> columns, bool path) const {
  std::vector<double> channels(channel_count_, 0.0);
  std::size_t column = 0;
  for (std::size_t c = 0; c < channel_count_; ++c)
    for (std::size_t k = 0; k < (by_channel_ ? 1 : points_[c].size()); ++k, ++column)
      channels[c] += (by_channel_ ? 1.0 : points_[c][k].weight) *
                     (view_transmittance_[column] * columns[column] + (path ? view_radiance_[column] : 0.0));
  return channels;
}

}  // namespace ifov::benchmarks
