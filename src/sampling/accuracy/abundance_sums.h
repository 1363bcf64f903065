#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace ifov::sampling {

class Field;
class LabelTable;
class LeafIntegrator;
class Radiance;
struct Abundance;

/// The shares of the materials in these outputs, which a group of source pixels reaches, output by output and sorted by material.
/// Half-widths are `normal` standard errors. `count`: of all outputs.
std::vector<Abundance> abundances_of(const Radiance& radiance, const LeafIntegrator& integrator,
                                     const LabelTable& table, const Field& field,
                                     std::span<const int> outputs, std::size_t count, double normal);

}  // namespace ifov::sampling
