#include "sensor/detector/detector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ifov::sensor {
namespace {

// In alphabetical order, in which records hold them.
constexpr DetectorFigure kFigures[] = {
    {"background", &Detector::background},
    {"bits", &Detector::bits},
    {"blooming", &Detector::blooming},
    {"column_gain", &Detector::column_gain},
    {"column_offset", &Detector::column_offset},
    {"dark", &Detector::dark},
    {"dead_share", &Detector::dead_share},
    {"dsnu", &Detector::dsnu},
    {"electrons_per_radiance", &Detector::electrons_per_radiance},
    {"full_well", &Detector::full_well},
    {"gain", &Detector::gain},
    {"hot_dark", &Detector::hot_dark},
    {"hot_share", &Detector::hot_share},
    {"nonlinearity", &Detector::nonlinearity},
    {"nuc_frames", &Detector::nuc_frames},
    {"nuc_high", &Detector::nuc_high},
    {"nuc_low", &Detector::nuc_low},
    {"offset", &Detector::offset},
    {"one_over_f", &Detector::one_over_f},
    {"prnu", &Detector::prnu},
    {"read_noise", &Detector::read_noise},
    {"row_gain", &Detector::row_gain},
    {"row_offset", &Detector::row_offset},
    {"specimen", &Detector::specimen},
    {"vignette_2", &Detector::vignette_2},
    {"vignette_4", &Detector::vignette_4},
    {"vignette_6", &Detector::vignette_6},
    {"vignette_px", &Detector::vignette_px},
};

}  // namespace

std::span<const DetectorFigure> detector_figures() { return kFigures; }

bool Detector::has_pattern() const {
  return prnu > 0.0 || dsnu > 0.0 || row_gain > 0.0 || row_offset > 0.0 || column_gain > 0.0 ||
         column_offset > 0.0 || dead_share > 0.0 || hot_share > 0.0;
}

Detector Detector::lit_by(double share) const {
  Detector there = *this;
  there.electrons_per_radiance *= share;
  return there;
}

double Detector::largest_count() const { return std::exp2(bits) - 1.0; }

double Detector::mean_electrons(double radiance_w_m2_sr_um) const {
  return electrons_per_radiance * radiance_w_m2_sr_um + background + dark;
}

double Detector::radiance_w_m2_sr_um(double electrons) const {
  return (electrons - background - dark) / electrons_per_radiance;
}

double Detector::variance(double radiance_w_m2_sr_um) const {
  return std::max(mean_electrons(radiance_w_m2_sr_um), 0.0) + read_noise * read_noise + gain * gain / 12.0;
}

double Detector::noise_w_m2_sr_um(double radiance_w_m2_sr_um) const {
  return std::sqrt(variance(radiance_w_m2_sr_um)) / electrons_per_radiance;
}

double Detector::correction_noise(double radiance_w_m2_sr_um) const {
  if (!is_corrected()) return 0.0;
  const double share = (radiance_w_m2_sr_um - nuc_low) / (nuc_high - nuc_low);
  return std::sqrt((variance(nuc_low) * (1.0 - share) * (1.0 - share) + variance(nuc_high) * share * share) /
                   nuc_frames);
}

double Detector::count(double signal) const {
  if (!(std::abs(signal) <= std::numeric_limits<double>::max())) return 0.0;
  return std::clamp(std::floor(offset + signal / gain + 0.5), 0.0, largest_count());
}

double Detector::largest_signal() const {
  const double well = full_well > 0.0 ? full_well : std::numeric_limits<double>::infinity();
  return digitises() ? std::min(well, signal_of_count(largest_count())) : well;
}

}  // namespace ifov::sensor
