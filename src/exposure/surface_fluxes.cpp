// What points of a surface gain now.
#include <cmath>

#include "exposure/exposed_point.h"
#include "exposure/neighbours.h"
#include "exposure/point_rays.h"
#include "exposure/solved_surface.h"
#include "geometry/surface_point.h"
#include "sampling/random.h"
#include "scene/heat_fluxes.h"

namespace ifov::exposure {
namespace {

enum class FluxDraw { temperature, sun, sky, below, sent };

constexpr int kDrawsOfFluxes = 4;
constexpr double kLeastOfView = 0.002;  // that is below the horizon

}  // namespace

std::optional<scene::HeatFluxes> SolvedSurface::fluxes(const geometry::SurfacePoint& point,
                                                       std::uint64_t draw) const {
  if (neighbours_ == nullptr) return std::nullopt;
  const ExposedPoint exposed(scene_, point, two_faces_);
  const thermal::Pose pose = exposed.pose();
  const std::size_t now = classes_->rows() - 1;
  const double above = classes_->open_share(pose.normal), below = classes_->skin().faces() - above;
  const thermal::FromBeside ground = classes_->from_ground(now);
  const Neighbours::Behind behind{Neighbours::kDepth, PointRays::kChanceBehind,
                                  exposed.position_m().z - pose.height_m};
  double kelvin = 0.0, variance_k2 = 0.0, sun = 0.0, hidden = 0.0;
  thermal::FromBeside beside;
  std::vector<math::Vec3> directions;
  std::vector<geometry::SurfacePoint> met;
  const auto add = [&](const geometry::SurfacePoint& hit, double view, std::uint64_t key) {
    const thermal::FromBeside comes = hit.hit() ? neighbours_->sent(hit, now, behind, key) : ground;
    beside.sunlight_w_m2 += view * comes.sunlight_w_m2;
    beside.longwave_w_m2 += view * comes.longwave_w_m2;
  };
  for (int k = 0; k < kDrawsOfFluxes; ++k) {
    const std::uint64_t key = sampling::hash(draw, k, kDrawsOfFluxes);
    const scene::EstimatedTemperature one = at(point, sampling::hash(key, FluxDraw::temperature));
    kelvin += one.kelvin / kDrawsOfFluxes;
    variance_k2 += one.deviation_k * one.deviation_k / (kDrawsOfFluxes * kDrawsOfFluxes);
    if (neighbours_->sees_sun(exposed, now, sampling::hash(key, FluxDraw::sun))) sun += 1.0 / kDrawsOfFluxes;
    exposed.sky_directions(sampling::hash(key, FluxDraw::sky), 1, directions);
    neighbours_->met(exposed, directions, met);
    for (std::size_t ray = 0; ray < directions.size(); ++ray) {
      const double share = 1.0 / static_cast<double>(kDrawsOfFluxes * directions.size());
      if (exposed.leaves(directions[ray]) && !met[ray].hit()) continue;
      hidden += share;
      add(met[ray], share * above, sampling::hash(key, FluxDraw::sent, ray));
    }
    if (below < kLeastOfView) continue;
    exposed.ground_directions(sampling::hash(key, FluxDraw::below), 1, directions);
    neighbours_->met(exposed, directions, met);
    for (std::size_t ray = 0; ray < directions.size(); ++ray)
      add(met[ray], below / static_cast<double>(kDrawsOfFluxes * directions.size()),
          sampling::hash(key, FluxDraw::sent, ray, FluxDraw::below));
  }
  const auto gains_at = [&](double surface_k) {
    return classes_->last_fluxes(pose, sun, 1.0 - hidden, beside, surface_k);
  };
  const thermal::Fluxes gains = gains_at(kelvin);
  scene::HeatFluxes found{gains.sun, gains.sky, gains.reflected, gains.sky_longwave, gains.ground_longwave};
  // What is emitted and given to the air bends with temperature: of estimates the mean is off by half of its second derivative times their variance.
  const double deviation_k = std::sqrt(variance_k2);
  const thermal::Fluxes colder = gains_at(kelvin - deviation_k), warmer = gains_at(kelvin + deviation_k);
  const auto unbent = [&](double thermal::Fluxes::*of) {
    return 2.0 * gains.*of - 0.5 * (colder.*of + warmer.*of);
  };
  found.emitted = unbent(&thermal::Fluxes::emitted);
  found.convection = unbent(&thermal::Fluxes::convection);
  found.latent = unbent(&thermal::Fluxes::latent);
  found.power = gains.power;
  const double left = found.sun + found.sky + found.reflected + found.sky_longwave + found.scene_longwave +
                      found.emitted + found.convection + found.latent + found.power;
  if (classes_->skin().is_held())
    found.power -= left;
  else
    found.conduction = -left;
  return found;
}

}  // namespace ifov::exposure
