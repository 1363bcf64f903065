#pragma once

#include <cstdint>

#include "materials/bsdf/bsdf_model.h"

/// What every model of scattering has to keep, measured: its samples follow its density, its warp has an inverse, and light may go
/// either way. Normals are +z.
namespace ifov::materials {

/// Inputs of a model that lie at a share (0 to 1) of each parameter's range; of words the first, above 0.5 the
/// last, of a table one that is
/// brighter to the sides. Words that may be left out are, and a leaf's proteins and carbon, which stand in place of dry matter.
BsdfInputs inputs_within_ranges(const BsdfModel& model, double share);

/// A view from this direction; the tangent is +x.
BsdfEvent view_of(math::Vec3 outgoing, Side side = Side::reflected);

/// BSDF of a model at one of its wavelengths, 1/sr; of a separable one its shape.
double brdf_at(const Bsdf& bsdf, const BsdfEvent& event, double um = 1.0);

/// Chi-square of a model's samples against its density, as a probability. Directions are counted by the slopes of the facets that
/// would mirror them, in units of the widths: rings in arsinh of the slope and sectors, and those below the horizon.
double samples_against_density(const Bsdf& bsdf, math::Vec3 outgoing, double width_x, double width_y,
                               int draws);

/// The same with directions counted in cells of equal solid angle, on either side: of models without a lobe.
double directions_against_density(const Bsdf& bsdf, math::Vec3 outgoing, Side side, int draws,
                                  std::uint64_t seed);

/// Largest distance (of unit vectors) between a direction drawn and the one that is drawn from its inverse, over across^2 points.
double worst_round_trip(const Bsdf& bsdf, math::Vec3 outgoing, Side side, int across);

/// Largest difference of the BSDF from that with both directions exchanged (into a medium: from n^2 times its other side's), in units of it, over across^2 directions that the model
/// draws. BSDFs are told in single precision, whose steps are 1.2e-7.
double worst_reciprocity(const Bsdf& bsdf, math::Vec3 outgoing, Side side, int across);

}  // namespace ifov::materials
