#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "thermal/faces/convection.h"
#include "thermal/faces/evaporation.h"
#include "thermal/faces/leaf.h"
#include "thermal/fluxes.h"
#include "thermal/surface_exchange.h"
#include "thermal/wind_profile.h"

namespace ifov::thermal {

struct TimeTable;

/// What comes from outside at one instant.
struct Outdoors {
  double direct_w_m2 = 0.0;   ///< of the Sun across its beam
  double diffuse_w_m2 = 0.0;  ///< of the sky in sunlight on a level plane
  double sun_azimuth_rad = 0.0, sun_elevation_rad = -1.0;
  double longwave_w_m2 = 0.0;  ///< of the sky on a level plane
  MoistAir air;
  double wind_m_s = 0.0;       ///< as measured
  double wind_from_rad = 0.0;  ///< not a number: it is not known
};

/// The same over time at equal distances, linear between; the first and last hold beyond.
struct OutdoorsSeries {
  double begin_s = 0.0, step_s = 300.0;
  std::vector<Outdoors> rows;
  Anemometer anemometer;
};

/// A surface's skin: what it takes of what comes.
struct Skin {
  double solar_absorptance = 0.7;
  double emissivity = 0.95;
  Roughness roughness = Roughness::rough;
  Wetness wetness;
  double power_w_m2 = 0.0;                             ///< from inside, given off at the surface
  std::shared_ptr<const TimeTable> power_over_time{};  ///< the same in place of that; null: it is that
  double convecting_faces = 1.0;                       ///< areas that the air reaches, over that of one face
  /// Above it the surface melts: what it gains beyond goes away with the water, and none of it freezes again.
  double melts_k = std::numeric_limits<double>::infinity();
  /// What is as warm as the air, or as is told of it over time: heat from inside holds it there.
  bool as_air = false;
  std::shared_ptr<const TimeTable> held_k{};
  bool is_held() const { return as_air || held_k != nullptr; }
  /// A thin sheet of one temperature, both faces of which are outdoors and alike.
  bool two_faces = false;
  double transmittance = 0.0;  ///< of sunlight, to the other side
  Leaf leaf;                   ///< convection and vapour of a leaf in place of the rest
  int faces() const { return two_faces ? 2 : 1; }
  bool operator==(const Skin&) const = default;
};

/// How a surface stands. The ground about a tilted one is taken to be as warm as the air and to reflect `ground_reflectance`.
struct Stand {
  double tilt_rad = 0.0;     ///< 0: level, facing up
  double azimuth_rad = 0.0;  ///< that it faces, clockwise from north
  double height_m = 0.0;     ///< above ground
  Terrain terrain = Terrain::open;
  double ground_reflectance = 0.2;
  /// Of the sky above the surface's horizon, weighed as the surface sees it, 0 to 1; what hides the rest is taken to be as the ground.
  double free_sky = 1.0;
  bool operator==(const Stand&) const = default;
};

/// What comes to a surface from all but the sky, W m-2 of it.
struct FromBeside {
  double sunlight_w_m2 = 0.0, longwave_w_m2 = 0.0;
};
/// From level ground all about.
FromBeside of_level_ground(const Outdoors& now, const Stand& stand);

/// The balance of a surface outdoors,
///   a (E_sun V cos + E_sky F + r_g E_global (1 - F)) + e (L_sky F + sigma T_a^4 (1 - F)) - e sigma T^4 + h (T_a - T) - LE + P,
/// with the sky's share of its view F = (1 + cos tilt) / 2 and V of the Sun that it sees. A sheet of two faces gains what both do, by area of
/// the sheet: one faces the Sun, F is 1 for both together, and all that they see is 2.
class SurfaceBalance : public SurfaceExchange {
 public:
  /// `visibility`: V at each row, from 0 to 1; empty: 1. `free_sky`: at each row in place of the stand's; empty: that. `beside`: at each row in
  /// place of the ground; empty: that.
  SurfaceBalance(const OutdoorsSeries& series, const Skin& skin, const Stand& stand,
                 std::vector<double> visibility = {}, std::vector<double> free_sky = {},
                 std::vector<FromBeside> beside = {});

  const Skin& skin() const { return skin_; }

  SurfaceGain gain(double time_s, double surface_k) const override;
  Fluxes fluxes(double time_s, double surface_k) const;
  /// a E_sun cos at a row: what the Sun adds there where nothing is in the way, W m-2.
  double full_sun_w_m2(std::size_t row) const { return full_sun_[row]; }
  /// What it gains at one instant more where its whole sky is free than where none of it is, over the sky's share F of its view
  /// in the open: a E_sky - a r_g E_global + e (L_sky - sigma T_a^4), W m-2.
  static double of_free_sky_w_m2(const Outdoors& now, const Skin& skin, double ground_reflectance);

 private:
  /// What does not depend on the surface's temperature, and what convection and latent heat go by.
  struct Row {
    Fluxes given;
    MoistAir air;
    double forced_w_m2_k = 0.0;                                ///< of forced convection, at glass
    double held_k = std::numeric_limits<double>::quiet_NaN();  ///< by heat from inside
    double open_stomata = 1.0;                                 ///< share, of a leaf
    double forced_back_w_m2_k = 0.0;                           ///< at the other of two faces
  };
  Row row_of(const OutdoorsSeries& series, const Stand& stand, std::size_t index, double visibility,
             double free_sky, const FromBeside* beside);
  /// That of a time, which `between` holds where it is no row's.
  const Row& at(double time_s, Row& between) const;
  /// Adds the rest, and the derivative of the sum.
  Fluxes complete(const Row& row, double surface_k, double& slope) const;

  double begin_s_, step_s_, cos_tilt_;
  Skin skin_;
  std::vector<Row> rows_;
  std::vector<double> full_sun_;
};

}  // namespace ifov::thermal
