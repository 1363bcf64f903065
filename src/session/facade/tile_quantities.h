#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "ifov/tile.h"

namespace ifov::io {
struct RunPlan;
class QuantitySet;
}  // namespace ifov::io
namespace ifov::sampling {
struct TileResult;
}

namespace ifov::session {

/// Those with these words in documents ("all" for every one). Throws InputError, with the choices, where there is no such.
io::QuantitySet quantities_named(const std::vector<std::string>& words);

/// What is told of one tile, with what keeps the values.
class QuantityValues {
 public:
  std::span<const TileQuantity> spans() const { return spans_; }

 private:
  friend class AskedQuantities;
  class Kept;
  std::vector<TileQuantity> spans_;
  /// Of numbers of all types, none of which moves while there come more.
  std::deque<std::vector<std::byte>> bytes_;
};

/// The quantities of a plan but the radiance, which tiles always tell.
class AskedQuantities {
 public:
  /// Keeps a reference to the plan.
  explicit AskedQuantities(const io::RunPlan& plan);
  QuantityValues of(const sampling::TileResult& tile) const;

 private:
  const io::RunPlan& plan_;
  std::vector<QuantityDescription> descriptions_;
};

}  // namespace ifov::session
