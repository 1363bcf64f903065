#include "session/solved/solved_temperatures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/parallel.h"
#include "exposure/ground_beside.h"
#include "exposure/neighbours.h"
#include "exposure/past_scene.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "scene/scene.h"
#include "session/assembly/atmosphere/weather_assembly.h"
#include "session/solved/document_outdoors.h"
#include "session/solved/other_side.h"
#include "session/solved/second_pass.h"
#include "thermal/wind_profile.h"

namespace ifov::session {
namespace {

constexpr double kSunRadius_rad = 0.00465;                 // at 1 au, of 6.957e8 m
constexpr std::size_t kMeasured = 64, kLeastMeasured = 8;  // points, of all materials and of each
constexpr double kLeastUnsettled_k = 0.2;
constexpr int kSkyPairs = 128;
constexpr int kForBeside = 3, kMetForBeside = 4;
constexpr int kRaysBeside = 6, kMoreRaysBeside = 12, kMoreBeyond = 4;

thermal::Stand open_stand(const DocumentOutdoors& about) {
  thermal::Stand stand;
  stand.terrain = about.terrain;
  return stand;
}

ThermalMaterial thermal_of(const io::Document& document, const io::MaterialDocument& source,
                           const scene::Scene& scene, std::uint32_t material, double deep_k) {
  if (auto thermal = assemble_thermal(document.sources, source, scene.materials[material], deep_k))
    return std::move(*thermal);
  throw io::document_error(
      document.sources, source.position,
      format(
          "the temperature of '{}' is to be solved, and it has neither \"thermal\" nor a reflectance of the "
          "library, of which it is known what it stands on",
          source.name));
}

/// All that the classes of a material are solved from.
thermal::ClassSurface surface_of(const ThermalMaterial& material, const thermal::Stand& stand) {
  return {material.solid, material.skin, stand, material.start};
}

/// By material the first that is the same to heat, whose classes it has.
using Firsts = std::map<std::uint32_t, std::uint32_t>;

Firsts firsts_of(const ByMaterial& by_material, const thermal::Stand& stand) {
  Firsts firsts;
  for (const auto& [material, solved] : by_material) {
    firsts[material] = material;
    const thermal::ClassSurface own = surface_of(solved.thermal, stand);
    for (const auto& [earlier, first] : firsts)
      if (earlier != material && earlier == first &&
          surface_of(by_material.at(earlier).thermal, stand) == own) {
        firsts[material] = earlier;
        break;
      }
  }
  return firsts;
}

/// The Sun of the image is the one that warmed the scene, unless the document has put it elsewhere.
void warn_of_another_sun(const scene::Scene& scene, const thermal::Outdoors& now, LogSink& log) {
  constexpr double kApart_deg = 3.0;
  if (!scene.sun || scene.sun->is_moon) return;
  const double level = std::cos(now.sun_elevation_rad);
  const math::Vec3 there{level * std::sin(now.sun_azimuth_rad), level * std::cos(now.sun_azimuth_rad),
                         std::sin(now.sun_elevation_rad)};
  const double apart_deg =
      std::acos(std::clamp(math::dot(there, scene.sun->direction), -1.0, 1.0)) * 180.0 / std::numbers::pi;
  if (apart_deg > kApart_deg)
    log.warn(format(
        "the Sun of 'light' stands {:.0f} deg from where it stood at the document's 'time', by which temperatures "
        "are solved: its shadows and theirs do not go together",
        apart_deg));
}

/// By what a level surface in the open is off by the length of steps: twice as long ones make four times the error.
double step_error_k(const SolvedMaterial& solved, const thermal::OutdoorsSeries& series,
                    const thermal::Stand& stand) {
  thermal::OutdoorsSeries every_other = series;
  every_other.step_s *= 2.0;
  every_other.rows.clear();
  for (std::size_t row = (series.rows.size() - 1) % 2; row < series.rows.size(); row += 2)
    every_other.rows.push_back(series.rows[row]);
  const auto last_k = [&](const thermal::OutdoorsSeries& of) {
    return thermal::solve_surface(solved.thermal.solid, solved.thermal.skin, stand, of, solved.thermal.start)
        .history.nodes.back()
        .surface_k;
  };
  return std::abs(last_k(every_other) - last_k(series)) / 3.0;
}

/// A place of a surface that is warmed by what it sees.
struct Measured {
  Measured(const SolvedMaterial& of, const geometry::SurfacePoint& seen) : solved(&of), at(seen) {}
  Measured(const SolvedMaterial& of, const geometry::SurfacePoint& place, double above_ground_m)
      : solved(&of), at(place), made_up(true), height_m(above_ground_m) {}

  const SolvedMaterial* solved;
  geometry::SurfacePoint at;
  bool made_up = false;   ///< the camera sees too few of the material
  int chosen_for = 0;     ///< 1, 2: for a past that was mixed, that changed; kForBeside, kMetForBeside
  double height_m = 0.0;  ///< above ground
  double off_k = 0.0;
  BesideOff beside;
  double full_k = 0.0;  ///< without what is about it, as it is exposed; where that is asked
  exposure::SolvedSurface::Exposure exposure{};
  double across_k = 0.0;  ///< of a sheet of two faces
  std::optional<double>
      ground_k,      ///< by what its temperature would be another if the ground were that beside
      other_side_k;  ///< likewise if the other side of its sheet counted
};

/// Level, tilted and upright, to all sides: what the camera may see of a material by way of mirrors, or between its rays.
geometry::SurfacePoint made_up_point(std::size_t number) {
  const double tilt_rad = 0.25 * std::numbers::pi * static_cast<double>(number % 3);
  const double azimuth_rad = 0.7 + 2.4 * static_cast<double>(number);  // the golden angle
  geometry::SurfacePoint point;
  point.geometric_normal = point.shading_normal =
      math::as_normal({std::sin(tilt_rad) * std::sin(azimuth_rad), std::sin(tilt_rad) * std::cos(azimuth_rad),
                       std::cos(tilt_rad)});
  return point;
}

/// Half of the sky's light, and the Sun some hours of a day, others not.
exposure::SolvedSurface::Exposure made_up_exposure(std::size_t number, std::size_t rows, double height_m) {
  constexpr std::size_t kHours = 5;
  exposure::SolvedSurface::Exposure exposure;
  exposure.free_sky = 0.5 + 0.5 * static_cast<double>(number % 2);
  exposure.height_m = height_m;
  for (std::size_t row = 0; row < rows; ++row)
    exposure.visibility.push_back((kHours * row / std::max<std::size_t>(rows, 1) + number) % 2 == 0 ? 1.0
                                                                                                    : 0.0);
  return exposure;
}

/// Of what is seen of a material those few whose past is least like that of always Sun or never, and those about which most came or went.
void add_unsettled(std::vector<Measured>& points, const SolvedMaterial& solved,
                   std::span<const geometry::SurfacePoint* const> seen, const exposure::PastScene& past) {
  const exposure::SolvedSurface surface(solved.classes, past, kSunRadius_rad);
  std::vector<exposure::SolvedSurface::Unsettled> all;
  for (const geometry::SurfacePoint* point : seen) all.push_back(surface.unsettled(*point));
  int chosen_for = 0;
  for (const auto kelvins :
       {&exposure::SolvedSurface::Unsettled::mixed_k, &exposure::SolvedSurface::Unsettled::changed_k}) {
    ++chosen_for;
    double most_k = kLeastUnsettled_k;
    for (const auto& one : all) most_k = std::max(most_k, one.*kelvins);
    std::vector<const geometry::SurfacePoint*> found;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (all[k].*kelvins >= 0.5 * most_k) found.push_back(seen[k]);
    const std::size_t count = std::min(found.size(), kLeastMeasured);
    for (std::size_t k = 0; k < count; ++k) {
      points.emplace_back(solved, *found[k * found.size() / count]);
      points.back().chosen_for = chosen_for;
    }
  }
}

/// Of points of a material a few that see something else than the sky.
void add_beside(std::vector<Measured>& points, const SolvedMaterial& solved,
                std::span<const geometry::SurfacePoint* const> seen, int chosen_for) {
  std::vector<const geometry::SurfacePoint*> found;
  for (std::size_t k = 0; k < seen.size(); ++k)
    if (solved.surface->sees_surfaces(*seen[k], k)) found.push_back(seen[k]);
  const std::size_t count = std::min(found.size(), kLeastMeasured);
  for (std::size_t k = 0; k < count; ++k) {
    points.emplace_back(solved, *found[k * found.size() / count]);
    points.back().chosen_for = chosen_for;
  }
}

using PointsOfMaterials = std::map<std::uint32_t, std::vector<const geometry::SurfacePoint*>>;

PointsOfMaterials solved_points(const scene::Scene& scene, std::span<const geometry::SurfacePoint> points,
                                const Firsts& firsts) {
  PointsOfMaterials of_material;
  for (const geometry::SurfacePoint& point : points) {
    if (!point.hit()) continue;
    const scene::ResolvedSurface surface = scene.resolve_without_temperature(point);
    if (const std::uint32_t by = scene.states[surface.constituents[0].state].solved; by > 0)
      of_material[firsts.at(by - 1)].push_back(&point);
  }
  return of_material;
}

/// Points that the camera sees, evenly over the image, of each material about as many as it fills; made up where those are few. Materials that
/// are the same to heat are one.
std::vector<Measured> points_by_material(const scene::Scene& scene, const sensor::Camera& camera,
                                         const ByMaterial& by_material, const Firsts& firsts,
                                         const exposure::PastScene& past, bool unseen) {
  const std::vector<geometry::SurfacePoint> seen = seen_evenly(scene, camera);
  PointsOfMaterials of_material = solved_points(scene, seen, firsts);
  std::vector<geometry::SurfacePoint> met;
  if (unseen) met = met_from(scene, past, seen);
  PointsOfMaterials met_of_material = solved_points(scene, met, firsts);
  std::size_t all = 0;
  for (const auto& [material, found] : of_material) all += found.size();
  std::vector<Measured> points;
  for (const auto& [material, solved] : by_material) {
    if (firsts.at(material) != material) continue;
    const auto& found = of_material[material];
    const std::size_t share = all > kMeasured ? kMeasured * found.size() / all : found.size();
    const std::size_t count = std::min(found.size(), std::max(share, kLeastMeasured));
    for (std::size_t k = 0; k < count; ++k) points.emplace_back(solved, *found[k * found.size() / count]);
    // As high as what is seen of the material, else anywhere.
    for (std::size_t k = count; k < kLeastMeasured; ++k)
      points.emplace_back(solved, made_up_point(k),
                          found.empty() ? past.highest_m() * static_cast<double>(k % 4) / 3.0
                                        : past.height_above_ground_m(found[k % found.size()]->position_m,
                                                                     thermal::kLowestWind_m));
    add_unsettled(points, solved, found, past);
    add_beside(points, solved, found, kForBeside);
    add_beside(points, solved, met_of_material[material], kMetForBeside);
  }
  return points;
}

/// Where rays to what is about the points of a material scatter by a good part of what images seem to be off there, more of them tell.
void ask_again(const Neighbourhood& about, std::span<Measured> points, int threads) {
  constexpr double kGoodPart = 0.2, kLittle_k2 = 0.0025;
  std::map<std::pair<const SolvedMaterial*, int>, std::array<double, 3>> of;  // squares, of scatter, points
  const auto group_of = [](const Measured& point) { return std::pair(point.solved, point.chosen_for); };
  for (const Measured& point : points) {
    if (point.chosen_for < kForBeside) continue;
    auto& [squares_k2, scatter_k2, count] = of[group_of(point)];
    const auto& [one_k, other_k] = point.beside.off_k;
    squares_k2 += 0.25 * (one_k + other_k) * (one_k + other_k);
    scatter_k2 += 0.25 * (one_k - other_k) * (one_k - other_k);
    ++count;
  }
  std::vector<std::size_t> again;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].chosen_for < kForBeside) continue;
    const auto& [squares_k2, scatter_k2, count] = of.at(group_of(points[k]));
    if (scatter_k2 > kGoodPart * squares_k2 && squares_k2 > kLittle_k2 * count) again.push_back(k);
  }
  Neighbourhood by_more = about;
  by_more.rays_beyond = kMoreBeyond;
  parallel_for(static_cast<std::int64_t>(again.size()), threads, [&](std::int64_t k) {
    const std::size_t number = again[static_cast<std::size_t>(k)];
    Measured& point = points[number];
    point.beside = beside_off(by_more, *point.solved->surface, *point.solved, point.at, number,
                              point.exposure, point.full_k, kMoreRaysBeside);
  });
}

/// What classes make of the points against solutions in full, material by material; of the root mean squares the largest.
void measure(TemperatureErrors& errors, const io::Document& document, const Neighbourhood& about,
             const Firsts& firsts, std::vector<Measured> points, int threads) {
  const exposure::PastScene& past = about.past;
  parallel_for(static_cast<std::int64_t>(points.size()), threads, [&](std::int64_t k) {
    const auto number = static_cast<std::size_t>(k);
    Measured& point = points[number];
    const exposure::SolvedSurface surface(point.solved->classes, past, kSunRadius_rad);
    auto exposure = point.made_up
                        ? made_up_exposure(number, point.solved->classes->sunlit_rows(), point.height_m)
                        : surface.exposure(point.at, static_cast<std::uint64_t>(k), kSkyPairs, 1);
    const math::Vec3 normal = surface.normal_at(point.at);
    const auto full_solution_k = [&] {
      return full_solution(*point.solved, about.series, about.stand, normal, exposure)
          .history.nodes.back()
          .surface_k;
    };
    const double full_k = full_solution_k();
    point.off_k = surface.temperature_k(point.at, exposure) - full_k;
    point.height_m = exposure.height_m;
    if (point.made_up) return;
    if (point.chosen_for >= kForBeside) {
      point.beside = beside_off(about, *point.solved->surface, *point.solved, point.at, number, exposure,
                                full_k, kRaysBeside);
      point.full_k = full_k;
      point.exposure = exposure;
    }
    if (point.solved->classes->two_faces())
      point.across_k = across_k(about, *point.solved, point.at, number, full_k);
    else
      point.other_side_k = other_side_k(about, *point.solved, point.at, number, full_k);
    if (exposure.height_m > 0.0) return;
    exposure.height_m =
        exposure::height_above_ground_beside_m(past, point.at.position_m, thermal::kLowestWind_m);
    if (exposure.height_m > 0.0) point.ground_k = std::abs(full_solution_k() - full_k);
  });
  ask_again(about, points, threads);
  double worst_half_width_k = 0.0;
  for (const auto& [material, solved] : about.by_material) {
    if (firsts.at(material) != material) {
      errors.by_material[material] = errors.by_material.at(firsts.at(material));
      continue;
    }
    double sum_k = 0.0, squares_k2 = 0.0, count = 0.0;
    std::array<std::pair<double, int>, 2> beside{};     // squares, points: that the camera sees, that are met
    std::array<std::pair<double, double>, 2> chosen{};  // squares, points
    for (const Measured& point : points) {
      if (point.solved != &solved) continue;
      errors.worst_k = std::max(errors.worst_k, std::abs(point.off_k));
      if (point.chosen_for >= kForBeside) {
        auto& [squares, number] = beside[static_cast<std::size_t>(point.chosen_for - kForBeside)];
        // With what their rays scatter, which makes it more.
        const double mean_k = 0.5 * (point.beside.off_k[0] + point.beside.off_k[1]);
        squares += mean_k * mean_k + point.beside.further_k * point.beside.further_k;
        ++number;
        continue;
      }
      if (point.chosen_for > 0) {
        auto& [squares, number] = chosen[static_cast<std::size_t>(point.chosen_for - 1)];
        squares += point.off_k * point.off_k;
        number += 1.0;
        ++errors.unsettled;
        continue;
      }
      count += 1.0;
      sum_k += point.off_k;
      squares_k2 += point.off_k * point.off_k;
      ++(point.made_up ? errors.made_up : errors.points);
      if (point.made_up) continue;
      ++errors.by_material[material].seen;
      errors.lowest_m = errors.points == 1 ? point.height_m : std::min(errors.lowest_m, point.height_m);
      errors.highest_m = std::max(errors.highest_m, point.height_m);
      errors.across_k = std::max(errors.across_k, point.across_k);
      double& of_sheet_k = errors.by_material[material].other_side_k;
      of_sheet_k = std::max({of_sheet_k, point.across_k, point.other_side_k.value_or(0.0)});
      if (point.other_side_k) {
        ++errors.free_standing;
        if (*point.other_side_k > errors.other_side_k) {
          errors.other_side_k = *point.other_side_k;
          errors.free_material = document.scene.materials[material].name;
        }
      }
      if (!point.ground_k) continue;
      ++errors.on_nothing;
      errors.ground_k = std::max(errors.ground_k, *point.ground_k);
      double& of_material_k = errors.by_material[material].ground_k;
      of_material_k = std::max(of_material_k, *point.ground_k);
    }
    TemperatureErrors::OfMaterial& own = errors.by_material[material];
    own.rms_k = std::sqrt(squares_k2 / count);
    own.points = count;
    own.beside = beside[0].second;
    own.beside_k = std::sqrt(beside[0].first / std::max(own.beside, 1));
    own.met_beside = beside[1].second;
    own.met_beside_k = std::sqrt(beside[1].first / std::max(own.met_beside, 1));
    for (const auto& [squares, number] : chosen)
      own.unsettled_k = std::max(own.unsettled_k, std::sqrt(squares / std::max(number, 1.0)));
    const double of_image_k = errors.mirrors ? own.whole_half_width_k() : own.half_width_k();
    if (!errors.material.empty() && of_image_k < worst_half_width_k) continue;
    worst_half_width_k = of_image_k;
    errors.rms_k = own.rms_k;
    errors.unsettled_k = own.unsettled_k;
    errors.beside_k =
        own.seen == 0 || errors.mirrors ? std::max(own.beside_k, own.met_beside_k) : own.beside_k;
    errors.bias_k = sum_k / count;
    errors.material = document.scene.materials[material].name;
  }
}

}  // namespace

std::optional<SourcePosition> solved_temperature_at(const io::Document& document) {
  const auto solved = [](const std::optional<io::TemperatureDocument>& temperature) {
    return temperature && std::holds_alternative<io::SolvedTemperatureDocument>(temperature->value);
  };
  for (const io::MaterialDocument& material : document.scene.materials)
    if (solved(material.temperature)) return material.temperature->position;
  for (const auto& object : document.scene.objects)
    if (solved(object.temperature)) return object.temperature->position;
  return std::nullopt;
}

void require_weather(const io::Document& document) {
  if (document.weather && document.time && solved_temperature_at(document))
    outdoors_of_document(document, *assemble_weather(document.sources, *document.weather, document.time));
}

std::optional<TemperatureErrors> solve_temperatures(const io::Document& document,
                                                    const atmosphere::WeatherSeries* weather,
                                                    const sensor::Camera& camera, scene::Scene& scene,
                                                    bool unseen, SolvedClasses* shared, int threads,
                                                    LogSink* log) {
  ByMaterial by_material;
  for (const scene::SurfaceState& state : scene.states)
    if (state.solved > 0) by_material[state.solved - 1];
  if (by_material.empty()) {
    scene.solved.clear();
    return std::nullopt;
  }
  const auto missing = [&](const char* what) {
    return io::document_error(document.sources, solved_temperature_at(document).value_or(SourcePosition{}),
                              what);
  };
  if (!document.time)
    throw missing("a temperature that is solved needs a \"time\", and weather of the day before it");
  if (weather == nullptr)
    throw missing(
        "a temperature that is solved needs \"weather\": a file with air temperature, wind and sunlight, such as "
        "\"weather\": {\"file\": \"amsterdam.epw\"}");
  const DocumentOutdoors about = outdoors_of_document(document, *weather);
  const auto kept = std::make_shared<const thermal::OutdoorsSeries>(about.outdoors.series);
  const thermal::OutdoorsSeries& series = *kept;
  const thermal::Stand stand = open_stand(about);
  const exposure::PastScene past(*scene.world, scene.departed.get());
  for (auto& [material, solved] : by_material)
    solved.thermal =
        thermal_of(document, document.scene.materials[material], scene, material, about.mean_air_k);
  const Firsts firsts = firsts_of(by_material, stand);
  for (auto& [material, solved] : by_material) {
    if (firsts.at(material) != material) {
      solved.classes = by_material.at(firsts.at(material)).classes;
      continue;
    }
    if (shared != nullptr && shared->contains(material)) {
      solved.classes = shared->at(material);
      continue;
    }
    solved.classes = std::make_shared<const thermal::SurfaceClasses>(
        kept, surface_of(solved.thermal, stand), threads, past.changes(), past.highest_m(), true);
    if (shared != nullptr) shared->emplace(material, solved.classes);
  }
  exposure::Neighbours::ByNumber by_number(scene.solved.size());
  for (const auto& [material, solved] : by_material) by_number[material] = solved.classes;
  const auto neighbours =
      std::make_shared<const exposure::Neighbours>(scene::Scene(scene), std::move(by_number), kSunRadius_rad);
  for (auto& [material, solved] : by_material)
    scene.solved[material] = solved.surface =
        std::make_shared<const exposure::SolvedSurface>(solved.classes, past, kSunRadius_rad, neighbours);
  choose_spending(scene, camera, by_material, firsts, threads);

  TemperatureErrors errors;
  errors.mirrors = may_show_unseen(scene);
  for (const auto& [material, solved] : by_material) {
    if (firsts.at(material) != material) continue;
    const double step_k = errors.by_material[material].step_k = step_error_k(solved, series, stand);
    errors.step_k = std::max(errors.step_k, step_k);
  }
  measure(errors, document, {scene, past, by_material, series, stand, kSunRadius_rad}, firsts,
          points_by_material(scene, camera, by_material, firsts, past, unseen || errors.mirrors), threads);
  errors.weather = about.statement;
  for (const std::string& note : about.outdoors.notes) errors.weather += "; " + note;
  if (log != nullptr) warn_of_another_sun(scene, series.rows.back(), *log);
  return errors;
}

}  // namespace ifov::session
