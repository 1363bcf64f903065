#pragma once

#include "geometry/triangle_mesh.h"
#include "landscape/shapes/chance.h"

namespace ifov::landscape {

/// A boulder about 1 m across, sunk into the ground by a third; slot: rock.
geometry::TriangleMesh rock_mesh(const Chance& chance);

}  // namespace ifov::landscape
