#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/document/document_values.h"
#include "io/document/spectrum_document.h"

namespace ifov::io {

class CameraSettings;
struct OpticsDocument;

struct CameraDocument {
  std::string model;                               ///< its key
  std::shared_ptr<const CameraSettings> settings;  ///< of one of camera_models(); never null once read
  SourcePosition position;
};

struct GaussianChannel {
  double centre_um = 0.0, fwhm_um = 0.0;
};
struct TopHatChannel {
  double from_um = 0.0, to_um = 0.0;
};
struct MonochromaticChannel {
  double at_um = 0.0;
};
/// Relative response from columns of numbers, wavelength first.
struct TabulatedChannel {
  DocumentFile file;
  double um_per_unit = 1.0;  ///< micrometres per unit of the wavelength column
  int column = 2;            ///< which column holds the response, counted from 1
  std::string band;          ///< which block of a file with several (";; <name>" lines); empty: the only one
};

struct PolarizerDocument {
  double angle_rad = 0.0;  ///< of the axis, from the image's right counterclockwise as the image is looked at
  double extinction = 1e4;  ///< light along the axis that is let through over light across it
  friend bool operator==(const PolarizerDocument&, const PolarizerDocument&) = default;
};
struct RetarderDocument {                        ///< before the polarizer
  double retardance_rad = 0.0, angle_rad = 0.0;  ///< the angle is of the slow axis, as a polarizer's
  friend bool operator==(const RetarderDocument&, const RetarderDocument&) = default;
};

/// Series in the document have been spread out: one entry per channel, with a name of its own.
struct ChannelDocument {
  std::string name;
  std::variant<GaussianChannel, TopHatChannel, TabulatedChannel, MonochromaticChannel> response;
  SourcePosition position;
  std::optional<SpectrumDocument> noise;  ///< noise-equivalent radiance, W m-2 sr-1 um-1
  std::optional<double> noise_k;          ///< or noise-equivalent temperature difference at 300 K
  std::optional<PolarizerDocument> polarizer = {};
  std::optional<RetarderDocument> retarder = {};
  std::shared_ptr<const struct SnrDocument> snr = {};  ///< or a ratio, in place of the noise; null: none
  std::shared_ptr<const struct DetectorDocument> detector = {};  ///< what it has of its own; null: nothing
  std::optional<std::array<double, 2>> shift_px = {};            ///< of its pixels' responses, right and down
  std::shared_ptr<const struct SmileDocument> smile = {};        ///< null: the sensor's; likewise
  std::shared_ptr<const struct KeystoneDocument> keystone = {};
};

struct SensorDocument {
  CameraDocument camera;
  std::shared_ptr<const struct MountList> mounts;  ///< of its own, on the platform's; null: none
  std::vector<ChannelDocument> channels;           ///< at least one; names are unique
  std::shared_ptr<const struct PsfDocument> psf;   ///< (psf_document.h); null: no blur
  bool stokes = false;                             ///< Q, U and V are told beside I
  double fill_factor = 1.0;  ///< sensitive area of an element over its pitch's, a centred square
  double sides_apart = 0.0;  ///< by what share sides of elements differ from its own; never written
  std::shared_ptr<const OpticsDocument> optics;         ///< null: none is told; likewise
  std::shared_ptr<const DetectorDocument> detector;     ///< (detector_document.h)
  std::shared_ptr<const SmileDocument> smile;           ///< null: responses are alike in all columns
  std::shared_ptr<const KeystoneDocument> keystone;     ///< (spectrometer_document.h)
  std::shared_ptr<const struct MosaicDocument> mosaic;  ///< null: each element sees all channels
  SourcePosition position, psf_position;
};

}  // namespace ifov::io
