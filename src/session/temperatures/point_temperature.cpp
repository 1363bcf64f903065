#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/names.h"
#include "exposure/solved_surface.h"
#include "io/document/document.h"
#include "math/angle.h"
#include "session/assembly/geometry/placed_objects.h"
#include "session/assembly/surfaces/thermal_assembly.h"
#include "session/session.h"
#include "session/solved/document_outdoors.h"
#include "session/solved/second_pass.h"
#include "session/temperatures/looked_for_point.h"
#include "session/temperatures/reported_day.h"
#include "session/temperatures/temperature_survey.h"

namespace ifov::session {
namespace {

using Exposure = exposure::SolvedSurface::Exposure;

constexpr int kSkyPairs = 512, kSunRays = 64, kRaysBeside = 64, kDrawsBeside = 512;

std::size_t object_of(const io::Document& document, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < document.scene.objects.size(); ++k) {
    if (document.scene.objects[k].name == name) return k;
    if (!document.scene.objects[k].name.empty()) names.push_back(document.scene.objects[k].name);
  }
  throw InputError(
      format("{}: no object is named '{}'{}", document.sources.file_name, name, did_you_mean(name, names)));
}

/// At each row of the series.
std::vector<double> sun_seen(const exposure::SolvedSurface& surface, const Exposure& exposure) {
  std::vector<double> seen(surface.classes().rows(), 0.0);
  for (std::size_t k = 0; k < exposure.visibility.size(); ++k)
    seen[surface.classes().row_of_series(k)] = exposure.visibility[k];
  return seen;
}

std::vector<double> last_of(std::vector<double> values, std::size_t count) {
  values.erase(values.begin(), values.end() - static_cast<std::ptrdiff_t>(count));
  return values;
}

std::string wind_text(const thermal::Stand& stand) {
  const std::string terrain(thermal::name_of(stand.terrain));
  return stand.height_m > 0.0
             ? format("{:.2f} m above {} terrain", stand.height_m, terrain)
             : format("in the wind of {:g} m or lower above {} terrain", thermal::kLowestWind_m, terrain);
}

std::string place_text(const geometry::SurfacePoint& met) {
  return format("({:.2f}, {:.2f}, {:.2f}) m", met.position_m.x, met.position_m.y, met.position_m.z);
}

/// InputError where nothing was met, or what has no solved temperature.
void require_solved(const io::Document& document, const LookedForPoint& point,
                    const PointQuestion& question) {
  const std::string& file = document.sources.file_name;
  const math::Ray& ray = point.along;
  if (!point.met.hit())
    throw InputError(format(
        "{}: no surface{} is met from ({:.2f}, {:.2f}, {:.2f}) m along ({:g}, {:g}, {:g}) at the document's time",
        file, question.object.empty() ? std::string() : " of '" + question.object + "'", ray.origin_m.x,
        ray.origin_m.y, ray.origin_m.z, ray.direction.x, ray.direction.y, ray.direction.z));
  if (point.surface == nullptr)
    throw InputError(format(
        "{}: the surface at {}, of {}, has no temperature that is solved: give it, or its material, \"temperature\": \"solved\"",
        file, place_text(point.met), title_of(document.scene.objects, point.object)));
}

}  // namespace

io::TemperatureReport point_temperature(const io::Document& document, const PointQuestion& question) {
  const DocumentOutdoors about = outdoors_of_survey(document);
  const thermal::OutdoorsSeries& series = about.outdoors.series;
  std::optional<std::size_t> object;
  if (!question.object.empty()) object = object_of(document, question.object);
  LoadOptions options;
  options.unseen_temperatures = true;
  const Session session = Session::load(document, nullptr, options);
  const LookedForPoint point = look_for(session.parts(), object, question);
  require_solved(document, point, question);
  const auto* const surface = dynamic_cast<const exposure::SolvedSurface*>(point.surface);
  const geometry::SurfacePoint& met = point.met;
  const auto thermal = assemble_thermal(document.sources, document.scene.materials[point.material],
                                        *point.optics, about.mean_air_k);
  const Exposure exposure = surface->exposure(met, 0, kSkyPairs, kSunRays);
  const math::Vec3 normal = surface->normal_at(met);

  thermal::Stand stand;
  stand.terrain = about.terrain;
  stand.tilt_rad = std::acos(std::clamp(normal.z, -1.0, 1.0));
  stand.azimuth_rad = std::atan2(normal.x, normal.y);
  stand.height_m = exposure.height_m;
  const auto solve = [&](std::vector<double> visibility, std::vector<double> free_sky,
                         std::vector<thermal::FromBeside> beside = {}) {
    return thermal::solve_surface(thermal->solid, thermal->skin, stand, series, thermal->start,
                                  std::move(visibility), std::move(free_sky), std::move(beside));
  };
  io::TemperatureReport report = report_about(document.sources.file_name, about);
  const thermal::SurfaceSolution sunlit = solve(std::vector<double>(series.rows.size(), 1.0), {});
  const thermal::SurfaceSolution shaded = solve(std::vector<double>(series.rows.size(), 0.0), {});
  const std::vector<double> seen = sun_seen(*surface, exposure);
  std::vector<double> free_sky = exposure.past_free_sky;
  if (free_sky.empty()) free_sky.assign(series.rows.size(), exposure.free_sky);
  const ByMaterial by_material = solved_materials(document, session.parts().scene, about.mean_air_k);
  thermal::Stand open;
  open.terrain = about.terrain;
  const thermal::SurfaceSolution here = solve(
      seen, free_sky,
      beside_of(
          {session.parts().scene, surface->scene(), by_material, series, open, surface->sun_radius_rad()},
          met, exposure, 0, kRaysBeside, 1, surface->classes().two_faces()));

  double azimuth_deg = stand.azimuth_rad / math::kDegree;
  if (azimuth_deg < 0.0) azimuth_deg += 360.0;
  report.notes.push_back(format(
      "the point {} of {}: it slopes by {:.1f} deg{}, {}; {} rays to the sky and {} to the Sun at each step, from as many "
      "places of its disc; up to {} to what is about it, each solved in full",
      place_text(met), title_of(document.scene.objects, point.object), stand.tilt_rad / math::kDegree,
      stand.tilt_rad > 0.5 * math::kDegree ? format(" and faces {:.0f} deg from north", azimuth_deg) : "",
      wind_text(stand), 2 * kSkyPairs, kSunRays, kRaysBeside));
  const double own_k = here.surface_k(series.rows.size() - 1);
  report.notes.push_back(format(
      "at the document's time: {:.2f} degC; images, which know it by its class, have {:.2f} degC, and state +-{:.2f} K for its material",
      own_k - 273.15,
      surface->temperature_k(met, exposure) + surface->beside_k(met, exposure, 0, kDrawsBeside) - 273.15,
      point.half_width_k));
  const std::size_t shown = report.time_s.size();
  report.materials.push_back({document.scene.materials[point.material].name,
                              thermal->description,
                              day_of(sunlit, about),
                              day_of(shaded, about),
                              unaccounted_of(here),
                              {{day_of(here, about), last_of(seen, shown), last_of(free_sky, shown)}}});
  return report;
}

}  // namespace ifov::session
