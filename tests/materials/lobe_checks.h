#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "materials/bsdf/bsdf.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/microfacet/crowded_square.h"
#include "materials/bsdf_checks.h"
#include "materials/reflectance_events.h"
#include "sampling/random.h"
#include "support/statistics.h"

namespace ifov::materials::test {

using materials::brdf_at;
using materials::view_of;

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

using materials::samples_against_density;

}  // namespace ifov::materials::test
