#pragma once

#include <array>
#include <span>
#include <vector>

#include "ifov/simulation.h"

namespace ifov::session {

struct Parts;

/// Simulation::cast().
std::vector<RayHit> cast_rays(const Parts& parts, std::span<const std::array<double, 3>> origins_m,
                              std::span<const std::array<double, 3>> directions, int threads);

}  // namespace ifov::session
