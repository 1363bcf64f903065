#pragma once

#include <cstddef>
#include <vector>

#include "geometry/world/surface_survey.h"

namespace ifov::transport {

/// Facets near each other that face alike.
struct FacetCluster {
  geometry::SurfaceSurvey::Ball ball;
  math::Vec3 normal;    ///< their mean, unit
  double spread = 0.0;  ///< most distance of a facet's unit normal from it
};

/// The flat faces and triangles of a survey in at most so many clusters, split where places and normals of much area
/// differ most. Of very many triangles only each n-th is looked at: clusters are places to look for, and may lack some.
std::vector<FacetCluster> facet_clusters(const geometry::SurfaceSurvey& survey, std::size_t most);

}  // namespace ifov::transport
