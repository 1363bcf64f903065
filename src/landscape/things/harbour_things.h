#pragma once

#include "geometry/triangle_mesh.h"

namespace ifov::landscape {

/// A 20-foot container, 6.06 x 2.44 x 2.59 m, its length along x, with corrugated sides; slot: container.
geometry::TriangleMesh container_mesh();

/// A cargo ship along x, its waterline at z = 0, `length_m` long; slots: hull, bottom, deck, house, window, trim.
geometry::TriangleMesh ship_mesh(double length_m, double beam_m);

/// A gantry crane that straddles its rails, which run along x at y = 0 and y = 15; its boom reaches to y = 45. Slots:
/// steel, cable, window.
geometry::TriangleMesh crane_mesh();

/// A shed along x with a low gabled roof, its middle at the origin; slots: wall, roof, door, trim.
geometry::TriangleMesh shed_mesh(double length_m, double width_m);

/// A lorry that carries a container, heading along +x; slots: cab, glass, tyre, bed, container.
geometry::TriangleMesh lorry_mesh();

}  // namespace ifov::landscape
