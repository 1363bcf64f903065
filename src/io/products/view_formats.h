#pragma once

#include "io/products/product_format.h"

namespace ifov::io::formats {

/// What single views found, as tables; with every run of such.
extern const ProductFormat kViewCsv, kViewNetcdf;

}  // namespace ifov::io::formats
