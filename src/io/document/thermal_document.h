#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geodesy/utc_time.h"
#include "io/document/document_values.h"

namespace ifov::io {

/// A sheet of a solid: of the library, or of its three numbers. Or one of air.
struct ThermalLayerDocument {
  struct AirGap {
    double thickness_m = 0.0;
    std::string heat_flow = "horizontal";  ///< one of thermal::HeatFlow
    std::vector<double> emissivities{0.9, 0.9};
  };
  double thickness_m = 0.0;
  std::string library;  ///< empty: the numbers
  double conductivity_w_m_k = 0.0, density_kg_m3 = 0.0, specific_heat_j_kg_k = 0.0;
  std::optional<AirGap> air_gap{};  ///< in place of all that
};

/// A quantity that is always the same, or goes over time: of the document, or of a file.
struct TimedDocument {
  struct AtTime {
    geodesy::UtcTime time;
    double value = 0.0;
  };
  double constant = 0.0;
  std::vector<AtTime> table;  ///< in rising order
  std::optional<DocumentFile> file{};
  bool is_over_time() const { return !table.empty() || file; }
};

/// What lies behind the last layer; nothing given: no heat passes.
struct ThermalBackDocument {
  struct Room {
    TimedDocument temperature_k;
    double conductance_w_m2_k = 0.0;
  };
  struct Ground {
    std::optional<double> temperature_k;  ///< absent: the mean of the air
  };
  /// The other face of a thin sheet, outdoors as well.
  struct OtherSide {};
  std::optional<TimedDocument> held_k;
  std::optional<Room> room;
  std::optional<Ground> ground;
  std::optional<OtherSide> other_side;
};

/// A leaf by what its air and its stomata pass.
struct LeafDocument {
  double width_m = 0.0;
  double stomatal_mol_m2_s = 0.0;
  bool both_faces = false;  ///< have stomata
  double water_m = 0.0;     ///< thickness of the water that it holds
};

/// The seven numbers of DIRSIG's THERM.
struct ThermDocument {
  double density_kg_m3 = 0.0, specific_heat_j_kg_k = 0.0, conductivity_w_m_k = 0.0, thickness_m = 0.0;
  double solar_absorption = 0.0, emissivity = 0.0, exposed_area = 0.5;
};

/// What a surface's temperature follows from: layers, THERM's numbers or a leaf's.
struct ThermalDocument {
  std::vector<ThermalLayerDocument> layers;
  std::optional<ThermDocument> therm;
  std::optional<LeafDocument> leaf;
  std::optional<TimedDocument> held;  ///< K over time; of the air where it is not
  ThermalBackDocument back;
  std::string roughness = "rough";  ///< one of thermal::Roughness
  double wetness = 0.0;
  double resistance_s_m = 0.0;
  TimedDocument power_w_m2;                             ///< heat from inside
  std::optional<double> solar_absorptance, emissivity;  ///< absent: of the spectrum
  SourcePosition position;
};

/// How temperatures are solved.
struct TemperaturesDocument {
  double spin_up_s = 3.0 * 86400.0;
  double step_s = 300.0;
  bool repeat_first_day = false;
  std::string terrain = "open";  ///< one of thermal::Terrain
  double anemometer_m = 10.0;
  std::string anemometer_terrain = "open";
};

}  // namespace ifov::io
