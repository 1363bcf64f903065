// Of a build without Cairo (IFOV_CAIRO=OFF), in place of quicklook_figure.cpp.
#include "core/error.h"
#include "io/products/quicklook.h"

namespace ifov::io {

std::string why_no_figures() {
  return "this ifov was built without Cairo (IFOV_CAIRO=OFF) and draws no figures";
}

std::string make_quicklook(const RasterView&, const RunRecord&, const std::vector<int>&) {
  throw EnvironmentError(why_no_figures());
}

}  // namespace ifov::io
