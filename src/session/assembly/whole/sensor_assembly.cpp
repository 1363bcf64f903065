#include "session/assembly/whole/sensor_assembly.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/overloaded.h"
#include "geometry/world.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/cameras/mount_error.h"
#include "io/document/detector_document.h"
#include "io/document/pupil_document.h"
#include "io/document/sensor_document.h"
#include "io/raster/raster.h"
#include "io/spectra/channel_table.h"
#include "io/spectra/csv_spectrum.h"
#include "render/polarized/polarimetry.h"
#include "render/tile_sink.h"
#include "scene/scene.h"
#include "sensor/airy_aperture.h"
#include "sensor/camera.h"
#include "sensor/flying/picture_stack.h"
#include "sensor/psf.h"
#include "sensor/pupil.h"
#include "sensor/view_list.h"
#include "sensor/view_list_camera.h"
#include "session/assembly/shared/map_frame.h"
#include "session/assembly/shared/scene_maps.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {

namespace {

/// Of a PSF within its cut.
constexpr double kFarthestPsf_px = 64.0;

struct BuildChannel {
  const io::DocumentSources& sources;
  const io::ChannelDocument& channel;

  radiometry::Channel operator()(const io::GaussianChannel& s) const {
    return radiometry::Channel::gaussian(channel.name, s.centre_um, s.fwhm_um);
  }
  radiometry::Channel operator()(const io::TopHatChannel& s) const {
    return radiometry::Channel::top_hat(channel.name, s.from_um, s.to_um);
  }
  radiometry::Channel operator()(const io::MonochromaticChannel& s) const {
    return radiometry::Channel::monochromatic(channel.name, s.at_um);
  }
  radiometry::Channel operator()(const io::TabulatedChannel& s) const {
    return with_position(sources, s.file.position, [&] {
      const io::WavelengthUnit unit =
          s.um_per_unit == 1.0 ? io::WavelengthUnit::micrometres : io::WavelengthUnit::nanometres;
      if (s.band.empty()) {
        io::CsvSpectrumOptions options;
        options.unit = unit;
        options.value_column = s.column;
        options.outside = radiometry::OutsideRange::zero;
        return radiometry::Channel::tabulated(channel.name, io::read_csv_spectrum(s.file.path, options));
      }
      std::vector<radiometry::Channel> channels = io::read_channels(s.file.path, unit);
      std::string names;
      for (radiometry::Channel& candidate : channels) {
        if (candidate.name == s.band) {
          candidate.name = channel.name;
          return candidate;
        }
        names += (names.empty() ? "'" : ", '") + candidate.name + "'";
      }
      throw InputError(format("'{}' has no band '{}'; it has {}", s.file.path, s.band, names));
    });
  }
};

}  // namespace

std::unique_ptr<sensor::Camera> assemble_camera(const io::DocumentSources& sources,
                                                const io::CameraDocument& camera,
                                                const io::OriginDocument& origin,
                                                const geometry::World& world, std::uint64_t seed) {
  return with_position(sources, camera.position, [&] {
    io::CameraSite site{origin.offset_m, world.heights().high_m, world.heights().low_m, seed};
    const MapsOfScene maps(sources, origin);
    site.maps = &maps;
    if (const auto period = world.period()) site.period_m = {period->x_m, period->y_m};
    return io::with_mounts(sources, [&] { return camera.settings->build(site); });
  });
}

std::vector<radiometry::Channel> assemble_channels(const io::DocumentSources& sources,
                                                   std::span<const io::ChannelDocument> written) {
  std::vector<radiometry::Channel> channels;
  for (const io::ChannelDocument& channel : written)
    channels.push_back(with_position(sources, channel.position, [&] {
      return std::visit(BuildChannel{sources, channel}, channel.response);
    }));
  return channels;
}

std::shared_ptr<const render::Polarimetry> assemble_polarimetry(const io::SensorDocument& sensor) {
  using radiometry::MuellerMatrix;
  const std::vector<io::ChannelDocument>& channels = sensor.channels;
  auto polarimetry = std::make_shared<render::Polarimetry>();
  polarimetry->stokes = sensor.stokes;
  const bool bare = std::none_of(channels.begin(), channels.end(), [](const io::ChannelDocument& channel) {
    return channel.polarizer || channel.retarder;
  });
  if (bare && !sensor.stokes) return nullptr;
  if (bare) return polarimetry;
  for (const io::ChannelDocument& channel : channels) {
    MuellerMatrix optics;
    if (channel.retarder)
      optics = MuellerMatrix::linear_retarder(channel.retarder->retardance_rad, channel.retarder->angle_rad);
    if (channel.polarizer)
      optics = MuellerMatrix::linear_diattenuator(1.0, 1.0 / channel.polarizer->extinction,
                                                  channel.polarizer->angle_rad) *
               optics;
    polarimetry->optics.push_back(optics);
  }
  return polarimetry;
}

std::optional<io::AiryPsf> diffraction_of(const io::SensorDocument& sensor) {
  if (const auto* airy = std::get_if<io::AiryPsf>(&sensor.psf)) return *airy;
  const auto* pupil = std::get_if<std::shared_ptr<const io::PupilDocument>>(&sensor.psf);
  if (pupil == nullptr) return std::nullopt;
  return io::AiryPsf{(*pupil)->aperture_m, (*pupil)->wavelength_um, (*pupil)->obscuration};
}

sensor::AiryAperture airy_aperture(const io::SensorDocument& sensor) {
  const io::AiryPsf airy = diffraction_of(sensor).value();
  const io::OpticsDocument none;
  const io::OpticsDocument& optics = sensor.optics ? *sensor.optics : none;
  const auto camera = sensor.camera.settings->optics();
  sensor::AiryAperture made;
  made.wavelength_um = airy.wavelength_um.value_or(0.0);
  made.pitch_m = camera ? camera->pitch_m : sensor.detector->pitch_m.value();
  const std::optional<double> focal_length_m =
                                  camera ? std::optional(camera->focal_length_m) : optics.focal_length_m,
                              aperture_m = airy.aperture_m ? airy.aperture_m : optics.aperture_m;
  if (aperture_m && focal_length_m)
    made.diameter_m = *aperture_m, made.focal_length_m = *focal_length_m;
  else
    made.diameter_m = 1.0, made.focal_length_m = optics.f_number.value();
  made.obscuration = airy.obscuration.value_or(airy.aperture_m ? 0.0 : optics.obscuration);
  return made;
}

sensor::Pupil assemble_pupil(const io::SensorDocument& sensor, double wavelength_um) {
  const io::PupilDocument& told = *std::get<std::shared_ptr<const io::PupilDocument>>(sensor.psf);
  sensor::Pupil pupil;
  pupil.aperture = airy_aperture(sensor);
  if (!(pupil.aperture.wavelength_um > 0.0)) pupil.aperture.wavelength_um = wavelength_um;
  if (told.spiders) {
    pupil.spiders = told.spiders->count;
    pupil.spider_width = told.spiders->width;
    pupil.spider_angle_rad = told.spiders->angle_rad;
  }
  pupil.defocus_m = told.defocus_m.value_or(0.0);
  for (const io::PupilDocument::Coefficient& one : told.zernike)
    pupil.wavefront.push_back({one.noll, one.rms_m.value_or(0.0), one.rms_waves.value_or(0.0)});
  return pupil;
}

namespace {

/// Where to cut a Gaussian, sigmas, beside things that are `contrast` times as bright as the rest: what is left out of them is 1e-4 of the rest at
/// most, unless more than `widest_px` would be kept. 4.4 to 8.
double gaussian_cut_sigmas(double sigma_px, double contrast, double widest_px) {
  constexpr double kLeast = 4.4, kMost = 8.0, kStep = 0.1, kLeftOut = 1e-4;
  double cut = kLeast;
  const auto left_out = [&] {
    const double kept = std::erf(cut / std::numbers::sqrt2);
    return 1.0 - kept * kept;
  };
  while (contrast * left_out() > kLeftOut && cut + kStep <= std::min(kMost, widest_px / sigma_px))
    cut += kStep;
  return cut;
}

}  // namespace

std::unique_ptr<sensor::Psf> assemble_psf(const io::DocumentSources& sources,
                                          const io::SensorDocument& sensor, double wavelength_um,
                                          double contrast) {
  return with_position(sources, sensor.psf_position, [&] {
    using Made = std::unique_ptr<sensor::Psf>;
    Made made = std::visit(
        Overloaded{[](const io::NoPsf&) -> Made { return nullptr; },
                   [&](const io::GaussianPsf& gaussian) -> Made {
                     return sensor::make_gaussian_psf(
                         gaussian.sigma_px,
                         gaussian_cut_sigmas(gaussian.sigma_px, contrast, kFarthestPsf_px));
                   },
                   [&](const io::AiryPsf&) -> Made {
                     sensor::AiryAperture aperture = airy_aperture(sensor);
                     if (!(aperture.wavelength_um > 0.0)) aperture.wavelength_um = wavelength_um;
                     return sensor::make_airy_psf(aperture);
                   },
                   [&](const std::shared_ptr<const io::PupilDocument>&) -> Made {
                     return sensor::make_pupil_psf(assemble_pupil(sensor, wavelength_um));
                   },
                   [](const io::KernelPsf& kernel) -> Made {
                     const io::Raster raster = io::read_raster(kernel.file.path);
                     std::vector<double> values(
                         raster.values.begin(),
                         raster.values.begin() + static_cast<std::ptrdiff_t>(raster.width) * raster.height);
                     return sensor::make_kernel_psf(raster.width, raster.height, std::move(values),
                                                    kernel.samples_per_pixel);
                   }},
        sensor.psf);
    if (made != nullptr && made->half_width_px() > kFarthestPsf_px)
      throw InputError(format(
          "the PSF reaches {:.4g} pixels from its middle, and images are blurred within {:g}; expected a narrower one, or wider "
          "pixels",
          made->half_width_px(), kFarthestPsf_px));
    return made;
  });
}

render::ImageInfo image_info(const io::OriginDocument& origin, const sensor::Camera& camera,
                             const std::vector<radiometry::Channel>& channels, const scene::Scene& scene,
                             math::Vec3 map_offset_m) {
  render::ImageInfo info;
  info.width_px = camera.width_px();
  info.height_px = camera.height_px();
  if (const sensor::PictureStack* const pictures = camera.pictures())
    info.sweep_lines = pictures->lines_of_each();
  for (const radiometry::Channel& channel : channels)
    info.channels.push_back({channel.name, channel.centre_um, channel.fwhm_um});
  info.materials = scene::truth_materials(scene).names;
  if (const auto grid = camera.ground_grid()) {
    const math::Point3 corner_m = grid->upper_left_m + map_offset_m;
    info.has_map = true;
    info.map_x_m = corner_m.x;
    info.map_y_m = corner_m.y;
    info.gsd_m = grid->gsd_m;
    info.map_rotation_rad = grid->rotation_rad;
  }
  info.map_projection = map_system(origin);
  if (const sensor::ViewListCamera* const views = camera.view_list()) {
    info.views = views->list();
    if (info.views->kind == sensor::ViewList::Kind::points) info.radiance_unit = "W m-2 um-1";
  }
  return info;
}

}  // namespace ifov::session
