#include "io/document/product_words.h"

#include <array>

namespace ifov::io {
namespace {

constexpr std::array<std::string_view, 9> kWords{"envi",       "geotiff", "netcdf", "glt", "vrt",
                                                 "demosaiced", "png",     "html",   "stac"};

}  // namespace

std::span<const std::string_view> product_words() { return kWords; }

std::vector<std::string> usual_product_words() {
  std::vector<std::string> usual;
  for (const char* word : {"envi", "png", "html"})
    if (why_not_built(word).empty()) usual.emplace_back(word);
  return usual;
}

std::string why_not_built([[maybe_unused]] std::string_view word) {
#ifndef IFOV_CAIRO
  if (word == "png") return "this ifov was built without Cairo (IFOV_CAIRO=OFF) and draws no figures";
#endif
  return {};
}

}  // namespace ifov::io
