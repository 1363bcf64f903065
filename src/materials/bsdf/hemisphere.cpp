#include "materials/bsdf/hemisphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "materials/bsdf/microfacet/crowded_square.h"

namespace ifov::materials {
namespace {

constexpr int kAcross = 64;           // directions along each side of the unit square
constexpr int kAcrossLobe = 128;      // of models with a lobe besides
constexpr double kNegligible = 2e-6;  // of all light
constexpr int kAzimuths = 8;          // of models with a direction
constexpr int kViewAngles = 12;       // of bihemispherical values

/// Numbers of the unit interval that crowd at its ends, where directions graze and integrands are least smooth, and what
/// each counts (the polynomial transformation of Korobov, for the midpoint rule).
struct Crowded {
  double u, weight;
};
Crowded crowded(int k) {
  const double t = (k + 0.5) / kAcross;
  return {t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) / kAcross};
}

/// Points of the square, all and in four parts: every second along either side. Azimuths take the parts in turn.
struct Points {
  static constexpr int kParts = 4;
  std::vector<SquarePoint> all;
  std::array<std::vector<SquarePoint>, kParts> parts;

  Points(std::vector<SquarePoint> points, int across) : all(std::move(points)) {
    std::array<double, kParts> whole{};
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto row = static_cast<int>(k) / across, column = static_cast<int>(k) % across;
      const auto part = static_cast<std::size_t>(2 * (row % 2) + column % 2);
      parts[part].push_back(all[k]);
      whole[part] += all[k].weight;
    }
    for (std::size_t part = 0; part < kParts; ++part)
      for (SquarePoint& point : parts[part]) point.weight /= whole[part];
  }
};

Points plain_points() {
  std::vector<SquarePoint> points;
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kAcross; ++j) {
      const Crowded x = crowded(i), y = crowded(j);
      points.push_back({x.u, y.u, x.weight * y.weight});
    }
  return {std::move(points), kAcross};
}

const Points& lobe_points(int across) {
  static const Points coarse(crowded_square(kAcross), kAcross),
      fine(crowded_square(kAcrossLobe), kAcrossLobe);
  return across == kAcross ? coarse : fine;
}

}  // namespace

namespace {

/// What is added up: evaluate() of an event, into `count` floats.
using Evaluate = std::function<void(const BsdfEvent& event, float* values)>;

void add_up(const Bsdf& bsdf, const Evaluate& evaluate, Side side, std::size_t count, double cosine,
            const Points& lobe, float* spectrum) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const int azimuths = bsdf.is_isotropic() ? 1 : kAzimuths;
  std::vector<double> sum(count, 0.0);
  std::vector<float> values(count);
  static const Points plain = plain_points();
  const auto add_part = [&](BsdfEvent event, double first, double last, const Points& points, int azimuth) {
    const auto part = static_cast<std::size_t>(azimuth % Points::kParts);
    for (const SquarePoint& point : azimuths > 1 ? points.parts[part] : points.all) {
      const BsdfSample sample = bsdf.sample(event, first + (last - first) * point.u1, point.u2);
      if (!(sample.weight > 0.0)) continue;
      event.incoming = sample.incoming;
      evaluate(event, values.data());
      const double weight = (last - first) * point.weight * sample.weight;
      for (std::size_t n = 0; n < count; ++n) sum[n] += weight * static_cast<double>(values[n]);
    }
  };
  for (int a = 0; a < azimuths; ++a) {
    const double azimuth = 2.0 * std::numbers::pi * a / azimuths;
    BsdfEvent event;
    event.outgoing = {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
    event.normal = {0.0, 0.0, 1.0};
    event.tangent = {1.0, 0.0, 0.0};
    event.side = side;
    if (bsdf.is_delta()) {
      const BsdfSample only = bsdf.sample(event, 0.5, 0.5);
      event.incoming = only.incoming;
      evaluate(event, values.data());
      for (std::size_t n = 0; n < count; ++n) sum[n] += only.weight * static_cast<double>(values[n]);
      continue;
    }
    // Of two lobes each by itself.
    const double seam = bsdf.seam(event);
    if (seam > kNegligible) add_part(event, 0.0, seam, plain, a);
    add_part(event, seam, 1.0, seam > 0.0 ? lobe : plain, a);
  }
  for (std::size_t n = 0; n < count; ++n) spectrum[n] = static_cast<float>(sum[n] / azimuths);
}

void add_up(const Bsdf& bsdf, Side side, ParameterSpectra parameters, std::size_t count, double cosine,
            const Points& lobe, float* spectrum) {
  add_up(
      bsdf, [&](const BsdfEvent& event, float* values) { bsdf.evaluate(event, parameters, count, values); },
      side, count, cosine, lobe, spectrum);
}

}  // namespace

void polarized_hemispherical(const Bsdf& bsdf, Side side, ParameterSpectra parameters, std::size_t count,
                             double cosine, float* whole, float* q) {
  std::vector<float> column(4 * count), both(2 * count);
  const MuellerRows rows{column.data(), count, false};
  add_up(
      bsdf,
      [&](const BsdfEvent& event, float* values) {
        bsdf.evaluate_mueller(event, parameters, count, rows);
        std::copy_n(rows.at(0, 0), 2 * count, values);
      },
      side, 2 * count, cosine, lobe_points(kAcrossLobe), both.data());
  std::copy_n(both.data(), count, whole);
  std::copy_n(both.data() + count, count, q);
}

void directional_hemispherical(const Bsdf& bsdf, Side side, ParameterSpectra parameters, std::size_t count,
                               double cosine, float* spectrum) {
  add_up(bsdf, side, parameters, count, cosine, lobe_points(kAcrossLobe), spectrum);
}

radiometry::Spectrum directional_hemispherical(const Bsdf& bsdf, Side side, double cosine) {
  std::vector<const radiometry::Spectrum*> spectra;
  for (const radiometry::Spectrum& spectrum : bsdf.spectra()) spectra.push_back(&spectrum);
  radiometry::CommonWavelengths common = radiometry::common_wavelengths(spectra);
  const bool constant = common.um.empty();
  if (constant) common.um.push_back(1.0);
  std::vector<std::vector<float>> rows;
  std::vector<const float*> parameters;
  for (const radiometry::Spectrum& spectrum : bsdf.spectra()) {
    std::vector<float>& row = rows.emplace_back();
    for (const double um : common.um) row.push_back(static_cast<float>(spectrum.at(um)));
  }
  for (const std::vector<float>& row : rows) parameters.push_back(row.data());

  // By equal shares of projected solid angle, where light comes from all sides alike.
  std::vector<double> towards{cosine};
  if (cosine < 0.0) {
    towards.clear();
    for (int k = 0; k < kViewAngles; ++k) towards.push_back(std::sqrt((k + 0.5) / kViewAngles));
  }
  std::vector<std::vector<float>> found(towards.size(), std::vector<float>(common.um.size()));
  parallel_for(static_cast<std::int64_t>(towards.size()), 0, [&](std::int64_t index) {
    const auto k = static_cast<std::size_t>(index);
    add_up(bsdf, side, parameters, common.um.size(), towards[k], lobe_points(kAcross), found[k].data());
  });
  std::vector<double> values(common.um.size(), 0.0);
  const double weight = 1.0 / static_cast<double>(towards.size());
  for (const std::vector<float>& row : found)
    for (std::size_t k = 0; k < row.size(); ++k) values[k] += weight * static_cast<double>(row[k]);
  if (constant) return radiometry::Spectrum::constant(values[0]);
  return {std::move(common.um), std::move(values), common.outside, spectra.front()->name()};
}

}  // namespace ifov::materials
