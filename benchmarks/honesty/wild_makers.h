#pragma once

#include "honesty/wild_draft.h"

/// One function a kind of scene: adds its materials and objects to a draft, and what the plain tracer must be told.
namespace ifov::benchmarks {

void make_gaps(WildDraft& draft);   ///< slabs or two roofs with a gap between them
void make_walls(WildDraft& draft);  ///< thinner than a pixel, often taller than one
void make_wires(WildDraft& draft);
void make_panels(WildDraft& draft);   ///< rows, as level boxes or one tilted mesh
void make_texture(WildDraft& draft);  ///< maps of classes or temperatures in step with the pixels
void make_blocks(WildDraft& draft);   ///< boxes of all sizes
void make_overhead(
    WildDraft& draft);  ///< plates high above the ground: penumbrae between places without noise

void make_facade(WildDraft& draft);  ///< a flat mirror that sends sunlight to the ground
void make_yard(WildDraft& draft);    ///< boxes of mirrors
void make_ball(WildDraft& draft);    ///< a mirror sphere on the ground
void make_hemisphere(WildDraft& draft);
void make_hot_sphere(WildDraft& draft);  ///< small, above cool ground
void make_lamps(WildDraft& draft);       ///< small hot spheres in a canyon
void make_street(WildDraft& draft);      ///< lamps of all forms over boxes, posts and wires, by night
void make_night(WildDraft& draft);       ///< a small hot sphere over ground with warm slabs, at 1.6 and 11 um

void make_copies(WildDraft& draft);     ///< of prototypes with something small and bright on them
void make_holes(WildDraft& draft);      ///< a plate above the ground with an opacity map
void make_hot_cells(WildDraft& draft);  ///< few, in a temperature map
void make_faces(WildDraft& draft);      ///< a mesh with few faces unlike the others

void make_gloss(WildDraft& draft);   ///< metal, lacquer and plastic of roughness 0.02 to 0.5
void make_glass(WildDraft& draft);   ///< panes before painted things, solids of smooth and of rough glass
void make_water(WildDraft& draft);   ///< a sea under a wind, or still water, with things in it
void make_relief(WildDraft& draft);  ///< heights from a raster under maps of classes or temperatures

void make_mixture(WildDraft& draft);  ///< side by side in every place, each with a temperature map
void make_wide(WildDraft& draft);     ///< channels of up to 1000 um
void make_colours(WildDraft& draft);  ///< steep spectra and several reflections in a canyon
void make_airy(WildDraft& draft);     ///< edges behind a diffracting aperture

}  // namespace ifov::benchmarks
