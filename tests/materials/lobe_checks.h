#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "materials/bsdf/bsdf.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/microfacet/crowded_square.h"
#include "materials/reflectance_events.h"
#include "sampling/random.h"
#include "support/statistics.h"

namespace ifov::materials::test {

/// BRDF of a model at one of its wavelengths, 1/sr.
inline double brdf_at(const Bsdf& bsdf, const BsdfEvent& event, double um = 1.0) {
  std::vector<float> values;
  std::vector<const float*> rows;
  for (const radiometry::Spectrum& spectrum : bsdf.spectra())
    values.push_back(static_cast<float>(spectrum.at(um)));
  for (const float& value : values) rows.push_back(&value);
  float found = 0.0f;
  bsdf.evaluate(event, rows, 1, &found);
  return static_cast<double>(found);
}

/// As emissivity has it, averaged over azimuth.
inline double hemispherical_at(const Bsdf& bsdf, double cosine, double um = 1.0) {
  std::vector<float> values;
  std::vector<const float*> rows;
  for (const radiometry::Spectrum& spectrum : bsdf.spectra())
    values.push_back(static_cast<float>(spectrum.at(um)));
  for (const float& value : values) rows.push_back(&value);
  float found = 0.0f;
  directional_hemispherical(bsdf, Side::reflected, rows, 1, cosine, &found);
  return static_cast<double>(found);
}

inline BsdfEvent view_of(math::Vec3 out) { return {out, {}, {0, 0, 1}, {1, 0, 0}, Side::reflected}; }

/// Directional-hemispherical reflectance towards one direction over `across`^2 directions of each lobe.
inline double reflectance_towards(const Bsdf& bsdf, math::Vec3 out, int across, double um = 1.0) {
  BsdfEvent event = view_of(out);
  const double seam = bsdf.seam(event);
  std::vector<float> values;
  std::vector<const float*> rows;
  for (const radiometry::Spectrum& spectrum : bsdf.spectra())
    values.push_back(static_cast<float>(spectrum.at(um)));
  for (const float& value : values) rows.push_back(&value);
  const std::vector<SquarePoint> points = crowded_square(across);
  double sum = 0.0;
  const auto add = [&](double first, double last) {
    for (const SquarePoint& point : points) {
      const BsdfSample sample = bsdf.sample(event, first + (last - first) * point.u1, point.u2);
      if (!(sample.weight > 0.0)) continue;
      event.incoming = sample.incoming;
      float found = 0.0f;
      bsdf.evaluate(event, rows, 1, &found);
      sum += point.weight * (last - first) * sample.weight * static_cast<double>(found);
    }
  };
  if (seam > 0.0) add(0.0, seam);
  add(seam, 1.0);
  return sum;
}

/// Chi-square of a model's samples against its density, as a probability. Directions are counted by the slopes of the facets that
/// would mirror them, in units of the widths: rings in arsinh of the slope and sectors, and those below the horizon.
inline double samples_against_density(const Bsdf& bsdf, math::Vec3 out, double width_x, double width_y,
                                      int draws) {
  constexpr int kRings = 16, kSectors = 8, kFine = 32;
  const double highest = std::asinh(100.0 / std::min(width_x, width_y));
  const BsdfEvent view = view_of(out);
  std::vector<double> counted(kRings * kSectors + 1, 0.0), expected(kRings * kSectors + 1, 0.0);
  for (int k = 0; k < draws; ++k) {
    const auto key = static_cast<std::uint64_t>(k);
    const BsdfSample sample =
        bsdf.sample(view, sampling::unit_double(2 * key), sampling::unit_double(2 * key + 1));
    std::size_t cell = kRings * kSectors;
    if (sample.weight > 0.0) {
      const math::Vec3 h = math::normalized(out + sample.incoming);
      const double x = h.x / (h.z * width_x), y = h.y / (h.z * width_y), r = std::hypot(x, y);
      const int ring = std::min(kRings - 1, static_cast<int>(kRings * std::asinh(r) / highest));
      const int sector = std::min(
          kSectors - 1, static_cast<int>(kSectors * (std::atan2(y, x) / (2.0 * std::numbers::pi) + 0.5)));
      cell = static_cast<std::size_t>(ring * kSectors + sector);
    }
    counted[cell] += 1.0;
  }
  double whole = 0.0;
  for (int ring = 0; ring < kRings * kFine; ++ring)
    for (int sector = 0; sector < kSectors * kFine; ++sector) {
      const double t = highest * (ring + 0.5) / (kRings * kFine), r = std::sinh(t);
      const double azimuth = 2.0 * std::numbers::pi * ((sector + 0.5) / (kSectors * kFine) - 0.5);
      const math::Vec3 h =
          math::normalized({r * std::cos(azimuth) * width_x, r * std::sin(azimuth) * width_y, 1.0});
      BsdfEvent event = view;
      event.incoming = math::normalized(2.0 * math::dot(out, h) * h - out);
      if (!(math::dot(out, h) > 0.0) || !(event.incoming.z > 0.0)) continue;
      const double area = width_x * width_y * r * std::cosh(t) * highest * 2.0 * std::numbers::pi /
                          (kRings * kSectors * kFine * kFine);  // of slopes
      const double share = bsdf.pdf(event) * 4.0 * math::dot(out, h) * h.z * h.z * h.z * area;
      expected[static_cast<std::size_t>(ring / kFine * kSectors + sector / kFine)] += share * draws;
      whole += share;
    }
  expected.back() = std::max(0.0, 1.0 - whole) * draws;
  // Slivers of cells above the horizon may lie between the points of the sum: pooled with others, they may be hit.
  for (double& count : expected) count = std::max(count, 1e-9);
  return ifov::test::chi_square_test(counted, expected);
}

}  // namespace ifov::materials::test
