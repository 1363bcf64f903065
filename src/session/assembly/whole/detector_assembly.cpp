#include "session/assembly/whole/detector_assembly.h"

#include <cmath>
#include <numbers>

#include "core/overloaded.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/cameras/lens_tables.h"
#include "io/document/detector_document.h"
#include "io/document/sensor_document.h"
#include "radiometry/channel.h"
#include "radiometry/solar_spectrum.h"
#include "sensor/detector/read_out.h"
#include "sensor/detector/rule_07.h"
#include "session/assembly/shared/spectrum_assembly.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/whole/element_sides.h"

namespace ifov::session {
namespace {

using radiometry::Spectrum;

constexpr double kElementaryCharge_c = 1.602176634e-19;

/// The key that says a channel's noise without physics; null: none does.
const char* noise_key(const io::ChannelDocument& channel) {
  return channel.noise ? "noise" : channel.noise_k ? "noise_temperature" : channel.snr ? "snr" : nullptr;
}

/// One channel's.
class Assembly {
 public:
  Assembly(const io::DocumentSources& sources, const io::SensorDocument& sensor,
           const io::ChannelDocument& channel, const radiometry::Channel& response)
      : sources_(sources), sensor_(sensor), channel_(channel), response_(response) {
    if (sensor.detector) document_ = *sensor.detector;
    if (channel.detector) document_ = document_.under(*channel.detector);
    where_ = channel.detector ? channel.detector->position : document_.position;
  }

  ChannelDetector made() const {
    ChannelDetector made;
    made.lag = document_.lag.value_or(0.0), made.inertia = inertia();
    if (document_.only_remembers()) return made;
    if (noise_key(channel_) != nullptr)
      throw io::document_error(
          sources_, channel_.position,
          format(
              "channel '{}' states its noise by '{}', and its noise also follows from the 'detector': leave one of "
              "the two out",
              channel_.name, noise_key(channel_)));
    if (response_.is_monochromatic())
      throw io::document_error(
          sources_, channel_.position,
          format(
              "channel '{}' is a single wavelength, through which no light falls on a detector: give it a width",
              channel_.name));
    if (!sensor_.optics) fail("a detector needs the sensor's 'optics', which say how much light falls on it");
    made.optics = optics();
    made.figures = figures(made.optics);
    made.photons_per_radiance = photons_per_radiance(made.optics);
    made.reference_w_m2_sr_um = reference();
    check(made.figures);
    return made;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw io::document_error(sources_, where_, message);
  }
  [[noreturn]] void fail_optics(const std::string& message) const {
    throw io::document_error(sources_, sensor_.optics->position, message);
  }

  static bool alike(double a, double b, double tolerance) { return std::abs(a / b - 1.0) <= tolerance; }

  /// What is left after an exposure of what elements had not come to.
  double inertia() const {
    constexpr double kMostExposures = 1000.0;
    if (!document_.time_constant_s) return 0.0;
    const sensor::ReadOut camera = sensor_.camera.settings->read_out();
    if (camera.period_s > 0.0 && document_.frame_period_s)
      fail(format(
          "detector.frame_period is of frames, and elements of the camera are exposed every {:g} ms: leave it out",
          1e3 * camera.period_s));
    if (!(camera.period_s > 0.0) && !document_.frame_period_s)
      fail("the detector's time constant needs the time from frame to frame: give 'frame_period'");
    const double period_s = camera.period_s > 0.0 ? camera.period_s : *document_.frame_period_s;
    if (*document_.time_constant_s > kMostExposures * period_s)
      fail(format("a time constant of {:g} ms is {:.4g} exposures of {:g} ms: expected at most {:g}",
                  1e3 * *document_.time_constant_s, *document_.time_constant_s / period_s, 1e3 * period_s,
                  kMostExposures));
    return std::exp(-period_s / *document_.time_constant_s);
  }

  double pitch_m() const {
    const auto camera = sensor_.camera.settings->optics();
    if (!camera && !document_.pitch_m) fail("the detector has no pitch: give it 'pitch'");
    if (camera && document_.pitch_m && !alike(*document_.pitch_m, camera->pitch_m, 1e-6))
      fail(format("detector.pitch is {:g} um, and the camera's pitch {:g} um: leave it out",
                  1e6 * *document_.pitch_m, 1e6 * camera->pitch_m));
    return camera ? camera->pitch_m : *document_.pitch_m;
  }

  double f_number() const {
    constexpr double kAlike = 0.01;
    const io::OpticsDocument& optics = *sensor_.optics;
    const auto camera = sensor_.camera.settings->optics();
    if (camera && optics.focal_length_m && !alike(*optics.focal_length_m, camera->focal_length_m, 1e-6))
      fail_optics(format("optics.focal_length is {:g} mm, and the camera's {:g} mm: leave it out",
                         1e3 * *optics.focal_length_m, 1e3 * camera->focal_length_m));
    const std::optional<double> focal_length_m =
        camera ? std::optional(camera->focal_length_m) : optics.focal_length_m;
    if (!optics.aperture_m || !focal_length_m) {
      if (!optics.f_number)
        fail_optics(
            "the optics do not say how fast they are: give 'f_number', or 'aperture' and 'focal_length'");
      return *optics.f_number;
    }
    const double follows = *focal_length_m / *optics.aperture_m;
    if (optics.f_number && !alike(*optics.f_number, follows, kAlike))
      fail_optics(
          format("optics.f_number is {:g}, and the camera's focal length and the aperture make {:.4g}: leave "
                 "one of them out",
                 *optics.f_number, follows));
    return follows;
  }

  sensor::ElementOptics optics() const {
    if (!document_.integration_time_s)
      fail("the detector has no integration time: give it 'integration_time'");
    const double pitch = pitch_m();
    return {f_number(), sensor_.optics->obscuration, sensor_.fill_factor * pitch * pitch,
            *document_.integration_time_s};
  }

  double dark_electrons() const {
    return *document_.integration_time_s *
           std::visit(Overloaded{[](std::monostate) { return 0.0; }, [](double e_s) { return e_s; },
                                 [&](const io::Rule07Document& rule) {
                                   const double pitch = pitch_m();
                                   return sensor::rule_07_a_m2(rule.cutoff_um, rule.temperature_k) * pitch *
                                          pitch / kElementaryCharge_c;
                                 }},
                      document_.dark_current);
  }

  Spectrum throughput() const {
    const auto& written = sensor_.optics->throughput;
    return written ? spectrum(*written, "throughput") : Spectrum::constant(1.0);
  }

  double photons_per_radiance(const sensor::ElementOptics& optics) const {
    return sensor::electrons_per_radiance(optics, response_, throughput(), Spectrum::constant(1.0));
  }

  void add_light(const sensor::ElementOptics& optics, sensor::Detector& figures) const {
    if (!document_.quantum_efficiency)
      fail("the detector has no quantum efficiency: give it 'quantum_efficiency'");
    const io::OpticsDocument& written = *sensor_.optics;
    const Spectrum efficiency = spectrum(*document_.quantum_efficiency, "quantum efficiency");
    const Spectrum through = throughput();
    with_position(sources_, channel_.position, [&] {
      figures.electrons_per_radiance = sensor::electrons_per_radiance(optics, response_, through, efficiency);
      if (written.temperature_k)
        figures.background = sensor::background_electrons(
            optics, response_,
            written.emissivity ? spectrum(*written.emissivity, "emissivity of the optics")
                               : through.complement(),
            efficiency, *written.temperature_k);
    });
    if (!(figures.electrons_per_radiance > 0.0))
      fail(
          format("no light of channel '{}' becomes an electron: throughput or quantum efficiency are 0 there",
                 channel_.name));
  }

  Spectrum spectrum(const io::SpectrumDocument& written, const char* name) const {
    return assemble_spectrum(sources_, written, name);
  }

  sensor::Detector figures(const sensor::ElementOptics& optics) const {
    sensor::Detector figures;
    add_light(optics, figures);
    figures.dark = dark_electrons();
    figures.read_noise = document_.read_noise.value_or(0.0);
    figures.one_over_f = document_.one_over_f.value_or(0.0);
    figures.full_well = document_.full_well.value_or(0.0);
    figures.nonlinearity = document_.nonlinearity.value_or(0.0);
    figures.prnu = document_.prnu.value_or(0.0), figures.dsnu = document_.dsnu.value_or(0.0);
    figures.row_gain = document_.row_gain.value_or(0.0);
    figures.row_offset = document_.row_offset.value_or(0.0);
    figures.column_gain = document_.column_gain.value_or(0.0);
    figures.column_offset = document_.column_offset.value_or(0.0);
    figures.dead_share = document_.dead.value_or(0.0);
    if (document_.hot) {
      figures.hot_share = document_.hot->share;
      figures.hot_dark = document_.hot->dark_current_e_s * *document_.integration_time_s;
    }
    figures.specimen = document_.specimen.value_or(1);
    figures.blooming = document_.blooming.value_or(0.0);
    add_vignetting(figures);
    add_counts(figures);
    add_correction(figures);
    return figures;
  }

  void add_vignetting(sensor::Detector& figures) const {
    if (!sensor_.optics->vignetting) return;
    const io::OpticsDocument::Vignetting& told = *sensor_.optics->vignetting;
    if (sensor_.camera.settings->read_out().kind == sensor::ReadOut::Kind::sweeps)
      fail_optics(
          "'vignetting' is of elements with places of their own in the field, and those of a sweep pass through the same one: leave it out");
    if (told.cos4) {
      const auto camera = sensor_.camera.settings->optics();
      const std::optional<double> focal_length_m =
          camera ? std::optional(camera->focal_length_m) : sensor_.optics->focal_length_m;
      if (!focal_length_m)
        fail_optics(
            "'cos4' takes the field angle, and nothing says the focal length: give 'focal_length', or a 'polynomial'");
      figures.vignette_px = *focal_length_m / pitch_m();
    }
    const auto term = [&](std::size_t k) { return k < told.polynomial.size() ? told.polynomial[k] : 0.0; };
    if (told.table)
      figures.vignette_rows = with_position(sources_, told.table->position, [&] {
        return std::make_shared<const std::vector<std::array<double, 2>>>(
            io::read_vignetting(*told.table, *sensor_.camera.settings->focal_plane(), pitch_m()));
      });
    figures.vignette_2 = term(0), figures.vignette_4 = term(1), figures.vignette_6 = term(2);
  }

  void add_correction(sensor::Detector& figures) const {
    if (!document_.correction) return;
    figures.nuc_low = radiance_of(document_.correction->low);
    figures.nuc_high = radiance_of(document_.correction->high);
    figures.nuc_frames = document_.correction->frames;
    if (!(figures.nuc_low < figures.nuc_high))
      fail(format(
          "the lights of the 'correction' make {:.4g} and {:.4g} W m-2 sr-1 um-1 in channel '{}': expected a 'high' that is brighter "
          "than 'low'",
          figures.nuc_low, figures.nuc_high, channel_.name));
    if (figures.mean_electrons(figures.nuc_high) >= figures.largest_signal())
      fail(format(
          "the brighter light of the 'correction' makes {:.4g} electrons in channel '{}', and the detector holds {:.4g}: expected a darker "
          "one",
          figures.mean_electrons(figures.nuc_high), channel_.name, figures.largest_signal()));
  }

  void add_counts(sensor::Detector& figures) const {
    if (!document_.bits) {
      if (document_.gain || document_.offset)
        fail("'gain' and 'offset' are of counts, and the detector makes none: give it 'bits'");
      return;
    }
    figures.bits = *document_.bits;
    figures.offset = document_.offset.value_or(0.0);
    const double counts = figures.largest_count() - figures.offset;
    if (!(counts > 0.0))
      fail(format(
          "{} bits hold counts up to {:.0f}, and the offset is {:g} counts: give more bits, or less offset",
          *document_.bits, figures.largest_count(), figures.offset));
    if (!document_.gain && !document_.full_well)
      fail(
          "counts need to know how many electrons make one: give 'gain', or a 'full_well' that the largest count stands for");
    figures.gain = document_.gain ? *document_.gain : *document_.full_well / counts;
    if (document_.full_well && *document_.full_well > figures.gain * (counts + 0.5))
      fail(format(
          "{} bits hold counts up to {:.0f}, and a full well of {:g} e- makes {:.0f} at {:g} e-/count and an offset of "
          "{:g}: give more bits, a gain of {:.4g} e-/count or more, or a full_well of {:.4g} e- or less",
          *document_.bits, figures.largest_count(), *document_.full_well,
          figures.offset + *document_.full_well / figures.gain, figures.gain, figures.offset,
          *document_.full_well / counts, figures.gain * counts));
  }

  void check(const sensor::Detector& figures) const {
    if (!document_.full_well && !document_.bits)
      fail(
          format("the detector of channel '{}' is never saturated: give it 'full_well', or 'bits' and 'gain'",
                 channel_.name));
    if (figures.nonlinearity > 0.0 && !document_.full_well)
      fail("'nonlinearity' is what is missing at the full well: give the detector 'full_well'");
    if (figures.blooming > 0.0 && sensor_.camera.settings->read_out().kind == sensor::ReadOut::Kind::sweeps)
      fail(
          "'blooming' is of elements whose neighbours see neighbouring pixels at the same time, which those of a sweep do not; leave it out");
    if (figures.dead_share + figures.hot_share > 1.0) fail("more elements are dead or hot than there are");
    if (figures.background + figures.dark >= figures.largest_signal())
      fail(format(
          "the detector of channel '{}' is always saturated: without any light from the scene, dark current makes {:.4g} "
          "electrons and the optics' own emission {:.4g} in {:g} ms, and it holds {:.4g}",
          channel_.name, figures.dark, figures.background, 1e3 * *document_.integration_time_s,
          figures.largest_signal()));
  }

  double reference() const {
    constexpr double kWarm_k = 300.0;
    return document_.reference ? radiance_of(*document_.reference)
                               : radiometry::channel_planck_w_m2_sr_um(response_, kWarm_k);
  }

  double radiance_of(const io::ReferenceDocument& light) const {
    return with_position(sources_, where_, [&] {
      if (light.temperature_k) return radiometry::channel_planck_w_m2_sr_um(response_, *light.temperature_k);
      if (light.radiance) return spectrum(*light.radiance, "radiance").at(response_.centre_um);
      return *light.reflectance * std::cos(light.sun_zenith_rad) / std::numbers::pi *
             radiometry::channel_mean(response_, radiometry::solar_irradiance_1au());
    });
  }

  const io::DocumentSources& sources_;
  const io::SensorDocument& sensor_;
  const io::ChannelDocument& channel_;
  const radiometry::Channel& response_;
  io::DetectorDocument document_;
  SourcePosition where_;
};

}  // namespace

std::vector<ChannelDetector> assemble_detectors(const io::DocumentSources& sources,
                                                const io::SensorDocument& written,
                                                std::span<const radiometry::Channel> channels) {
  std::vector<ChannelDetector> detectors;
  const io::SensorDocument sensor = with_element_sides(sources, written);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const io::ChannelDocument& channel = sensor.channels[c];
    detectors.push_back(sensor.detector || channel.detector
                            ? Assembly(sources, sensor, channel, channels[c]).made()
                            : ChannelDetector());
  }
  return detectors;
}

}  // namespace ifov::session
