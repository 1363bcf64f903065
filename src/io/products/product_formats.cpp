#include "io/products/product_formats.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "io/document/product_words.h"
#include "io/products/geotiff.h"
#include "io/products/netcdf.h"
#include "io/products/product_format.h"
#include "io/products/qgis_style.h"
#include "io/products/quicklook.h"
#include "io/products/report_format.h"
#include "io/products/view_formats.h"
#include "io/quantities/quantity_set.h"
#include "render/image_info.h"

namespace ifov::io {
namespace {

/// The cubes, which are written while the run is at work.
constexpr ProductFormat kEnvi{.name = "envi"};

constexpr std::array kFormats{&kEnvi,
                              &formats::kGeotiff,
                              &formats::kNetcdf,
                              &formats::kGlt,
                              &formats::kGeolocatedVrt,
                              &formats::kWavelengths,
                              &formats::kDemosaiced,
                              &formats::kQgisStyle,
                              &formats::kViewCsv,
                              &formats::kViewNetcdf,
                              &formats::kPng,
                              &formats::kHtml,
                              &formats::kStac};  // which lists all others

}  // namespace

bool is_picture(const render::ImageInfo& image) { return image.views == nullptr; }

std::span<const ProductFormat* const> all_product_formats() { return kFormats; }

const ProductFormat* find_product_format(std::string_view name) {
  for (const ProductFormat* format : kFormats)
    if (!name.empty() && format->name == name) return format;
  return nullptr;
}

bool ProductFormats::has(const ProductFormat& format) const {
  return format.name.empty() || std::find(asked_.begin(), asked_.end(), &format) != asked_.end();
}

std::vector<const ProductFormat*> ProductFormats::list() const {
  std::vector<const ProductFormat*> chosen;
  for (const ProductFormat* format : kFormats)
    if (has(*format)) chosen.push_back(format);
  return chosen;
}

void ProductFormats::add_needed(const render::ImageInfo& image, QuantitySet& cubes) const {
  for (const ProductFormat* format : list())
    if (format->needs != nullptr && (format->suits == nullptr || format->suits(image)))
      cubes.add(*format->needs);
}

std::uint64_t ProductFormats::bytes(const render::ImageInfo& image, const QuantitySet& cubes) const {
  std::uint64_t bytes = 0;
  for (const ProductFormat* format : list())
    if (format->bytes != nullptr && (format->suits == nullptr || format->suits(image)))
      bytes += format->bytes(image, cubes);
  return bytes;
}

ProductFormats product_formats(std::span<const std::string> words) {
  ProductFormats formats;
  for (const std::string& word : words) {
    const ProductFormat* format = find_product_format(word);
    if (format == nullptr) throw std::logic_error("no kind of product is called '" + word + "'");
    formats.add(*format);
  }
  return formats;
}

ProductFormats usual_product_formats() { return product_formats(usual_product_words()); }

}  // namespace ifov::io
