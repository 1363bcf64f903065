#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace ifov::radiometry {

/// What a spectrum is outside the wavelengths it was given at.
enum class OutsideRange {
  error,   ///< asking is an InputError that names the spectrum and its range
  extend,  ///< the first or last value goes on
  zero,    ///< nothing there (spectral responses)
};

/// A function of wavelength, linear between given points, or one number for all wavelengths. Any quantity:
/// the unit is the caller's. Immutable.
class Spectrum {
 public:
  /// 0 everywhere.
  Spectrum() : values_{0.0} {}
  static Spectrum constant(double value);
  /// Values at strictly increasing wavelengths, as many of one as of the other, all finite (else InputError).
  /// `name` is what error messages call it.
  Spectrum(std::vector<double> wavelength_um, std::vector<double> values,
           OutsideRange outside = OutsideRange::error, std::string name = {});

  double at(double wavelength_um) const;
  bool is_constant() const { return wavelength_um_.empty(); }
  double first_um() const;  ///< -infinity for a constant
  double last_um() const;   ///< +infinity for a constant
  OutsideRange outside() const { return outside_; }
  const std::string& name() const { return name_; }
  std::span<const double> wavelength_um() const { return wavelength_um_; }  ///< empty for a constant
  std::span<const double> values() const { return values_; }                ///< one value for a constant
  double maximum() const;
  double minimum() const;

  /// f(value) at every given point (linear maps are exact).
  Spectrum mapped(const std::function<double(double)>& f) const;
  Spectrum scaled(double factor) const;
  /// 1 - value: emissivity of an opaque surface from its reflectance.
  Spectrum complement() const;
  Spectrum with_outside(OutsideRange outside) const;
  Spectrum with_name(std::string name) const;

 private:
  std::vector<double> wavelength_um_;
  std::vector<double> values_;
  OutsideRange outside_ = OutsideRange::error;
  std::string name_;
};

/// `within`, a table, where it is known, and `beyond` on either side of that.
Spectrum continued(const Spectrum& within, const Spectrum& beyond);

/// Of both, where both can be asked; linear between the points of either. The first alone where there is no such wavelength.
Spectrum sum(const Spectrum& a, const Spectrum& b);

/// Integral over [first_um, last_um] of the product of some spectra, exact for up to
/// seven piecewise linear factors.
double integral_of_product(std::span<const Spectrum* const> factors, double first_um, double last_um);
double integral(const Spectrum& spectrum, double first_um, double last_um);

/// Mean of `spectrum` weighted with `weight`, over the range of `weight` (which must be a table with a
/// positive integral, else InputError).
double weighted_mean(const Spectrum& spectrum, const Spectrum& weight);

/// Points between which all the spectra are linear, within [first_um, last_um], ends included; sorted, each
/// once.
std::vector<double> merged_wavelengths_um(std::span<const Spectrum* const> spectra, double first_um,
                                          double last_um);

/// Where what is made of several spectra is known, and how it ends: one that is an error outside its range bounds it, the
/// others are asked beyond theirs.
struct CommonWavelengths {
  /// As merged_wavelengths_um; empty where all are constants, or where there is no such wavelength.
  std::vector<double> um;
  OutsideRange outside = OutsideRange::extend;
};
CommonWavelengths common_wavelengths(std::span<const Spectrum* const> spectra);

}  // namespace ifov::radiometry
