#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "atmosphere/particles/aerosol_optics.h"
#include "atmosphere/particles/aerosol_phase_functions.h"
#include "atmosphere/profile/profile.h"

namespace ifov::atmosphere {

struct AerosolDescription;

/// The aerosol over height: boundary layer to 2 km, tropospheric to 10 km, stratospheric to 30 km, meteoric
/// dust above; extinction at 550 nm of LOWTRAN7 (interpolated in 1/visibility), each kind with its own
/// spectral shape, that of the boundary layer at its mean humidity (mean of log(100 % - humidity) weighted
/// with extinction), the tropospheric at 70 %.
class AerosolColumn {
 public:
  static constexpr std::size_t kRegions = 4;
  /// InputError for unknown names, both of visibility and optical thickness, or values that cannot be.
  /// `model` names the model atmosphere whose season holds where none is given.
  AerosolColumn(const AerosolDescription& description, const Profile& profile, std::string_view model);

  bool empty() const { return regions_.empty(); }
  double visibility_km() const { return visibility_km_; }
  double boundary_humidity_percent() const { return humidity_percent_; }
  /// Vertical optical thickness at 550 nm of a region between two altitudes.
  double thickness_550(std::size_t region, double first_km, double last_km) const;
  double thickness_550(double first_km, double last_km) const;  ///< of all
  /// Extinction at 550 nm, km-1, of a region at an altitude.
  double extinction_550_km(std::size_t region, double altitude) const;
  AerosolProperties properties(std::size_t region, double wavelength_um) const;
  PhaseFunction phase_function(std::size_t region, double wavelength_um) const;

 private:
  struct Region {
    std::vector<double> altitude_km, extinction_km;
    AerosolOptics optics;
    AerosolPhaseFunctions phase_functions;
  };
  std::vector<Region> regions_;
  double visibility_km_ = 0.0;
  double humidity_percent_ = 0.0;
};

}  // namespace ifov::atmosphere
