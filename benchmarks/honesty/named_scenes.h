#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "honesty/figure_row.h"
#include "honesty/judged_scene.h"

namespace ifov::benchmarks {

/// Scenes in which images were once wrong and sure of themselves. What must hold: the intervals of converged pixels hold
/// the truth in 0.93 of cases, |z| > 4 in fewer than 0.5 %, and so many pixels are converged.
struct NamedScene {
  std::string_view name;
  double least_converged = 0.95;  ///< share; saying "not converged" is no way out where light can be sought
};
std::span<const NamedScene> named_scenes();

/// The scene of that name: rows, whose radiance is known exactly, or a document of benchmarks/honesty/scenes. Writes
/// its maps and meshes to `folder`.
WildScene named_scene(std::string_view name, const std::filesystem::path& folder);

/// Judges each of these (empty: all), prints its figures, and gives three rows a scene.
std::vector<FigureRow> report_named_scenes(std::span<const std::string> names,
                                           const std::filesystem::path& folder, const Judging& judging,
                                           int threads);

}  // namespace ifov::benchmarks
