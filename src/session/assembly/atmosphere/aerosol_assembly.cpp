#include "session/assembly/atmosphere/aerosol_assembly.h"

#include <algorithm>
#include <utility>

#include "atmosphere/particles/aerosol_description.h"
#include "atmosphere/particles/aerosol_types.h"
#include "atmosphere/particles/given_particles.h"
#include "atmosphere/particles/measured_particles.h"
#include "atmosphere/particles/mie_particles.h"
#include "atmosphere/particles/particle_layer.h"
#include "core/format.h"
#include "io/atmosphere/aeronet_inversion.h"
#include "io/atmosphere/phase_function_file.h"
#include "io/document/aerosol_document.h"
#include "radiometry/refractive_index.h"
#include "session/assembly/shared/spectrum_assembly.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {
namespace {

using atmosphere::GivenParticles;

atmosphere::SizeDistribution sizes(const io::MieDocument& mie) {
  constexpr double kUsualVariance = 0.1;
  if (mie.radius_um) return atmosphere::lognormal(*mie.radius_um, mie.deviation.value());
  return atmosphere::gamma_by_effective_radius(mie.effective_radius_um.value(),
                                               mie.effective_variance.value_or(kUsualVariance));
}

std::shared_ptr<const atmosphere::Particles> spheres(const io::DocumentSources& sources,
                                                     const io::MieDocument& mie) {
  const io::IndexDocument& index = mie.index;
  return with_position(sources, mie.position, [&] {
    if (!index.name.empty()) {
      const radiometry::RefractiveIndex* whole = radiometry::whole_refractive_index(index.name);
      const radiometry::RefractiveIndex& built_in =
          whole != nullptr ? *whole : radiometry::refractive_index(index.name);
      return std::make_shared<const atmosphere::MieParticles>(sizes(mie), built_in.n, built_in.k);
    }
    return std::make_shared<const atmosphere::MieParticles>(
        sizes(mie), assemble_spectrum(sources, index.n.value(), "n of the haze"),
        assemble_spectrum(sources, index.k.value(), "k of the haze"));
  });
}

std::shared_ptr<const atmosphere::Particles> particles(const io::DocumentSources& sources,
                                                       const io::OwnHazeDocument& haze) {
  if (haze.mie) return spheres(sources, *haze.mie);
  constexpr double kUsualHumidity_percent = 70.0;
  if (haze.kind)
    return atmosphere::particles_of(atmosphere::aerosol_type(*haze.kind),
                                    haze.humidity_percent.value_or(kUsualHumidity_percent));
  const io::SpectrumDocument& of_albedo = haze.single_scattering_albedo.value();
  const radiometry::Spectrum albedo =
      assemble_spectrum(sources, of_albedo, "single-scattering albedo of the haze");
  const auto made = [&](const SourcePosition& position, const auto& scatters) {
    return with_position(sources, position, [&] {
      return std::make_shared<const GivenParticles>(haze.angstrom.value(), albedo, scatters);
    });
  };
  // What is wrong with the albedo is told where it stands.
  made(of_albedo.position, radiometry::Spectrum::constant(0.0));
  if (haze.phase_function)
    return made(haze.phase_function->position, with_position(sources, haze.phase_function->position, [&] {
                  return io::read_phase_functions(haze.phase_function->path);
                }));
  return made(haze.asymmetry.value().position,
              assemble_spectrum(sources, *haze.asymmetry, "asymmetry of the haze"));
}

std::shared_ptr<const atmosphere::MeasuredParticles> measured(const io::DocumentSources& sources,
                                                              const io::AeronetDocument& written) {
  io::AeronetInversion found = with_position(sources, written.file.position, [&] {
    return io::read_aeronet_inversion(written.file.path, written.time);
  });
  atmosphere::MeasuredParticles::Optics optics{std::move(found.wavelength_um), std::move(found.optical_depth),
                                               std::move(found.single_scattering_albedo),
                                               std::move(found.asymmetry)};
  if (written.phase_functions)
    optics.scatters = with_position(sources, written.phase_functions->position, [&] {
      return io::read_aeronet_phase_functions(written.phase_functions->path, found.time);
    });
  return with_position(sources, written.file.position, [&] {
    return std::make_shared<const atmosphere::MeasuredParticles>(std::move(optics));
  });
}

std::shared_ptr<const atmosphere::ParticleLayer> layer_of(const io::DocumentSources& sources,
                                                          const io::OwnHazeDocument& haze) {
  atmosphere::ParticleLayer layer;
  if (haze.aeronet) {
    const auto particles = measured(sources, *haze.aeronet);
    layer.optical_depth = particles->optical_depth(layer.wavelength_um);
    layer.particles = particles;
  } else {
    layer.optical_depth = haze.optical_depth.value();
    layer.wavelength_um = haze.wavelength_um;
    layer.particles = particles(sources, haze);
  }
  layer.base_km = haze.base_km;
  layer.top_km = haze.top_km;
  layer.scale_height_km = haze.scale_height_km;
  layer.heights = haze.heights;
  return std::make_shared<const atmosphere::ParticleLayer>(std::move(layer));
}

std::vector<const io::OwnHazeDocument*> own_parts(const io::AerosolDocument& written) {
  if (written.own) return {&*written.own};
  std::vector<const io::OwnHazeDocument*> parts;
  for (const io::OwnHazeDocument& part : written.mixture) parts.push_back(&part);
  return parts;
}

std::string statement_of(const io::OwnHazeDocument& haze) {
  const auto altitude = [](const std::optional<double>& km, const char* otherwise) {
    return km ? format("{:.4g} km", *km) : std::string(otherwise);
  };
  std::string what = haze.aeronet ? "a retrieval of AERONET"
                                  : format("{}optical depth {:.4g} at {:.4g} um",
                                           haze.mie    ? "spheres, "
                                           : haze.kind ? *haze.kind + ", "
                                                       : std::string(),
                                           haze.optical_depth.value(), haze.wavelength_um);
  if (!haze.heights.empty())
    return what + format(", from {:.4g} to {:.4g} km by a table", haze.heights.front().altitude_km,
                         haze.heights.back().altitude_km);
  const double scale_km =
      haze.scale_height_km.value_or(haze.top_km ? 0.0 : atmosphere::LayerHeights::kUsualScale_km);
  return what + format(", from {} to {}{}", altitude(haze.base_km, "the ground"),
                       altitude(haze.top_km, "the end of the air"),
                       scale_km > 0.0 ? format(", falling to 1/e over {:.4g} km", scale_km) : std::string());
}

}  // namespace

atmosphere::AerosolDescription assemble_aerosol(const io::DocumentSources& sources,
                                                const io::AerosolDocument& written) {
  atmosphere::AerosolDescription description = written.tables;
  if (written.own) description.own.push_back(layer_of(sources, *written.own));
  for (const io::OwnHazeDocument& part : written.mixture) description.own.push_back(layer_of(sources, part));
  return description;
}

std::string haze_statement(const io::AerosolDocument& written) {
  std::string text;
  for (const io::OwnHazeDocument* part : own_parts(written))
    text += (text.empty() ? "" : "; ") + statement_of(*part);
  return text;
}

std::string haze_polarization(const io::AerosolDocument& written) {
  bool spheres = false, tables = false, none = false;
  for (const io::OwnHazeDocument* part : own_parts(written)) {
    const bool composed = part->kind && atmosphere::aerosol_type(*part->kind).composed;
    if (part->mie || composed)
      spheres = true;
    else if (part->kind)
      tables = true;
    else
      none = true;
  }
  if (spheres && !tables && !none) return "it polarizes light as spheres do";
  if (tables && !spheres && !none) return "it polarizes light as haze of the tables is taken to";
  if (none && !spheres && !tables) return "light that it scatters is not polarized";
  return "its spheres and its types of the tables polarize light that they scatter, what else it has does not";
}

bool has_aerosol_of(const io::AerosolDocument& written, const std::string& type) {
  const std::vector<const io::OwnHazeDocument*> parts = own_parts(written);
  if (parts.empty()) return written.tables.type == type;
  return std::any_of(parts.begin(), parts.end(),
                     [&](const io::OwnHazeDocument* part) { return part->kind == type; });
}

}  // namespace ifov::session
