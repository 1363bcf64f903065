#include "session/assembly/surfaces/lamp_assembly.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "io/document/light_document.h"
#include "io/document/shapes/measures.h"
#include "io/photometry/ies.h"
#include "radiometry/photometry.h"
#include "radiometry/planck.h"
#include "scene/lamp.h"
#include "session/assembly/shared/map_frame.h"
#include "session/assembly/shared/spectrum_assembly.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {
namespace {

using Form = io::LampDocument::Form;

/// Planck's law over the wavelengths that hold all of its power but 1e-6: W m-2 sr-1 um-1.
radiometry::Spectrum blackbody(double temperature_k) {
  constexpr double kFirst_um_k = 700.0, kLast_um_k = 4e5;  // times the temperature
  constexpr int kSteps = 2600;
  std::vector<double> wavelength_um, radiance;
  for (int k = 0; k <= kSteps; ++k) {
    const double um = kFirst_um_k / temperature_k * std::pow(kLast_um_k / kFirst_um_k, k / double{kSteps});
    wavelength_um.push_back(um);
    radiance.push_back(radiometry::planck_w_m2_sr_um(um, temperature_k));
  }
  return {std::move(wavelength_um), std::move(radiance), radiometry::OutsideRange::zero, "light of a lamp"};
}

/// Where the file's plane of 0 deg points.
math::Vec3 plane_of_zero(const io::LampDocument& lamp) {
  const math::Vec3 down = math::normalized(lamp.towards);
  const math::Vec3 along{std::sin(lamp.azimuth_rad), std::cos(lamp.azimuth_rad), 0.0};
  constexpr double kParallel = 1e-6;
  return math::length(math::cross(down, along)) > kParallel ? along : math::Vec3{0.0, 0.0, 1.0};
}

class LampAssembly {
 public:
  LampAssembly(const io::DocumentSources& sources, const MapFrame& frame, scene::Scene& scene)
      : sources_(sources), frame_(frame), scene_(scene) {
    materials::Material black;
    black.name = "light source";
    material_ = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(std::move(black));
  }

  PlacedLamp place(const io::LampDocument& lamp) {
    PlacedLamp placed;
    placed.is_disk = lamp.form == Form::disk;
    const math::Point3 at = lamp.at_m - frame_.document_offset_m();
    const math::Transform sized = math::Transform::scaling({lamp.radius_m, lamp.radius_m, lamp.radius_m});
    placed.scene_from_unit = placed.is_disk ? io::upright_to(at, lamp.towards) * sized
                                            : math::Transform::translation(at - math::Point3{}) * sized;
    placed.state.material = material_;
    const std::string key = key_of(lamp);
    const auto known = known_.find(key);
    if (known != known_.end()) {
      placed.state.lamp = known->second;
      return placed;
    }
    scene_.lamps.push_back(light(lamp));
    placed.state.lamp = static_cast<std::uint32_t>(scene_.lamps.size());
    known_[key] = placed.state.lamp;
    return placed;
  }

 private:
  /// What its light depends on; spectra by where they stand in the document.
  static std::string key_of(const io::LampDocument& lamp) {
    const auto place = [](const auto& spectrum) {
      return spectrum ? format("{}:{}", spectrum->position.line, spectrum->position.column) : std::string();
    };
    return format("{} {} {} {} {} {} {} {} {} {} {} {} {} {}", static_cast<int>(lamp.form), lamp.radius_m,
                  lamp.towards.x, lamp.towards.y, lamp.towards.z, lamp.half_angle_rad, lamp.edge_rad,
                  lamp.intensities ? lamp.intensities->path : std::string(), lamp.azimuth_rad,
                  lamp.temperature_k.value_or(0.0), place(lamp.spectrum), place(lamp.radiance),
                  lamp.power_w.value_or(0.0), lamp.flux_lm.value_or(0.0));
  }

  scene::Lamp light(const io::LampDocument& source) {
    scene::Lamp lamp;
    std::optional<radiometry::LuminousIntensity> measured;
    double solid_angle_sr = 4.0 * std::numbers::pi;  // that the brightest intensity would have to fill
    if (source.form == Form::disk) {
      solid_angle_sr = std::numbers::pi;
      lamp.pattern = std::make_shared<scene::OneSidePattern>(source.towards);
    }
    if (source.form == Form::spot) {
      const auto spot =
          std::make_shared<scene::SpotPattern>(source.towards, source.half_angle_rad, source.edge_rad);
      solid_angle_sr = spot->solid_angle_sr();
      lamp.pattern = spot;
    }
    if (source.form == Form::goniometer) {
      measured = with_position(sources_, source.intensities->position,
                               [&] { return io::read_ies(source.intensities->path); });
      solid_angle_sr = measured->flux_lm() / measured->highest();
      lamp.pattern =
          std::make_shared<scene::GoniometerPattern>(*measured, source.towards, plane_of_zero(source));
    }
    const double area_m2 = std::numbers::pi * source.radius_m * source.radius_m;  // as seen
    const radiometry::Spectrum form = spectrum_of(source);
    double factor = 1.0;
    if (source.power_w) {
      if (form.is_constant())
        throw InputError(
            "the light is the same at all wavelengths, without end: its power has no meaning; give "
            "a table, or 'flux'");
      factor = *source.power_w /
               (radiometry::integral(form, form.first_um(), form.last_um()) * area_m2 * solid_angle_sr);
    } else if (source.flux_lm || measured) {
      const double flux_lm = source.flux_lm ? *source.flux_lm : measured->flux_lm();
      const double seen = radiometry::luminous(form);
      if (!(seen > 0.0)) throw InputError("nothing of the light is visible: its luminous flux says nothing");
      factor = flux_lm / (seen * area_m2 * solid_angle_sr);
    }
    lamp.radiance = form.scaled(factor);
    return lamp;
  }

  radiometry::Spectrum spectrum_of(const io::LampDocument& source) {
    if (source.temperature_k) return blackbody(*source.temperature_k);
    const auto& given = source.radiance ? source.radiance : source.spectrum;
    if (!given) return radiometry::Spectrum::constant(1.0);
    const radiometry::Spectrum spectrum = assemble_spectrum(sources_, *given, "light of a lamp");
    with_position(sources_, given->position, [&] {
      if (spectrum.minimum() < 0.0) throw InputError("the light is below 0 at some wavelength");
      if (!(spectrum.maximum() > 0.0)) throw InputError("the light is 0 at all wavelengths");
    });
    // A lamp gives off nothing where its table does not reach.
    return spectrum.is_constant() ? spectrum : spectrum.with_outside(radiometry::OutsideRange::zero);
  }

  const io::DocumentSources& sources_;
  const MapFrame& frame_;
  scene::Scene& scene_;
  std::uint32_t material_ = 0;
  std::map<std::string, std::uint32_t> known_;
};

}  // namespace

std::vector<PlacedLamp> assemble_lamps(const io::DocumentSources& sources,
                                       std::span<const io::LampDocument> lamps, const MapFrame& frame,
                                       scene::Scene& scene) {
  std::vector<PlacedLamp> placed;
  if (lamps.empty()) return placed;
  LampAssembly assembly(sources, frame, scene);
  for (const io::LampDocument& lamp : lamps)
    with_position(sources, lamp.position, [&] { placed.push_back(assembly.place(lamp)); });
  return placed;
}

}  // namespace ifov::session
