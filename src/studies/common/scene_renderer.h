#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/run_control.h"
#include "io/document/sampling_document.h"
#include "render/tile_sink.h"
#include "session/session.h"

namespace ifov::studies {

/// One scene, loaded once, that is rendered in several ways.
class SceneRenderer {
 public:
  /// Loads as session::Session does, with its errors.
  SceneRenderer(const io::Document& document, LogSink* log);

  struct Choices {
    int threads = 0;
    int tile_px = 64;
    std::span<const int> tiles;  ///< positions in the grid of tiles; empty: all of them
    const CancelToken* cancel = nullptr;
    ProgressSink* progress = nullptr;
    std::optional<std::uint64_t> seed = std::nullopt;  ///< instead of the document's
  };

  /// Renders with a way of sampling instead of the document's; returns the wall time, seconds.
  double render(const io::SamplingDocument& sampling, const Choices& choices, render::TileSink& image) const;

  /// Asks a lattice of n x n labels in every pixel and writes their abundances; radiances stay zero.
  /// InputError where the scene mixes materials by map, which labels do not show.
  double render_abundances(int n, const Choices& choices, render::TileSink& image) const;

  const render::ImageInfo& info() const;

  /// What shines on the scene and how warm its surfaces are, in words.
  std::string lighting() const;

 private:
  session::Session session_;
};

}  // namespace ifov::studies
