#pragma once

#include <memory>
#include <string>
#include <vector>

namespace ifov::sampling {
class PixelFootprint;
}

namespace ifov::sensor {

struct AiryAperture;
struct AlongTrack;

/// Point spread function of the optics as a pixel looks through it: what of the light of a point that lies so far from the pixel comes to
/// it, which is the image of a point turned by 180 deg. A density over the focal plane in 1/px^2, cut to a finite support
/// and normalised to 1 within it. Coordinates are image offsets in pixels, x right, y down.
class Psf {
 public:
  virtual ~Psf() = default;

  /// The density vanishes where |dx| or |dy| is larger.
  virtual double half_width_px() const = 0;

  /// Energy that falls on the rectangle [x0, x1] x [y0, y1].
  virtual double energy(double x0_px, double y0_px, double x1_px, double y1_px) const = 0;

  /// Size of the finest structure: tables of the density take several cells over it.
  virtual double detail_px() const = 0;

  /// Share of the whole energy within the cut.
  virtual double kept() const = 0;

  /// Density of what the cut leaves out, in shares of the whole energy per px^2: 0 within the cut, integral 1 - kept().
  /// `smooth`: without rings that are too fine to matter.
  virtual double cut_density(double dx_px, double dy_px, bool smooth) const = 0;

  /// Whether that is enough to be worth rays of its own (PsfWings).
  virtual bool has_wings() const { return false; }

  /// Whether the density goes by the distance from the middle alone.
  virtual bool round() const { return true; }

  /// Whether it is a density along x times one along y.
  virtual bool separable() const { return false; }

  /// Whether it is alike on both sides of either axis, and its rings are those of a round one, stretched or spread.
  virtual bool mirrored() const { return round(); }

  /// One line for people: shape, parameters, where it is cut and how much energy the cut leaves out.
  virtual std::string description() const = 0;
};

/// Gaussian exp(-r^2 / (2 sigma^2)), cut to the square |dx|, |dy| <= cut_sigmas * sigma. The default of 4.4
/// leaves out 1 - erf(4.4 / sqrt 2)^2 = 2.2e-5 of the energy; a wider one makes more pixels share each ray.
std::unique_ptr<Psf> make_gaussian_psf(double sigma_px, double cut_sigmas = 4.4);

/// Diffraction, cut at the radius that encircles the given share of the energy; what lies beyond is PsfWings'.
std::unique_ptr<Psf> make_airy_psf(const AiryAperture& aperture, double encircled_energy = 0.95);

/// The share to trace: 95 %, or more of a pattern that is small beside a pixel, whose wings lie within the pixel that its edges cross: as far as
/// 0.45 pixels, and 99.5 % at most.
double airy_energy_to_trace(const AiryAperture& aperture);

/// A measured or computed image of a point: rows x columns samples, each a constant over a square of side 1 /
/// samples_per_pixel, its middle where the point is. Normalised here.
std::unique_ptr<Psf> make_kernel_psf(int columns, int rows, std::vector<double> values,
                                     double samples_per_pixel);

/// The PSF in the pixels of an image in which a pixel of the focal plane is so many samples long along x, and so many lines along y.
std::unique_ptr<const Psf> stretched_psf(std::unique_ptr<const Psf> psf, double along_x, double along_y);

/// The same PSF, but that what its cut leaves out is spread over the length of a line scanner's elements and their stages, or along x over
/// that of elements that are swept; over the motion of an exposure it is not.
std::shared_ptr<const Psf> spread_cut(std::shared_ptr<const Psf> psf, const AlongTrack& along, bool along_x);

/// Response of a pixel: the PSF convolved with the detector's sensitive square of side sqrt(fill_factor).
/// A null PSF is perfect optics.
sampling::PixelFootprint make_footprint(const Psf* psf, double fill_factor);

/// The same of a line scanner, whose sensitive area is sqrt(fill_factor) across and what AlongTrack says along the track.
sampling::PixelFootprint make_footprint(const Psf* psf, double fill_factor, const AlongTrack& along);

/// The same of elements that are swept along image x, where AlongTrack counts there; sqrt(fill_factor) along y.
sampling::PixelFootprint make_swept_footprint(const Psf* psf, double fill_factor, const AlongTrack& along);

}  // namespace ifov::sensor
