#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/run_control.h"

namespace ifov::sampling {
class PixelSampler;
}

namespace ifov::studies {

class ImageStore;

struct RenderTimes {
  double load_s = 0.0, render_s = 0.0;
};

/// How a rendering is done. Only `sampler` changes the result.
struct RenderChoices {
  int threads = 1;
  const CancelToken* cancel = nullptr;
  const sampling::PixelSampler* sampler = nullptr;  ///< takes the place of the document's
  std::span<const int> tile_order;                  ///< as in render::RenderControl
};

/// Reads the text as a document, loads it by session::Session and renders it into `image`. Files it names are
/// looked for in `folder`.
RenderTimes render_document(const std::string& text, const std::filesystem::path& folder,
                            const RenderChoices& choices, ImageStore& image);

}  // namespace ifov::studies
