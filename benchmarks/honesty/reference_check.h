#pragma once

#include <filesystem>
#include <vector>

#include "honesty/figure_row.h"

namespace ifov::benchmarks {

/// The plain tracer and the photons against closed forms: Stefan and Boltzmann's law, rows of exact areas (blurred and
/// not), the view factor of a sphere, sunlight by way of a flat mirror, the glint of a mirror sphere; and that a lamp
/// told 3 % too large, a mirror not told of and a glint not looked for are noticed.
std::vector<FigureRow> check_reference(const std::filesystem::path& work);

}  // namespace ifov::benchmarks
