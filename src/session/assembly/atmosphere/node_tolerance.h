#pragma once

#include <span>

#include "radiometry/channel.h"

namespace ifov::render {
struct AccuracyRequest;
}
namespace ifov::scene {
struct Scene;
}

namespace ifov::session {

/// Relative error that spectral nodes may make: this share of the accuracy asked for,
/// but no more than `usual` and no less than single precision bears. Accuracies in kelvin and radiance are taken
/// as shares of the warmest and the whitest that there is, where the same error is the smallest share. `request` null: no accuracy is asked for.
double node_tolerance(const scene::Scene& scene, std::span<const radiometry::Channel> channels,
                      const render::AccuracyRequest* request, double share, double usual);

}  // namespace ifov::session
