#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ifov::io {

/// What documents call the kinds of products (output.formats), in the order of messages and of the reference. Each is the
/// name of a ProductFormat, which says how it is written.
std::span<const std::string_view> product_words();

/// Those of them that are written where a document does not say: of envi, png and html what this build writes.
std::vector<std::string> usual_product_words();

/// Why this build does not write a kind of product; empty where it does.
std::string why_not_built(std::string_view word);

}  // namespace ifov::io
