#include "session/assembly/whole/sensor_assembly.h"

#include <algorithm>

#include "geometry/world.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/cameras/mount_error.h"
#include "io/document/sensor_document.h"
#include "io/spectra/channel_table.h"
#include "io/spectra/csv_spectrum.h"
#include "render/polarized/polarimetry.h"
#include "render/tile_sink.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "sensor/flying/picture_stack.h"
#include "sensor/view_list.h"
#include "sensor/view_list_camera.h"
#include "session/assembly/shared/map_frame.h"
#include "session/assembly/shared/scene_maps.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {

namespace {

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
