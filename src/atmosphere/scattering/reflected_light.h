#pragma once

#include <memory>
#include <optional>
#include <span>

#include "atmosphere/scattering/ground/ground_shape.h"
#include "atmosphere/scattering/scattered_field.h"

namespace ifov::atmosphere {

class GroundModes;
class SuccessiveOrders;
struct NodeRadiance;

/// Light of a directional ground, which Sun and sky light, with all that goes back and forth between it and the air.
struct ReflectedLight {
  ScatteredField field;   ///< as ColumnSolution::groundlit(), of ground of this shape
  GroundShape shape;      ///< of what leaves the ground
  double exitance = 0.0;  ///< of that ground, for sunlight of irradiance 1
};

/// `down`: sunlight that the air has scattered down on black ground, by mode (SuccessiveOrders::Mode::ground_down). What comes back
/// to the ground is reflected again, until that is less than `tolerance` of what was reflected first; a geometric series stands for
/// the rest. `back`: how much of it comes back about a round Earth, over what does in flat layers. None where the ground reflects nothing.
std::optional<ReflectedLight> reflected_light(const std::shared_ptr<const SolvedColumn>& solved,
                                              const SuccessiveOrders& orders, const GaussNodes& nodes,
                                              const GroundModes& ground, std::span<const GroundLight> down,
                                              double back, double tolerance);

/// Of the ground's light only a share comes back about a round Earth of what does in flat layers; what does not goes up.
void send_back(FluxProfile& fluxes, double share);

/// Irradiances of level surfaces from the radiances of mode 0 at nodes; no direct ones.
FluxProfile diffuse_fluxes(const ScatteringColumn& column, const GaussNodes& nodes,
                           const NodeRadiance& radiance);

}  // namespace ifov::atmosphere
