#pragma once

#include "landscape/plants/tree.h"
#include "landscape/shapes/random_stream.h"

namespace ifov::landscape {

/// A straight stem with whorls of branches, branchlets on both sides of them and shoots of needles on all.
Tree grow_conifer(const Species& species, const RandomStream& random);

}  // namespace ifov::landscape
