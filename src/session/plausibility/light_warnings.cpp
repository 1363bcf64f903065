#include "session/plausibility/light_warnings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "core/names.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "io/quantities/quantity.h"
#include "materials/bsdf/bsdf.h"
#include "sampling/sequence.h"
#include "sampling/warp.h"
#include "sensor/psf_wings.h"
#include "session/assembly/whole/camera_grid.h"
#include "session/loaded/parts.h"
#include "transport/spectral_scene.h"

namespace ifov::session {
namespace {

/// From this wavelength on what surfaces emit matters, and from the second on most of light is that.
constexpr double kEmission_um = 3.0, kThermal_um = 5.0;

bool any_channel(const Parts& parts, auto&& is) {
  return std::any_of(parts.channels.begin(), parts.channels.end(),
                     [&](const auto& c) { return is(c.centre_um); });
}

/// What of the light that meets a material goes on in any channel, at most.
double brightness(const Parts& parts, std::uint32_t material) {
  return parts.spectral_scene->brightest(material);
}

bool anything_reflects(const Parts& parts) {
  const std::vector<scene::SurfaceState>& states = parts.scene.states;
  return std::any_of(states.begin(), states.end(),
                     [&](const auto& s) { return brightness(parts, s.material) > 0.0; });
}

/// Surfaces without a temperature are as dark as space.
void warn_of_cold_surfaces(const Parts& parts, LogSink& log) {
  if (!any_channel(parts, [](double um) { return um > kEmission_um; })) return;
  std::string names;
  for (std::size_t s = 0; s < parts.scene.states.size(); ++s) {
    const materials::Material& material = parts.scene.materials[parts.scene.states[s].material];
    if (parts.scene.emits(static_cast<std::uint32_t>(s)) || material.curve_of) continue;
    names += (names.empty() ? "'" : ", '") + material.name + "'";
  }
  if (!names.empty())
    log.warn(
        format("there are thermal channels, and no temperature for {}: what has none emits nothing", names));
}

/// Products that are over sunlight, where a document names them and the Sun is down.
void warn_of_no_sunlight(const Parts& parts, LogSink& log) {
  const auto& products = parts.document.output.products;
  const auto& sun = parts.scene.sun;
  if (!products || *products == io::QuantitySet::all() || (sun && !sun->is_moon && sun->is_up())) return;
  std::vector<std::string> names;
  for (const io::Quantity* quantity : *products)
    if (quantity->needs.sunlight) names.emplace_back(quantity->name);
  if (!names.empty())
    log.warn(format("there will be no {}: the Sun is below the horizon", list_names(names, "and")));
}

void warn_of_sun(const Parts& parts, LogSink& log) {
  const auto& sun = parts.scene.sun;
  constexpr double kOnHorizon = 1e-6;  // what rounding makes of a zenith angle of 90 degrees
  if (!sun || sun->direction.z > kOnHorizon) return;
  const double below_deg = std::max(0.0, -sun->elevation_rad()) * 180.0 / std::numbers::pi;
  if (parts.atmosphere && sun->is_twilight()) {
    if (parts.document.light.moon)
      log.warn(format(
          "the Moon is left out: the Sun stands {:.1f} deg below the horizon, and its twilight is brighter",
          below_deg));
    return;
  }
  log.warn(format("the {} stands {:.1f} deg below the horizon: it lights nothing{}",
                  sun->is_moon ? "Moon" : "Sun", below_deg,
                  sun->is_moon       ? ""
                  : parts.atmosphere ? ", and twilight is modelled down to 6 deg"
                                     : ", and only a modelled atmosphere has twilight"));
}

void warn_of_sky(const Parts& parts, LogSink& log) {
  const io::Document& document = parts.document;
  const bool declared = document.light.sky_position.line > 0;
  if (declared || parts.has_sky() || !anything_reflects(parts)) return;
  const bool reflective = parts.scene.sun && any_channel(parts, [](double um) { return um <= kThermal_um; });
  const bool thermal =
      parts.scene.temperatures() && any_channel(parts, [](double um) { return um > kEmission_um; });
  if (!reflective && !thermal) return;
  log.warn(format(
      "there is no sky: {}{}{}. Give light.sky, or an atmosphere; \"sky\": {{\"none\": {{}}}} says that this is meant",
      reflective ? "what the Sun does not reach is lit by other surfaces alone" : "",
      reflective && thermal ? ", and " : "", thermal ? "surfaces reflect a sky at 0 K" : ""));
}

/// Shares of rays that leave below the horizon: of those of the camera, and of those that what they meet reflects.
struct Leaving {
  double seen = 0.0, met = 0.0;
};

Leaving leaving_below(const Parts& parts) {
  constexpr int kAcross = 24, kEach = 4;
  std::vector<math::Ray> rays;
  const geometry::World& world = *parts.scene.world;
  const std::vector<geometry::SurfacePoint> hits = hits_of_camera(world, *parts.camera, kAcross, &rays);
  Leaving leaving;
  std::vector<math::Ray> onward;
  for (std::size_t k = 0; k < hits.size(); ++k) {
    if (!hits[k].hit()) {
      leaving.seen += rays[k].direction.z < 0.0 ? 1.0 / static_cast<double>(hits.size()) : 0.0;
      continue;
    }
    const scene::ResolvedSurface surface = parts.scene.resolve(hits[k]);
    if (std::none_of(surface.begin(), surface.end(),
                     [&](const auto& c) { return brightness(parts, c.material) > 0.0; }))
      continue;
    const double side = hits[k].front ? 1.0 : -1.0;
    const math::Vec3 normal = side * hits[k].geometric_normal.as_vector();
    const sampling::TangentFrame frame(normal);
    for (int j = 0; j < kEach; ++j) {
      const auto index = static_cast<std::uint32_t>(onward.size()) + 1;
      const math::Vec3 direction = frame.to_world(sampling::cosine_hemisphere(sampling::halton_point(index)));
      onward.push_back({hits[k].position_m + hits[k].offset_m * normal, direction});
    }
  }
  std::vector<geometry::SurfacePoint> met(onward.size());
  world.intersect(onward, met);
  for (std::size_t k = 0; k < met.size(); ++k)
    if (!met[k].hit() && onward[k].direction.z < 0.0) leaving.met += 1.0 / static_cast<double>(onward.size());
  return leaving;
}

/// The wings of a PSF bring light from far beside the picture.
void warn_of_wings(const Parts& parts, LogSink& log) {
  constexpr int kAcross = 32;
  constexpr double kNoticed = 0.01;
  constexpr double kReach_px = sensor::PsfWings::kBlocks * sensor::PsfWings::kFar;
  std::vector<math::Ray> rays;
  const std::vector<geometry::SurfacePoint> hits =
      hits_of_camera(*parts.scene.world, *parts.camera, kAcross, &rays, kReach_px);
  double seen = 0.0;
  for (std::size_t k = 0; k < hits.size(); ++k)
    seen += !hits[k].hit() && rays[k].direction.z < 0.0 ? 1.0 / static_cast<double>(hits.size()) : 0.0;
  if (seen < kNoticed) return;
  log.warn(
      format("the wings of the PSF reach {:g} px beyond the picture, and {:.2g} % of what they see are "
             "surroundings that are not declared and taken as black at 0 K",
             kReach_px, 100.0 * seen));
}

void warn_of_surroundings(const Parts& parts, LogSink& log) {
  constexpr double kNoticed = 0.002;
  if (parts.document.light.surroundings || !parts.assumed_surroundings.empty()) return;
  // Rays would make the trees of large meshes, which belongs to rendering.
  if (parts.scene.world->storage().chunks > 0) {
    log.warn(
        "light.surroundings are not declared: rays that leave the scene below the horizon meet black at 0 K");
    return;
  }
  if (!parts.wings.empty()) warn_of_wings(parts, log);
  const Leaving leaving = leaving_below(parts);
  if (leaving.seen < kNoticed && leaving.met < kNoticed) return;
  log.warn(format(
      "light.surroundings are not declared and taken as black at 0 K: {:.3g} % of the picture sees them, and "
      "{:.3g} % of the light that would fall on what is in it comes from there",
      100.0 * leaving.seen, 100.0 * leaving.met));
}

void warn_of_depth(const Parts& parts, LogSink& log) {
  constexpr double kNoticed = 1e-3;
  const std::optional<int>& depth = parts.document.sampling.max_depth;
  if (!depth) return;
  double brightest = 0.0;
  std::string name;
  for (const scene::SurfaceState& state : parts.scene.states) {
    const double found = brightness(parts, state.material);
    if (found > brightest) name = parts.scene.materials[state.material].name;
    brightest = std::max(brightest, found);
  }
  const double left = std::pow(brightest, *depth);
  if (left < kNoticed) return;
  log.warn(format(
      "max_depth {}: light that is reflected more often is left out, and no interval knows of it. Between "
      "surfaces like '{}', which reflects up to {:.2g} %, that is up to {:.2g} % of it; without max_depth nothing is left out",
      *depth, name, 100.0 * brightest, 100.0 * left));
}

}  // namespace

std::string surroundings_statement(const Parts& parts) {
  const auto& written = parts.document.light.surroundings;
  if (!written || !written->material || parts.spectral_scene->surroundings_light() == nullptr) return {};
  std::string line = format("surroundings: '{}' by its BRDF, below the horizon", written->material->name);
  if (parts.atmosphere)
    line +=
        " and in the air; what of the scene's own ground differs from them lights the air as Lambertian ground does";
  else
    line += parts.imported ? ", where the sky is uniform; the air has their light as of Lambertian ground"
                           : ", where the sky is uniform";
  const materials::Material& material = parts.scene.materials[parts.scene.surroundings.material];
  if (!material.bsdf->is_isotropic() && parts.atmosphere)
    line += "; what the air scatters of their light again is as of the mean of both sides of the Sun's plane";
  return line;
}

void warn_of_light_left_out(const Parts& parts, LogSink& log) {
  warn_of_cold_surfaces(parts, log);
  warn_of_sun(parts, log);
  warn_of_no_sunlight(parts, log);
  warn_of_sky(parts, log);
  warn_of_surroundings(parts, log);
  warn_of_depth(parts, log);
}

}  // namespace ifov::session
