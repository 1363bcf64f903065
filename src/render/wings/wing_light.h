#pragma once

#include <span>

#include "sampling/tile.h"

namespace ifov::sensor {
class PsfWings;
}

namespace ifov::render {

class AccuracyTolerance;
class SpotLight;
struct CutRange;

/// Share of the accuracy asked for that samplers leave to what a PSF's cut leaves out.
inline constexpr double kCutShare = 0.1;

/// Adds to a tile what falls on its pixels by way of the PSF's wings, beside what the sampler found within the cut
/// (which must be normalised). The wings' cells are looked at by 2 x 2 stratified paths each; their variance goes into
/// the tile's, by what a plane through the four leaves over. What lies beyond the wings is taken to be as the mean of
/// the farthest cells, and half-widths grow by its share times the largest difference to that of any cell; pixels are
/// judged anew by what was asked for, and those that the wings leave too wide get Reason::psf_cut. Abundances follow, by the wings
/// of the reference. What outshines the scene and is too small for cells is looked at by itself, and weighed by the PSF where it stands:
/// `spots`, may be null. `wings`: by group of the problem's footprints; one where it has no groups. `tolerance` may be null. Throws Cancelled.
void add_wings(std::span<const sensor::PsfWings* const> wings, const sampling::TileProblem& problem,
               const AccuracyTolerance* tolerance, const SpotLight* spots, sampling::Field& field,
               sampling::TileResult& tile);

/// Whether a cut leaves out anything of any column.
bool leaves_out(std::span<const double> left_out);

/// For a cut without wings: half-widths grow by `left_out` of the energy, by column, times the largest difference to any other pixel
/// of the tile and to what is `about` it, and pixels that are too wide for it get Reason::psf_cut. Nothing where it is empty or all 0. `later`: light that will
/// join them; may be null.
void widen_by_cut(std::span<const double> left_out, const CutRange& about, const sampling::LaterLight* later,
                  const AccuracyTolerance* tolerance, sampling::TileResult& tile);

}  // namespace ifov::render
