#pragma once

#include <optional>
#include <vector>

namespace ifov::io {

/// Diffraction of an aperture with vanes in it and a wavefront behind it: the first three as of an AiryPsf.
struct PupilDocument {
  std::optional<double> aperture_m, wavelength_um, obscuration;
  struct Spiders {
    int count = 0;
    double width = 0.0;  ///< over the aperture's diameter
    double angle_rad = 0.0;
  };
  std::optional<Spiders> spiders;
  std::optional<double> defocus_m;
  struct Coefficient {
    int noll = 0;
    std::optional<double> rms_m, rms_waves;  ///< one of them
  };
  std::vector<Coefficient> zernike;
};

}  // namespace ifov::io
