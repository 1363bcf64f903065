#include "transport/sky/sky_irradiance.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

namespace ifov::transport {

namespace {

constexpr double kHorizon = 0.5 * std::numbers::pi;
constexpr int kTilts = 61, kAzimuths = 61;  // of normals, 0 to pi each
constexpr int kRings = 45, kSectors = 180;  // of directions over the upper hemisphere
constexpr double kStep = std::numbers::pi / (kTilts - 1);

struct Hat {
  std::size_t low;
  double upper;  // share of the upper end
};

Hat hat(const std::vector<double>& nodes, double x) {
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
  const std::size_t low = static_cast<std::size_t>(above - nodes.begin()) - 1;
  return {low, std::clamp((x - nodes[low]) / (nodes[low + 1] - nodes[low]), 0.0, 1.0)};
}

/// How much each zenith angle and azimuth of a table counts for a level surface. Hats are linear in both; the integral of
/// sin z cos z is -cos 2z / 4, that of z sin z cos z is sin 2z / 8 - z cos 2z / 4.
std::vector<double> level_weights(const SkyTable& sky) {
  const auto whole = [](double z) { return -0.25 * std::cos(2.0 * z); };
  const auto moment = [](double z) { return 0.125 * std::sin(2.0 * z) - 0.25 * z * std::cos(2.0 * z); };
  const std::vector<double>&zenith = sky.zenith_rad, &azimuth = sky.azimuth_rad;
  std::vector<double> rings(zenith.size(), 0.0), sectors(azimuth.size(), 0.0), weights;
  for (std::size_t z = 0; z + 1 < zenith.size(); ++z) {
    const double low = zenith[z], high = zenith[z + 1], all = whole(high) - whole(low);
    const double upper = (moment(high) - moment(low) - low * all) / (high - low);
    rings[z] += all - upper;
    rings[z + 1] += upper;
  }
  rings.front() += whole(zenith.front()) - whole(0.0);
  rings.back() += whole(kHorizon) - whole(std::min(kHorizon, zenith.back()));
  for (std::size_t a = 0; a + 1 < azimuth.size(); ++a)
    for (const std::size_t end : {a, a + 1})  // half of the sector, on both sides of the Sun's plane
      sectors[end] += azimuth[a + 1] - azimuth[a];
  for (const double ring : rings)
    for (const double sector : sectors) weights.push_back(ring * sector / std::numbers::pi);
  return weights;
}

/// Directions of the upper hemisphere, about equally far apart, and where the table has them.
struct Direction {
  math::Vec3 unit;
  double solid_angle_sr;
  std::array<std::uint32_t, 4> row;
  std::array<double, 4> weight;
};

/// Azimuths count from the Sun's.
std::vector<Direction> directions_of(const SkyTable& sky) {
  std::vector<Direction> directions;
  const std::size_t stride = sky.azimuth_rad.size();
  for (int r = 0; r < kRings; ++r)
    for (int s = 0; s < kSectors; ++s) {
      const double low = kHorizon * r / kRings, high = kHorizon * (r + 1) / kRings;
      const double zenith = 0.5 * (low + high), azimuth = 2.0 * std::numbers::pi * (s + 0.5) / kSectors;
      const Hat z = hat(sky.zenith_rad, zenith);
      const Hat a = hat(sky.azimuth_rad, std::min(azimuth, 2.0 * std::numbers::pi - azimuth));
      const auto row = static_cast<std::uint32_t>(z.low * stride + a.low);
      directions.push_back(
          {{std::sin(zenith) * std::cos(azimuth), std::sin(zenith) * std::sin(azimuth), std::cos(zenith)},
           (std::cos(low) - std::cos(high)) * 2.0 * std::numbers::pi / kSectors,
           {row, row + 1, row + static_cast<std::uint32_t>(stride),
            row + static_cast<std::uint32_t>(stride) + 1},
           {(1.0 - z.upper) * (1.0 - a.upper), (1.0 - z.upper) * a.upper, z.upper * (1.0 - a.upper),
            z.upper * a.upper}});
    }
  return directions;
}

void add_up(const SkyTable& sky, const std::vector<double>& weights, float* row) {
  const std::size_t n = sky.spectra.stride();
  std::vector<double> sum(n, 0.0);
  for (std::size_t r = 0; r < weights.size(); ++r) {
    if (weights[r] == 0.0) continue;
    const float* spectrum = sky.spectra.row(r);
    for (std::size_t i = 0; i < n; ++i) sum[i] += weights[r] * static_cast<double>(spectrum[i]);
  }
  for (std::size_t i = 0; i < n; ++i) row[i] = static_cast<float>(sum[i]);
}

radiometry::SpectrumBlock tilted_table(const SkyTable& sky) {
  radiometry::SpectrumBlock table;
  table.resize(kTilts * kAzimuths, sky.spectra.columns());
  const std::vector<Direction> directions = directions_of(sky);
  std::vector<double> weights;
  for (int t = 0; t < kTilts; ++t)
    for (int a = 0; a < kAzimuths; ++a) {
      const double tilt = kStep * t, azimuth = kStep * a;
      const math::Vec3 normal{std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth),
                              std::cos(tilt)};
      weights.assign(sky.spectra.rows(), 0.0);
      if (t == 0) weights = level_weights(sky);
      for (const Direction& d : directions) {
        const double part = t == 0 ? 0.0 : math::dot(normal, d.unit) * d.solid_angle_sr / std::numbers::pi;
        if (part <= 0.0) continue;
        for (std::size_t k = 0; k < d.row.size(); ++k) weights[d.row[k]] += part * d.weight[k];
      }
      add_up(sky, weights, table.row(static_cast<std::size_t>(t * kAzimuths + a)));
    }
  return table;
}

}  // namespace

struct SkyIrradiance::Tilted {
  std::once_flag once;
  radiometry::SpectrumBlock table;  // [tilt][azimuth]
};

SkyIrradiance::SkyIrradiance(const SkyTable& sky) : tilted_(std::make_unique<Tilted>()) {
  level_.resize(1, sky.spectra.columns());
  add_up(sky, level_weights(sky), level_.row(0));
}

SkyIrradiance::~SkyIrradiance() = default;

SkyIrradiance::Corners SkyIrradiance::at(math::Vec3 normal, const SkyTable& sky) const {
  if (normal.z >= 1.0) {
    const float* level = level_.row(0);
    return {{level, level, level, level}, {1.0f, 0.0f, 0.0f, 0.0f}};
  }
  std::call_once(tilted_->once, [&] { tilted_->table = tilted_table(sky); });
  const double along = normal.x * sky.towards_sun.x + normal.y * sky.towards_sun.y;
  const double across = normal.x * sky.towards_sun.y - normal.y * sky.towards_sun.x;
  const double tilt = std::acos(std::clamp(normal.z, -1.0, 1.0)) / kStep;
  const double azimuth = std::atan2(std::abs(across), along) / kStep;
  const auto t = static_cast<std::size_t>(std::min(tilt, kTilts - 2.0));
  const auto a = static_cast<std::size_t>(std::min(azimuth, kAzimuths - 2.0));
  const double above = tilt - static_cast<double>(t), beyond = azimuth - static_cast<double>(a);
  const auto row = [&](std::size_t down, std::size_t right) {
    return tilted_->table.row((t + down) * kAzimuths + a + right);
  };
  return {{row(0, 0), row(0, 1), row(1, 0), row(1, 1)},
          {static_cast<float>((1.0 - above) * (1.0 - beyond)), static_cast<float>((1.0 - above) * beyond),
           static_cast<float>(above * (1.0 - beyond)), static_cast<float>(above * beyond)}};
}

}  // namespace ifov::transport
