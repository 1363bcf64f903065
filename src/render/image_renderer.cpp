#include "render/image_renderer.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "geometry/world.h"
#include "render/open_sky.h"
#include "render/pilot_rays.h"
#include "render/polarized/steering.h"
#include "render/scene_field.h"
#include "render/tile_grid.h"
#include "render/tile_loop.h"
#include "render/tile_sink.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/tolerance/atmosphere_budget.h"
#include "render/tolerance/node_budget.h"
#include "render/truth_layers.h"
#include "render/unsampled_light.h"
#include "render/view_renderer.h"
#include "render/wings/wing_light.h"
#include "render/wings/wing_maps.h"
#include "render/wings/wing_spots.h"
#include "sampling/image/survey.h"
#include "sampling/pixel_sampler.h"
#include "sampling/tile.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/mirrors/sun_disc.h"
#include "transport/mirrors/sun_images.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

/// Where the image is judged as a whole, no pixel is too wide of its own: what the sampler said of it stands, and light that is not
/// found or not described.
void judge_as_image(const std::vector<sampling::Reasons>& sampled, sampling::TileResult& tile) {
  constexpr sampling::Reasons kOfPixels =
      bit(sampling::Reason::unseen_light) | bit(sampling::Reason::edge) | bit(sampling::Reason::structure);
  for (std::size_t p = 0; p < tile.reasons.size(); ++p)
    tile.reasons[p] = static_cast<sampling::Reasons>(sampled[p] | (tile.reasons[p] & kOfPixels));
  std::fill(tile.worst_ratio.begin(), tile.worst_ratio.end(), 0.0f);
}

/// Directions in which a sensor would see the Sun, by way of flat mirrors too.
std::vector<math::Vec3> sun_and_its_images(const transport::SpectralScene& scene) {
  constexpr int kReflections = 2;  // as labels follow them (SeenThrough)
  std::vector<math::Vec3> directions = {scene.scene().sun->direction};
  if (scene.sun_mirrors() != nullptr) {
    const transport::SunImages images(*scene.sun_mirrors(), directions[0], kReflections);
    for (const transport::SunImages::Image& image : images.images()) directions.push_back(image.direction);
  }
  return directions;
}

/// What is no channel's own has what that of the reference, the first, has.
std::vector<double> cut_by_column(const std::vector<double>& by_channel, const SceneField& field) {
  std::vector<double> cut;
  for (int c = 0; !by_channel.empty() && c < field.columns(); ++c)
    cut.push_back(by_channel[static_cast<std::size_t>(std::max(0, field.channel_of(c)))]);
  return cut;
}

}  // namespace

Progress render_image(const RenderJob& job, const RenderControl& control, TileSink& sink) {
  if (const sensor::ViewListCamera* const views = job.camera.view_list())
    return render_views(job, *views, control, sink);
  const int width = job.camera.width_px(), height = job.camera.height_px();
  const std::vector<sampling::PixelRect> tiles = tile_grid(width, height, job.tile_px);
  const double margin_px = PilotRays::margin_px(job);
  std::optional<PilotRays> pilot_rays;
  if (job.pilot_rays) {
    const scene::Scene& scene = job.scene.scene();
    std::vector<math::Vec3> towards_sun, glare;
    if (scene.sun) {
      towards_sun = transport::fixed_disc_points(scene.sun->direction, scene.sun->half_angle_rad);
      glare = sun_and_its_images(job.scene);
    }
    pilot_rays.emplace(*scene.world, scene.assignments.size(), job.camera, towards_sun,
                       job.scene.sought_assignments(), margin_px, glare);
  }

  std::int64_t pixels = 0;
  for (const int index : control.tile_order) pixels += tiles[static_cast<std::size_t>(index)].count();
  if (control.tile_order.empty()) pixels = static_cast<std::int64_t>(width) * height;
  // Samplers that judge every column where none is named are not to judge the shares of mixtures.
  std::vector<int> steering_channels = job.steering_channels;
  if (steering_channels.empty())
    for (std::size_t c = 0; c < job.scene.nodes().channel_count(); ++c)
      steering_channels.push_back(static_cast<int>(c));
  add_stokes_columns(job.polarimetry, job.scene.nodes().channel_count(), steering_channels);

  const LightTold told(job.polarimetry, job.parts);
  const UnsampledLight unsampled(job, control.threads, control.cancel);
  transport::TransportOptions transport = unsampled.transport();
  // Light of which Q and U are told is not followed apart from the open sky's.
  const std::vector<float> sky_shares = job.sampler.takes_many_values() && job.polarimetry == nullptr
                                            ? open_sky_shares(job.scene, job.camera)
                                            : std::vector<float>();
  if (!sky_shares.empty()) transport.sky_shares = &sky_shares;
  const auto problem_of = [&](const sampling::PixelRect& tile) {
    sampling::TileProblem problem;
    problem.tile = tile;
    problem.image = {0, 0, width, height};
    problem.seed = job.seed;
    problem.footprint = &job.footprint;
    problem.groups = job.groups;
    problem.tolerance = job.tolerance;
    problem.steering_channels = steering_channels;
    problem.cancel = control.cancel;
    problem.keep_memory = job.keep_memory;
    return problem;
  };
  const auto field_of = [&] {
    return std::make_unique<SceneField>(job.scene, job.camera, transport, job.label_detail, told);
  };
  const sampling::TileProblem whole_image = problem_of({0, 0, width, height});
  const std::unique_ptr<const sampling::ImageSurvey> survey =
      job.sampler.survey({whole_image, field_of, control.threads});
  Tally tally(pixels, control.progress);
  std::optional<WingSpots> wing_spots;
  std::optional<SpotLight> spot_light;
  if (!job.wings.empty()) {
    const auto field = field_of();
    std::vector<WingSpots::Box> boxes = unsampled.met();
    for (const WingSpots::Box& box :
         shining_map_places(job.scene, job.camera, job.seed, control.cancel, *field))
      boxes.push_back(box);
    wing_spots.emplace(WingSpots::find(job.scene, job.camera, std::move(boxes)));
    spot_light.emplace(*wing_spots, job.seed, control.cancel, *field);
    spot_light->add(unsampled.spots(static_cast<std::size_t>(field->columns())));
    tally.add(field->counts());
  }
  if (survey != nullptr) tally.add(survey->rays);
  const auto render_tile = [&](std::size_t index) {
    if (control.cancel != nullptr && control.cancel->cancelled()) throw Cancelled();
    const PilotRays::Near tile_pilot_rays =
        pilot_rays ? pilot_rays->near(tiles[index], margin_px) : PilotRays::Near{};
    sampling::TileProblem problem = problem_of(tiles[index]);
    problem.survey = survey.get();
    problem.pilot_points = tile_pilot_rays.points;
    problem.pilot_objects = tile_pilot_rays.objects;
    sampling::TileResult before;
    if (job.earlier != nullptr && job.earlier->read(index, before)) problem.before = &before;

    SceneField field(job.scene, job.camera, transport, job.label_detail, told);
    const auto later = unsampled.tell(problem.tile, static_cast<std::size_t>(field.blends().first_column()));
    problem.later = later.get();
    sampling::TileResult result;
    job.sampler.sample(problem, field, result);
    const std::vector<sampling::Reasons> sampled = result.reasons;
    if (!job.wings.empty())
      add_wings(job.wings, problem, job.tolerance, spot_light ? &*spot_light : nullptr, field, result);
    widen_by_cut(cut_by_column(job.cut, field), problem.later, job.tolerance, result);
    result.rays = field.counts();
    result.rays += before.rays;
    field.unseen().settle(job.tolerance, problem.later, result);
    field.blends().settle(result);
    unsampled.add_to(result);
    widen(job.nodes, job.tolerance, result);
    unsampled.settle(result);
    widen(job.air, job.tolerance, result);
    field.settle(result);
    if (job.image_wide) judge_as_image(sampled, result);
    if (!result.column_errors.empty()) result.column_errors.resize(static_cast<std::size_t>(result.columns));
    if (!job.keep_variances && !job.keep_memory) result.drop_variances();
    add_truth_layers(job.collectors, job.scene.scene(), job.camera, result);
    sink.write(result);
    tally.add(result);
  };
  TilesInOrder in_order(control.tile_order, tiles.size());
  TileSource& source = control.source != nullptr ? *control.source : in_order;
  render_from(source, control.threads, render_tile);
  return tally.total();
}

std::vector<int> steering_channels_of(int channels, std::span<const int> always, int count) {
  std::vector<int> chosen(always.begin(), always.end());
  const int spread = std::min(channels, count);
  for (int k = 0; k < spread; ++k)
    chosen.push_back(static_cast<int>((static_cast<std::int64_t>(2 * k + 1) * channels) / (2 * spread)));
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

}  // namespace ifov::render
