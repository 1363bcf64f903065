#include "materials/bsdf/microfacet/coat_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "materials/bsdf/microfacet/facet_albedo.h"
#include "materials/bsdf/microfacet/fresnel_rows.h"
#include "materials/bsdf/microfacet/visible_facets.h"

namespace ifov::materials {

using radiometry::Spectrum;

std::vector<Spectrum> CoatRows::of_fresnel(FacetShape shape, double width,
                                           std::span<const Spectrum> fresnel) {
  const FacetDistribution facets(shape, width, width);
  const std::shared_ptr<const FacetAlbedo> albedo = FacetAlbedo::shared(shape, width, width);
  std::vector<std::array<double, FresnelRows::kCount>> once(kCount);
  std::vector<double> lost(kCount);
  const VisibleFacets grid;
  parallel_for(static_cast<std::int64_t>(kCount), 0, [&](std::int64_t index) {
    const auto k = static_cast<std::size_t>(index);
    const double root = static_cast<double>(k) / static_cast<double>(kCount - 1);
    const double cosine = std::max(1e-6, root * root);
    const math::Vec3 out{std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
    once[k].fill(0.0);
    grid.for_each_reflection(facets, out, [&](double weight, double at) {
      const RowWeights rows = FresnelRows::at(at);
      for (std::size_t i = 0; i < 4; ++i) once[k][rows.first + i] += weight * rows.weight[i];
    });
    lost[k] = albedo->lost(out);
  });
  std::vector<Spectrum> rows;
  for (std::size_t k = 0; k < kCount; ++k)
    rows.push_back(combined(fresnel, [&](std::span<const double> v) {
      return std::max(0.0, 1.0 - std::inner_product(v.begin(), v.end(), once[k].begin(), 0.0) -
                               lost[k] * albedo->again_factor(mean_reflectance(v)));
    }));
  // Weights of the angles in the mean, of the cubic between them.
  std::array<double, kCount> mean{};
  constexpr int kSteps = 2000;
  for (int k = 0; k < kSteps; ++k) {
    const double cosine = (k + 0.5) / kSteps;
    const RowWeights weights = at(cosine);
    for (std::size_t i = 0; i < 4; ++i) mean[weights.first + i] += 2.0 * cosine * weights.weight[i] / kSteps;
  }
  const std::vector<Spectrum> passed = rows;
  rows.push_back(combined(passed, [&](std::span<const double> v) {
    return std::inner_product(v.begin(), v.end(), mean.begin(), 0.0);
  }));
  return rows;
}

RowWeights CoatRows::at(double cosine) {
  return cubic_weights(std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (kCount - 1), kCount);
}

double CoatRows::mixed(RowWeights weights, std::span<const double> rows) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += weights.weight[i] * rows[weights.first + i];
  return sum;
}

double mean_reflectance(std::span<const double> fresnel) {
  return std::inner_product(fresnel.begin(), fresnel.begin() + FresnelRows::kCount,
                            FresnelRows::mean_weights().begin(), 0.0);
}

std::vector<double> grey_levels(std::span<const Spectrum> spectra) {
  std::vector<double> levels;
  for (const Spectrum& spectrum : spectra)
    levels.push_back(std::accumulate(spectrum.values().begin(), spectrum.values().end(), 0.0) /
                     static_cast<double>(spectrum.values().size()));
  return levels;
}

}  // namespace ifov::materials
