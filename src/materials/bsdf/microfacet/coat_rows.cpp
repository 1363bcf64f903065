#include "materials/bsdf/microfacet/coat_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/parallel.h"
#include "materials/bsdf/microfacet/facet_albedo.h"
#include "materials/bsdf/microfacet/fresnel_rows.h"
#include "materials/bsdf/microfacet/visible_facets.h"

namespace ifov::materials {

using radiometry::Spectrum;

namespace {

using Weights = std::array<double, FresnelRows::kCount>;

math::Vec3 row_direction(std::size_t k) {
  const double root = static_cast<double>(k) / static_cast<double>(CoatRows::kCount - 1);
  const double cosine = std::max(1e-6, root * root);
  return {std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
}

/// By angle the weights of FresnelRows in what facets reflect once, each reflection times use(out, in).
template <class Use>
std::vector<Weights> reflected_once(const FacetDistribution& facets, const Use& use) {
  std::vector<Weights> once(CoatRows::kCount);
  const VisibleFacets grid;
  parallel_for(static_cast<std::int64_t>(CoatRows::kCount), 0, [&](std::int64_t index) {
    const auto k = static_cast<std::size_t>(index);
    const math::Vec3 out = row_direction(k);
    once[k].fill(0.0);
    grid.for_each_reflection(facets, out, [&](double weight, double at, math::Vec3 in) {
      const RowWeights rows = FresnelRows::at(at);
      const double used = weight * use(out, in);
      for (std::size_t i = 0; i < 4; ++i) once[k][rows.first + i] += used * rows.weight[i];
    });
  });
  return once;
}

/// cos of twice the angle from the plane of both directions to that of `out` and the normal.
double turn_of_plane(math::Vec3 out, math::Vec3 in) {
  const math::Vec3 own{0.0, -out.x, 0.0}, facet = math::cross(out, in);
  const double along = math::dot(own, facet), squares = math::dot(own, own) * math::dot(facet, facet);
  return squares > 0.0 ? 2.0 * along * along / squares - 1.0 : 1.0;
}

}  // namespace

std::vector<Spectrum> CoatRows::of_fresnel(FacetShape shape, double width,
                                           std::span<const Spectrum> fresnel) {
  const std::shared_ptr<const FacetAlbedo> albedo = FacetAlbedo::shared(shape, width, width);
  const std::vector<Weights> once =
      reflected_once(FacetDistribution(shape, width, width), [](math::Vec3, math::Vec3) { return 1.0; });
  std::vector<Spectrum> rows;
  for (std::size_t k = 0; k < kCount; ++k) {
    const double lost = albedo->lost(row_direction(k));
    rows.push_back(combined(fresnel, [&](std::span<const double> v) {
      return std::max(0.0, 1.0 - std::inner_product(v.begin(), v.end(), once[k].begin(), 0.0) -
                               lost * albedo->again_factor(mean_reflectance(v)));
    }));
  }
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

std::vector<Spectrum> CoatRows::polarization_of_fresnel(FacetShape shape, double width,
                                                        std::span<const Spectrum> along) {
  const std::vector<Weights> once = reflected_once(FacetDistribution(shape, width, width), turn_of_plane);
  std::vector<Spectrum> rows;
  for (std::size_t k = 0; k < kCount; ++k)
    rows.push_back(combined(along, [&](std::span<const double> v) {
      return -std::inner_product(v.begin(), v.end(), once[k].begin(), 0.0);
    }));
  return rows;
}

void CoatRows::add_under(double cosine_out, double cosine_in, ParameterSpectra passed, ParameterSpectra along,
                         const float* under, std::size_t count, const MuellerRows& rows) {
  const RowWeights there = at(cosine_out), back = at(cosine_in);
  const auto between = [](ParameterSpectra table, const RowWeights& weights, std::size_t n) {
    float sum = 0.0f;
    for (std::size_t i = 0; i < 4; ++i)
      sum += static_cast<float>(weights.weight[i]) * table[weights.first + i][n];
    return sum;
  };
  for (std::size_t n = 0; n < count; ++n) {
    const float spread = under[n] * static_cast<float>(std::numbers::inv_pi);
    const float leaves[] = {between(passed, there, n), between(along, there, n)};
    const float enters = spread * between(passed, back, n);
    rows.at(0, 0)[n] += leaves[0] * enters;
    rows.at(1, 0)[n] += leaves[1] * enters;
    if (!rows.all) continue;
    const float enters_q = spread * between(along, back, n);
    rows.at(0, 1)[n] += leaves[0] * enters_q;
    rows.at(1, 1)[n] += leaves[1] * enters_q;
  }
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
