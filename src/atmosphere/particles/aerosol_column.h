#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "atmosphere/particles/aerosol_optics.h"
#include "atmosphere/profile/profile.h"

namespace ifov::atmosphere {

class LayerHeights;
class Particles;
class PhaseFunction;
struct AerosolDescription;
struct ParticleLayer;

/// The aerosol over height: boundary layer to 2 km, tropospheric to 10 km, stratospheric to 30 km, meteoric
/// dust above; extinction at 550 nm of LOWTRAN7 (interpolated in 1/visibility), each kind with its own
/// spectral shape, that of the boundary layer at its mean humidity (mean of log(100 % - humidity) weighted
/// with extinction), the tropospheric at 70 %. Haze of the user's own is a region more, in place of the first two, and clouds
/// are the last ones.
class AerosolColumn {
 public:
  static constexpr std::size_t kRegions =
      4;  ///< of LOWTRAN7, the first in the list where there is its aerosol
  /// InputError for unknown names, more than one of visibility, optical thickness and own haze, or values that cannot be.
  /// `model` names the model atmosphere whose season holds where none is given.
  AerosolColumn(const AerosolDescription& description, const Profile& profile, std::string_view model);

  bool empty() const { return regions_.empty(); }
  bool hazy() const { return first_cloud_ > 0; }         ///< there is aerosol, beside clouds or alone
  double cloud_top_km() const { return cloud_top_km_; }  ///< of the highest, where there are any
  bool cloudy() const { return first_cloud_ < regions_.size(); }
  std::size_t first_cloud() const {
    return first_cloud_;
  }  ///< of the regions; their number where there is none
  std::size_t regions() const { return regions_.size(); }
  /// Where own haze and clouds begin and end within the air, and for clouds depths of 0.25, 0.75, 1.75 ... from both sides, between
  /// which light changes fast.
  const std::vector<double>& boundaries_km() const { return boundaries_km_; }
  double visibility_km() const { return visibility_km_; }
  double boundary_humidity_percent() const { return humidity_percent_; }
  /// Vertical optical thickness at 550 nm of a region between two altitudes.
  double thickness_550(std::size_t region, double first_km, double last_km) const;
  double thickness_550(double first_km, double last_km) const;  ///< of all but clouds
  /// Extinction at 550 nm, km-1, of a region at an altitude.
  double extinction_550_km(std::size_t region, double altitude) const;
  AerosolProperties properties(std::size_t region, double wavelength_um) const;
  PhaseFunction phase_function(std::size_t region, double wavelength_um) const;
  const Particles& particles(std::size_t region) const { return *regions_[region].particles; }

 private:
  struct Region {
    std::vector<double> altitude_km, extinction_km;  ///< empty where `heights` tells
    std::shared_ptr<const Particles> particles;
    std::shared_ptr<const LayerHeights> heights = {};
    double thickness_550 = 0.0;  ///< of a region with `heights`
  };
  void add_haze(const AerosolDescription& description, const Profile& profile, std::string_view model);
  /// The share of the layer that lies between two altitudes is told by the heights that this returns.
  std::shared_ptr<const LayerHeights> add(const ParticleLayer& layer, double thickest, double ground_km);
  void add_cloud(const ParticleLayer& layer, double ground_km);
  std::vector<Region> regions_;
  std::size_t first_cloud_ = 0;
  double cloud_top_km_ = 0.0;
  std::vector<double> boundaries_km_;
  double visibility_km_ = 0.0;
  double humidity_percent_ = 0.0;
};

}  // namespace ifov::atmosphere
