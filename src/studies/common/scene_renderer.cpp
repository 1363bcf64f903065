#include "studies/common/scene_renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "io/document/aerosol_document.h"
#include "io/document/document.h"
#include "render/image_renderer.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "sampling/pixel_sampler.h"
#include "session/assembly/whole/sampling_assembly.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::studies {

namespace {

/// Labels of the centres of n x n cells of each pixel.
class LabelGrid final : public sampling::PixelSampler {
 public:
  explicit LabelGrid(int n) : n_(n) {}
  int halo_px() const override { return 0; }

  void sample(const sampling::TileProblem& problem, sampling::Field& field,
              sampling::TileResult& result) const override {
    const sampling::PixelRect tile = problem.tile;
    result.reset(tile, field.columns());
    const std::size_t cells = static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_);
    std::vector<sampling::FocalPoint> points(cells);
    std::vector<sampling::Label> labels(cells);
    for (int pixel = 0; pixel < tile.count(); ++pixel) {
      const int i = tile.x0 + pixel % tile.width(), j = tile.y0 + pixel / tile.width();
      for (std::size_t k = 0; k < cells; ++k)
        points[k] = {i + (double(k % static_cast<std::size_t>(n_)) + 0.5) / n_,
                     j + (double(k / static_cast<std::size_t>(n_)) + 0.5) / n_};
      field.labels(points, labels);
      std::map<std::uint32_t, std::size_t> found;
      for (const sampling::Label label : labels) ++found[field.material_of(label)];
      for (const auto& [material, count] : found)
        result.abundances.push_back({static_cast<std::uint32_t>(pixel), material,
                                     static_cast<float>(double(count) / double(cells)), 0.0f});
      result.samples[static_cast<std::size_t>(pixel)] = static_cast<std::uint32_t>(cells);
    }
  }

 private:
  int n_;
};

double timed_render(const render::RenderJob& job, const SceneRenderer::Choices& choices,
                    const render::ImageInfo& info, render::TileSink& image) {
  image.begin(info);
  render::RenderControl control;
  control.threads = choices.threads;
  control.cancel = choices.cancel;
  control.progress = choices.progress;
  control.tile_order = choices.tiles;
  const auto start = std::chrono::steady_clock::now();
  render::render_image(job, control, image);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

SceneRenderer::SceneRenderer(const io::Document& document, LogSink* log)
    : session_(session::Session::load(document, log)) {}

const render::ImageInfo& SceneRenderer::info() const { return session_.parts().info; }

std::string SceneRenderer::lighting() const {
  const scene::Scene& scene = session_.parts().scene;
  std::string out = "No Sun";
  if (scene.sun) {
    const double zenith_deg =
        std::acos(std::clamp(scene.sun->direction.z, -1.0, 1.0)) * 180.0 / std::numbers::pi;
    out =
        format("Sun at a zenith angle of {:.1f} degrees, {}", zenith_deg,
               scene.sun->half_angle_rad > 0.0
                   ? format("a disc of {:.2f} degrees", scene.sun->half_angle_rad * 360.0 / std::numbers::pi)
                   : std::string("a point"));
  }
  constexpr double kGreen_um = 0.55;
  const auto& modelled = session_.parts().document.atmosphere.modelled;
  if (modelled)
    out += format("; the {} atmosphere with {} aerosol, over surroundings of the document",
                  modelled->description.air.model,
                  (modelled->aerosol ? modelled->aerosol->tables : atmosphere::AerosolDescription{}).type);
  else if (scene.sky.radiance)
    out += format("; a uniform sky of {:.3g} W m-2 sr-1 um-1 at {} um", scene.sky.radiance->at(kGreen_um),
                  kGreen_um);
  else if (scene.sky.temperature_k)
    out += format("; a sky that radiates as a black body of {:.1f} K", *scene.sky.temperature_k);
  else
    out += "; a black sky";
  double coldest_k = 0.0, hottest_k = 0.0;
  for (const scene::SurfaceState& state : scene.states) {
    if (state.temperature_k <= 0.0) continue;
    coldest_k = coldest_k > 0.0 ? std::min(coldest_k, state.temperature_k) : state.temperature_k;
    hottest_k = std::max(hottest_k, state.temperature_k);
  }
  out += hottest_k > 0.0 ? format("; surfaces at {:.1f} to {:.1f} K.", coldest_k, hottest_k)
                         : std::string("; surfaces emit nothing.");
  return out;
}

double SceneRenderer::render(const io::SamplingDocument& sampling, const Choices& choices,
                             render::TileSink& image) const {
  const session::Session::Parts& parts = session_.parts();
  const io::Document& document = parts.document;
  const session::SamplingPlan plan = session::assemble_sampling(document.sources, sampling, document.sensor,
                                                                parts.told_channels, parts.responses.get());
  const std::unique_ptr<render::AccuracyTolerance> tolerance = parts.tolerance_of(plan);
  render::RenderJob job = parts.job(plan, tolerance.get());
  job.tile_px = choices.tile_px;
  if (choices.seed) job.seed = *choices.seed;
  return timed_render(job, choices, parts.info, image);
}

double SceneRenderer::render_abundances(int n, const Choices& choices, render::TileSink& image) const {
  const session::Session::Parts& parts = session_.parts();
  for (const scene::SurfaceAssignment& assignment : parts.scene.assignments)
    if (assignment.mixes_materials())
      throw InputError(
          "labels do not tell the materials of a mixture apart: scenes with mixture maps have no reference");
  const LabelGrid sampler(n);
  const render::RenderJob own = parts.job();
  render::RenderJob job{own.scene, own.camera, own.footprint, sampler, nullptr, own.transport};
  job.groups = own.groups;
  job.label_detail = render::LabelDetail::material;
  job.pilot_rays = false;
  job.tile_px = choices.tile_px;
  return timed_render(job, choices, parts.info, image);
}

}  // namespace ifov::studies
