#include "session/sensor_notes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <variant>

#include "core/format.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/detector_document.h"
#include "io/document/document.h"
#include "io/document/psf_document.h"
#include "sensor/spectrometer/column_responses.h"
#include "session/assembly/whole/psf_assembly.h"
#include "session/loaded/parts.h"

namespace ifov::session {
namespace {

/// Of values by channel and column, those that are furthest from 0 to either side.
struct Extremes {
  double least = 0.0, most = 0.0;
  void add(double value) { least = std::min(least, value), most = std::max(most, value); }
  std::string text(double unit, const char* name) const {
    return format("{:.3g} to {:.3g} {}", least / unit, most / unit, name);
  }
};

void note_smile(const Parts& parts, std::vector<std::string>& lines) {
  if (!parts.responses) return;
  const sensor::ColumnResponses& responses = *parts.responses;
  Extremes centres, widths;
  double left_out = 0.0;
  for (std::size_t c = 0; c < responses.channels(); ++c) {
    for (const double centre_um : responses[c].columns.centre_um)
      centres.add(centre_um - parts.told_channels[c].centre_um);
    for (const double fwhm_um : responses[c].columns.fwhm_um)
      widths.add(fwhm_um - parts.told_channels[c].fwhm_um);
    left_out = std::max(left_out, responses[c].left_out);
  }
  lines.push_back(format(
      "smile: centres lie off by {} and widths by {} from column to column; paths carry {} responses of {} channels, whose sums "
      "leave out {:.2g} % of a column's at most",
      centres.text(1e-3, "nm"), widths.text(1e-3, "nm"), responses.carried(), responses.channels(),
      100.0 * left_out));
}

void note_keystone(const Parts& parts, std::vector<std::string>& lines) {
  if (parts.keystone_px.empty()) return;
  Extremes shifts;
  double apart = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(parts.info.width_px); ++i) {
    double least = INFINITY, most = -INFINITY;
    for (const std::vector<double>& of_channel : parts.keystone_px) {
      const double shift = of_channel.empty() ? 0.0 : of_channel[i];
      shifts.add(shift);
      least = std::min(least, shift), most = std::max(most, shift);
    }
    apart = std::max(apart, most - least);
  }
  lines.push_back(format(
      "keystone: elements look {} to the right of where they stand, and channels of a column up to {:.3g} px apart",
      shifts.text(1.0, "px"), apart));
}

void note_stray_light(const Parts& parts, std::vector<std::string>& lines) {
  const io::SensorDocument& sensor = parts.document.sensor;
  if (!sensor.optics || !sensor.optics->stray_light) return;
  const io::OpticsDocument::StrayLight& stray = *sensor.optics->stray_light;
  const std::string told =
      format("stray light: {:.3g} % of the light falls in a halo, half of it within {:.4g} px",
             100.0 * stray.share, stray.radius_px);
  constexpr double kTraced_px = 128.0;
  const double a = stray.radius_px / std::numbers::sqrt3;
  lines.push_back(
      parts.wings.empty()
          ? told + "; this sampler, or elements as long as these, leave it out"
          : told + format("; {:.3g} % come from more than {:g} px away, which is taken to be as bright as "
                          "what lies there",
                          100.0 * stray.share * a / std::hypot(kTraced_px, a), kTraced_px));
}

/// Without a detector optics tell diffraction alone, and that only to a PSF that asks.
void note_optics(const Parts& parts, std::vector<std::string>& lines) {
  const io::SensorDocument& sensor = parts.document.sensor;
  if (!sensor.optics || sensor.detector ||
      std::any_of(sensor.channels.begin(), sensor.channels.end(),
                  [](const io::ChannelDocument& channel) { return channel.detector != nullptr; }))
    return;
  if (sensor.optics->stray_light) {
    lines.push_back(
        "optics: without a 'detector' they tell of stray light, and a 'psf' of 'airy' or 'pupil' its aperture and focal ratio: what they "
        "let through, and emit, counts for electrons, which take a detector");
    return;
  }
  const std::optional<io::AiryPsf> diffraction = diffraction_of(sensor);
  const bool asked = diffraction && (!diffraction->aperture_m || !sensor.camera.settings->optics());
  lines.push_back(
      asked
          ? "optics: without a 'detector' they tell the 'psf' its aperture and focal ratio, and nothing else: what they let through, and "
            "emit, counts for electrons, which take a detector"
          : "optics: nothing follows from them without a 'detector', which makes electrons of light, or a 'psf' of 'airy' or 'pupil' that "
            "takes its aperture from them; the image is blurred by 'psf' alone");
}

}  // namespace

std::vector<std::string> sensor_notes(const Parts& parts) {
  std::vector<std::string> lines;
  note_stray_light(parts, lines);
  note_smile(parts, lines);
  note_keystone(parts, lines);
  note_optics(parts, lines);
  return lines;
}

}  // namespace ifov::session
