#include "io/product_parts/cube_kinds.h"

#include <algorithm>

#include "core/format.h"

namespace ifov::io {
namespace {

/// Without what follows from the product alone.
CubeKind kind_of(Product product, const render::ImageInfo& info) {
  constexpr EnviType kReal = EnviType::float32;
  switch (product) {
    case Product::radiance: return {product, "", "radiance", "", true, {}, kReal};
    case Product::standard_error: return {product, "", "standard error of radiance", "", true, {}, kReal};
    case Product::half_width:
      return {product, "", "half-width of the radiance's interval", "", true, {}, kReal};
    case Product::air_half_width:
      return {product, "", "part of the half-width that the air's computation adds", "", true, {}, kReal};
    case Product::samples:
      return {product,         "",    "samples per pixel",
              "count",         false, {"samples", "label rays", "radiance evaluations"},
              EnviType::uint32};
    case Product::quality:
      return {product,
              "",
              "quality",
              "1",
              false,
              {"converged", "largest half-width over its limit", "missable fraction",
               "borders' share of the variance"},
              kReal};
    case Product::reasons:
      return {
          product,         "", "why pixels are not converged, a bit for each reason", "1", false, {"reasons"},
          EnviType::uint16};
    case Product::quality_class:
      return {product,       "", "converged, or the gravest reason why not", "1", false, {"quality class"},
              EnviType::byte};
    case Product::abundance: return {product, "", "material fractions", "1", false, info.materials, kReal};
    case Product::abundance_half_width:
      return {product,        "",   "half-width of the material fractions' intervals", "1", false,
              info.materials, kReal};
    case Product::location:
      return {product,
              "",
              "place of what the middle of each pixel sees",
              "m",
              false,
              {"easting", "northing", "height"},
              EnviType::float64};
    case Product::view_angles: break;
  }
  return {product, "",    "direction from the place to the sensor",
          "deg",   false, {"view zenith", "view azimuth"},
          kReal};
}

}  // namespace

CubeKind cube_kind(Product product, const render::ImageInfo& info) {
  CubeKind kind = kind_of(product, info);
  kind.suffix = format("_{}", kProductNames[static_cast<std::size_t>(product)]);
  return kind;
}

std::size_t band_count(const CubeKind& kind, const render::ImageInfo& info) {
  return kind.spectral ? info.channels.size() : kind.band_names.size();
}

ProductSet possible_products(ProductSet selection, const render::ImageInfo& info) {
  selection.add(Product::radiance);
  if (std::none_of(info.channels.begin(), info.channels.end(),
                   [](const render::ChannelInfo& c) { return c.air.has_value(); }))
    selection.remove(Product::air_half_width);
  if (info.materials.empty()) {
    selection.remove(Product::abundance);
    selection.remove(Product::abundance_half_width);
  }
  return selection;
}

std::uint64_t CubeSize::bytes() const {
  return static_cast<std::uint64_t>(width_px) * static_cast<std::uint64_t>(height_px) *
         static_cast<std::uint64_t>(bands) * static_cast<std::uint64_t>(value_bytes);
}

std::vector<CubeSize> cube_sizes(ProductSet selection, const render::ImageInfo& info) {
  selection = possible_products(selection, info);
  std::vector<CubeSize> sizes;
  for (std::size_t i = 0; i < kProductCount; ++i) {
    if (!selection.has(static_cast<Product>(i))) continue;
    const CubeKind kind = cube_kind(static_cast<Product>(i), info);
    sizes.push_back({info.width_px, info.height_px, static_cast<int>(band_count(kind, info)),
                     static_cast<int>(bytes_per_value(kind.type))});
  }
  return sizes;
}

}  // namespace ifov::io
