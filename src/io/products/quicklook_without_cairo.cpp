// Of a build without Cairo (IFOV_CAIRO=OFF), in place of quicklook_figure.cpp.
#include "core/error.h"
#include "io/document/product_words.h"
#include "io/products/quicklook.h"

namespace ifov::io {

std::string make_quicklook(const RasterView&, const RunRecord&, const std::vector<int>&) {
  throw SystemError(why_not_built("png"));
}

}  // namespace ifov::io
