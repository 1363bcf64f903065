#include <cmath>
#include <numbers>
#include <vector>

#include "materials/bsdf/rough_conductor.h"
#include "math/angle.h"
#include "studies/surfaces/dome_scene.h"

namespace ifov::studies {

double metal_dome_radiance(double roughness) {
  const materials::RoughConductor metal(
      radiometry::Spectrum::constant(domes::kMetalN), radiometry::Spectrum::constant(domes::kMetalK),
      radiometry::Spectrum::constant(1.0), {materials::FacetShape::ggx, roughness, roughness, 0.0});
  std::vector<float> values;
  std::vector<const float*> rows;
  for (const radiometry::Spectrum& spectrum : metal.spectra())
    values.push_back(static_cast<float>(spectrum.at(domes::kDome_um)));
  for (const float& value : values) rows.push_back(&value);
  // Polar coordinates about the highlight's middle, the radius by steps that grow with it.
  const double zenith = domes::kSunZenith_deg * math::kDegree;
  const math::Vec3 sun{std::sin(zenith), 0.0, std::cos(zenith)};
  const math::Vec3 half = math::normalized(sun + math::Vec3{0.0, 0.0, 1.0});
  constexpr int kRings = 1500, kTurns = 400;
  double sum = 0.0;
  const double least = 1e-3 * roughness, most = 2.0;
  const double ratio = std::log(most / least + 1.0) / kRings;
  for (int i = 0; i < kRings; ++i) {
    const double r = least * (std::exp((i + 0.5) * ratio) - 1.0), dr = (r + least) * ratio;
    for (int j = 0; j < kTurns; ++j) {
      const double turn = 2.0 * std::numbers::pi * (j + 0.5) / kTurns, x = half.x + r * std::cos(turn),
                   y = half.y + r * std::sin(turn);
      if (x * x + y * y >= 1.0) continue;
      materials::BsdfEvent event;
      event.outgoing = {0.0, 0.0, 1.0};
      event.incoming = sun;
      event.normal = math::as_normal({x, y, std::sqrt(1.0 - x * x - y * y)});
      if (!(event.incoming_cosine() > 0.0)) continue;
      float bsdf = 0.0f;
      metal.evaluate(event, rows, 1, &bsdf);
      sum += static_cast<double>(bsdf) * event.incoming_cosine() * r * dr * 2.0 * std::numbers::pi / kTurns;
    }
  }
  return sum * domes::kIrradiance_w_m2_um * domes::kRadius_m * domes::kRadius_m;
}

}  // namespace ifov::studies
