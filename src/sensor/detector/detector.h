#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace ifov::sensor {

/// What a detector element makes of one channel's radiance in one exposure: all that follows from optics, detector and the channel's
/// response, in electrons where nothing else is said. Symbols and equations are those of docs/theory/detectors.md. A struct of plain
/// figures, so that the record of a run can hold it.
struct Detector {
  double electrons_per_radiance = 0.0;  ///< k, per W m-2 sr-1 um-1 (1); 0: none, the channel has no detector
  double background = 0.0;              ///< of the optics' own emission (2)
  double dark = 0.0;                    ///< of the dark current
  double read_noise = 0.0;              ///< standard deviation
  double one_over_f = 0.0;    ///< corner of the read noise's spectrum, cycles a line (6); 0: it is white
  double full_well = 0.0;     ///< 0: it holds any number
  double nonlinearity = 0.0;  ///< share that is missing at the full well (4)
  double gain = 0.0;          ///< electrons a count; 0: nothing is digitised
  double offset = 0.0;        ///< counts without any electron
  double bits = 0.0;          ///< of the counts; 0: nothing is digitised
  double prnu = 0.0;          ///< spread of the response from element to element, a share of it
  double dsnu = 0.0;          ///< spread of the signal in darkness likewise
  double row_gain = 0.0;      ///< spread of what all elements of a row share, of the response
  double row_offset = 0.0;    ///< and of the signal in darkness
  double column_gain = 0.0;   ///< likewise of columns
  double column_offset = 0.0;
  double dead_share = 0.0;  ///< share of elements that answer no light
  double hot_share = 0.0;   ///< share of elements whose dark current is another
  double hot_dark = 0.0;    ///< electrons of theirs, in place of `dark`
  double blooming = 0.0;    ///< share of what a full well cannot hold that runs over into its neighbours
  double nuc_low =
      0.0;  ///< radiances that response and offset of each element were measured at, W m-2 sr-1 um-1
  double nuc_high = 0.0;
  double nuc_frames = 0.0;   ///< exposures of each; 0: they were not measured, and nothing is corrected
  double vignette_px = 0.0;  ///< focal length, pixels, by which light falls as cos^4 (12); 0: it does not
  double vignette_2 = 0.0;   ///< and terms of the second, fourth and sixth power of the image height
  double vignette_4 = 0.0;
  double vignette_6 = 0.0;
  /// Image heights, pixels, and the light there over that of the middle: straight between rows; null: as if there were none.
  std::shared_ptr<const std::vector<std::array<double, 2>>> vignette_rows = nullptr;
  double specimen =
      1.0;  ///< which of all detectors made alike: fixed patterns follow from it (a whole number)

  bool exists() const { return electrons_per_radiance > 0.0; }
  bool digitises() const { return bits > 0.0; }
  bool has_pattern() const;
  bool is_vignetted() const {
    return vignette_px > 0.0 || vignette_2 != 0.0 || vignette_4 != 0.0 || vignette_6 != 0.0 ||
           vignette_rows != nullptr;
  }
  /// The same where so large a share of the light of the middle falls.
  Detector lit_by(double share) const;
  bool is_corrected() const { return nuc_frames > 0.0; }
  /// The largest count.
  double largest_count() const;

  /// Mean of the electrons that are collected, of an element without faults (3); what saturation would leave of them is not looked at.
  double mean_electrons(double radiance_w_m2_sr_um) const;
  /// The radiance that so many make where nothing is noisy: the inverse.
  double radiance_w_m2_sr_um(double electrons) const;
  /// Variance of the signal from exposure to exposure, electrons squared (5): of photons, dark current, read noise and rounding. What
  /// is fixed and what drifts (1/f) is not in it.
  double variance(double radiance_w_m2_sr_um) const;
  /// Its standard deviation as a radiance: NEdL.
  double noise_w_m2_sr_um(double radiance_w_m2_sr_um) const;

  /// Standard deviation from element to element that a correction leaves, electrons (11): of the noise that the measurement had.
  double correction_noise(double radiance_w_m2_sr_um) const;

  /// The count of a signal; 0 of what is not a number.
  double count(double signal) const;
  /// The signal that a count stands for.
  double signal_of_count(double count) const { return (count - offset) * gain; }
  /// The largest signal that can be told, of the full well or of the counts; infinite where there is neither.
  double largest_signal() const;
};

/// One of Detector's figures by the name that records give it.
struct DetectorFigure {
  const char* name;
  double Detector::*value;
};
std::span<const DetectorFigure> detector_figures();

}  // namespace ifov::sensor
