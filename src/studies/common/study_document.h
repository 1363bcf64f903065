#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/run_control.h"
#include "io/document/document.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "io/document/shapes/primitive.h"
#include "sampling/tile.h"
#include "studies/common/image_store.h"

/// Documents as the studies write them, and their images.
namespace ifov::studies {

/// The document as a study keeps and renders it.
std::string study_text(const io::Document& document);

/// A document of a scene without light, seen from above.
io::Document nadir_document(io::CameraDocument camera, const std::string& channel, double wavelength_um,
                            io::SamplingDocument sampling, std::uint64_t seed);

/// A nadir camera with 1 m pixels whose image coordinates are (x, y) = (X - west, north - Y) of the ground
/// point.
io::CameraDocument nadir_camera(int width_px, int height_px, double west_m, double north_m);

io::SamplingDocument single_sampling();
io::SamplingDocument grid_sampling(int n);
/// The paper's scheme.
io::SamplingDocument adaptive_sampling(int sub_elements, int max_samples, io::ErrorSize allowed_difference);
/// `more` may change what else is asked.
io::SamplingDocument accuracy_sampling(io::ErrorSize error,
                                       const std::function<void(io::AccuracySampling&)>& more = nullptr);

io::MaterialDocument grey(const std::string& name, double reflectance);
io::MaterialDocument black(const std::string& name, io::TemperatureDocument temperature);
/// Of one material.
template <class Primitive>
io::ObjectDocument object_of(Primitive primitive, const std::string& material) {
  io::ObjectDocument object;
  object.shape = io::PrimitiveShape{std::string(Primitive::kModel.key),
                                    std::make_shared<const Primitive>(std::move(primitive))};
  object.material = io::MaterialBinding{io::DocumentName{material, {}}, {}};
  return object;
}

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

/// Makes a folder where there is none; SystemError where that fails.
void make_folder(const std::filesystem::path& folder);

/// Writes a file whole; SystemError where that fails.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace ifov::studies
