#pragma once

#include <memory>
#include <optional>
#include <string>

#include "io/document/document_values.h"
#include "io/document/sampling_document.h"
#include "sampling/pixel_sampler.h"

namespace ifov::io {

/// What a document says of how the rays of its pixels are found. Never changed.
class SamplerSettings {
 public:
  virtual ~SamplerSettings() = default;

  virtual std::unique_ptr<sampling::PixelSampler> build() const = 0;

  /// For single views, of which each may hold a scene.
  virtual std::unique_ptr<sampling::PixelSampler> build_for_views() const { return build(); }

  /// For people: "grid 10 x 10".
  virtual std::string description() const = 0;

  /// Whether it can tell how far its values may be off.
  virtual bool knows_errors() const { return true; }

  /// The channel that it looks at; null: all of them.
  virtual const DocumentName* channel_looked_at() const { return nullptr; }

  /// How many pixels are measured once more, where any are.
  virtual std::optional<int> audited_pixels() const { return std::nullopt; }
};

/// The settings where they are a T, else null.
template <class T>
const T* sampler_as(const SamplingDocument& sampling) {
  return dynamic_cast<const T*>(sampling.method.get());
}

}  // namespace ifov::io
