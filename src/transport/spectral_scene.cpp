#include "transport/spectral_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "atmosphere/imported_atmosphere.h"
#include "atmosphere/sensor/directional_light.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "geometry/world.h"
#include "materials/bsdf/bsdf.h"
#include "materials/bsdf/node_bsdf.h"
#include "radiometry/planck_table.h"
#include "scene/lamp.h"
#include "scene/scene.h"
#include "transport/emitters.h"
#include "transport/lamp_light.h"
#include "transport/mirrors/emitter_mirrors.h"
#include "transport/mirrors/sun_lobes.h"
#include "transport/mirrors/sun_mirrors.h"
#include "transport/sky/ground_around.h"
#include "transport/sky/sky_dome.h"
#include "transport/sky/surroundings_light.h"
#include "transport/view_table.h"

namespace ifov::transport {

SpectralScene::SpectralScene(const scene::Scene& scene, const radiometry::SpectralNodes& nodes,
                             bool polarized)
    : scene_(scene),
      nodes_(nodes),
      polarized_(polarized),
      materials_(scene.materials, nodes, polarized),
      emission_(scene.states.size(), nodes.node_count()),
      light_(kRows, nodes.node_count()) {
  emit_surfaces();
  if (scene.sun) {
    const radiometry::Spectrum* product[] = {&scene.sun->irradiance, &scene.sun->transmittance};
    nodes.average_source(product, light_.values(kSunIrradiance));
  }
  sky_of_scene();
  light_surroundings();
  find_mirrors();

  if (scene.view_path.transmittance || scene.view_path.radiance) {
    has_view_path_ = true;
    nodes.average_surface(scene.view_path.transmittance.value_or(radiometry::Spectrum::constant(1.0)),
                          light_.values(kViewTransmittance));
    if (scene.view_path.radiance)
      nodes.average_source(*scene.view_path.radiance, light_.values(kViewRadiance));
  }
  find_emitters();
}

SpectralScene::SpectralScene(const scene::Scene& scene, const atmosphere::SensorAtmosphere& air,
                             bool polarized)
    : scene_(scene),
      nodes_(air.nodes()),
      polarized_(polarized),
      materials_(scene.materials, nodes_, polarized),
      emission_(scene.states.size(), nodes_.node_count()),
      light_(kRows, nodes_.node_count()),
      has_view_path_(true) {
  emit_surfaces();
  radiometry::SpectrumBlock emitted(1, node_count());
  emit(scene.surroundings, emitted.row(0));
  const GroundAround ground = air.directional() != nullptr
                                  ? couple_directional(air, emitted.values(0))
                                  : couple(air, air.sky_irradiance(), emitted.values(0));
  const math::Vec3 towards_sun = scene.sun ? scene.sun->direction : math::Vec3{1.0, 0.0, 0.0};
  dome_ = std::make_unique<SkyDome>(air, towards_sun, ground, polarized);
  if (!air.lines_of_sight().single())
    view_table_ = std::make_unique<ViewTable>(air, towards_sun, ground, polarized);
  else if (polarized && air.polarized())
    single_view_ = std::make_unique<ViewTable>(air, towards_sun, ground);
  light_heights(air);
  light_surroundings(&air);
  find_emitters();
  find_mirrors();
}

SpectralScene::SpectralScene(const scene::Scene& scene, const atmosphere::ImportedAtmosphere& air,
                             bool polarized)
    : scene_(scene),
      nodes_(air.nodes()),
      polarized_(polarized),
      materials_(scene.materials, nodes_, polarized),
      emission_(scene.states.size(), nodes_.node_count()),
      light_(kRows, nodes_.node_count()),
      has_view_path_(true) {
  emit_surfaces();
  std::vector<double> sky = air.sky_irradiance();
  if (!air.has_sky()) {
    sky_of_scene();
    for (std::size_t n = 0; n < node_count(); ++n) sky[n] = std::numbers::pi * light_.row(kSky)[n];
  }
  couple(air, sky, std::vector<float>(node_count(), 0.0f));
  light_surroundings();
  find_emitters();
  find_mirrors();
}

SpectralScene::~SpectralScene() = default;

const ViewTable* SpectralScene::polarized_path() const {
  if (single_view_) return single_view_.get();
  return view_table_ && view_table_->polarized() ? view_table_.get() : nullptr;
}

template <class Air>
GroundAround SpectralScene::couple(const Air& air, std::span<const double> sky_irradiance,
                                   std::span<const float> emitted) {
  const float* albedo = materials_.reflectance(scene_.surroundings.material);
  const double sine = scene_.sun ? std::max(0.0, scene_.sun->direction.z) : 0.0;
  std::vector<double> ground(node_count());
  for (std::size_t n = 0; n < node_count(); ++n) {
    const double direct = air.sun_irradiance()[n] * sine;
    const double back = air.spherical_albedo()[n];
    const double all =
        (direct + sky_irradiance[n] + std::numbers::pi * back * emitted[n]) / (1.0 - albedo[n] * back);
    ground[n] = emitted[n] + albedo[n] * all / std::numbers::pi;
    light_.row(kSunIrradiance)[n] = static_cast<float>(air.sun_irradiance()[n]);
    light_.row(kSky)[n] = static_cast<float>((all - direct) / std::numbers::pi);
    light_.row(kViewTransmittance)[n] = static_cast<float>(air.view_transmittance()[n]);
    light_.row(kDiffuse)[n] = static_cast<float>(air.diffuse_transmittance()[n]);
    light_.row(kViewRadiance)[n] =
        static_cast<float>(air.view_radiance()[n] + ground[n] * air.diffuse_transmittance()[n]);
  }
  return {std::move(ground), {}};
}

GroundAround SpectralScene::couple_directional(const atmosphere::SensorAtmosphere& air,
                                               std::span<const float> emitted) {
  const atmosphere::DirectionalLight& ground = *air.directional();
  GroundAround around{{emitted.begin(), emitted.end()}, std::vector<double>(node_count())};
  for (std::size_t n = 0; n < node_count(); ++n) {
    const double even = around.even[n], exitance = ground.exitance(n, even);
    around.shaped[n] = exitance / std::numbers::pi;
    const double down = air.sky_irradiance()[n] + ground.albedo[n] * exitance +
                        std::numbers::pi * air.spherical_albedo()[n] * even;
    light_.row(kSunIrradiance)[n] = static_cast<float>(air.sun_irradiance()[n]);
    light_.row(kSky)[n] = static_cast<float>(down / std::numbers::pi);
    light_.row(kViewTransmittance)[n] = static_cast<float>(air.view_transmittance()[n]);
    light_.row(kDiffuse)[n] = static_cast<float>(air.diffuse_transmittance()[n]);
    light_.row(kViewRadiance)[n] = static_cast<float>(
        air.view_radiance()[n] + even * air.diffuse_transmittance()[n] + around.shaped[n] * ground.view[n]);
  }
  return around;
}

void SpectralScene::light_heights(const atmosphere::SensorAtmosphere& air) {
  const std::vector<double>& heights_km = air.lines_of_sight().height().known();
  if (heights_km.size() < 2) return;
  for (const double height : heights_km) heights_m_.push_back(1e3 * height);
  sun_spectra_.resize(heights_km.size(), node_count());
  sky_spectra_.resize(heights_km.size(), node_count());
  for (std::size_t h = 0; h < heights_km.size(); ++h)
    for (std::size_t n = 0; n < node_count(); ++n) {
      const double ground = air.sky_at_height(0)[n];
      sun_spectra_.row(h)[n] = static_cast<float>(air.sun_at_height(h)[n]);
      sky_spectra_.row(h)[n] = ground > 0.0 ? static_cast<float>(air.sky_at_height(h)[n] / ground) : 1.0f;
    }
}

const float* SpectralScene::between_heights(const radiometry::SpectrumBlock& rows, double height_m,
                                            float* scratch) const {
  const auto above = std::upper_bound(heights_m_.begin() + 1, heights_m_.end() - 1, height_m);
  const std::size_t low = static_cast<std::size_t>(above - heights_m_.begin()) - 1;
  const float share = static_cast<float>(
      std::clamp((height_m - heights_m_[low]) / (heights_m_[low + 1] - heights_m_[low]), 0.0, 1.0));
  const float *a = rows.row(low), *b = rows.row(low + 1);
  for (std::size_t n = 0; n < stride(); ++n) scratch[n] = a[n] + share * (b[n] - a[n]);
  return scratch;
}

const float* SpectralScene::sun_irradiance(double height_m, float* scratch) const {
  return heights_m_.empty() ? sun_irradiance() : between_heights(sun_spectra_, height_m, scratch);
}

const float* SpectralScene::sky_share(double height_m, float* scratch) const {
  return between_heights(sky_spectra_, height_m, scratch);
}

void SpectralScene::sky_of_scene() {
  if (scene_.sky.radiance)
    nodes_.average_source(*scene_.sky.radiance, light_.values(kSky));
  else if (scene_.sky.temperature_k)
    nodes_.planck(*scene_.sky.temperature_k, light_.values(kSky));
}

const float* SpectralScene::lamp_radiance(std::uint32_t state) const {
  const std::uint32_t lamp = scene_.states[state].lamp;
  return lamp > 0 ? lamps_.row(lamp - 1) : nullptr;
}

void SpectralScene::emit(const scene::SurfaceState& state, float* spectrum) const {
  if (state.temperature_k <= 0.0) return;
  std::vector<float> planck(node_count());
  nodes_.planck(state.temperature_k, std::span<float>(planck));
  const float* emissivity = materials_.emissivity(state.material);
  for (std::size_t n = 0; n < planck.size(); ++n) spectrum[n] = emissivity[n] * planck[n];
}

std::vector<bool> SpectralScene::sought_assignments() const {
  return emitters_ != nullptr ? emitters_->assignments() : std::vector<bool>{};
}

void SpectralScene::find_emitters() {
  emitters_ = Emitters::find(*this);
  if (emitters_ != nullptr && emitters_->count() > 0) emitter_mirrors_ = EmitterMirrors::find(scene_);
}

void SpectralScene::find_mirrors() {
  const geometry::SurfaceSurvey* survey =
      scene_.sun && scene_.world != nullptr ? scene_.world->survey() : nullptr;
  if (survey != nullptr) mirrors_ = std::make_unique<SunMirrors>(scene_, *survey);
  const geometry::SurfaceSurvey* lobes =
      scene_.sun && scene_.world != nullptr ? scene_.world->lobe_survey() : nullptr;
  if (lobes != nullptr) lobes_ = std::make_unique<const SunLobes>(scene_, *lobes);
}

void SpectralScene::light_lamps() {
  if (scene_.lamps.empty()) return;
  lamps_.resize(scene_.lamps.size(), node_count());
  for (std::size_t k = 0; k < scene_.lamps.size(); ++k)
    nodes_.average_source(scene_.lamps[k].radiance, lamps_.values(k));
  std::vector<const scene::RadiationPattern*> patterns(scene_.states.size());
  bool any = false;
  for (std::uint32_t s = 0; s < scene_.states.size(); ++s) {
    const scene::Lamp* lamp = scene_.lamp_of(s);
    if (lamp == nullptr) continue;
    patterns[s] = lamp->pattern.get();
    any = any || patterns[s] != nullptr;
    if (patterns[s] != nullptr) continue;
    float *whole = emission_.row(s), *own = lamps_.row(scene_.states[s].lamp - 1);
    for (std::size_t n = 0; n < stride(); ++n) whole[n] += own[n];
  }
  if (any) patterned_ = std::move(patterns);
}

void SpectralScene::emit_surfaces() {
  bool directional = false;
  for (std::size_t s = 0; s < scene_.states.size(); ++s) {
    emit(scene_.states[s], emission_.row(s));
    directional = directional || materials_.directional(scene_.states[s].material) != nullptr;
  }
  if (directional) {
    black_.resize(scene_.states.size(), node_count());
    for (std::size_t s = 0; s < scene_.states.size(); ++s)
      if (scene_.states[s].temperature_k > 0.0 &&
          materials_.directional(scene_.states[s].material) != nullptr)
        nodes_.planck(scene_.states[s].temperature_k, black_.values(s));
  }
  constexpr double kBeyond_k = 0.5;     // beyond what maps hold, so that the table's ends are not met
  constexpr double kDeviations = 0.25;  // of solved temperatures, over their range
  if (const std::optional<scene::TemperatureRange> range = scene_.mapped_temperatures()) {
    const double beyond_k =
        kBeyond_k + (scene_.solved.empty() ? 0.0 : kDeviations * (range->hottest_k - range->coldest_k));
    planck_ = std::make_unique<radiometry::PlanckTable>(
        nodes_, std::max(0.5 * range->coldest_k, range->coldest_k - beyond_k), range->hottest_k + beyond_k);
  }
  light_lamps();
}

void SpectralScene::light_surroundings(const atmosphere::SensorAtmosphere* air) {
  const scene::SurfaceState& state = scene_.surroundings;
  const materials::Material& material = scene_.materials[state.material];
  const auto row = [&](LightRow which) {
    return std::vector<float>(light_.row(which), light_.row(which) + node_count());
  };
  SurroundingsLight::Lit lit{nodes_,
                             scene_.sun ? scene_.sun->direction : math::Vec3{1.0, 0.0, 0.0},
                             polarized_,
                             air,
                             row(kSunIrradiance),
                             row(kSky),
                             {},
                             std::vector<double>(node_count())};
  if (state.temperature_k > 0.0) {
    lit.black.resize(node_count());
    nodes_.planck(state.temperature_k, std::span<float>(lit.black));
    for (std::size_t n = 0; n < node_count(); ++n)
      lit.even[n] = static_cast<double>(materials_.emissivity(state.material)[n] * lit.black[n]);
  }
  around_ = SurroundingsLight::of(material, std::move(lit));
  float* around = light_.row(kSurroundings);
  if (around_ != nullptr)
    around_->add(SurroundingsLight::Part::emitted, {0.0, 0.0, -1.0}, nullptr, {around});
  else
    emit(scene_.surroundings, around);
  const float* reflectance = materials_.reflectance(scene_.surroundings.material);
  const double sine = scene_.sun ? std::max(0.0, scene_.sun->direction.z) : 0.0;
  for (std::size_t n = 0; n < node_count(); ++n)
    around[n] +=
        reflectance[n] *
        (light_.row(kSunIrradiance)[n] * static_cast<float>(sine / std::numbers::pi) + light_.row(kSky)[n]);
}

const float* SpectralScene::surroundings_radiance(math::Vec3 direction, float* scratch) const {
  if (around_ == nullptr) return surroundings_radiance();
  std::fill_n(scratch, stride(), 0.0f);
  around_->add_all(direction, nullptr, {scratch});
  return scratch;
}

void SpectralScene::split_surroundings(math::Vec3 direction, float* emitted, float* sun, float* sky) const {
  using Part = SurroundingsLight::Part;
  if (around_ != nullptr) {
    for (const auto& [part, row] : {std::pair{Part::emitted, emitted}, {Part::sun, sun}, {Part::sky, sky}}) {
      std::fill_n(row, stride(), 0.0f);
      around_->add(part, direction, nullptr, {row});
    }
    return;
  }
  const float* reflectance = materials_.reflectance(scene_.surroundings.material);
  const double sine = scene_.sun ? std::max(0.0, scene_.sun->direction.z) : 0.0;
  std::fill_n(emitted, stride(), 0.0f);
  emit(scene_.surroundings, emitted);
  for (std::size_t n = 0; n < stride(); ++n) {
    sun[n] = reflectance[n] * (light_.row(kSunIrradiance)[n] * static_cast<float>(sine / std::numbers::pi));
    sky[n] = reflectance[n] * light_.row(kSky)[n];
  }
}

const float* SpectralScene::absorption(std::uint32_t material) const {
  const materials::NodeBsdf* model = materials_.directional(material);
  return model == nullptr ? nullptr : model->absorption();
}

void SpectralScene::mapped_black(const scene::Constituent& constituent, float* spectrum) const {
  static thread_local radiometry::SpectrumBlock rows;
  if (rows.rows() != 3 || rows.stride() != stride()) rows.resize(3, node_count());
  const auto estimated = [&](double middle_k, double deviation_k, float* of) {
    planck_->row(middle_k, of);
    if (!(deviation_k > 0.0)) return;
    // Planck's law bends: the mean over estimates T + d is B(T) + B'' sigma^2 / 2, of which the second part is taken away.
    float *below = rows.row(0), *above = rows.row(1);
    planck_->row(middle_k - deviation_k, below);
    planck_->row(middle_k + deviation_k, above);
    for (std::size_t n = 0; n < stride(); ++n) of[n] = 2.0f * of[n] - 0.5f * (below[n] + above[n]);
  };
  estimated(constituent.mapped_temperature_k, constituent.deviation_k, spectrum);
  if (constituent.times == 1.0f) return;
  float* other = rows.row(2);
  estimated(static_cast<double>(constituent.else_k), static_cast<double>(constituent.else_deviation_k),
            other);
  for (std::size_t n = 0; n < stride(); ++n)
    spectrum[n] = other[n] + constituent.times * (spectrum[n] - other[n]);
}

const float* SpectralScene::black(const scene::Constituent& constituent, float* scratch) const {
  if (constituent.mapped_temperature_k > 0.0) {
    mapped_black(constituent, scratch);
    return scratch;
  }
  return scene_.states[constituent.state].temperature_k > 0.0 ? black_.row(constituent.state) : nullptr;
}

const float* SpectralScene::thermal_emission(const scene::Constituent& constituent, double cosine,
                                             float* scratch, float* work) const {
  const double own_k = scene_.states[constituent.state].temperature_k;
  const materials::NodeBsdf* model = materials_.directional(constituent.material);
  if (constituent.mapped_temperature_k <= 0.0 && model == nullptr)
    return own_k > 0.0 ? emission_.row(constituent.state) : nullptr;
  const float* __restrict emissivity = materials_.emissivity(constituent.material);
  if (model != nullptr) {
    model->emissivity(cosine, work, scratch);
    emissivity = work;
  }
  if (!black_body(constituent, scratch)) return nullptr;
  for (std::size_t n = 0; n < stride(); ++n) scratch[n] *= emissivity[n];
  return scratch;
}

const float* SpectralScene::emission(const scene::Constituent& constituent, double cosine,
                                     math::Vec3 outgoing, float* scratch, float* work) const {
  const float* lamp = lamp_radiance(constituent.state);
  if (lamp == nullptr) return thermal_emission(constituent, cosine, scratch, work);
  const scene::RadiationPattern* pattern = lamp_pattern(constituent.state);
  if (pattern == nullptr && constituent.mapped_temperature_k <= 0.0 &&
      materials_.directional(constituent.material) == nullptr)
    return emission_.row(constituent.state);  // with the lamp's light
  const float share = pattern != nullptr ? static_cast<float>(pattern->at(outgoing)) : 1.0f;
  const float* thermal = thermal_emission(constituent, cosine, scratch, work);
  for (std::size_t n = 0; n < stride(); ++n)
    scratch[n] = share * lamp[n] + (thermal != nullptr ? thermal[n] : 0.0f);
  return scratch;
}

bool SpectralScene::black_body(const scene::Constituent& constituent, float* spectrum) const {
  if (constituent.mapped_temperature_k > 0.0) {
    mapped_black(constituent, spectrum);
    return true;
  }
  if (!(scene_.states[constituent.state].temperature_k > 0.0)) return false;
  std::copy_n(black_.row(constituent.state), stride(), spectrum);
  return true;
}

bool SpectralScene::emission_q(const scene::ResolvedSurface& surface, math::Vec3 outgoing,
                               float* scratch) const {
  const double cosine = std::abs(math::dot(surface.shading_normal, outgoing));
  float *black = scratch + stride(), *share = black + stride();
  bool any = false;
  for (const scene::Constituent& constituent : surface) {
    const materials::NodeBsdf* model = materials_.directional(constituent.material);
    if (model == nullptr || !model->polarized_emission(cosine, share) || !black_body(constituent, black))
      continue;
    const float weight = static_cast<float>(constituent.weight);
    for (std::size_t n = 0; n < stride(); ++n)
      scratch[n] = (any ? scratch[n] : 0.0f) + weight * black[n] * share[n];
    any = true;
  }
  return any;
}

const float* SpectralScene::emission(const scene::ResolvedSurface& surface, math::Vec3 outgoing,
                                     float* scratch) const {
  const double cosine = std::abs(math::dot(surface.shading_normal, outgoing));
  float *part = scratch + stride(), *work = part + stride();
  if (surface.count == 1) return emission(surface.constituents[0], cosine, outgoing, scratch, work);
  bool any = false;
  for (const scene::Constituent& constituent : surface) {
    const float* spectrum = emission(constituent, cosine, outgoing, part, work);
    if (spectrum == nullptr) continue;
    const float weight = static_cast<float>(constituent.weight);
    if (any)
      for (std::size_t n = 0; n < stride(); ++n) scratch[n] += weight * spectrum[n];
    else
      for (std::size_t n = 0; n < stride(); ++n) scratch[n] = weight * spectrum[n];
    any = true;
  }
  return any ? scratch : nullptr;
}

std::vector<double> SpectralScene::white_reflected() const {
  const double sine = scene_.sun ? std::max(0.0, scene_.sun->direction.z) : 0.0;
  std::vector<double> white = white_below_lamps(*this);
  for (std::size_t c = 0; c < white.size(); ++c)
    for (std::size_t n = nodes_.first_node(c); n < nodes_.first_node(c + 1); ++n) {
      const double reflected = light_.row(kSunIrradiance)[n] * sine / std::numbers::pi + light_.row(kSky)[n];
      white[c] += nodes_.node_weight(n) * reflected * (has_view_path_ ? view_transmittance()[n] : 1.0f);
    }
  return white;
}

std::vector<double> SpectralScene::path_radiance() const {
  std::vector<double> path(nodes_.channel_count(), 0.0);
  if (!has_view_path_) return path;
  for (std::size_t c = 0; c < path.size(); ++c)
    for (std::size_t n = nodes_.first_node(c); n < nodes_.first_node(c + 1); ++n)
      path[c] += nodes_.node_weight(n) * view_radiance()[n];
  return path;
}

}  // namespace ifov::transport
