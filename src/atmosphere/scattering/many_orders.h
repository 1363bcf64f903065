#pragma once

#include "atmosphere/scattering/mode_operator.h"

namespace ifov::atmosphere {

/// Moments of light of all orders, x = once + K x, K one more scattering: by GMRES (Saad and Schultz 1986, SIAM J. Sci. Stat.
/// Comput. 7, 856), where orders would be added for very long: in a layer of optical depth t they fall off as slowly as 1 - 1/t^2.
/// The residual is less than `tolerance` of `once`, in the mean square.
struct AllOrders {
  ModeMoments moments;
  int scatterings = 0;  ///< times that K was applied
};
AllOrders all_orders(const ModeOperator& step, const ModeMoments& once, double tolerance);

}  // namespace ifov::atmosphere
