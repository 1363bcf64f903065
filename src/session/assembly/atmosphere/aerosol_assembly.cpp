#include "session/assembly/atmosphere/aerosol_assembly.h"

#include "atmosphere/particles/given_particles.h"
#include "atmosphere/particles/mie_particles.h"
#include "atmosphere/particles/particle_layer.h"
#include "core/format.h"
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

}  // namespace

atmosphere::AerosolDescription assemble_aerosol(const io::DocumentSources& sources,
                                                const io::AerosolDocument& written) {
  atmosphere::AerosolDescription description = written.tables;
  if (!written.own) return description;
  const io::OwnHazeDocument& haze = *written.own;
  atmosphere::ParticleLayer layer;
  layer.optical_depth = haze.optical_depth;
  layer.wavelength_um = haze.wavelength_um;
  layer.particles = particles(sources, haze);
  layer.base_km = haze.base_km;
  layer.top_km = haze.top_km;
  layer.scale_height_km = haze.scale_height_km;
  description.own = std::make_shared<const atmosphere::ParticleLayer>(layer);
  return description;
}

std::string haze_statement(const io::OwnHazeDocument& haze) {
  const auto altitude = [](const std::optional<double>& km, const char* otherwise) {
    return km ? format("{:.4g} km", *km) : std::string(otherwise);
  };
  const double scale_km =
      haze.scale_height_km.value_or(haze.top_km ? 0.0 : atmosphere::LayerHeights::kUsualScale_km);
  return format("{}optical depth {:.4g} at {:.4g} um, from {} to {}{}", haze.mie ? "spheres, " : "",
                haze.optical_depth, haze.wavelength_um, altitude(haze.base_km, "the ground"),
                altitude(haze.top_km, "the end of the air"),
                scale_km > 0.0 ? format(", falling to 1/e over {:.4g} km", scale_km) : std::string());
}

}  // namespace ifov::session
