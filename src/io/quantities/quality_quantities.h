#pragma once

#include "io/quantities/quantity.h"

namespace ifov::io::quantities {

/// Samples, and which of them were label rays and radiance evaluations.
extern const Quantity kSamples;
/// Converged; largest half-width over its limit; missable fraction; borders' share of the variance.
extern const Quantity kQuality;
/// Why a pixel is not converged: a bit for each reason; the gravest of them.
extern const Quantity kReasons, kQualityClass;

}  // namespace ifov::io::quantities
