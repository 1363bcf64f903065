#include "session/loaded/single_views.h"

#include <algorithm>
#include <numbers>

#include "io/document/cameras/view_settings.h"
#include "io/document/document.h"
#include "sensor/camera.h"
#include "session/assembly/atmosphere/atmosphere_assembly.h"
#include "session/loaded/parts.h"
#include "transport/spectral_scene.h"

namespace ifov::session {
namespace {

constexpr double kDegreesOfView = 180.0 / std::numbers::pi;

void check_zeniths(const Parts& parts, const io::CameraDocument& written) {
  for (int k = 0; k < parts.camera->width_px(); ++k) {
    const double zenith_rad = sensor::nadir_angle_rad(parts.camera->ray({k + 0.5, 0.5}));
    if (!(zenith_rad <= kLowestView_rad))
      throw io::document_error(
          parts.document.sources, written.position,
          format(
              "under a modelled atmosphere the light of an area is told up to {:.0f} degrees from the vertical; view {} of '{}' "
              "is {:.1f} degrees away",
              kLowestView_rad * kDegreesOfView, k, written.model, zenith_rad * kDegreesOfView));
  }
}

}  // namespace

void check_single_views(const Parts& parts) {
  const io::CameraDocument& written = parts.document.sensor.camera;
  const auto* const settings = dynamic_cast<const io::ViewSettings*>(written.settings.get());
  if (settings == nullptr) return;
  const bool modelled = parts.document.atmosphere.modelled.has_value();
  if (settings->within_scene() && (modelled || parts.document.atmosphere.imported ||
                                   parts.scene.view_path.transmittance || parts.scene.view_path.radiance))
    throw io::document_error(
        parts.document.sources, written.position,
        format(
            "'{}' begins within the scene and looks to all sides, and the air of an atmosphere is worked out along lines of sight "
            "from above: leave 'atmosphere' out, and give the light at the ground by 'light.sun' and 'light.sky'",
            written.model));
  if (modelled) check_zeniths(parts, written);
}

void tell_irradiance(Parts& parts) {
  if (!parts.info.views || parts.atmosphere || parts.imported || parts.spectral_scene->has_view_path())
    return;
  const radiometry::SpectralNodes& nodes = *parts.nodes;
  const double sine = parts.scene.sun ? std::max(0.0, parts.scene.sun->direction.z) : 0.0;
  for (std::size_t c = 0; c < nodes.channel_count(); ++c)
    for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n)
      parts.info.channels[c].irradiance +=
          nodes.node_weight(n) *
          (sine * static_cast<double>(parts.spectral_scene->sun_irradiance()[n]) +
           std::numbers::pi * static_cast<double>(parts.spectral_scene->sky_radiance()[n]));
}

}  // namespace ifov::session
