#pragma once

#include <cstdint>
#include <optional>

#include "session/solved/second_pass.h"

namespace ifov::session {

/// By how much a thin sheet that is taken to be insulated behind may be off at a point where its other side is outdoors: what a sheet of the
/// same layers that is as warm on both faces has, less `full_k`, which it has as it is exposed. Nothing where the other side sees mostly
/// insides, or where something is told of it.
std::optional<double> other_side_k(const Neighbourhood& about, const SolvedMaterial& solved,
                                   const geometry::SurfacePoint& point, std::uint64_t key, double full_k);

/// By how much a face of a sheet of two is off the temperature that both are taken to have: by half of what drives heat across it, through the
/// resistance of its layers.
double across_k(const Neighbourhood& about, const SolvedMaterial& solved, const geometry::SurfacePoint& point,
                std::uint64_t key, double full_k);

}  // namespace ifov::session
