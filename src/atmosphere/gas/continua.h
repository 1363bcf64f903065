#pragma once

#include "atmosphere/gas/gas_amounts.h"
#include "atmosphere/gas/gas_model.h"

namespace ifov::atmosphere {

/// Optical depths of the continuous absorption of a path.
struct ContinuumDepths {
  double water = 0.0;
  double nitrogen = 0.0;          ///< 2080 to 2740 cm-1
  double oxygen = 0.0;            ///< 1395 to 1760 cm-1
  double oxygen_pairs = 0.0;      ///< not in LOWTRAN7
  double ozone = 0.0;             ///< Chappuis, Huggins and Hartley, above 13000 cm-1
  double nitrogen_dioxide = 0.0;  ///< 15200 to 41200 cm-1; not in LOWTRAN7
  double total() const { return water + nitrogen + oxygen + oxygen_pairs + ozone + nitrogen_dioxide; }
};

/// At a wavenumber, cm-1; the formulas of LOWTRAN7 (Kneizys et al. 1988) with the water continuum of Clough
/// et al. (1989), and cross-sections of nitrogen dioxide of JPL Publication 06-2 (2006).
ContinuumDepths continuum_depths(double wavenumber_cm1, const GasAmounts& amounts, GasModel model);

/// Share of the far-wing term that stays: 1 up to 1250 cm-1, 0 from 1900 cm-1 on, linear between.
double far_wing_share(double wavenumber_cm1, GasModel model);

}  // namespace ifov::atmosphere
