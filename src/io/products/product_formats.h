#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace ifov::render {
struct ImageInfo;
}

namespace ifov::io {

class QuantitySet;
struct ProductFormat;

/// A choice among all_product_formats(), in their order; those that come with every run are in all.
class ProductFormats {
 public:
  ProductFormats() = default;
  ProductFormats(std::initializer_list<const ProductFormat*> formats) : asked_(formats) {}

  bool has(const ProductFormat& format) const;
  void add(const ProductFormat& format) { asked_.push_back(&format); }
  std::vector<const ProductFormat*> list() const;

  /// Adds the cubes that they are made of.
  void add_needed(const render::ImageInfo& image, QuantitySet& cubes) const;

  /// Of the files, which are not small.
  std::uint64_t bytes(const render::ImageInfo& image, const QuantitySet& cubes) const;

 private:
  std::vector<const ProductFormat*> asked_;
};

/// Those that a document asks for, by their words (product_words). std::logic_error for one that no format has.
ProductFormats product_formats(std::span<const std::string> words);

/// What is written where a document asks for nothing: cubes, picture and report.
ProductFormats usual_product_formats();

}  // namespace ifov::io
