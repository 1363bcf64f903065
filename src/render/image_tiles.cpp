#include "render/image_tiles.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "geometry/world.h"
#include "render/open_sky.h"
#include "render/pilot_rays.h"
#include "render/polarized/steering.h"
#include "render/scene_field.h"
#include "render/tile_grid.h"
#include "render/tile_sink.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/tolerance/atmosphere_budget.h"
#include "render/tolerance/node_budget.h"
#include "render/truth_layers.h"
#include "render/unsampled_light.h"
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

struct ImageTiles::Parts {
  Parts(const RenderJob& of, const RenderControl& with)
      : job(of),
        control(with),
        width(of.camera.width_px()),
        height(of.camera.height_px()),
        grid(tile_grid(width, height, of.tile_px)),
        margin_px(PilotRays::margin_px(of)),
        told(of.polarimetry, of.parts),
        unsampled(of, with.threads, with.cancel),
        transport(unsampled.transport()) {}

  const RenderJob& job;
  const RenderControl& control;
  int width, height;
  std::vector<sampling::PixelRect> grid;
  double margin_px;
  LightTold told;
  UnsampledLight unsampled;
  transport::TransportOptions transport;
  std::optional<PilotRays> pilot_rays;
  std::vector<int> steering_channels;
  std::vector<float> sky_shares;
  std::unique_ptr<const sampling::ImageSurvey> survey;
  std::optional<WingSpots> wing_spots;
  std::optional<SpotLight> spot_light;
  sampling::RayCounts before;

  std::unique_ptr<SceneField> field() const {
    return std::make_unique<SceneField>(job.scene, job.camera, transport, job.label_detail, told);
  }
  sampling::TileProblem problem_of(const sampling::PixelRect& tile) const {
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
  }
};

ImageTiles::ImageTiles(const RenderJob& job, const RenderControl& control)
    : parts_(std::make_unique<Parts>(job, control)) {
  Parts& p = *parts_;
  if (job.pilot_rays) {
    const scene::Scene& scene = job.scene.scene();
    std::vector<math::Vec3> towards_sun, glare;
    if (scene.sun) {
      towards_sun = transport::fixed_disc_points(scene.sun->direction, scene.sun->half_angle_rad);
      glare = sun_and_its_images(job.scene);
    }
    p.pilot_rays.emplace(*scene.world, scene.assignments.size(), job.camera, towards_sun,
                         job.scene.sought_assignments(), p.margin_px, glare);
  }
  // Samplers that judge every column where none is named are not to judge the shares of mixtures.
  p.steering_channels = job.steering_channels;
  if (p.steering_channels.empty())
    for (std::size_t c = 0; c < job.scene.nodes().channel_count(); ++c)
      p.steering_channels.push_back(static_cast<int>(c));
  add_stokes_columns(job.polarimetry, job.scene.nodes().channel_count(), p.steering_channels);
  if (job.sampler.takes_many_values()) p.sky_shares = open_sky_shares(job.scene, job.camera);
  if (!p.sky_shares.empty()) p.transport.sky_shares = &p.sky_shares;
  const sampling::TileProblem whole_image = p.problem_of({0, 0, p.width, p.height});
  p.survey = job.sampler.survey({whole_image, [&p] { return p.field(); }, control.threads});
  if (!job.wings.empty()) {
    const auto field = p.field();
    std::vector<WingSpots::Box> boxes = p.unsampled.met();
    for (const WingSpots::Box& box :
         shining_map_places(job.scene, job.camera, job.seed, control.cancel, *field))
      boxes.push_back(box);
    p.wing_spots.emplace(WingSpots::find(job.scene, job.camera, std::move(boxes)));
    p.spot_light.emplace(*p.wing_spots, job.seed, control.cancel, *field);
    p.spot_light->add(p.unsampled.spots(static_cast<std::size_t>(field->columns())));
    p.before += field->counts();
  }
  if (p.survey != nullptr) p.before += p.survey->rays;
}

ImageTiles::~ImageTiles() = default;
const std::vector<sampling::PixelRect>& ImageTiles::grid() const { return parts_->grid; }
const sampling::RayCounts& ImageTiles::rays_before() const { return parts_->before; }
std::unique_ptr<SceneField> ImageTiles::field() const { return parts_->field(); }
std::unique_ptr<SceneField> ImageTiles::tracer() const {
  const Parts& p = *parts_;
  transport::TransportOptions transport = p.transport;
  transport.no_spectra = true;
  return std::make_unique<SceneField>(p.job.scene, p.job.camera, transport, p.job.label_detail, p.told);
}

sampling::TileResult ImageTiles::render(std::size_t index, SceneField& field) const {
  const Parts& p = *parts_;
  const RenderJob& job = p.job;
  if (p.control.cancel != nullptr && p.control.cancel->cancelled()) throw Cancelled();
  const PilotRays::Near tile_pilot_rays =
      p.pilot_rays ? p.pilot_rays->near(p.grid[index], p.margin_px) : PilotRays::Near{};
  sampling::TileProblem problem = p.problem_of(p.grid[index]);
  problem.survey = p.survey.get();
  problem.pilot_points = tile_pilot_rays.points;
  problem.pilot_objects = tile_pilot_rays.objects;
  sampling::TileResult before;
  if (job.earlier != nullptr && job.earlier->read(index, before)) problem.before = &before;

  const auto later = p.unsampled.tell(problem.tile, static_cast<std::size_t>(field.blends().first_column()));
  problem.later = later.get();
  sampling::TileResult result;
  job.sampler.sample(problem, field, result);
  const std::vector<sampling::Reasons> sampled = result.reasons;
  if (!job.wings.empty())
    add_wings(job.wings, problem, job.tolerance, p.spot_light ? &*p.spot_light : nullptr, field, result);
  widen_by_cut(cut_by_column(job.cut, field), problem.later, job.tolerance, result);
  result.rays = field.counts();
  result.rays += before.rays;
  field.unseen().settle(job.tolerance, problem.later, result);
  field.blends().settle(result);
  p.unsampled.add_to(result);
  widen(job.nodes, job.tolerance, result);
  p.unsampled.settle(result);
  widen(job.air, job.tolerance, result);
  field.settle(result);
  if (job.image_wide) judge_as_image(sampled, result);
  if (!result.column_errors.empty()) result.column_errors.resize(static_cast<std::size_t>(result.columns));
  if (!job.keep_variances && !job.keep_memory) result.drop_variances();
  add_truth_layers(job.collectors, job.scene.scene(), job.camera, result);
  return result;
}

sampling::TileResult ImageTiles::render(std::size_t index) const { return render(index, *parts_->field()); }

std::string cannot_share_paths(std::span<const RenderJob* const> by_time) {
  const RenderJob& first = *by_time.front();
  if (first.camera.view_list() != nullptr) return "their rays are a list";
  if (first.image_wide) return "the accuracy is that of the image as a whole";
  if (first.polarimetry != nullptr || first.parts) return "more than radiance is told";
  if (!first.scene.scene().mirror_assignments().empty()) return "there are mirrors or panes";
  for (const RenderJob* job : by_time) {
    if (job->scene.scene().sun) return "the Sun lights the image";
    if (job->scene.scene().world != first.scene.scene().world) return "the scene is not the same";
  }
  return "";
}

}  // namespace ifov::render
