#pragma once

#include "landscape/output/scene_folder.h"
#include "landscape/output/scene_maker.h"
#include "landscape/plots/plot_plan.h"
#include "landscape/streets/street_plan.h"

namespace ifov::landscape {

/// All that lies flat: streets with their markings, kerbs, sidewalks, driveways, patios, pools and beds as one mesh,
/// lawns as another with a map of what grows there. The pieces meet edge to edge; none lies on another but paint.
void lay_ground(const StreetPlan& streets, const PlotPlan& plots, const RandomStream& random,
                SceneFolder& folder, SceneMaker& scene);

}  // namespace ifov::landscape
