#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

namespace ifov::render {
struct ImageInfo;
}
namespace ifov::truth {
struct Collector;
}

namespace ifov::io {

struct Quantity;

/// All there are, in the order in which their cubes are written.
std::span<const Quantity* const> all_quantities();

/// Null where there is none of this name.
const Quantity* find_quantity(std::string_view name);

/// A choice among them, in their order.
class QuantitySet {
 public:
  QuantitySet() = default;
  QuantitySet(std::initializer_list<const Quantity*> quantities) {
    for (const Quantity* quantity : quantities) add(*quantity);
  }
  static QuantitySet all();

  bool has(const Quantity& quantity) const;
  void add(const Quantity& quantity);
  void remove(const Quantity& quantity) { std::erase(chosen_, &quantity); }

  auto begin() const { return chosen_.begin(); }
  auto end() const { return chosen_.end(); }
  std::size_t size() const { return chosen_.size(); }
  friend bool operator==(const QuantitySet&, const QuantitySet&) = default;

 private:
  std::vector<const Quantity*> chosen_;
};

/// What is written where a document names nothing. `map_tells`: every pixel's place follows from its column and line. `stokes`: the
/// sensor tells polarization.
QuantitySet usual_quantities(bool map_tells, bool stokes = false);

/// What is left of a choice for this image, the radiance always.
QuantitySet possible_quantities(const QuantitySet& choice, const render::ImageInfo& image,
                                bool knows_errors = true);

/// Adds what the tables of single views hold (product_parts/view_values.h); of points more.
void add_view_quantities(bool points, QuantitySet& choice);

/// What tiles must note for them, each once.
std::vector<const truth::Collector*> collectors_of(const QuantitySet& quantities);

struct CubeSize {
  int width_px = 0, height_px = 0, bands = 0;
  int value_bytes = 4;
  std::uint64_t bytes() const;
};
CubeSize cube_size(const Quantity& quantity, const render::ImageInfo& image);

}  // namespace ifov::io
