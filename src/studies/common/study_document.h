#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/run_control.h"
#include "sampling/tile.h"
#include "studies/common/image_store.h"

/// Documents as the studies write them, and their images.
namespace ifov::studies {

/// A document in parts; each is a JSON text. What is empty is left away.
struct StudyDocument {
  std::string title;  ///< a comment at the top
  std::string materials, objects, light, camera, channels, psf, sampling;
  std::uint64_t seed = 1;
  std::string text() const;
};

std::string metres(double value_m);
std::string point_text(double x_m, double y_m, double z_m);

/// A nadir camera with 1 m pixels whose image coordinates are (x, y) = (X - west, north - Y) of the ground
/// point.
std::string nadir_camera(int width_px, int height_px, double west_m, double north_m);

std::string single_sampling();
std::string grid_sampling(int n);
/// The paper's scheme; `allowed_difference` with its unit.
std::string adaptive_sampling(int sub_elements, int max_samples, std::string_view allowed_difference);
/// `error` with its unit; `more` further members, each with a leading comma.
std::string accuracy_sampling(std::string_view error, std::string_view more = "");

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

/// Makes a folder where there is none; EnvironmentError where that fails.
void make_folder(const std::filesystem::path& folder);

/// Writes a file whole; EnvironmentError where that fails.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace ifov::studies
