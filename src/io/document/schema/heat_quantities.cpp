#include "io/document/schema/heat_quantities.h"

namespace ifov::io {
namespace {

// Calorie and British thermal unit of the International Table, of which 1 cal g-1 K-1 is 1 BTU lb-1 degF-1.
constexpr double kCal_j = 4.1868, kBtu_j = 1055.05585262, kFoot_m = 0.3048, kPound_kg = 0.45359237,
                 kDegF_k = 5.0 / 9.0;
constexpr Unit kConductivityUnits[] = {
    {"W m-1 K-1"},
    {"kcal m-1 h-1 K-1", 1e3 * kCal_j / 3600.0},
    {"cal cm-1 s-1 K-1", 100.0 * kCal_j},
    {"BTU h-1 ft-1 degF-1", kBtu_j / (3600.0 * kFoot_m * kDegF_k)},
    {"BTU in h-1 ft-2 degF-1", kBtu_j * 0.0254 / (3600.0 * kFoot_m * kFoot_m * kDegF_k)},
    {"W/m/K", 1.0, 0.0, false},
    {"W/(m K)", 1.0, 0.0, false},
};
constexpr Unit kMassDensityUnits[] = {
    {"kg/m3"},
    {"g/cm3", 1e3},
    {"lb/ft3", kPound_kg / (kFoot_m * kFoot_m * kFoot_m)},
    {"kg m-3", 1.0, 0.0, false},
    {"g cm-3", 1e3, 0.0, false},
};
constexpr Unit kSpecificHeatUnits[] = {
    {"J kg-1 K-1"},
    {"kJ kg-1 K-1", 1e3},
    {"cal g-1 K-1", 1e3 * kCal_j},
    {"BTU lb-1 degF-1", kBtu_j / (kPound_kg * kDegF_k)},
    {"J/kg/K", 1.0, 0.0, false},
    {"J/(kg K)", 1.0, 0.0, false},
};
constexpr Unit kConductanceUnits[] = {
    {"W m-2 K-1"},
    {"kcal m-2 h-1 K-1", 1e3 * kCal_j / 3600.0},
    {"BTU h-1 ft-2 degF-1", kBtu_j / (3600.0 * kFoot_m * kFoot_m * kDegF_k)},
    {"W/m2/K", 1.0, 0.0, false},
};
constexpr Unit kHeatFluxUnits[] = {{"W m-2"},
                                   {"kW m-2", 1e3},
                                   {"BTU h-1 ft-2", kBtu_j / (3600.0 * kFoot_m * kFoot_m)},
                                   {"W/m2", 1.0, 0.0, false}};
constexpr Unit kLeafConductanceUnits[] = {
    {"mol m-2 s-1"}, {"mmol m-2 s-1", 1e-3}, {"mol/m2/s", 1.0, 0.0, false}};
constexpr Unit kResistanceUnits[] = {{"s/m"}, {"s m-1", 1.0, 0.0, false}};

}  // namespace

const Dimension kConductivity{"a conductivity of heat", "1.4 W m-1 K-1", kConductivityUnits, 1e-9, 1e9};
const Dimension kMassDensity{"a density of mass", "2300 kg/m3", kMassDensityUnits, 1e-6, 1e9};
const Dimension kSpecificHeat{"a specific heat", "880 J kg-1 K-1", kSpecificHeatUnits, 1e-3, 1e9};
const Dimension kConductance{"a conductance of heat", "8 W m-2 K-1", kConductanceUnits, 1e-9, 1e9};
const Dimension kHeatFlux{"a flux of heat", "60 W m-2", kHeatFluxUnits, 1e-9, 1e9};
const Dimension kLeafConductance{"a conductance of stomata", "0.4 mol m-2 s-1", kLeafConductanceUnits, 1e-9,
                                 1e9};
const Dimension kResistance{"a resistance of vapour", "70 s/m", kResistanceUnits, 1e-9, 1e9};

}  // namespace ifov::io
