#pragma once

#include <memory>
#include <string>
#include <vector>

#include "studies/temperature/solved_scene.h"

/// The scenes of the study, loaded: of `road` (material 0) and `brick` (1).
namespace ifov::studies {

using SolvedScenePtr = std::unique_ptr<const SolvedScene>;

/// A pole of 0.5 m, 5 m high, about the origin of a road, at 15 h.
SolvedScenePtr pole_scene(const StudyOptions& options);
/// A car on it, 4.4 by 1.8 by 1.5 m, from `came_min` before 15 h to `left_min` before.
SolvedScenePtr car_scene(int came_min, int left_min, const StudyOptions& options);
/// The road alone, solved by the minute.
SolvedScenePtr bare_scene(const StudyOptions& options);
/// Flat roofs of the road's stuff at 14 h: of the k-th, east of the origin by 10 km (k + 1).
SolvedScenePtr roof_scene(bool suburb, const std::vector<double>& heights_m, const StudyOptions& options);
/// A closed room of brick, and a box in it, in still air of 290 K, 10 days on.
SolvedScenePtr room_scene(const StudyOptions& options);
/// A suburb whose opaque materials are solved for, by what their names say they are made of.
/// `wind_direction`: whether the weather tells it.
SolvedScenePtr suburb_scene(const std::string& hour, bool wind_direction, const std::string& name,
                            const StudyOptions& options);

}  // namespace ifov::studies
