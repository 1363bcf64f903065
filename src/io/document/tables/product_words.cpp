#include "io/document/product_words.h"

#include <array>

namespace ifov::io {
namespace {

constexpr std::array<std::string_view, 5> kWords{"envi", "geotiff", "netcdf", "png", "html"};

}  // namespace

std::span<const std::string_view> product_words() { return kWords; }

}  // namespace ifov::io
