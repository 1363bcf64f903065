#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "materials/bsdf/event/bsdf_event.h"
#include "radiometry/spectrum.h"

namespace ifov::materials {

/// Where light of the far side comes from.
enum class Passage : std::uint8_t {
  none,      ///< it does not come through, or is spread (a leaf)
  straight,  ///< through a sheet, without a change of direction
  into,      ///< out of a medium that begins behind the surface, as seen from outside
  out_of,    ///< the same surface as seen from within the medium
};

/// A direction drawn for light that leaves a surface towards `outgoing`.
struct BsdfSample {
  math::Vec3 incoming;  ///< unit, from the surface towards where the light comes from
  double weight = 0.0;  ///< shape x cosine / pdf; 0 where nothing is scattered
  double pdf = 0.0;     ///< per steradian; 0 for a delta
};

/// The two numbers from which a direction was drawn.
struct UnitSquarePoint {
  double u1 = 0.0, u2 = 0.0;
};

/// How a surface spreads light: a bidirectional scattering distribution function (Nicodemus et al. 1977) with its
/// parameters, immutable and shared between threads. Reciprocal.
///
/// Of a separable model the BSDF is factor(wavelength) x shape(event): the factor is the material's reflectance or
/// transmittance, and the directional-hemispherical reflectance of the shape is 1. Constituents of one surface whose
/// model is the same object are then added up before light is spread. Any other model gives its BSDF by event, in all
/// wavelengths at once (evaluate()); its shape() is 1 where it may scatter, and materials work out its
/// directional-hemispherical reflectance, so that emissivity is 1 less that (Kirchhoff).
class Bsdf {
 public:
  virtual ~Bsdf() = default;

  /// All light of a side leaves in one direction: sample() gives the direction that it came from, weight 1 (0: there is none), shape()
  /// and pdf() are 0. Of such a model that is not separable evaluate() gives the share of radiance that comes that way, 0 to 1; in a
  /// medium radiance stands for basic radiance, L / n^2 (docs/theory/surfaces.md).
  virtual bool is_delta() const { return false; }
  virtual bool is_separable() const { return false; }
  virtual bool is_lambertian() const { return false; }  ///< its shape is 1/pi
  /// A separable model is isotropic.
  virtual bool is_isotropic() const { return true; }
  virtual bool may_transmit() const { return false; }
  /// The longest wavelength to which its theory holds, um; beyond it is about right.
  virtual double holds_to_um() const { return std::numeric_limits<double>::infinity(); }
  virtual Passage passage() const { return Passage::none; }
  /// The same surface from its other side, where that differs; null: it does not.
  virtual std::shared_ptr<const Bsdf> behind() const { return nullptr; }
  /// Of `into` and `out_of`: the index of the medium by which directions are bent.
  virtual double bending_index() const { return 1.0; }
  /// Of `into`: what the medium absorbs, 1/m, by wavelength; null: nothing.
  virtual const radiometry::Spectrum* absorption() const { return nullptr; }

  /// Draws `incoming` for all else of the view, on its side. Unless overridden, in proportion to the cosine.
  virtual BsdfSample sample(const BsdfEvent& view, double u1, double u2) const;
  /// Density with which sample() draws `incoming`, 1/sr.
  virtual double pdf(const BsdfEvent& event) const;
  /// The numbers from which sample() draws `incoming`.
  virtual UnitSquarePoint invert(const BsdfEvent& event) const;
  /// Where sample() draws from two lobes: it takes one for u1 below this number, which is 0 of a model with one. It is smooth in
  /// its numbers on either side, and two points of the square may lead to one direction; invert() then gives either.
  virtual double seam(const BsdfEvent& view) const;
  /// 1/sr for a separable model, else 1; 0 where either direction is not on its side of the surface.
  virtual double shape(const BsdfEvent& event) const;

  /// About what evaluate() gives in a wavelength in which the surface absorbs nothing, 1/sr: whether a path goes on is decided
  /// by this, before its spectrum is known. Lambert's, unless overridden; a model with a lobe overrides it, so that sample()'s
  /// weight times this is about 1 and no path counts for many. Of a separable model shape().
  virtual double grey(const BsdfEvent& event) const;

  /// How far the micro-facets of its lobe lean: least and most standard deviations of their slope, by direction. 0: it has no
  /// lobe.
  struct LobeSlopes {
    double least = 0.0, most = 0.0;
  };
  virtual LobeSlopes lobe_slopes() const { return {}; }
  /// Share of grey() that its lobe makes, 0 to 1.
  virtual double lobe_share(const BsdfEvent&) const { return 0.0; }
  virtual bool lobe_is_all() const { return false; }  ///< what is not of the lobe its facets reflect again
  /// What that lobe would be if its facets leant by `slope` at least, 1/sr: light that it throws somewhere, spread so far that random
  /// paths find it. Every model whose lobe may throw_rarely() has it.
  virtual double widened_lobe(const BsdfEvent&, double /*slope*/) const { return 0.0; }
  virtual double passed_spread() const { return 0.0; }  ///< rad, of a lobe that comes through; 0: wide
  virtual double through_share(const BsdfEvent&) const { return -1.0; }  ///< of paths; < 0: by factors

  /// What evaluate() needs in the wavelengths of its spectrum; none of a separable model.
  virtual std::span<const radiometry::Spectrum> spectra() const { return {}; }
  /// BSDF, 1/sr, in `count` wavelengths, for an event whose directions are on their sides. `parameters` are the spectra of
  /// spectra(), in their order. Never called of a separable model.
  virtual void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                        float* bsdf) const;

  /// Whether light that leaves is polarized by the surface, or keeps of its polarization. Without it light leaves
  /// unpolarized, whatever arrives.
  virtual bool polarizes() const { return false; }
  /// What evaluate_mueller() needs beside spectra(); they may be negative. None of a separable model.
  virtual std::span<const radiometry::Spectrum> polarization_spectra() const { return {}; }
  /// As evaluate(), the whole matrix (of a separable model over its factor; of a delta as seen by sample()): writes
  /// columns() of `rows` in `count` wavelengths. `parameters` are the spectra of spectra() and then those of
  /// polarization_spectra(). Element 0, 0 is what evaluate() gives. Called where polarizes() alone.
  virtual void evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                                const MuellerRows& rows) const;
};

}  // namespace ifov::materials
