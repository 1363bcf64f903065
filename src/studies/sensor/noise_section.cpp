#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "sensor/detector/detector_checks.h"
#include "sensor/detector/one_over_f.h"
#include "studies/sensor/sensor_checks.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {
namespace {

sensor::Detector study_detector() {
  sensor::Detector detector;
  detector.electrons_per_radiance = 1.0;
  detector.full_well = 1e5;
  detector.read_noise = 30.0;
  detector.dark = 40.0;
  detector.bits = 12;
  detector.offset = 20.0;
  detector.gain = 1e5 / (4095.0 - 20.0);
  return detector;
}

void add_photon_transfer(ReportSection& section) {
  const sensor::Detector detector = study_detector();
  const sensor::PhotonTransfer found = sensor::photon_transfer(detector);
  section.figures.between(
      "transfer_slope", found.slope, 0.99, 1.01, "",
      "photon transfer, 8 to 80,000 electrons, 12 bits: slope of the variance over the mean");
  section.figures.between("transfer_gain", found.gain / detector.gain, 0.99, 1.01, "",
                          "electrons a count by photon transfer, over what they are");
  const double floor = std::sqrt(detector.read_noise * detector.read_noise + detector.dark +
                                 detector.gain * detector.gain / 12.0);
  section.figures.between("transfer_floor", std::sqrt(found.darkness.variance) * detector.gain / floor, 0.99,
                          1.01, "", "noise in darkness over sqrt(read noise^2 + dark + gain^2/12)");
  const sensor::Moments full = sensor::moments(sensor::signal_image(detector, 2e5, 400, 1000).values);
  section.figures.between("transfer_well", full.mean / detector.full_well, 0.99, 1.01, "",
                          "signal of twice the full well over the full well");
  section.figures.between("transfer_well_noise", std::sqrt(full.variance) / detector.read_noise, 0.99, 1.01,
                          "", "its noise over the read noise, which is all that is left");
  Plot plot;
  plot.title = "Photon transfer";
  plot.x_label = "mean above darkness, counts";
  plot.y_label = "variance above darkness, counts^2";
  plot.x_log = plot.y_log = true;
  PlotSeries measured{"of 400,000 counts each", "#d55e00", found.mean, found.variance, true},
      shot{"mean over the gain", "#0072b2", {}, {}, false};
  for (const double mean : {found.mean.front(), found.mean.back()})
    shot.x.push_back(mean), shot.y.push_back(mean / detector.gain);
  plot.series = {shot, measured};
  plot.levels = {{"variance in darkness", "#888", found.darkness.variance, 0.0}};
  section.plots.push_back(
      {"transfer", plot, "A full well of 100,000 electrons, 30 of read noise, 40 of dark current."});
}

void add_patterns(ReportSection& section) {
  sensor::Detector detector;
  detector.electrons_per_radiance = 1.0;
  detector.prnu = 0.01, detector.row_gain = 0.004, detector.column_gain = 0.006;
  detector.dsnu = 40.0, detector.row_offset = 25.0, detector.column_offset = 60.0;
  for (const bool light : {false, true}) {
    constexpr double kBright = 1e10;  // photons are no matter there, and neither are offsets
    const double radiance = light ? kBright : 0.0;
    const sensor::PatternSpreads wide = sensor::pattern_spreads(
                                     sensor::signal_image(detector, radiance, 40, 16000)),
                                 tall = sensor::pattern_spreads(
                                     sensor::signal_image(detector, radiance, 16000, 40));
    const double pixel = light ? kBright * detector.prnu : detector.dsnu,
                 row = light ? kBright * detector.row_gain : detector.row_offset,
                 column = light ? kBright * detector.column_gain : detector.column_offset;
    const char* where = light ? "light" : "darkness";
    section.figures.between(format("pattern_{}_pixels", where), wide.pixel / pixel, 0.97, 1.03, "",
                            format("fixed pattern in {}: spread of elements over what was put in", where));
    section.figures.between(format("pattern_{}_rows", where), tall.row / row, 0.97, 1.03, "",
                            "of 16,000 rows");
    section.figures.between(format("pattern_{}_columns", where), wide.column / column, 0.97, 1.03, "",
                            "of 16,000 columns");
    section.figures.between(format("pattern_{}_ratio", where), tall.row / wide.column / (row / column), 0.97,
                            1.03, "", "rows over columns, over that of what was put in");
  }
}

void add_one_over_f(const SectionOptions& options, ReportSection& section) {
  constexpr int kLines = 512, kColumns = 6000;
  constexpr double kCorner = 0.05, kRead = 10.0;
  sensor::Detector detector;
  detector.electrons_per_radiance = 1.0;
  detector.read_noise = kRead;
  detector.one_over_f = kCorner;
  const std::vector<double> power = sensor::column_spectrum(
      sensor::one_over_f_noise(detector, options.study.seed, 0, kLines, kColumns, options.study.threads),
      kLines);
  Plot plot;
  plot.title = "Spectrum of 1/f noise";
  plot.x_label = "cycles a line";
  plot.y_label = "electrons^2 per cycle a line";
  plot.x_log = plot.y_log = true;
  PlotSeries measured{"mean over 6,000 columns", "#d55e00", {}, {}, true},
      law{"as put in", "#0072b2", {}, {}, false};
  double most = 0.0;
  for (std::size_t low = 4; low < power.size(); low *= 2) {
    double found = 0.0, expected = 0.0;
    for (std::size_t k = low; k < 2 * low && k < power.size(); ++k) {
      const double law_of_k = kRead * kRead * kCorner * kLines / static_cast<double>(k);
      found += power[k], expected += law_of_k;
      if (k < 40 || k % 8 == 0) {
        measured.x.push_back(static_cast<double>(k) / kLines), measured.y.push_back(power[k]);
        law.x.push_back(measured.x.back()), law.y.push_back(law_of_k);
      }
    }
    most = std::max(most, std::abs(found / expected - 1.0));
  }
  section.figures.at_most("one_over_f", 100.0 * most, 3.0, "%",
                          "1/f noise: largest difference of the power in an octave from what was put in");
  plot.series = {law, measured};
  section.plots.push_back(
      {"one_over_f", plot, "Corner at 0.05 cycles a line, 10 electrons of white read noise."});
}

}  // namespace

ReportSection noise_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Noise";
  section.text =
      "What `ifov detect` draws on a rendered plane of 300 K, and what a laboratory would measure of the detector: photon transfer, fixed patterns "
      "by analysis of variance, the spectrum of 1/f noise.";
  const NoisyPlane plane = noisy_plane(options.study.is_quick() ? 200 : 1000, 0.05, options.study);
  const double within = 0.05 * 3.0 / std::sqrt(2.0 * static_cast<double>(plane.pixels));
  section.figures.between(
      "nedt", plane.spread_k, 0.05 - within, 0.05 + within, "K",
      format("plane of 300 K, NEdT of 0.05 K: spread of {} brightness temperatures", plane.pixels));
  const double mean_within = 4.0 * 0.05 / std::sqrt(static_cast<double>(plane.pixels));
  section.figures.between("nedt_mean", plane.mean_k, 300.0 - mean_within, 300.0 + mean_within, "K",
                          "and their mean");
  add_photon_transfer(section);
  add_patterns(section);
  add_one_over_f(options, section);
  return section;
}

}  // namespace ifov::studies
