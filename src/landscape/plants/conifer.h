#pragma once

#include "landscape/plants/tree.h"
#include "landscape/shapes/chance.h"

namespace ifov::landscape {

/// A straight stem with whorls of branches, branchlets on both sides of them and shoots of needles on all.
Tree grow_conifer(const Species& species, const Chance& chance);

}  // namespace ifov::landscape
