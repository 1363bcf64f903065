#pragma once

#include <vector>

namespace ifov::transport {

class SpectralScene;

/// By channel: radiance of a level white Lambertian straight below the lamp that lights it most, each lamp taken as shining the
/// same in all directions and no nearer than half a metre; 0 without lamps. W m-2 sr-1 um-1.
std::vector<double> white_below_lamps(const SpectralScene& scene);

}  // namespace ifov::transport
