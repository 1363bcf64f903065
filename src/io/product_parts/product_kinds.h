#pragma once

#include <array>
#include <bitset>
#include <string_view>

namespace ifov::io {

/// The cubes that a run can leave.
enum class Product {
  radiance,
  standard_error,
  half_width,
  air_half_width,
  samples,
  quality,
  reasons,
  quality_class,
  abundance,
  abundance_half_width,
  location,
  view_angles,
};

/// As documents name them; a cube is called NAME_<product>.img.
inline constexpr std::array<std::string_view, 12> kProductNames{
    "radiance", "standard_error", "half_width", "air_half_width",       "samples",  "quality",
    "reasons",  "quality_class",  "abundance",  "abundance_half_width", "location", "view_angles"};
inline constexpr std::size_t kProductCount = kProductNames.size();

class ProductSet {
 public:
  constexpr ProductSet() = default;
  ProductSet(std::initializer_list<Product> products) {
    for (const Product product : products) add(product);
  }
  static ProductSet all() {
    ProductSet set;
    set.bits_.set();
    return set;
  }
  bool has(Product product) const { return bits_.test(static_cast<std::size_t>(product)); }
  void add(Product product, bool present = true) { bits_.set(static_cast<std::size_t>(product), present); }
  void remove(Product product) { add(product, false); }
  friend bool operator==(const ProductSet&, const ProductSet&) = default;

 private:
  std::bitset<kProductCount> bits_;
};

/// What is written where a document names nothing: one cube of errors beside the radiance, and what has few bands.
inline ProductSet usual_products() {
  return {Product::radiance, Product::half_width,    Product::samples,   Product::quality,
          Product::reasons,  Product::quality_class, Product::abundance, Product::location};
}

}  // namespace ifov::io
