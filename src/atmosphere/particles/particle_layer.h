#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ifov::atmosphere {

class Particles;

/// Particles between two altitudes, as somebody asks for them.
struct ParticleLayer {
  struct Height {
    double altitude_km = 0.0;  ///< above mean sea level
    double density = 0.0;      ///< in any unit, 0 or more
  };
  std::string name = "haze";    ///< in messages
  double optical_depth = 0.0;   ///< vertical, of extinction ...
  double wavelength_um = 0.55;  ///< ... at this wavelength
  std::shared_ptr<const Particles> particles;
  std::optional<double> base_km;  ///< above mean sea level; none: the ground
  std::optional<double> top_km;   ///< none: the end of the air
  std::optional<double>
      scale_height_km;  ///< of a density that falls exponentially; none: uniform, or 2 km without a top
  /// A density of one's own at rising altitudes, two or more, linear between and none beyond; base, top and scale height are then
  /// none. Empty: as these say.
  std::vector<Height> heights = {};
};

inline constexpr double kThickestCloud = 100.0;  ///< optical depth at 550 nm

/// Where the particles of a layer are, over ground at some altitude.
class LayerHeights {
 public:
  static constexpr double kUsualScale_km = 2.0;
  /// InputError for a layer inside the ground, above the air or upside down.
  LayerHeights(const ParticleLayer& layer, double ground_km);
  /// Of the layer's particles, the share between two altitudes.
  double share(double low_km, double high_km) const;
  /// Share per km at an altitude.
  double density(double altitude_km) const;
  double base_km() const { return base_km_; }
  double top_km() const { return top_km_; }
  /// Where the density begins, ends and bends.
  std::vector<double> boundaries_km() const;

 private:
  double above(double altitude_km) const;
  double above_in_table(double altitude_km) const;
  double base_km_, top_km_;
  std::optional<double> scale_km_;
  std::vector<ParticleLayer::Height> table_;
};

}  // namespace ifov::atmosphere
