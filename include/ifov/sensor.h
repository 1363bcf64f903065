#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ifov/document.h"

namespace ifov {

/// What follows of a document's sensor before a ray is cast.
struct SensorDescription {
  int width_px = 0, height_px = 0;
  std::optional<double> gsd_m;     ///< where the middle of the image meets z = 0
  std::optional<double> swath_m;   ///< between the ends of the middle line, on z = 0
  double ifov_rad = 0.0;           ///< of a pixel in the middle, across; 0 where rays are parallel
  std::optional<double> f_number;  ///< of the optics
  /// Of a frame camera that flies, how far the picture of z = 0 moves at most: while a row is exposed, and from row to row of a rolling shutter.
  std::optional<double> smear_px, row_shift_px;

  struct Channel {
    std::string name;
    double centre_um = 0.0, fwhm_um = 0.0;
    double pixel_mtf = 0.0;         ///< at half a cycle a pixel: of the sensitive square
    std::optional<double> psf_mtf;  ///< of the document's point spread function, where a formula tells it
    std::optional<double> diffraction_mtf;  ///< of the optics' aperture at the centre of the channel
    bool has_detector = false;
    // With a detector, in one exposure at its reference:
    double radiance = 0.0;  ///< W m-2 sr-1 um-1
    double photons = 0.0;   ///< that meet the element through optics and channel
    double electrons = 0.0, background = 0.0, dark = 0.0;
    std::optional<double> well_share;  ///< of what can be told, by all electrons together
    std::optional<double> snr;
    // With any noise:
    double nedl = 0.0;           ///< W m-2 sr-1 um-1; 0: no noise is told
    std::optional<double> nedt;  ///< K, at the temperature of the radiance, or at 300 K
    std::optional<double> nedt_at_k;
    /// Of a spectrometer, by detector column: the least and the most that its centre and its width are, and how far to the right it looks.
    struct Range {
      double least = 0.0, most = 0.0;
    };
    std::optional<Range> centres_um, fwhms_um;  ///< with a smile
    std::optional<Range> shift_px;              ///< with a keystone
    // Of a detector with a lag or a time constant:
    std::optional<double> step_share;  ///< of a step of the light that the first exposure shows
    std::optional<double> memory_mtf;  ///< modulation of what swings by half a cycle an exposure
    /// Of optics with vignetting: the light of the middle that falls on the image's corners, and SNR and NEdT there.
    std::optional<double> corner_light, corner_snr, corner_nedt;
    /// Of a detector that is corrected, what is left from element to element at its reference, W m-2 sr-1 um-1.
    std::optional<double> correction_left;
  };
  std::vector<Channel> channels;
  std::string
      mosaic;  ///< names of channels by element, rows in parentheses; empty: elements see all channels
};

/// Formulas: docs/theory/detectors.md. Neither scene nor atmosphere is loaded: a nadir camera whose height follows from the scene stands on
/// z = 0. Throws InputError, located; SystemError for files of responses and spectra.
IFOV_API SensorDescription describe_sensor(const Document& document);

/// An instrument whose published figures a document takes by name ("preset").
struct SensorPresetInfo {
  std::string name, about;
  std::vector<std::string> also;     ///< other names that it is found by
  std::vector<std::string> sources;  ///< with licences
  int bands = 0;
  double first_um = 0.0, last_um = 0.0;  ///< between the outermost half-maxima
  std::string noise;                     ///< "SNR", "NEdT of 3", ...; empty: none is told
  std::string ground;                    ///< size of its pixels on the ground, or its kind, in words
  std::string document;                  ///< it over the shore of a lake, to be changed: a document, JSON
};
IFOV_API std::vector<SensorPresetInfo> sensor_preset_list();
/// By its name or another that it has, letters compared without case. Throws InputError, naming near misses.
IFOV_API SensorPresetInfo find_sensor_preset(const std::string& name);

}  // namespace ifov
