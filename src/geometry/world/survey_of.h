#pragma once

#include <vector>

#include "geometry/world/surface_survey.h"

namespace ifov::geometry {

class PieceWalk;
struct WorldContent;

/// `surveyed` by material: whether it counts. Missing entries do not. `facets`: flat triangles are listed among the smooth
/// ones, and no flats.
SurfaceSurvey survey_of(const WorldContent& content, const PieceWalk& walk, const std::vector<bool>& surveyed,
                        bool facets = false);

}  // namespace ifov::geometry
