#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "io/document/spectrum_document.h"

namespace ifov::io {

/// What light passes on its way to the detector. Of aperture, focal length and f-number two say the third.
struct OpticsDocument {
  std::optional<double> aperture_m, focal_length_m, f_number;
  double obscuration = 0.0;  ///< diameter of what stands in the middle of the aperture, over its own
  std::optional<SpectrumDocument> throughput;  ///< share of light that is let through; 1 if not given
  std::optional<double> temperature_k;         ///< of the optics; none: they emit nothing
  std::optional<SpectrumDocument> emissivity;  ///< what the throughput leaves of 1 if not given
  struct StrayLight {
    double share = 0.0;      ///< of all light that passes
    double radius_px = 0.0;  ///< that half of it falls within
  };
  std::optional<StrayLight> stray_light;
  struct Vignetting {
    bool cos4 = false;
    std::vector<double>
        polynomial;  ///< of even powers of the image height, from the second on; at most three
    std::optional<DocumentFile> table;  ///< or shares by image heights
  };
  std::optional<Vignetting> vignetting;
  SourcePosition position;

  /// What `other` says, and this where it says nothing; of aperture, focal length and f-number other's or this one's all.
  OpticsDocument under(const OpticsDocument& other) const;
};

/// Dark current of HgCdTe by its cutoff and temperature.
struct Rule07Document {
  double cutoff_um = 0.0, temperature_k = 0.0;
  friend bool operator==(const Rule07Document&, const Rule07Document&) = default;
};

/// Elements whose dark current is another.
struct HotElementsDocument {
  double share = 0.0;
  double dark_current_e_s = 0.0;
  friend bool operator==(const HotElementsDocument&, const HotElementsDocument&) = default;
};

/// What a surface of a temperature sends, or a diffuse one of a reflectance under the Sun at 1 au without air, or a radiance.
struct ReferenceDocument {
  std::optional<double> temperature_k, reflectance;
  double sun_zenith_rad = 0.0;
  std::optional<SpectrumDocument> radiance;  ///< W m-2 sr-1 um-1
};

/// Two lights that response and offset of each element are measured at, and how often.
struct CorrectionDocument {
  ReferenceDocument low, high;
  int frames = 1;
};

/// Detector elements. What a channel says of its own counts before what the sensor says.
struct DetectorDocument {
  std::optional<double> pitch_m, integration_time_s;
  std::optional<SpectrumDocument> quantum_efficiency;
  std::variant<std::monostate, double, Rule07Document> dark_current;  ///< electrons per second and element
  std::optional<double> read_noise;                                   ///< electrons, standard deviation
  std::optional<double> one_over_f;                                   ///< corner, cycles a line
  std::optional<double> full_well;                                    ///< electrons
  std::optional<double> nonlinearity;  ///< share that is missing at the full well
  std::optional<int> bits;
  std::optional<double> gain;                             ///< electrons a count
  std::optional<double> offset;                           ///< counts
  std::optional<double> prnu, row_gain, column_gain;      ///< spreads, shares of the response
  std::optional<double> dsnu, row_offset, column_offset;  ///< spreads, electrons
  std::optional<double> dead;                             ///< share of elements
  std::optional<HotElementsDocument> hot;
  std::optional<int> specimen;
  std::optional<double> lag;  ///< share that stays behind from exposure to exposure
  std::optional<double> time_constant_s, frame_period_s;
  std::optional<double> blooming;  ///< share of what is too much that runs over
  std::optional<CorrectionDocument> correction;
  std::optional<ReferenceDocument> reference;
  SourcePosition position;

  /// What `other` says, and this where it says nothing.
  DetectorDocument under(const DetectorDocument& other) const;
  /// Whether it tells only how elements remember, which goes with noise that is stated, too.
  bool only_remembers() const;
};

/// Noise as a ratio of a radiance to it.
struct SnrDocument {
  double ratio = 0.0;
  SpectrumDocument radiance;  ///< W m-2 sr-1 um-1
};

}  // namespace ifov::io
