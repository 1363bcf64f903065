#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sampling/field.h"
#include "sampling/pixel_rect.h"
#include "sampling/tile.h"

namespace ifov::render {

struct RenderControl;
struct RenderJob;
class SceneField;

/// An image that is rendered tile by tile, with all that is known before the first of them. Any number of threads may render, each
/// with a field of its own.
class ImageTiles {
 public:
  /// Keeps references.
  ImageTiles(const RenderJob& job, const RenderControl& control);
  ~ImageTiles();

  const std::vector<sampling::PixelRect>& grid() const;
  const sampling::RayCounts& rays_before() const;  ///< that all this took
  std::unique_ptr<SceneField> field() const;       ///< of one tile
  std::unique_ptr<SceneField> tracer() const;      ///< the same, for paths whose light others make
  /// Throws Cancelled.
  sampling::TileResult render(std::size_t index, SceneField& field) const;
  sampling::TileResult render(std::size_t index) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Why images of several times cannot share their paths, in words; empty: they can. Of jobs that differ in how warm surfaces are, and in
/// what follows from that alone.
std::string cannot_share_paths(std::span<const RenderJob* const> by_time);

}  // namespace ifov::render
