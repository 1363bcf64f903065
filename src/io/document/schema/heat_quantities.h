#pragma once

#include "io/document/schema/quantity.h"

namespace ifov::io {

extern const Dimension kConductivity;     ///< of heat, W m-1 K-1
extern const Dimension kMassDensity;      ///< kg m-3
extern const Dimension kSpecificHeat;     ///< J kg-1 K-1
extern const Dimension kConductance;      ///< of heat, W m-2 K-1
extern const Dimension kHeatFlux;         ///< W m-2
extern const Dimension kLeafConductance;  ///< of vapour, mol m-2 s-1
extern const Dimension kResistance;       ///< of vapour, s m-1

}  // namespace ifov::io
