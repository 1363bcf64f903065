#pragma once

#include "io/products/product_format.h"

namespace ifov::io::formats {

/// The report, a page for browsers.
extern const ProductFormat kHtml;

}  // namespace ifov::io::formats
