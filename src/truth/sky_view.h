#pragma once

#include "truth/collector.h"

namespace ifov::truth {

/// Which share of the half space before a plane is sky, weighed by the cosine of its directions as the irradiance is, and the
/// half-width of its 95 % interval: of the surface that a ray meets, on the side that is seen; of a sensor::HemisphereView of its own
/// plane. The sky is what rays above the horizon reach without meeting anything, panes included.
extern const Collector kSkyView;

}  // namespace ifov::truth
