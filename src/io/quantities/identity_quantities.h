#pragma once

#include "io/quantities/quantity.h"

namespace ifov::io::quantities {

/// The material, and the document's object, that the middle of the pixel sees, as classes with names.
extern const Quantity kMaterialClass, kObjectClass;
/// Number of the placed object that the middle of the pixel sees, from 1 on: copies are told apart.
extern const Quantity kInstance;
/// The material with the largest share of the pixel, as a class with a name, and how many materials have a share.
extern const Quantity kDominantMaterial, kMaterialCount;

}  // namespace ifov::io::quantities
