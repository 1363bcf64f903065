#pragma once

#include <string>

#include "landscape/chance.h"
#include "landscape/plot_plan.h"
#include "landscape/scene_folder.h"
#include "landscape/scene_text.h"

namespace ifov::landscape {

/// Writes a map of what grows on the lawns, 10 cm a cell (coarser above 400 m), and returns the material entry that
/// drapes it: each garden's care, drought over tens of metres, patches of metres and tufts of decimetres decide
/// between lush, sparse and dry grass, clover and bare soil.
std::string lawn_material(const StreetPlan& streets, const PlotPlan& plots, const Chance& chance, SceneFolder& folder,
                          SceneText& text);

}  // namespace ifov::landscape
