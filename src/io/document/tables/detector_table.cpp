#include <cmath>

#include "core/format.h"
#include "io/document/cameras/lens_tables.h"
#include "io/document/detector_document.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

using Detector = DetectorDocument;

SchemaType<double> share() { return fraction(Range::between(0.0, 1.0)); }
SchemaType<double> electrons() { return quantity(kElectrons, Range::at_least(0.0, "e-")); }
SchemaType<double> current() { return quantity(kDarkCurrent, Range::at_least(0.0, "e-/s")); }

SchemaType<Rule07Document> rule_07_type() {
  Record<Rule07Document> inner(
      "Rule 07",
      "Dark current of HgCdTe photodiodes, of the whole area of an element (Tennant et al. 2008).");
  inner
      .required("cutoff", &Rule07Document::cutoff_um, quantity(kWavelength, Range::between(1.0, 30.0, "um")),
                "wavelength at which the response ends")
      .required("temperature", &Rule07Document::temperature_k,
                quantity(kTemperature, Range::between(10.0, 400.0, "K")), "of the detector");
  struct Holder {
    Rule07Document rule;
  };
  Record<Holder> record("dark current", "Dark current that follows from a rule.");
  record.required("rule_07", &Holder::rule, inner.type(), "of HgCdTe photodiodes");
  return converted<Rule07Document>(
      record.type(), [](const Holder& holder) { return holder.rule; },
      [](const Rule07Document& rule) { return Holder{rule}; });
}

using DarkCurrent = decltype(Detector::dark_current);

SchemaType<DarkCurrent> dark_current_type() {
  return either(converted<DarkCurrent>(
                    current(), [](double e_s) { return DarkCurrent(e_s); },
                    [](const DarkCurrent& dark) { return target::as<double>(dark); }),
                converted<DarkCurrent>(
                    rule_07_type(), [](Rule07Document rule) { return DarkCurrent(rule); },
                    [](const DarkCurrent& dark) { return target::as<Rule07Document>(dark); }));
}

SchemaType<HotElementsDocument> hot_type() {
  Record<HotElementsDocument> record("hot elements",
                                     "Elements whose dark current is another, at places by chance.");
  record.required("share", &HotElementsDocument::share, share(), "of all elements")
      .required("dark_current", &HotElementsDocument::dark_current_e_s, current(), "theirs");
  return record.type();
}

SchemaType<ReferenceDocument> reference_type() {
  Record<ReferenceDocument> record("reference", "The light that noise is told of as one number.");
  record.exactly_one()
      .one("temperature", &ReferenceDocument::temperature_k, quantity(kTemperature, Range::above(0.0, "K")),
           "a black surface")
      .one("reflectance", &ReferenceDocument::reflectance, share(),
           "a diffuse surface under the Sun at 1 au, without air")
      .one("radiance", &ReferenceDocument::radiance, spectrum_type(SpectrumOf::radiance), "a radiance")
      .with_default("sun_zenith", &ReferenceDocument::sun_zenith_rad,
                    quantity(kAngle, {0.0, 90.0, false, true, "deg"}), "\"0 deg\"",
                    "zenith angle of that Sun")
      .needs("sun_zenith", "reflectance");
  return record.type();
}

SchemaType<CorrectionDocument> correction_type() {
  Record<CorrectionDocument> record(
      "non-uniformity correction",
      "Response and offset of each element, measured at two even lights (blackbodies, or a lamp's flat field) before the image, and taken out of it: "
      "what is left is the noise of the measurement, nonlinearity between the lights, and elements that do not answer.");
  record.required("low", &CorrectionDocument::low, reference_type(), "the darker light")
      .required("high", &CorrectionDocument::high, reference_type(), "the brighter one")
      .with_default("frames", &CorrectionDocument::frames, integer(1, 1000000), "64",
                    "exposures of each, of which the mean is taken");
  return record.type();
}

void add_memory(Record<Detector>& record) {
  record
      .optional(
          "lag", &Detector::lag, fraction({0.0, 1.0, false, true, {}}),
          "share of the signal that stays behind when it is read, and is in the next exposure of the element: the next line of a line "
          "scanner, the next sample of a sweep, the next frame (`ifov detect --after`)")
      .optional("time_constant", &Detector::time_constant_s, quantity(kDuration, Range::above(0.0, "s")),
                "of elements that follow the light as 1 - exp(-t / time constant), as microbolometers do")
      .optional("frame_period", &Detector::frame_period_s, quantity(kDuration, Range::above(0.0, "s")),
                "from frame to frame, for `time_constant`; a scanner's camera has said it already")
      .optional(
          "blooming", &Detector::blooming, share(),
          "share of the electrons that a full well cannot hold that runs over into its neighbours along a frame's columns, or a line "
          "scanner's line, until they find room; the rest is drained. 0 if not given")
      .needs("blooming", "full_well")
      .optional("correction", &Detector::correction, correction_type(),
                "of what differs from element to element, before signals are told; none if not given");
}

void add_patterns(Record<Detector>& record) {
  record
      .optional("prnu", &Detector::prnu, share(),
                "standard deviation of the response from element to element, a share of it")
      .optional("dsnu", &Detector::dsnu, electrons(),
                "standard deviation of the signal in darkness from element to element")
      .optional("row_gain", &Detector::row_gain, share(),
                "the same of what all elements of a row of the image share: of the response")
      .optional("row_offset", &Detector::row_offset, electrons(), "and of the signal in darkness")
      .optional("column_gain", &Detector::column_gain, share(), "of columns: of the response")
      .optional("column_offset", &Detector::column_offset, electrons(), "and of the signal in darkness")
      .optional("dead", &Detector::dead, share(), "share of elements that answer no light")
      .optional("hot", &Detector::hot, hot_type(), "elements whose dark current is another")
      .optional(
          "specimen", &Detector::specimen, integer(0, 1000000000),
          "which of all detectors that are made alike: fixed patterns and faults follow from it, and not from the "
          "seed of the noise; 1 if not given");
}

}  // namespace

namespace {

SchemaType<OpticsDocument::StrayLight> stray_light_type() {
  using Stray = OpticsDocument::StrayLight;
  constexpr double kNarrowest_px = 2.0, kWidest_px = 10000.0;
  Record<Stray> record(
      "stray light",
      "Light that mirrors, lenses and mounts scatter: a wide halo about whatever shines, a / (2 pi (r^2 + a^2)^1.5) with a = radius / sqrt 3. "
      "It takes a sampler that knows its errors; what is further away than 128 px is taken to be as bright as what lies there, and how far "
      "that may be off stands in the intervals.");
  record
      .required("share", &Stray::share, fraction({0.0, 0.5, false, false, {}}),
                "of the light that passes the optics")
      .required("radius", &Stray::radius_px,
                quantity(kPixels, Range::between(kNarrowest_px, kWidest_px, "px")),
                "that half of it falls within, in pixels of the focal plane");
  return record.type();
}

/// Of the polynomial, the least in the image.
double least_light(const std::vector<double>& terms) {
  constexpr int kSteps = 1000;
  double least = 1.0;
  for (int k = 0; k <= kSteps; ++k) {
    const double s = static_cast<double>(k) / kSteps;
    double power = 1.0, light = 1.0;
    for (const double term : terms) power *= s, light += term * power;
    least = std::min(least, light);
  }
  return least;
}

SchemaType<OpticsDocument::Vignetting> vignetting_type() {
  using Vignetting = OpticsDocument::Vignetting;
  static constexpr double kDarkest = 0.01;
  Record<Vignetting> record(
      "vignetting",
      "How light falls towards the corners of the field, over that of its middle. Electrons, counts and noise of `ifov detect` know it; radiance "
      "is made of them by who knows it too.");
  record
      .with_default(
          "cos4", &Vignetting::cos4, boolean(), "false",
          "by the fourth power of the cosine of the field angle, which the focal length and the pitch say")
      .optional(
          "polynomial", &Vignetting::polynomial, list(number(Range::between(-10.0, 10.0)), 1, 3),
          "times 1 + a r^2 + b r^4 + c r^6, r being the distance from the middle over that of the image's corners (of a line scanner, of "
          "its ends)")
      .optional("table", &Vignetting::table,
                table_file_type("vignetting table",
                                "Image heights and the light there from a table (docs/formats/elements.md)."),
                "instead of a polynomial: shares from a file")
      .check([](const Vignetting& read, const DocumentNode& node) {
        if (!read.cos4 && read.polynomial.empty() && !read.table)
          node.fail(
              "vignetting of neither 'cos4', a 'polynomial' nor a 'table' darkens nothing: give one of them");
        if (read.table && !read.polynomial.empty())
          node.given("table").fail_at_key(
              "light falls by a 'polynomial' or by a 'table', and this vignetting has both: leave one out");
        if (const double least = least_light(read.polynomial); least < kDarkest)
          node.given("polynomial")
              .fail(format(
                  "the polynomial leaves {:.3g} of the light somewhere in the field; expected {:g} at least",
                  least, kDarkest));
      });
  return record.type();
}

}  // namespace

SchemaType<OpticsDocument> optics_type() {
  Record<OpticsDocument> record(
      "optics",
      "What light passes on its way to the detector. Of aperture, focal length and f-number two say the third.");
  const SchemaType<double> length = quantity(kLength, Range::above(0.0, "m"));
  record.optional("aperture", &OpticsDocument::aperture_m, length, "diameter of the entrance pupil")
      .optional("focal_length", &OpticsDocument::focal_length_m, length,
                "focal length; a 'frame' camera has said it already")
      .optional("f_number", &OpticsDocument::f_number, number(Range::between(0.5, 1000.0)),
                "focal length over aperture")
      .with_default("obscuration", &OpticsDocument::obscuration, fraction({0.0, 1.0, false, true, {}}), "0",
                    "diameter of what stands in the middle of the aperture, over the aperture's")
      .optional("throughput", &OpticsDocument::throughput, spectrum_type(SpectrumOf::fraction),
                "share of light that is let through, beside the channel's response; 1 if not given")
      .optional(
          "temperature", &OpticsDocument::temperature_k, quantity(kTemperature, Range::above(0.0, "K")),
          "of the optics, whose own emission falls on the detector; they emit nothing if it is not given")
      .optional("emissivity", &OpticsDocument::emissivity, spectrum_type(SpectrumOf::fraction),
                "of the optics; what `throughput` leaves of 1 if not given")
      .needs("emissivity", "temperature")
      .optional("stray_light", &OpticsDocument::stray_light, stray_light_type(),
                "light that falls far from where it belongs; none if not given")
      .optional("vignetting", &OpticsDocument::vignetting, vignetting_type(),
                "how much less light falls off the middle of the field, for a `detector`; none if not given")
      .check([](const OpticsDocument& optics, const DocumentNode& node) {
        if (!optics.aperture_m || !optics.focal_length_m || !optics.f_number) return;
        constexpr double kAlike = 0.01;
        const double follows = *optics.focal_length_m / *optics.aperture_m;
        if (std::abs(*optics.f_number / follows - 1.0) > kAlike)
          node.given("f_number")
              .fail(format(
                  "optics.f_number is {:g}, and focal length and aperture make {:.4g}: leave one of the three out",
                  *optics.f_number, follows));
      });
  return record.type();
}

SchemaType<DetectorDocument> detector_type() {
  Record<Detector> record(
      "detector",
      "Detector elements: how light becomes electrons and counts. What a channel's own `detector` says counts before the sensor's.");
  record
      .optional(
          "pitch", &Detector::pitch_m, quantity(kLength, Range::above(0.0, "m")),
          "side of an element, of which the sensor's `fill_factor` is sensitive; a 'frame' camera has said it already")
      .optional("integration_time", &Detector::integration_time_s,
                quantity(kDuration, Range::above(0.0, "s")), "for which light is collected")
      .optional("quantum_efficiency", &Detector::quantum_efficiency, spectrum_type(SpectrumOf::fraction),
                "electrons per photon, beside the channel's response")
      .optional("dark_current",
                via([](Detector& detector, DarkCurrent dark) { detector.dark_current = dark; },
                    [](const Detector& detector) {
                      return std::holds_alternative<std::monostate>(detector.dark_current)
                                 ? std::nullopt
                                 : std::optional(detector.dark_current);
                    }),
                dark_current_type(), "of an element, or a rule; none if not given")
      .optional("read_noise", &Detector::read_noise, electrons(),
                "standard deviation of what reading adds; none if not given")
      .optional(
          "one_over_f", &Detector::one_over_f, number(Range::between(0.0, 0.5)),
          "frequency, in cycles a line of the image, below which the read noise of a column is more 1/f than white")
      .needs("one_over_f", "read_noise")
      .optional("full_well", &Detector::full_well, quantity(kElectrons, Range::above(0.0, "e-")),
                "electrons that an element holds; what comes on top is lost")
      .optional("nonlinearity", &Detector::nonlinearity, fraction({0.0, 0.5, false, true, {}}),
                "share of the signal that is missing at the full well, growing with the signal")
      .optional("bits", &Detector::bits, integer(1, 32), "of a count; signals stay electrons if not given")
      .optional("gain", &Detector::gain, quantity(kGain, Range::above(0.0, "e-/count")),
                "electrons a count; if not given, the largest count is the full well")
      .optional("offset", &Detector::offset, number(Range::between(0.0, 4e9)),
                "counts without any electron; 0 if not given");
  add_patterns(record);
  add_memory(record);
  record.optional(
      "reference", &Detector::reference, reference_type(),
      "the light for which noise is told as one number: by the record, and for errors in shares of noise; a black surface of "
      "300 K if not given");
  return record.type();
}

SchemaType<SnrDocument> snr_type() {
  Record<SnrDocument> record("signal to noise", "Noise as a ratio.");
  record
      .required("ratio", &SnrDocument::ratio, number(Range::above(0.0)),
                "of a radiance to the noise's standard deviation")
      .required("radiance", &SnrDocument::radiance, spectrum_type(SpectrumOf::radiance), "that radiance");
  return record.type();
}

DetectorDocument DetectorDocument::under(const DetectorDocument& other) const {
  DetectorDocument both = other;
  const auto keep = [&](auto member) {
    if (!(both.*member)) both.*member = this->*member;
  };
  if (std::holds_alternative<std::monostate>(both.dark_current)) both.dark_current = dark_current;
  keep(&DetectorDocument::pitch_m), keep(&DetectorDocument::integration_time_s);
  keep(&DetectorDocument::quantum_efficiency), keep(&DetectorDocument::read_noise);
  keep(&DetectorDocument::one_over_f), keep(&DetectorDocument::full_well);
  keep(&DetectorDocument::nonlinearity), keep(&DetectorDocument::bits), keep(&DetectorDocument::gain);
  keep(&DetectorDocument::offset), keep(&DetectorDocument::prnu), keep(&DetectorDocument::row_gain);
  keep(&DetectorDocument::column_gain), keep(&DetectorDocument::dsnu), keep(&DetectorDocument::row_offset);
  keep(&DetectorDocument::column_offset), keep(&DetectorDocument::dead), keep(&DetectorDocument::hot);
  keep(&DetectorDocument::specimen), keep(&DetectorDocument::reference);
  keep(&DetectorDocument::lag), keep(&DetectorDocument::time_constant_s);
  keep(&DetectorDocument::frame_period_s), keep(&DetectorDocument::blooming);
  keep(&DetectorDocument::correction);
  return both;
}

bool DetectorDocument::only_remembers() const {
  const bool other = pitch_m || integration_time_s || quantum_efficiency || read_noise || one_over_f ||
                     full_well || nonlinearity || bits || gain || offset || prnu || row_gain || column_gain ||
                     dsnu || row_offset || column_offset || dead || hot || specimen || reference ||
                     blooming || correction || !std::holds_alternative<std::monostate>(dark_current);
  return !other && (lag || time_constant_s);
}

}  // namespace ifov::io
