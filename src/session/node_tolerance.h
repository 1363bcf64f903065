#pragma once

#include "session/session.h"

namespace ifov::session {

/// Relative error that spectral nodes may make: a tenth of the accuracy asked for, so that intervals need not speak of
/// them, but no more than `usual` and no less than single precision bears. Accuracies in kelvin and radiance are taken
/// as shares of the warmest and the whitest that there is, where the same error is the smallest share.
double node_tolerance(const Session::Parts& parts, double usual);

}  // namespace ifov::session
