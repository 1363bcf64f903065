#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/document/document_values.h"
#include "io/document/spectrum_document.h"
#include "math/vec3.h"

namespace ifov::io {

/// Parallel rays, straight down or aslant; pixels are squares of the plane z = 0. Rotation 0 has north (+y) at the top of the image.
struct OrthographicCamera {
  double gsd_m = 0.0;
  int width_px = 0, height_px = 0;
  /// Ground point of the image's centre; absent: the scene's origin.
  std::optional<std::array<double, 2>> centre_m;
  double rotation_rad = 0.0;  ///< of the camera about the vertical, clockwise seen from above: the top of the
                              ///< image points to this azimuth
  std::optional<double> height_m;                        ///< z at which rays start; absent: above everything
  double view_zenith_rad = 0.0, view_azimuth_rad = 0.0;  ///< of the direction from the ground to the sensor
};

/// Turns the camera so that its axis passes through a point.
struct LookAt {
  math::Point3 target_m;
  std::optional<math::Vec3> up;  ///< scene direction that is up in the image; absent: +z, or north (+y) where
                                 ///< the camera looks along z
};

/// Attitude of the aircraft that the camera hangs below, its axis along the body's down and the top of the
/// image at the nose: yaw clockwise from north, pitch nose up, roll right wing down, the 3-2-1 sequence in
/// north-east-down axes. All zero looks straight down with north at the top.
struct Attitude {
  double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
};

struct FrameCamera {
  double focal_length_m = 0.0;
  double pitch_m = 0.0;  ///< of the detector elements
  int width_px = 0, height_px = 0;
  math::Point3 position_m;
  std::variant<LookAt, Attitude> orientation;
};

struct CameraDocument {
  std::variant<OrthographicCamera, FrameCamera> model;
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

/// Series in the document have been spread out: one entry per channel, with a name of its own.
struct ChannelDocument {
  std::string name;
  std::variant<GaussianChannel, TopHatChannel, TabulatedChannel, MonochromaticChannel> response;
  SourcePosition position;
  std::optional<SpectrumDocument> noise;  ///< noise-equivalent radiance, W m-2 sr-1 um-1
  std::optional<double> noise_k;          ///< or noise-equivalent temperature difference at 300 K
};

struct NoPsf {};
struct GaussianPsf {
  double sigma_px = 0.0;
};
/// Diffraction of a circular aperture at one wavelength; with a frame camera only.
struct AiryPsf {
  double aperture_m = 0.0;
  double wavelength_um = 0.0;
};
struct KernelPsf {
  DocumentFile file;               ///< an image, its centre at the pixel's centre
  double samples_per_pixel = 1.0;  ///< kernel samples along one pixel side
};

struct SensorDocument {
  CameraDocument camera;
  std::vector<ChannelDocument> channels;  ///< at least one; names are unique
  std::variant<NoPsf, GaussianPsf, AiryPsf, KernelPsf> psf;
  SourcePosition psf_position;
  double fill_factor = 1.0;  ///< sensitive share of an element's area, a centred square
  SourcePosition position;
};

}  // namespace ifov::io
