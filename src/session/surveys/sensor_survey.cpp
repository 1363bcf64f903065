#include "session/surveys/sensor_survey.h"

#include <cmath>

#include "ifov/sensor.h"
#include "io/document/cameras/mount_error.h"
#include "io/document/cameras/view_settings.h"
#include "io/document/detector_document.h"
#include "io/document/origin_document.h"
#include "io/document/sensor_document.h"
#include "render/image_info.h"
#include "sensor/along_track.h"
#include "sensor/camera.h"
#include "sensor/detector/illumination.h"
#include "sensor/detector/memory.h"
#include "sensor/detector/read_out.h"
#include "sensor/flying/image_way.h"
#include "sensor/mtf.h"
#include "session/assembly/shared/scene_maps.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/whole/detector_assembly.h"
#include "session/assembly/whole/element_sides.h"
#include "session/assembly/whole/noise_assembly.h"
#include "session/assembly/whole/psf_assembly.h"
#include "session/assembly/whole/sensor_assembly.h"
#include "session/surveys/sensor_columns.h"

namespace ifov::session {
namespace {

constexpr double kNyquist = 0.5;

/// Where a ray meets z = 0; nothing of one that does not look down at it.
std::optional<math::Point3> on_ground(const math::Ray& ray) {
  if (!(ray.direction.z < 0.0)) return std::nullopt;
  return ray.origin_m + ray.direction * (-ray.origin_m.z / ray.direction.z);
}

void survey_camera(const sensor::Camera& camera, SensorDescription& told) {
  told.width_px = camera.width_px(), told.height_px = camera.height_px();
  told.gsd_m = camera.line_gsd_m(camera.middle_line_px());
  told.ifov_rad = camera.ifov(camera.middle_line_px()).x_rad;
  const auto left = on_ground(camera.ray({0.0, camera.middle_line_px()}));
  const auto right = on_ground(camera.ray({static_cast<double>(camera.width_px()), camera.middle_line_px()}));
  if (left && right) told.swath_m = math::length(*right - *left);
  if (const auto motion = sensor::frame_motion(camera, 0.0)) {
    if (camera.exposure_s() > 0.0) told.smear_px = motion->exposure_px;
    if (camera.row_period_s() > 0.0) told.row_shift_px = motion->row_px;
  }
}

/// NEdT where the channel sees what is warm.
void tell_nedt(const radiometry::Channel& channel, double at_k, SensorDescription::Channel& told) {
  constexpr double kThermal_um = 2.5;
  if (!(told.nedl > 0.0) || !(at_k > 0.0) || channel.centre_um < kThermal_um) return;
  told.nedt = told.nedl / radiometry::channel_planck_slope_w_m2_sr_um_k(channel, at_k);
  told.nedt_at_k = at_k;
}

/// Noise is the same of less light, and a larger share of it.
void tell_corner(const ChannelDetector& detector, const sensor::ReadOut& read_out,
                 const radiometry::Channel& channel, const SensorDescription& image,
                 SensorDescription::Channel& told) {
  if (!detector.figures.exists() || !detector.figures.is_vignetted()) return;
  const double light =
      sensor::Illumination(detector.figures, image.width_px, image.height_px, read_out).at(0.0, 0.0);
  told.corner_light = light;
  SensorDescription::Channel there;
  there.nedl = detector.figures.lit_by(light).noise_w_m2_sr_um(told.radiance);
  if (told.radiance > 0.0) told.corner_snr = told.radiance / there.nedl;
  if (told.nedt_at_k) tell_nedt(channel, *told.nedt_at_k, there), told.corner_nedt = there.nedt;
}

void tell_memory(const ChannelDetector& detector, SensorDescription::Channel& told) {
  const sensor::SignalMemory memory(detector.lag, detector.inertia);
  if (memory.none()) return;
  told.step_share = memory.weights().front();
  told.memory_mtf = memory.modulation(kNyquist);
}

void tell_detector(const ChannelDetector& detector, const radiometry::Channel& channel, double obscuration,
                   double fill_factor, double cycles_px, SensorDescription::Channel& told) {
  const sensor::Detector& figures = detector.figures;
  told.has_detector = true;
  told.radiance = detector.reference_w_m2_sr_um;
  told.photons = detector.photons_per_radiance * told.radiance;
  told.electrons = figures.electrons_per_radiance * told.radiance;
  told.background = figures.background, told.dark = figures.dark;
  if (std::isfinite(figures.largest_signal()))
    told.well_share = figures.mean_electrons(told.radiance) / figures.largest_signal();
  if (figures.is_corrected())
    told.correction_left = figures.correction_noise(told.radiance) / figures.electrons_per_radiance;
  if (told.radiance > 0.0) told.snr = told.radiance / told.nedl;
  const double pitch_um = 1e6 * std::sqrt(detector.optics.area_m2 / fill_factor);
  told.diffraction_mtf = sensor::diffraction_mtf(channel.centre_um * detector.optics.f_number / pitch_um,
                                                 obscuration, cycles_px);
}

}  // namespace

SensorDescription survey_sensor(const io::DocumentSources& sources, const io::SensorDocument& written,
                                const io::OriginDocument& origin) {
  constexpr double kWarm_k = 300.0;
  if (dynamic_cast<const io::ViewSettings*>(written.camera.settings.get()) != nullptr)
    throw io::document_error(
        sources, written.camera.position,
        format("'{}' makes no picture, so that nothing follows for its pixels; `ifov check` tells what its "
               "views are of",
               written.camera.model));
  const io::SensorDocument sensor = with_element_sides(sources, written);
  SensorDescription told;
  const std::unique_ptr<sensor::Camera> camera = with_position(sources, sensor.camera.position, [&] {
    const MapsOfScene maps(sources, origin);
    io::CameraSite site{origin.offset_m, 0.0};
    site.maps = &maps;
    return io::with_mounts(sources, [&] { return sensor.camera.settings->build(site); });
  });
  survey_camera(*camera, told);
  const std::vector<radiometry::Channel> channels = assemble_channels(sources, sensor.channels);
  const std::vector<ChannelDetector> detectors = assemble_detectors(sources, sensor, channels);
  const std::vector<double> noise = assemble_noise(sources, sensor, channels);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    SensorDescription::Channel& one = told.channels.emplace_back();
    one.name = channels[c].name, one.centre_um = channels[c].centre_um, one.fwhm_um = channels[c].fwhm_um;
    const sensor::AlongTrack swept = camera->along_line();
    one.pixel_mtf = swept.square(sensor.fill_factor)
                        ? sensor::square_mtf(std::sqrt(sensor.fill_factor), kNyquist)
                        : swept.mtf(kNyquist);
    const double cycles_px = kNyquist * swept.pitch_px;
    one.psf_mtf = with_position(sources, sensor.psf_position,
                                [&] { return psf_mtf(sources, sensor, channels[c].centre_um, cycles_px); });
    one.nedl = noise[c];
    tell_memory(detectors[c], one);
    if (!detectors[c].figures.exists()) {
      tell_nedt(channels[c], kWarm_k, one);
      continue;
    }
    told.f_number = detectors[c].optics.f_number;
    tell_detector(detectors[c], channels[c], sensor.optics->obscuration, sensor.fill_factor, cycles_px, one);
    tell_nedt(channels[c],
              radiometry::channel_brightness_temperature_k(channels[c], detectors[c].reference_w_m2_sr_um),
              one);
  }
  for (std::size_t c = 0; c < channels.size(); ++c)
    tell_corner(detectors[c], sensor.camera.settings->read_out(), channels[c], told, told.channels[c]);
  tell_columns(sources, sensor, channels, told);
  return told;
}

}  // namespace ifov::session
