#include "honesty/plain_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "geometry/world.h"
#include "materials/bsdf/bsdf.h"

namespace ifov::benchmarks {

namespace {

constexpr int kCertainSurfaces = 4;   // before a path may end by chance
constexpr double kGlintMargin = 1.5;  // a window's half-width over that of the glint

double cone_sr(double half_angle_rad) {
  const double half_sine = std::sin(0.5 * half_angle_rad);
  return 4.0 * std::numbers::pi * half_sine * half_sine;
}

}  // namespace

geometry::SurfacePoint nearest(const scene::Scene& scene, const math::Ray& ray) {
  geometry::SurfacePoint hit;
  scene.world->intersect({&ray, 1}, {&hit, 1});
  return hit;
}

const scene::Constituent& pick_constituent(const scene::ResolvedSurface& surface, RandomStream& random) {
  double left = random.uniform();
  for (const scene::Constituent& part : surface)
    if ((left -= part.weight) < 0.0) return part;
  return surface.constituents[surface.count - 1];
}

math::Vec3 mirror_image(math::Vec3 direction, math::Vec3 normal) {
  return direction - 2.0 * math::dot(direction, normal) * normal;
}

namespace {

/// cos_theta along the axis, the rest around it.
math::Vec3 about(math::Vec3 axis, double cosine, double angle) {
  const math::Vec3 other = std::abs(axis.x) < 0.6 ? math::Vec3{1.0, 0.0, 0.0} : math::Vec3{0.0, 1.0, 0.0};
  const math::Vec3 right = math::normalized(math::cross(axis, other)), up = math::cross(right, axis);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  return math::normalized(cosine * axis + sine * std::cos(angle) * right + sine * std::sin(angle) * up);
}

}  // namespace

math::Vec3 cosine_direction(math::Vec3 axis, RandomStream& random) {
  const double cosine = std::sqrt(1.0 - random.uniform());
  return about(axis, cosine, 2.0 * std::numbers::pi * random.uniform());
}

math::Vec3 cone_direction(math::Vec3 axis, double half_angle_rad, RandomStream& random) {
  const double half_sine = std::sin(0.5 * half_angle_rad);
  const double cosine = 1.0 - 2.0 * half_sine * half_sine * random.uniform();
  return about(axis, cosine, 2.0 * std::numbers::pi * random.uniform());
}

PlainTracer::PlainTracer(const scene::Scene& scene, const PlainSpectra& spectra, const sensor::Camera& camera,
                         const PlainFootprint& footprint, PlainHints hints)
    : scene_(scene),
      spectra_(spectra),
      surfaces_(scene, spectra),
      camera_(camera),
      footprint_(footprint),
      hints_(std::move(hints)) {
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m) {
    if (scene.materials[m].name == "lamp") lamp_ = m;
    if (!surfaces_.is_plain(m) && (scene.materials[m].temperature_k.value_or(0.0) > 0.0 ||
                                   !hints_.lamps.empty() || !hints_.sources.empty()))
      throw std::logic_error(
          "the plain tracer knows of warm things and lamps with Lambert's law and mirrors alone");
  }
  if (lamp_ != geometry::kNoMaterial) {
    lamp_radiance_.resize(spectra.columns());
    spectra.add_emission(lamp_, scene.materials[lamp_].temperature_k.value_or(0.0), 1.0,
                         std::vector<double>(spectra.columns(), 1.0), lamp_radiance_);
  }
  const auto look_at = [&](math::Point3 point, double radius_m) {
    sampling::FocalPoint place;
    if (!camera.project(point, place)) return;
    math::Ray view;
    camera.rays({&place, 1}, {&view, 1});
    const double down = std::abs(view.direction.z);  // what lies on level ground looks shorter than it is
    windows_.push_back({place.x_px, place.y_px, radius_m / (camera.gsd_m(point) * down)});
  };
  for (const PlainHints::Ball& ball : hints_.bright) look_at(ball.centre_m, ball.radius_m);
  for (const PlainHints::Ball& lamp : hints_.lamps) look_at(lamp.centre_m, lamp.radius_m);
  for (const PlainHints::Source& source : hints_.sources) look_at(source.ball.centre_m, source.ball.radius_m);
  if (!scene.sun || scene.sun->half_angle_rad <= 0.0) return;
  for (const PlainHints::Ball& mirror : hints_.mirrors) {
    math::Ray view;
    const sampling::FocalPoint middle{0.5 * camera.width_px(), 0.5 * camera.height_px()};
    camera.rays({&middle, 1}, {&view, 1});
    const math::Vec3 half_way = math::normalized(scene.sun->direction - view.direction);
    look_at(mirror.centre_m + mirror.radius_m * half_way,
            kGlintMargin * 0.5 * mirror.radius_m * std::sin(scene.sun->half_angle_rad));
  }
}

math::Vec3 PlainTracer::sun_direction(RandomStream& random) const {
  return scene_.sun->half_angle_rad > 0.0
             ? cone_direction(scene_.sun->direction, scene_.sun->half_angle_rad, random)
             : scene_.sun->direction;
}

bool PlainTracer::blocked(math::Point3 from_m, math::Vec3 direction, double length_m) const {
  const math::Ray ray{from_m, direction, 0.0, length_m};
  std::uint8_t answer = 0;
  scene_.world->occluded({&ray, 1}, {&answer, 1});
  return answer != 0;
}

void PlainTracer::add_sun(const geometry::SurfacePoint& hit, math::Vec3 side, std::uint32_t material,
                          std::span<const double> throughput, RandomStream& random,
                          std::span<double> sum) const {
  const math::Vec3 direction = sun_direction(random);
  const double cosine = math::dot(direction, side);
  if (direction.z <= 0.0) return;
  const std::vector<double>& factor =
      cosine > 0.0 ? spectra_.reflectance(material) : spectra_.transmittance(material);
  const math::Vec3 lit_side = cosine > 0.0 ? side : -side;
  std::vector<double> share;
  if (!surfaces_.comes_through({hit.position_m + hit.offset_m * lit_side, direction}, share)) return;
  // The cone's solid angle over the disc's projected one, in which the irradiance is counted.
  const double alpha = scene_.sun->half_angle_rad, half_cosine = std::cos(0.5 * alpha);
  const double weight = std::abs(cosine) / std::numbers::pi / (half_cosine * half_cosine);
  for (std::size_t c = 0; c < sum.size(); ++c)
    sum[c] += weight * throughput[c] * factor[c] * share[c] * spectra_.sun()[c];
}

void PlainTracer::add_sun(const geometry::SurfacePoint& hit, const materials::BsdfEvent& view,
                          std::uint32_t material, std::span<const double> throughput, RandomStream& random,
                          std::span<double> sum) const {
  materials::BsdfEvent event = view;
  event.incoming = sun_direction(random);
  const math::Vec3 side = view.normal.as_vector();
  const double cosine = math::dot(event.incoming, side);
  if (event.incoming.z <= 0.0) return;
  event.side = cosine > 0.0 ? materials::Side::reflected : materials::Side::transmitted;
  if (cosine <= 0.0 && !surfaces_.bsdf(material).may_transmit()) return;
  const math::Vec3 lit_side = cosine > 0.0 ? side : -side;
  std::vector<double> share;
  if (!surfaces_.comes_through({hit.position_m + hit.offset_m * lit_side, event.incoming}, share)) return;
  const std::vector<double> bsdf = surfaces_.evaluate(material, event);
  const double alpha = scene_.sun->half_angle_rad, half_cosine = std::cos(0.5 * alpha);
  double weight = std::abs(cosine) / (half_cosine * half_cosine);
  if (alpha > 0.0) {
    const double sought = 1.0 / cone_sr(alpha);
    weight *= sought / (sought + surfaces_.pdf(material, event));
  }
  for (std::size_t c = 0; c < sum.size(); ++c)
    sum[c] += weight * throughput[c] * bsdf[c] * share[c] * spectra_.sun()[c];
}

void PlainTracer::add_lamps(const geometry::SurfacePoint& hit, math::Vec3 side, std::uint32_t material,
                            std::span<const double> throughput, RandomStream& random,
                            std::span<double> sum) const {
  for (const PlainHints::Ball& lamp : hints_.lamps) {
    const double height = 2.0 * random.uniform() - 1.0, angle = 2.0 * std::numbers::pi * random.uniform();
    const double around = std::sqrt(1.0 - height * height);
    const math::Vec3 normal{around * std::cos(angle), around * std::sin(angle), height};
    const math::Vec3 way = lamp.centre_m + lamp.radius_m * normal - hit.position_m;
    const double length = math::length(way);
    const math::Vec3 direction = way / length;
    const double at_lamp = -math::dot(direction, normal), here = math::dot(direction, side);
    if (at_lamp <= 0.0) continue;
    const math::Vec3 lit_side = here > 0.0 ? side : -side;
    if (blocked(hit.position_m + hit.offset_m * lit_side, direction, length * (1.0 - 1e-5))) continue;
    const std::vector<double>& factor =
        here > 0.0 ? spectra_.reflectance(material) : spectra_.transmittance(material);
    const double weight =
        4.0 * lamp.radius_m * lamp.radius_m * std::abs(here) * at_lamp / (length * length);  // area / pi
    for (std::size_t c = 0; c < sum.size(); ++c)
      sum[c] += weight * throughput[c] * factor[c] * lamp_radiance_[c];
  }
}

double PlainHints::Source::towards_radiance(math::Vec3 outgoing) const {
  const double cosine = math::dot(outgoing, towards) / math::length(towards);
  if (form == Form::disk) return cosine > 0.0 ? radiance : 0.0;
  if (form == Form::ball) return radiance;
  const double beyond = std::acos(std::clamp(cosine, -1.0, 1.0)) - half_angle_rad;
  if (beyond <= 0.0) return radiance;
  if (beyond >= edge_rad) return 0.0;
  const double t = 1.0 - beyond / edge_rad;
  return radiance * t * t * (3.0 - 2.0 * t);
}

double PlainTracer::radiance_of_source(const geometry::SurfacePoint& hit, math::Vec3 outgoing) const {
  for (const PlainHints::Source& source : hints_.sources) {
    const math::Vec3 from_centre = hit.position_m - source.ball.centre_m;
    const double away = math::length(from_centre) / source.ball.radius_m;
    const bool on_disk = std::abs(math::dot(from_centre, source.towards)) <
                         1e-3 * source.ball.radius_m * math::length(source.towards);
    if (source.form == PlainHints::Source::Form::disk ? away < 1.001 && on_disk : std::abs(away - 1.0) < 1e-3)
      return source.towards_radiance(outgoing);
  }
  return 0.0;
}

/// One point of each, uniform over what faces this place of a ball's surface or over a disk.
void PlainTracer::add_sources(const geometry::SurfacePoint& hit, math::Vec3 side, std::uint32_t material,
                              std::span<const double> throughput, RandomStream& random,
                              std::span<double> sum) const {
  for (const PlainHints::Source& source : hints_.sources) {
    const double radius_m = source.ball.radius_m;
    math::Vec3 direction;
    double solid_angle_sr = 0.0;
    if (source.form == PlainHints::Source::Form::disk) {
      const math::Vec3 axis = math::normalized(source.towards);
      const math::Vec3 level = math::normalized(
          math::cross(axis, std::abs(axis.x) < 0.6 ? math::Vec3{1.0, 0.0, 0.0} : math::Vec3{0.0, 1.0, 0.0}));
      const double angle = 2.0 * std::numbers::pi * random.uniform(),
                   out_m = radius_m * std::sqrt(random.uniform());
      const math::Vec3 way = source.ball.centre_m + out_m * std::cos(angle) * level +
                             out_m * std::sin(angle) * math::cross(axis, level) - hit.position_m;
      const double length = math::length(way);
      direction = way / length;
      solid_angle_sr = std::numbers::pi * radius_m * radius_m * std::max(0.0, -math::dot(direction, axis)) /
                       (length * length);
    } else {
      const math::Vec3 way = source.ball.centre_m - hit.position_m;
      const double sine = radius_m / math::length(way);
      if (sine >= 1.0) continue;
      direction = cone_direction(math::normalized(way), std::asin(sine), random);
      solid_angle_sr = cone_sr(std::asin(sine));
    }
    const double here = math::dot(direction, side);
    const math::Vec3 lit_side = here > 0.0 ? side : -side;
    const std::vector<double>& factor =
        here > 0.0 ? spectra_.reflectance(material) : spectra_.transmittance(material);
    const geometry::SurfacePoint met = nearest(scene_, {hit.position_m + hit.offset_m * lit_side, direction});
    if (!met.hit()) continue;
    const math::Vec3 from_centre = met.position_m - source.ball.centre_m;
    if (math::length(from_centre) > 1.001 * radius_m) continue;  // something stands before it
    const double radiance = radiance_of_source(met, -direction);
    for (std::size_t c = 0; c < sum.size(); ++c)
      sum[c] += std::abs(here) / std::numbers::pi * solid_angle_sr * radiance * throughput[c] * factor[c];
  }
}

void PlainTracer::escape(const Way& way, Light& light) const {
  const math::Vec3 direction = way.ray.direction;
  const bool up = direction.z >= 0.0;
  const std::vector<double>& around = up ? spectra_.sky() : spectra_.surroundings();
  for (std::size_t c = 0; c < light.sum.size(); ++c) light.sum[c] += way.throughput[c] * around[c];
  if (!up || !scene_.sun || scene_.sun->half_angle_rad <= 0.0) return;
  const double sine = std::sin(scene_.sun->half_angle_rad);
  if (math::dot(direction, scene_.sun->direction) <= 0.0 ||
      math::length(math::cross(direction, scene_.sun->direction)) >= sine)
    return;
  const double found =
      way.only_deltas ? 1.0 : way.pdf / (way.pdf + 1.0 / cone_sr(scene_.sun->half_angle_rad));
  for (std::size_t c = 0; c < light.sum.size(); ++c)
    light.sum[c] += found * way.throughput[c] * spectra_.sun()[c] / (std::numbers::pi * sine * sine);
}

void PlainTracer::may_lack(const Way& way, std::uint32_t material, Light& light) const {
  if (!way.only_deltas || !way.bent || !scene_.sun) return;
  const std::vector<double>&reflectance = spectra_.reflectance(material),
        &transmittance = spectra_.transmittance(material);
  for (std::size_t c = 0; c < light.above.size(); ++c)
    light.above[c] += way.throughput[c] * (reflectance[c] + transmittance[c]) * spectra_.sun()[c] /
                      std::numbers::pi * hints_.focus * static_cast<double>(hints_.around_mirrors.size());
}

bool PlainTracer::scatter(const geometry::SurfacePoint& hit, std::uint32_t material, RandomStream& random,
                          Way& way, Light& light) const {
  const math::Vec3 side = side_of(hit);
  const materials::BsdfEvent view = surfaces_.view(material, -way.ray.direction, side);
  const bool delta = surfaces_.is_delta(material);
  if (!delta) {
    if (scene_.sun) add_sun(hit, view, material, way.throughput, random, light.sum);
    may_lack(way, material, light);
  }
  PlainSurfaces::Step step;
  if (!surfaces_.step(material, view, random, step)) return false;
  for (std::size_t c = 0; c < way.throughput.size(); ++c) way.throughput[c] *= step.factors[c];
  const bool through = step.event.side == materials::Side::transmitted;
  way.medium = surfaces_.medium_after(material, step.event.side, way.medium);
  const bool straight =
      delta && through && surfaces_.bsdf(material).passage() == materials::Passage::straight;
  if (!delta)
    way.only_deltas = false, way.pdf = step.pdf;
  else if (!straight)  // how the Sun's light comes here from the corner is the photons' affair
    way.bent = true, way.pdf = 0.0;
  way.delta_before = delta;
  way.ray = {hit.position_m + (through ? -hit.offset_m : hit.offset_m) * side, step.event.incoming};
  return true;
}

void PlainTracer::trace(math::Ray ray, double weight, RandomStream& random, Light& light) const {
  const std::size_t columns = spectra_.columns();
  Way way{ray, std::vector<double>(columns, weight)};
  for (int surfaces = 0;; ++surfaces) {
    const geometry::SurfacePoint hit = nearest(scene_, way.ray);
    if (!hit.hit()) return escape(way, light);
    if (way.medium != nullptr)
      for (std::size_t c = 0; c < columns; ++c)
        way.throughput[c] *= std::exp(-(*way.medium)[c] * hit.distance_m);
    const scene::ResolvedSurface surface = scene_.resolve(hit);
    for (const scene::Constituent& part : surface)
      if (part.material != lamp_ || way.delta_before || hints_.lamps.empty())
        spectra_.add_emission(part.material,
                              part.mapped_temperature_k > 0.0 ? part.mapped_temperature_k
                                                              : scene_.states[part.state].temperature_k,
                              part.weight, way.throughput, light.sum);

    if (way.delta_before && !hints_.sources.empty()) {
      const double radiance = radiance_of_source(hit, -way.ray.direction);
      for (std::size_t c = 0; c < columns; ++c) light.sum[c] += way.throughput[c] * radiance;
    }

    const std::uint32_t material = pick_constituent(surface, random).material;
    const std::vector<double>&reflectance = spectra_.reflectance(material),
          &transmittance = spectra_.transmittance(material);
    const math::Vec3 side = side_of(hit);
    const double most_reflected = *std::max_element(reflectance.begin(), reflectance.end());
    const double most_let_through = *std::max_element(transmittance.begin(), transmittance.end());
    if (most_reflected + most_let_through <= 0.0) return;

    if (!surfaces_.is_plain(material)) {
      if (!scatter(hit, material, random, way, light)) return;
    } else if (surfaces_.is_delta(material)) {
      for (std::size_t c = 0; c < columns; ++c) way.throughput[c] *= reflectance[c];
      way.ray = {hit.position_m + hit.offset_m * side, mirror_image(way.ray.direction, side)};
      way.delta_before = way.bent = true;
      way.pdf = 0.0;
    } else {
      if (scene_.sun) add_sun(hit, side, material, way.throughput, random, light.sum);
      add_lamps(hit, side, material, way.throughput, random, light.sum);
      add_sources(hit, side, material, way.throughput, random, light.sum);
      may_lack(way, material, light);
      const double reflected_probability = most_reflected / (most_reflected + most_let_through);
      const bool back = random.uniform() < reflected_probability;
      const math::Vec3 axis = back ? side : -side;
      for (std::size_t c = 0; c < columns; ++c)
        way.throughput[c] *=
            back ? reflectance[c] / reflected_probability : transmittance[c] / (1.0 - reflected_probability);
      way.ray = {hit.position_m + hit.offset_m * axis, cosine_direction(axis, random)};
      way.only_deltas = way.delta_before = false;
      way.pdf = 0.0;
    }
    if (surfaces < kCertainSurfaces) continue;
    const double survival = std::min(0.95, most_reflected + most_let_through);
    if (random.uniform() >= survival) return;
    for (double& factor : way.throughput) factor /= survival;
  }
}

double PlainTracer::window_density(const std::vector<Window>& windows, double x_px, double y_px) const {
  double density = 0.0;
  for (const Window& window : windows)
    if (std::abs(x_px - window.x_px) <= window.half_px && std::abs(y_px - window.y_px) <= window.half_px)
      density += 0.25 / (window.half_px * window.half_px);
  return windows.empty() ? 0.0 : density / static_cast<double>(windows.size());
}

PlainMean PlainTracer::pixel(int x, int y, int side, std::uint64_t key) const {
  const double centre_x = x + 0.5, centre_y = y + 0.5;
  std::vector<Window> windows;
  for (const Window& window : windows_)
    if (std::abs(window.x_px - centre_x) < footprint_.reach_px() + window.half_px &&
        std::abs(window.y_px - centre_y) < footprint_.reach_px() + window.half_px)
      windows.push_back(window);

  const std::size_t channels = spectra_.channels();
  PlainMean result{std::vector<double>(channels), std::vector<double>(channels),
                   std::vector<double>(channels)};
  std::vector<double> squares(channels);
  for (int replicate = 0; replicate < kReplicates; ++replicate) {
    RandomStream random(key, static_cast<std::uint64_t>(replicate));
    Light light{std::vector<double>(spectra_.columns()), std::vector<double>(spectra_.columns())};
    const double each = 1.0 / (static_cast<double>(side) * side);
    const auto look = [&](double x_px, double y_px, double weight) {
      const sampling::FocalPoint point{x_px, y_px};
      math::Ray ray;
      camera_.rays({&point, 1}, {&ray, 1});
      trace(ray, weight, random, light);
      ++result.paths;
    };
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const double u = (i + random.uniform()) / side, v = (j + random.uniform()) / side;
        const sampling::FocalPoint offset = footprint_.draw(u, v, random);
        const double px = centre_x + offset.x_px, py = centre_y + offset.y_px;
        if (windows.empty()) {
          look(px, py, each);
          continue;
        }
        // Both ways of drawing a point weigh it by the sum of their densities.
        const double own = footprint_.density(offset.x_px, offset.y_px);
        look(px, py, each * own / (own + window_density(windows, px, py)));
        const Window& window = windows[random.index(windows.size())];
        const double wx = window.x_px + window.half_px * (2.0 * u - 1.0);
        const double wy = window.y_px + window.half_px * (2.0 * v - 1.0);
        const double there = footprint_.density(wx - centre_x, wy - centre_y);
        if (there > 0.0) look(wx, wy, each * there / (there + window_density(windows, wx, wy)));
      }
    const std::vector<double> value = spectra_.at_sensor(light.sum),
                              above = spectra_.at_sensor(light.above, false);
    for (std::size_t c = 0; c < channels; ++c) {
      result.mean[c] += value[c] / kReplicates;
      squares[c] += value[c] * value[c] / kReplicates;
      result.above[c] += above[c] / kReplicates;
    }
  }
  for (std::size_t c = 0; c < channels; ++c)
    result.error[c] =
        std::sqrt(std::max(0.0, squares[c] - result.mean[c] * result.mean[c]) / (kReplicates - 1));
  return result;
}

}  // namespace ifov::benchmarks
