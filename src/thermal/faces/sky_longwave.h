#pragma once

namespace ifov::thermal {

inline constexpr double kStefanBoltzmann_w_m2_k4 = 5.670374419e-8;  ///< CODATA 2018

/// Emissivity of a clear sky by air temperature and vapour pressure near the ground: Prata (1996), Q. J. R. Meteorol.
/// Soc. 122, 1127: 1 - (1 + w) exp(-sqrt(1.2 + 3 w)), w = 46.5 e / T in g cm-2 with e in hPa.
double clear_sky_emissivity(double air_k, double vapour_pa);

/// With cloud on a fraction of the sky: Crawford and Duchon (1999), J. Appl. Meteorol. 38, 474: c + (1 - c) clear.
double sky_emissivity(double clear, double cloud_fraction);

/// Irradiance of the sky on a level plane, W m-2.
double sky_longwave_w_m2(double air_k, double vapour_pa, double cloud_fraction);

}  // namespace ifov::thermal
