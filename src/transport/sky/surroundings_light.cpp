#include "transport/sky/surroundings_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "atmosphere/scattering/ground/directional_ground.h"
#include "atmosphere/sensor/directional_light.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "materials/bsdf/bsdf.h"
#include "materials/material.h"
#include "radiometry/polarization_frame.h"
#include "radiometry/spectral_nodes.h"
#include "transport/sky/material_ground.h"

namespace ifov::transport {
namespace {

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180.0;
/// Of light that leaves: closer where rough ground brightens towards the horizon. The last holds beyond it.
constexpr double kZeniths_deg[] = {0,  5,  10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60,
                                   65, 70, 73, 76, 79, 81, 83, 85, 86, 87, 88, 89, 89.5};
constexpr int kAzimuthsOfASide = 18;

std::pair<std::size_t, double> interval_of(const std::vector<double>& nodes, double x) {
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
  const std::size_t low = static_cast<std::size_t>(above - nodes.begin()) - 1;
  return {low, std::clamp((x - nodes[low]) / (nodes[low + 1] - nodes[low]), 0.0, 1.0)};
}

}  // namespace

struct SurroundingsLight::Towards {
  double mu, azimuth_rad;  ///< of light that leaves; from the Sun's, counterclockwise, -pi to pi
  double own_rad;          ///< azimuth of space
};

SurroundingsLight::SurroundingsLight(std::shared_ptr<const atmosphere::GroundAtNodes> ground, bool both_sides,
                                     Lit lit)
    : lit_(std::move(lit)), ground_(std::move(ground)), both_sides_(both_sides) {
  components_ = lit_.polarized ? 3 : 1;
  if (lit_.air == nullptr || lit_.air->directional() == nullptr) return;
  components_ = sky_.emplace(*lit_.air, lit_.even).components();
  for (const double zenith_deg : kZeniths_deg) zenith_rad_.push_back(zenith_deg * kDegree);
  for (int k = both_sides_ ? -kAzimuthsOfASide : 0; k <= kAzimuthsOfASide; ++k)
    azimuth_rad_.push_back(kPi * k / kAzimuthsOfASide);
  rows_.resize(zenith_rad_.size() * azimuth_rad_.size() * components_, lit_.nodes.node_count());
  made_ = std::make_unique<std::once_flag[]>(zenith_rad_.size() * azimuth_rad_.size());
}

SurroundingsLight::~SurroundingsLight() = default;

std::unique_ptr<const SurroundingsLight> SurroundingsLight::of(const materials::Material& material, Lit lit) {
  if (!reflects_by_direction(material)) return nullptr;
  const double sun_azimuth_rad = std::atan2(lit.towards_sun.x, lit.towards_sun.y);
  auto ground = lit.air != nullptr && lit.air->directional() != nullptr
                    ? lit.air->directional()->ground
                    : material_ground(material, sun_azimuth_rad)->at(lit.nodes, lit.polarized);
  return std::unique_ptr<const SurroundingsLight>(
      new SurroundingsLight(std::move(ground), !material.bsdf->is_isotropic(), std::move(lit)));
}

SurroundingsLight::Towards SurroundingsLight::towards(math::Vec3 direction) const {
  const math::Vec3 leaves = -direction, sun = lit_.towards_sun;
  Towards way;
  way.mu = std::clamp(leaves.z, std::cos(std::end(kZeniths_deg)[-1] * kDegree), 1.0);
  way.own_rad = std::atan2(leaves.y, leaves.x);
  way.azimuth_rad = std::atan2(sun.x * leaves.y - sun.y * leaves.x, sun.x * leaves.x + sun.y * leaves.y);
  return way;
}

void SurroundingsLight::add(Part part, math::Vec3 direction, const radiometry::PolarizationFrame* frame,
                            const std::array<float*, 3>& to) const {
  const Towards way = towards(direction);
  switch (part) {
    case Part::emitted: add_emitted(way.mu, to[0]); break;
    case Part::sun: add_sun(way, frame, to); break;
    case Part::sky: add_sky(way, frame, to); break;
  }
}

void SurroundingsLight::add_all(math::Vec3 direction, const radiometry::PolarizationFrame* frame,
                                const std::array<float*, 3>& to) const {
  const Towards way = towards(direction);
  add_emitted(way.mu, to[0]);
  add_sun(way, frame, to);
  add_sky(way, frame, to);
}

void SurroundingsLight::add_emitted(double mu, float* to) const {
  if (lit_.black.empty()) return;
  static thread_local std::vector<double> share;
  share.resize(lit_.black.size());
  ground_->albedo(mu, share);
  for (std::size_t n = 0; n < share.size(); ++n) to[n] += static_cast<float>(1.0 - share[n]) * lit_.black[n];
}

void SurroundingsLight::add_sun(const Towards& way, const radiometry::PolarizationFrame* frame,
                                const std::array<float*, 3>& to) const {
  const double sine = lit_.towards_sun.z;
  if (!(sine > 0.0)) return;
  const std::size_t nodes = lit_.nodes.node_count(), rows = (frame != nullptr ? components_ : 1) * nodes;
  static thread_local std::vector<double> incoming, light;
  incoming.assign(rows, 0.0);
  light.assign(rows, 0.0);
  for (std::size_t n = 0; n < nodes; ++n) incoming[n] = sine * static_cast<double>(lit_.sun[n]);
  ground_->add_reflected({way.mu, -sine, way.azimuth_rad + kPi, 0.0}, incoming, light);
  for (std::size_t n = 0; n < nodes; ++n) to[0][n] += static_cast<float>(light[n]);
  if (frame == nullptr || components_ < 3) return;
  const radiometry::MuellerMatrix turn = turned(
      radiometry::carried(radiometry::meridional_frame(way.mu, way.own_rad), frame->direction), *frame);
  const double c = turn(1, 1), s = turn(1, 2);
  for (std::size_t n = 0; n < nodes; ++n) {
    const double q = light[nodes + n], u = light[2 * nodes + n];
    to[1][n] += static_cast<float>(c * q + s * u);
    to[2][n] += static_cast<float>(c * u - s * q);
  }
}

const float* SurroundingsLight::row(std::size_t zenith, std::size_t azimuth) const {
  const std::size_t k = zenith * azimuth_rad_.size() + azimuth, nodes = lit_.nodes.node_count();
  std::call_once(made_[k], [&] {
    std::vector<double> light(components_ * nodes, 0.0);
    sky_->add_sky(std::cos(zenith_rad_[zenith]), azimuth_rad_[azimuth] + kPi, light);
    for (std::size_t c = 0; c < components_; ++c)
      for (std::size_t n = 0; n < nodes; ++n)
        rows_.row(k * components_ + c)[n] = static_cast<float>(light[c * nodes + n]);
  });
  return rows_.row(k * components_);
}

void SurroundingsLight::add_sky(const Towards& way, const radiometry::PolarizationFrame* frame,
                                const std::array<float*, 3>& to) const {
  const std::size_t nodes = lit_.nodes.node_count();
  if (!sky_) {
    static thread_local std::vector<double> share;
    share.resize(nodes);
    ground_->albedo(way.mu, share);
    for (std::size_t n = 0; n < nodes; ++n) to[0][n] += static_cast<float>(share[n]) * lit_.sky[n];
    return;
  }
  const bool mirrored = !both_sides_ && way.azimuth_rad < 0.0;
  const double azimuth_rad = mirrored ? -way.azimuth_rad : way.azimuth_rad;
  const auto [z, above] = interval_of(zenith_rad_, std::acos(way.mu));
  const auto [a, beyond] = interval_of(azimuth_rad_, azimuth_rad);
  for (std::size_t k = 0; k < 4; ++k) {
    const double weight = (k / 2 == 1 ? above : 1.0 - above) * (k % 2 == 1 ? beyond : 1.0 - beyond);
    if (weight == 0.0) continue;
    const float* from = row(z + k / 2, a + k % 2);
    const float share = static_cast<float>(weight);
    for (std::size_t n = 0; n < nodes; ++n) to[0][n] += share * from[n];
    if (frame == nullptr || components_ < 3) continue;
    // Light of the table's direction, its frame carried to this one.
    const double turned_rad = azimuth_rad_[a + k % 2] - azimuth_rad;
    const radiometry::PolarizationFrame there = radiometry::meridional_frame(
        std::cos(zenith_rad_[z + k / 2]), way.own_rad + (mirrored ? -turned_rad : turned_rad));
    const radiometry::MuellerMatrix turn = turned(radiometry::carried(there, frame->direction), *frame);
    const float c = share * static_cast<float>(turn(1, 1)), s = share * static_cast<float>(turn(1, 2));
    const float *q = from + rows_.stride(), *u = q + rows_.stride();
    const float side = mirrored ? -1.0f : 1.0f;
    for (std::size_t n = 0; n < nodes; ++n) {
      to[1][n] += c * q[n] + s * side * u[n];
      to[2][n] += c * side * u[n] - s * q[n];
    }
  }
}

}  // namespace ifov::transport
