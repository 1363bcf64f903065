#pragma once

namespace ifov::radiometry {
struct Channel;
class Spectrum;
}  // namespace ifov::radiometry

namespace ifov::sensor {

/// What light meets a detector element through: equation (1) and (2) of docs/theory/detectors.md.
struct ElementOptics {
  double f_number = 0.0;
  double obscuration = 0.0;  ///< of the aperture's diameter
  double area_m2 = 0.0;      ///< that is sensitive
  double integration_time_s = 0.0;

  /// Area times solid angle, m2 sr: A pi (1 - obscuration^2) / (4 N^2), of optics that obey the sine condition.
  double throughput_m2_sr() const;
};

/// Electrons per W m-2 sr-1 um-1 of light whose spectral radiance is the same all over the channel. The response, scaled to a maximum
/// of 1, stands for the transmittance of the channel's filter; `transmittance` of the optics and `quantum_efficiency` come on top. A
/// monochromatic channel has no width and gets none.
double electrons_per_radiance(const ElementOptics& optics, const radiometry::Channel& channel,
                              const radiometry::Spectrum& transmittance,
                              const radiometry::Spectrum& quantum_efficiency);

/// Electrons of what optics of a temperature and an emissivity send through the channel's filter, within the cone of the light.
double background_electrons(const ElementOptics& optics, const radiometry::Channel& channel,
                            const radiometry::Spectrum& emissivity,
                            const radiometry::Spectrum& quantum_efficiency, double temperature_k);

}  // namespace ifov::sensor
