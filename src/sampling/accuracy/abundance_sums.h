#pragma once

#include <vector>

namespace ifov::sampling {

class Field;
class LabelTable;
class LeafIntegrator;
class Radiance;
struct TileResult;

/// Adds the shares of the materials in these outputs, which a group of source pixels reaches, to the result. Half-widths
/// are `normal` standard errors.
void add_abundances(const Radiance& radiance, const LeafIntegrator& integrator, const LabelTable& table,
                    const Field& field, const std::vector<int>& outputs, double normal, TileResult& result);

}  // namespace ifov::sampling
