#pragma once

#include <memory>
#include <variant>
#include <vector>

namespace ifov::thermal {

struct TimeTable;

/// A sheet of one solid. Values above 0.
struct SolidLayer {
  double thickness_m = 0.0;
  double conductivity_w_m_k = 0.0;
  double density_kg_m3 = 0.0;
  double specific_heat_j_kg_k = 0.0;
  double gap_behind_m2_k_w =
      0.0;  ///< resistance of what has no mass between it and what is behind, such as air; 0 or above
  bool operator==(const SolidLayer&) const = default;
};

/// Thinner layers are taken for mistakes of unit.
inline constexpr double kThinnestLayer_m = 1e-5;

/// sqrt(2 k / (rho c omega)) of a period of one day: a wave of that period is 1/e of its size that far below the surface.
double daily_depth_m(const SolidLayer& layer);
/// sqrt(k rho c), J m-2 K-1 s-1/2: thermal inertia (effusivity).
double thermal_inertia(const SolidLayer& layer);

/// What lies behind the last layer: no heat passes; a temperature that is held; air of a room, with the conductance
/// between it and the last layer's back; the last layer's solid, going on to kGroundDepths daily depths, where the
/// temperature is held. What is held or of a room may go over time: then that is in place of the temperature.
struct Insulated {
  bool operator==(const Insulated&) const = default;
};
struct HeldBack {
  double temperature_k = 0.0;
  std::shared_ptr<const TimeTable> over_time{};
  bool operator==(const HeldBack&) const = default;
};
struct RoomAir {
  double temperature_k = 0.0;
  double conductance_w_m2_k = 0.0;
  std::shared_ptr<const TimeTable> over_time{};
  bool operator==(const RoomAir&) const = default;
};
struct DeepGround {
  double temperature_k = 0.0;
  bool operator==(const DeepGround&) const = default;
};
/// The other face of the same thin sheet, which is outdoors, too (Skin::two_faces): both are taken to have one temperature.
struct OtherFace {
  bool operator==(const OtherFace&) const = default;
};
using Back = std::variant<Insulated, HeldBack, RoomAir, DeepGround, OtherFace>;
/// Of a sheet whose faces have about one temperature, m2 K W-1: 100 W m-2 across it are 1 K.
inline constexpr double kMostAcross_m2_k_w = 0.01;
/// From the surface to behind the last layer.
double resistance_across_m2_k_w(const std::vector<SolidLayer>& layers);
inline constexpr double kGroundDepths = 10.0;

/// From the surface inwards.
struct Solid {
  std::vector<SolidLayer> layers;
  Back back;
  bool operator==(const Solid&) const = default;
};

/// Throws InputError that says which layer is wrong, counted from 1 at the surface, and what is expected.
void check(const Solid& solid);

}  // namespace ifov::thermal
