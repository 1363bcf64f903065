#pragma once

#include <string>

#include "landscape/output/scene_folder.h"
#include "landscape/output/scene_maker.h"
#include "landscape/plots/plot_plan.h"
#include "landscape/shapes/random_stream.h"

namespace ifov::landscape {

/// Writes a map of what grows on the lawns, 10 cm a cell (coarser above 400 m), and returns the material entry that
/// drapes it: each garden's care, drought over tens of metres, patches of metres and tufts of decimetres decide
/// between lush, sparse and dry grass, clover and bare soil.
io::MaterialBinding lawn_material(const StreetPlan& streets, const PlotPlan& plots,
                                  const RandomStream& random, SceneFolder& folder, SceneMaker& scene);

}  // namespace ifov::landscape
