#include "session/response_assembly.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/document/atmosphere_document.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/document.h"
#include "render/wings/outshining.h"
#include "sampling/footprint_groups.h"
#include "sampling/means/region_interval.h"
#include "sampling/pixel_footprint.h"
#include "sensor/along_track.h"
#include "sensor/camera.h"
#include "sensor/channel_footprints.h"
#include "sensor/detector/brightness_scale.h"
#include "sensor/detector/read_out.h"
#include "sensor/psf.h"
#include "sensor/psf_wings.h"
#include "sensor/spectrometer/column_responses.h"
#include "session/assembly/whole/across_track.h"
#include "session/assembly/whole/element_sides.h"
#include "session/assembly/whole/noise_assembly.h"
#include "session/assembly/whole/psf_assembly.h"
#include "session/assembly/whole/sensor_assembly.h"
#include "session/loaded/parts.h"
#include "session/loaded/single_views.h"

namespace ifov::session {
namespace {

/// A PSF that is wider than this takes more pixels around each than an image is worth.
constexpr double kWidest_px = 64.0;

/// Wings of what is longer are not tabulated.
constexpr double kLongest_px = 4.0;

std::vector<sensor::ChannelResponse> responses(const Parts& parts, double along_x, double along_y) {
  const io::SensorDocument& sensor = *parts.sensor;
  const std::vector<radiometry::Channel>& channels = parts.channels;
  const bool by_channel = psf_depends_on_wavelength(sensor);
  std::vector<sensor::ChannelResponse> responses;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    sensor::ChannelResponse& response = responses.emplace_back();
    if (by_channel) response.wavelength_um = channels[c].centre_um;
    if (const auto& shift = sensor.channels[c].shift_px)
      response.shift_px = {(*shift)[0] * along_x, (*shift)[1] * along_y};
    if (!parts.keystone_px.empty()) response.across_px = parts.keystone_px[parts.told_channel(c)];
  }
  return responses;
}

/// How far a group's footprint may be from a channel's, in shares of its energy: nothing where it is the channel's own.
double apart_from(const sensor::ChannelGroup& group, std::span<const sensor::ChannelResponse> channels,
                  int channel) {
  const bool own =
      channels[static_cast<std::size_t>(group.like)] == channels[static_cast<std::size_t>(channel)];
  return own ? 0.0 : sensor::kOneFootprint;
}

/// Wings stand about the shift alone: the share of the energy that they have elsewhere where a column's pixels look further aside. Beyond
/// the cut, at r, the density of a round PSF goes as r^-3 (docs/theory/sensor.md), so that a step of s takes s (1 - E) / r of it.
double wings_apart(const sensor::Psf& psf, const std::vector<double>& across_px) {
  double farthest = 0.0;
  for (const double step : across_px) farthest = std::max(farthest, std::abs(step));
  if (!(farthest > 0.0)) return 0.0;
  return (1.0 - psf.kept()) * std::min(1.0, 1.5 * farthest / psf.half_width_px());
}

std::unique_ptr<sensor::PsfWings> wings_of(const std::shared_ptr<const sensor::Psf>& psf, double fill_factor,
                                           const sensor::AlongTrack& along, const sensor::AlongTrack& swept,
                                           sampling::Point2 shift) {
  if (along.square(fill_factor) && swept.square(fill_factor))
    return std::make_unique<sensor::PsfWings>(*psf, fill_factor, shift);
  const bool along_x = !swept.square(fill_factor);
  const double side = std::sqrt(fill_factor), motion = along_x ? swept.exposure_px : along.exposure_px;
  const auto spread = sensor::spread_cut(psf, along_x ? swept : along, along_x);
  return std::make_unique<sensor::PsfWings>(
      *spread, along_x ? sampling::Point2{motion, side} : sampling::Point2{side, motion}, shift);
}

}  // namespace

void assemble_sensor(Parts& parts) {
  const io::DocumentSources& sources = parts.document.sources;
  const io::SensorDocument& document = parts.document.sensor;
  parts.told_channels = assemble_channels(sources, document.channels);
  parts.camera = assemble_camera(sources, document.camera, parts.document.scene.origin, *parts.scene.world,
                                 parts.document.seed);
  const int width = parts.camera->width_px();
  parts.responses = assemble_smile(sources, document, parts.told_channels, width);
  parts.keystone_px = assemble_keystone(sources, document, parts.told_channels, width);
  parts.channels = parts.responses ? parts.responses->all_carried() : parts.told_channels;
  if (parts.responses) parts.most_spread = parts.responses->most_spread();
  parts.sensor = std::make_unique<const io::SensorDocument>(
      sensor_as_carried(with_element_sides(sources, document), parts.responses.get()));
  parts.polarimetry = assemble_polarimetry(*parts.sensor);
}

std::size_t Parts::told_channel(std::size_t carried) const {
  return responses ? responses->channel_of(carried) : carried;
}

namespace {

void assemble_response(Parts& parts, double contrast) {
  const io::SensorDocument& document = *parts.sensor;
  const double fill_factor = document.fill_factor;
  // Squares of other sides have so much of their energy elsewhere; of a line's elements only one side is another.
  const double sides_apart =
      (document.camera.settings->read_out().kind == sensor::ReadOut::Kind::frame ? 2.0 : 1.0) *
      document.sides_apart;
  const sensor::AlongTrack along = parts.camera->along_track(), swept = parts.camera->along_line();
  // Optics and shifts are told on the focal plane.
  const double along_x = swept.pitch_px, along_y = along.pitch_px;
  const std::vector<sensor::ChannelResponse> channels = responses(parts, along_x, along_y);
  const std::vector<sensor::ChannelGroup> found = sensor::group_channels(
      channels, fill_factor,
      [&](double wavelength_um) {
        return std::shared_ptr<const sensor::Psf>(sensor::stretched_psf(
            assemble_psf(parts.document.sources, document, wavelength_um, contrast), along_x, along_y));
      },
      psf_grows_with_wavelength(document));
  const bool has_wings =
      parts.plan.knows_errors && std::max(along.reach_px(), swept.reach_px()) < kLongest_px;
  parts.wings.clear();
  parts.psf_cut.clear();
  parts.groups.reset();
  std::vector<sampling::FootprintGroup> groups;
  std::vector<int> group_of_channel(channels.size(), 0);
  std::vector<double> cut(channels.size(), 0.0);
  for (const sensor::ChannelGroup& group : found) {
    const sampling::Point2 shift = channels[static_cast<std::size_t>(group.like)].shift_px;
    const sensor::Psf* const psf = group.psf.get();
    if (psf != nullptr && found.size() > 1 && psf->half_width_px() > kWidest_px)
      throw InputError(format("the PSF of channel '{}' reaches {:.3g} px to each side; expected {} at most",
                              parts.channels[static_cast<std::size_t>(group.like)].name, psf->half_width_px(),
                              kWidest_px));
    // Wings alone leave what is traced as sharp as without.
    const sensor::Psf* const traced = psf != nullptr && psf->half_width_px() > 0.0 ? psf : nullptr;
    groups.push_back({swept.square(fill_factor) ? sensor::make_footprint(traced, fill_factor, along)
                                                : sensor::make_swept_footprint(traced, fill_factor, swept),
                      shift, channels[static_cast<std::size_t>(group.like)].across_px});
    // Along the track of a longer element, or its sweep, the cut stands in the interval.
    const bool wings = psf != nullptr && psf->has_wings() && has_wings;
    if (wings) parts.wings.push_back(wings_of(group.psf, fill_factor, along, swept, shift));
    for (const int channel : group.channels) {
      group_of_channel[static_cast<std::size_t>(channel)] = static_cast<int>(groups.size()) - 1;
      cut[static_cast<std::size_t>(channel)] =
          sides_apart + (psf != nullptr && !wings ? 1.0 - psf->kept() : 0.0) +
          apart_from(group, channels, channel) + (wings ? wings_apart(*psf, groups.back().across_px) : 0.0);
    }
  }
  parts.footprint = std::make_unique<sampling::PixelFootprint>(groups.front().footprint);
  if (std::any_of(cut.begin(), cut.end(), [](double share) { return share > 0.0; }))
    parts.psf_cut = std::move(cut);
  const sampling::Point2 shift = groups.front().shift_px;
  if (groups.size() == 1 && shift.x == 0.0 && shift.y == 0.0 && groups.front().across_px.empty()) return;
  parts.groups =
      std::make_shared<const sampling::FootprintGroups>(std::move(groups), std::move(group_of_channel));
}

}  // namespace

void assemble_response(Parts& parts) { assemble_response(parts, 1.0); }

void keep_more_of_psf(Parts& parts) {
  if (!psf_has_tails(*parts.sensor)) return;
  // Others have wings, or end where they are measured.
  render::Outshining found = render::outshining(*parts.spectral_scene);
  if (!(found.contrast > 1.0)) return;
  assemble_response(parts, found.contrast);
  parts.outshining = std::move(found.radiance);
}

namespace {

/// What a level surface above the air has of the Sun; nothing where it is down, or where only what reaches the ground is told.
void tell_sunlight(Parts& p) {
  const std::optional<scene::Sun>& sun = p.scene.sun;
  const bool told_at_ground =
      p.document.atmosphere.simple || p.document.atmosphere.uniform || p.document.atmosphere.four_curve;
  if (!sun || sun->is_moon || !sun->is_up() || told_at_ground) return;
  const auto sunlight = [&](const radiometry::Channel& channel) {
    return sun->direction.z * radiometry::channel_mean(channel, sun->irradiance);
  };
  for (std::size_t c = 0; c < p.told_channels.size(); ++c) {
    p.info.channels[c].toa_irradiance = sunlight(p.told_channels[c]);
    if (!p.responses) continue;
    for (const radiometry::Channel& carried : (*p.responses)[c].carried)
      p.info.channels[c].toa_of_carried.push_back(sunlight(carried));
  }
}

/// What paths carry of a channel that counts most in the middle of the image.
std::size_t in_the_middle(const Parts& p, std::size_t channel) {
  if (!p.responses) return channel;
  const std::span<const float> weights = p.responses->weights(channel, p.camera->width_px() / 2);
  return p.responses->first(channel) +
         static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
}

void tell_responses(Parts& p) {
  for (std::size_t c = 0; c < p.told_channels.size(); ++c)
    p.info.channels[c].brightness = std::make_shared<const sensor::BrightnessScale>(p.told_channels[c]);
}

}  // namespace

void tell_of_image(Parts& p) {
  const io::Document& document = p.document;
  p.info = image_info(document.scene.origin, *p.camera, p.told_channels, p.scene, p.map_offset_m);
  tell_irradiance(p);
  tell_sunlight(p);
  tell_responses(p);
  tell_noise(document.sources, document.sensor, p.told_channels, p.info.channels);
  p.info.responses = p.responses;
  p.info.keystone_px = p.keystone_px;
  p.info.mosaic = assemble_mosaic(document.sensor);
  p.info.stokes = document.sensor.stokes;
  p.info.footprint_px = sampling::response_area_px(*p.footprint);
  for (std::size_t g = 0; p.groups != nullptr && g < p.groups->size(); ++g)
    p.info.footprint_px = std::max(p.info.footprint_px, sampling::response_area_px((*p.groups)[g].footprint));
  for (std::size_t c = 0; c < p.told_channels.size() && !p.air.empty(); ++c)
    p.info.channels[c].air = p.air[in_the_middle(p, c)];
}

}  // namespace ifov::session
