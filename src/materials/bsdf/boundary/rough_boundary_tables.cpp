#include "materials/bsdf/boundary/rough_boundary_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "materials/bsdf/boundary/smooth.h"
#include "materials/bsdf/microfacet/crowded_square.h"
#include "materials/bsdf/microfacet/facet_refraction.h"

namespace ifov::materials {
namespace {

using math::Vec3;
using radiometry::Spectrum;

constexpr std::size_t kRows = FresnelRows::kCount;
constexpr int kFacetsAcross = 80;

/// Weights of Fresnel's rows in what leaves at once: reflected, and let through.
struct AtOnce {
  std::array<double, kRows> reflected{}, through{};
};

void add(const RowWeights& rows, double weight, std::array<double, kRows>& to) {
  for (std::size_t i = 0; i < 4; ++i) to[rows.first + i] += weight * rows.weight[i];
}

/// Over facets by their visible area. `ratio`: the index beyond over that of the side of `out`.
AtOnce at_once(const FacetDistribution& facets, Vec3 out, double ratio, bool from_within) {
  static const std::vector<SquarePoint> points = crowded_square(kFacetsAcross);
  AtOnce sums;
  const double area = facets.projected_area(out);
  for (std::size_t first = 0; first < points.size(); first += kFacetsAcross) {
    const FacetDistribution::VisibleRow row(facets, out, points[first].u1);
    for (std::size_t k = first; k < first + kFacetsAcross; ++k) {
      const Vec3 facet = row.facet(points[k].u2);
      const double cosine = math::dot(out, facet);
      if (!(cosine > 0.0)) continue;
      const Vec3 bent = refracted_by(facet, out, ratio);
      const bool total = !(math::dot(bent, bent) > 0.0);
      const double outside = !from_within ? cosine : total ? 0.0 : -math::dot(bent, facet);
      const RowWeights rows = FresnelRows::at(outside);
      const Vec3 back = 2.0 * cosine * facet - out;
      if (back.z > 0.0) {
        const double lit = area * back.z;
        add(rows, points[k].weight * lit / (lit + facets.projected_area(back) * out.z - out.z * back.z),
            sums.reflected);
      }
      if (!total && bent.z < 0.0)
        add(rows, points[k].weight * seen_from_both_sides(facets, out, bent) * area / out.z, sums.through);
    }
  }
  return sums;
}

double angle_cosine(std::size_t k) {
  const double t = static_cast<double>(k) / static_cast<double>(RoughBoundaryTables::kAngles - 1);
  return std::max(1e-4, t * t);
}

/// Weights of the angles in 2 integral of L cos d cos.
std::array<double, RoughBoundaryTables::kAngles> mean_of_angles() {
  constexpr int kSteps = 2000;
  std::array<double, RoughBoundaryTables::kAngles> mean{};
  for (int k = 0; k < kSteps; ++k) {
    const double cosine = (k + 0.5) / kSteps;
    const RowWeights rows = RoughBoundaryTables::angle_at(cosine);
    for (std::size_t i = 0; i < 4; ++i) mean[rows.first + i] += 2.0 * cosine * rows.weight[i] / kSteps;
  }
  return mean;
}

}  // namespace

RowWeights RoughBoundaryTables::angle_at(double cosine) {
  return cubic_weights(std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (kAngles - 1), kAngles);
}

double RoughBoundaryTables::share_at(const std::vector<double>& shares, double cosine) {
  const double at = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (kAngles - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kAngles - 2);
  return shares[below] + (at - static_cast<double>(below)) * (shares[below + 1] - shares[below]);
}

RoughBoundaryTables::RoughBoundaryTables(const Spectrum& n, const Spectrum& k, const Spectrum& factor,
                                         const RoughBoundary::Surface& surface)
    : facets(surface.shape, surface.width, surface.width) {
  constexpr double kLeastIndex = 1.01;
  smooth::Medium medium = smooth::medium_of(n, k);
  index = medium.index;
  if (index < kLeastIndex)
    throw InputError(format(
        "a medium of index {:g} behind a rough boundary: it has to be {:g} or more, or its facets would bend nothing",
        index, kLeastIndex));
  if (medium.absorption.maximum() > 0.0) absorption = std::move(medium.absorption);
  const std::vector<Spectrum> fresnel = FresnelRows::of_index(n, k);
  for (const Spectrum& row : fresnel) {
    const Spectrum both[] = {row, factor};
    spectra.push_back(combined(both, [](std::span<const double> v) { return v[0] * v[1]; }));
  }
  for (const Spectrum& row : fresnel) spectra.push_back(row.complement());
  add_polarization(n, k, factor, fresnel);
  add_lost(factor);
  for (const Spectrum& spectrum : spectra)
    grey.push_back(std::accumulate(spectrum.values().begin(), spectrum.values().end(), 0.0) /
                   static_cast<double>(spectrum.values().size()));
  for (const std::size_t within : {0u, 1u})
    diffuse[within] = CosineLobe([&](double cosine) {
      const RowWeights rows = angle_at(cosine);
      double level = 0.0;
      for (std::size_t i = 0; i < 4; ++i)
        level += rows.weight[i] * grey[kLost + within * kAngles + rows.first + i];
      return level;
    });
  // The diffuse lobe as often as it brings light, of what either lobe brings, and never not at all.
  for (const std::size_t within : {0u, 1u}) {
    std::array<std::vector<double>, 2> goes_on;
    for (const std::size_t through : {0u, 1u}) {
      std::vector<double>& share = broad[within][through];
      const double again =
          through ? grey[kAgainThrough] / (within ? index * index : 1.0) : grey[kAgainReflected + within];
      const std::size_t beyond = through ? 1 - within : within;
      const std::array<double, kAngles> weights = mean_of_angles();
      double mean = 0.0;
      for (std::size_t a = 0; a < kAngles; ++a) mean += weights[a] * grey[kLost + beyond * kAngles + a];
      for (std::size_t a = 0; a < kAngles; ++a) {
        const double again_light = std::numbers::pi * again * mean * grey[kLost + within * kAngles + a];
        goes_on[through].push_back(std::max(1e-9, share_at_once_[within][through][a] + again_light));
        share.push_back(std::clamp(again_light / goes_on[through].back(), 1e-5, 0.98));
      }
    }
    for (std::size_t a = 0; a < kAngles; ++a)
      passed[within].push_back(goes_on[1][a] / (goes_on[0][a] + goes_on[1][a]));
  }
}

void RoughBoundaryTables::add_lost(const Spectrum& factor) {
  std::array<std::vector<AtOnce>, 2> sums;
  for (const std::size_t within : {0u, 1u}) {
    sums[within].resize(kAngles);
    parallel_for(static_cast<std::int64_t>(kAngles), 0, [&](std::int64_t number) {
      const auto a = static_cast<std::size_t>(number);
      const double cosine = angle_cosine(a);
      const Vec3 out{std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
      sums[within][a] = at_once(facets, out, within ? 1.0 / index : index, within != 0);
    });
  }
  std::vector<Spectrum> reflectance;  // without the factor
  for (std::size_t row = 0; row < kRows; ++row) reflectance.push_back(spectra[kThrough + row].complement());
  for (const std::size_t within : {0u, 1u})
    for (std::size_t a = 0; a < kAngles; ++a) {
      const AtOnce& sum = sums[within][a];
      spectra.push_back(combined(reflectance, [&](std::span<const double> v) {
        double leaves = 0.0;
        for (std::size_t row = 0; row < kRows; ++row)
          leaves += sum.reflected[row] * v[row] + sum.through[row] * (1.0 - v[row]);
        return std::clamp(1.0 - leaves, 0.0, 1.0);
      }));
      double back = 0.0, through = 0.0;
      for (std::size_t row = 0; row < kRows; ++row) {
        const auto values = reflectance[row].values();
        const double mean =
            std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
        back += sum.reflected[row] * mean;
        through += sum.through[row] * (1.0 - mean);
      }
      share_at_once_[within][0].push_back(back);
      share_at_once_[within][1].push_back(through);
    }
  // Of both sides: L by angle, then Fresnel's rows and the factor.
  std::vector<Spectrum> all(spectra.begin() + kLost, spectra.end());
  all.insert(all.end(), reflectance.begin(), reflectance.end());
  all.push_back(factor);
  const std::array<double, kAngles> weights = mean_of_angles();
  struct Means {
    double outside, within, through;
  };
  const auto means = [&](std::span<const double> v) {
    constexpr double kNone = 1e-12;
    Means m{0.0, 0.0, 0.0};
    for (std::size_t a = 0; a < kAngles; ++a)
      m.outside += weights[a] * v[a], m.within += weights[a] * v[kAngles + a];
    m.outside = std::max(kNone, m.outside);
    m.within = std::max(kNone, m.within);
    for (std::size_t row = 0; row < kRows; ++row)
      m.through += FresnelRows::mean_weights()[row] * (1.0 - v[2 * kAngles + row]);
    // No more goes out than there is.
    m.through = std::clamp(m.through, 0.0, std::min(1.0, index * index * m.within / m.outside));
    return m;
  };
  constexpr double kPi = std::numbers::pi;
  const std::vector<Spectrum> again{
      combined(all,
               [&](std::span<const double> v) {
                 const Means m = means(v);
                 return v.back() * (1.0 - m.through) / (kPi * m.outside);
               }),
      combined(all,
               [&](std::span<const double> v) {
                 const Means m = means(v);
                 return v.back() * (1.0 - m.through * m.outside / (index * index * m.within)) /
                        (kPi * m.within);
               }),
      combined(all, [&](std::span<const double> v) {
        const Means m = means(v);
        return m.through / (kPi * m.within);
      })};
  spectra.insert(spectra.end(), again.begin(), again.end());
}

}  // namespace ifov::materials
