#include "session/surface_spectra.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/bsdf/hemisphere.h"
#include "materials/material.h"
#include "radiometry/channel.h"
#include "scene/lamp.h"
#include "scene/scene.h"
#include "session/assembly/shared/colour_guess.h"

namespace ifov::session {
namespace {

/// What a model makes of light at some angles, and of what: nodes have to hold all of it.
void add_directional(const materials::Bsdf& bsdf, bool polarized,
                     std::vector<radiometry::Spectrum>& surfaces) {
  constexpr double kCosines[] = {1.0, 0.5, 0.1};
  surfaces.insert(surfaces.end(), bsdf.spectra().begin(), bsdf.spectra().end());
  for (const double cosine : kCosines)
    for (const materials::Side side : {materials::Side::reflected, materials::Side::transmitted})
      if (side == materials::Side::reflected || bsdf.may_transmit())
        surfaces.push_back(materials::directional_hemispherical(bsdf, side, cosine));
  // Elements of its matrix change their signs; light behind polarizers does not.
  if (!polarized || !bsdf.polarizes()) return;
  const auto elements = bsdf.polarization_spectra();
  double most = 0.0;
  for (const radiometry::Spectrum& element : elements)
    most = std::max({most, std::abs(element.minimum()), std::abs(element.maximum())});
  constexpr std::size_t kEvery = 8;
  for (std::size_t k = 0; k < elements.size() && most > 0.0; k += kEvery) {
    std::vector<double> passed;
    for (const double value : elements[k].values()) passed.push_back(0.5 + 0.5 * value / most);
    surfaces.push_back(
        elements[k].is_constant()
            ? radiometry::Spectrum::constant(passed[0])
            : radiometry::Spectrum({elements[k].wavelength_um().begin(), elements[k].wavelength_um().end()},
                                   std::move(passed), elements[k].outside(), elements[k].name()));
  }
}

/// By material: whether nodes need not be judged by it. Spectra that pictures are mixed of are many and of one form, a sigmoid of a
/// parabola: in each channel those stand for the others that vary most there, by themselves and for their brightness.
std::vector<bool> corners_left_out(const SurfacesOfNodes& of) {
  constexpr std::size_t kOfChannel = 12;
  constexpr int kLooks = 9;
  std::vector<bool> left_out(of.scene.materials.size(), false);
  std::vector<std::uint32_t> corners;
  for (const ColourGuess& guess : of.colour_guesses)
    corners.insert(corners.end(), guess.corners.begin(), guess.corners.end());
  for (const std::uint32_t corner : corners) left_out[corner] = true;
  for (const radiometry::Channel& channel : of.channels) {
    std::vector<std::pair<double, std::uint32_t>> by_variance, by_share;
    for (const std::uint32_t corner : corners) {
      const radiometry::Spectrum& reflectance = of.scene.materials[corner].reflectance;
      double sum = 0.0, squares = 0.0;
      for (int k = 0; k < kLooks; ++k) {
        const double value = reflectance.at(channel.centre_um +
                                            channel.fwhm_um * (static_cast<double>(k) / (kLooks - 1) - 0.5));
        sum += value / kLooks, squares += value * value / kLooks;
      }
      const double variance = squares - sum * sum;
      by_variance.emplace_back(-variance, corner);
      by_share.emplace_back(sum > 0.0 ? -variance / (sum * sum) : 0.0, corner);
    }
    for (auto* ranked : {&by_variance, &by_share}) {
      const std::size_t count = std::min(kOfChannel, ranked->size());
      std::partial_sort(ranked->begin(), ranked->begin() + static_cast<std::ptrdiff_t>(count), ranked->end());
      for (std::size_t k = 0; k < count; ++k) left_out[(*ranked)[k].second] = false;
    }
  }
  return left_out;
}

/// Whether two spectra are the same but for a factor.
bool same_shape(const radiometry::Spectrum& a, const radiometry::Spectrum& b) {
  const auto equal = [](double x, double y) { return std::abs(x - y) <= 1e-12 * std::abs(y); };
  if (!std::ranges::equal(a.wavelength_um(), b.wavelength_um(), equal)) return false;
  const double of_a = b.maximum(), of_b = a.maximum();
  return std::ranges::equal(a.values(), b.values(),
                            [&](double x, double y) { return equal(x * of_a, y * of_b); });
}

}  // namespace

std::vector<radiometry::Spectrum> spectra_of_surfaces(const SurfacesOfNodes& of) {
  std::vector<radiometry::Spectrum> surfaces;
  const std::vector<bool> left_out = corners_left_out(of);
  for (std::size_t m = 0; m < of.scene.materials.size(); ++m) {
    if (left_out[m]) continue;
    const materials::Material& material = of.scene.materials[m];
    surfaces.push_back(material.reflectance);
    if (!material.bsdf->is_separable()) add_directional(*material.bsdf, of.polarized, surfaces);
    if (!material.transmittance) continue;
    surfaces.push_back(*material.transmittance);
    // What a leaf emits is what it neither reflects nor transmits.
    if (of.modelled_air) surfaces.push_back(radiometry::sum(material.reflectance, *material.transmittance));
  }
  if (of.scene.sun) surfaces.push_back(of.scene.sun->transmittance);
  if (of.scene.view_path.transmittance) surfaces.push_back(*of.scene.view_path.transmittance);
  return surfaces;
}

std::vector<radiometry::Spectrum> spectra_of_lamps(const scene::Scene& scene) {
  std::vector<radiometry::Spectrum> lamps;
  for (const scene::Lamp& lamp : scene.lamps)
    if (std::ranges::none_of(lamps, [&](const auto& known) { return same_shape(known, lamp.radiance); }))
      lamps.push_back(lamp.radiance);
  return lamps;
}

bool polarizes(const scene::Scene& scene) {
  return std::ranges::any_of(scene.materials,
                             [](const materials::Material& material) { return material.bsdf->polarizes(); });
}

}  // namespace ifov::session
