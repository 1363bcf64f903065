#include "render/picture.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "render/bright_places.h"
#include "render/channels_by_column.h"
#include "render/field/scene_field.h"
#include "render/image_renderer.h"
#include "render/open_sky.h"
#include "render/polarized/steering.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/tolerance/atmosphere_budget.h"
#include "render/tolerance/node_budget.h"
#include "render/truth_layers.h"
#include "render/wings/cut_room.h"
#include "render/wings/wing_light.h"
#include "render/wings/wing_maps.h"
#include "render/wings/wing_spots.h"
#include "sampling/pixel_sampler.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/mirrors/sun_disc.h"
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

/// From so many times as far as footprints reach nothing comes by way of what a Gaussian's cut leaves out.
constexpr double kCutReach = 2.0;

/// What is no channel's own has what that of the reference, the first, has.
std::vector<double> by_column(const std::vector<double>& by_channel, const SceneField& field) {
  std::vector<double> values;
  for (int c = 0; !by_channel.empty() && c < field.columns(); ++c)
    values.push_back(by_channel[static_cast<std::size_t>(std::max(0, field.channel_of(c)))]);
  return values;
}

}  // namespace

Picture::Picture(const RenderJob& job, const RenderControl& control)
    : job_(job),
      cancel_(control.cancel),
      margin_px_(PilotRays::margin_px(job)),
      told_(job.polarimetry, job.parts),
      unsampled_(job, control.threads, control.cancel),
      transport_(unsampled_.transport()),
      steering_channels_(job.steering_channels) {
  if (job.pilot_rays) find_pilots();
  // Samplers that judge every column where none is named are not to judge the shares of mixtures.
  if (steering_channels_.empty())
    for (std::size_t c = 0; c < job.scene.nodes().channel_count(); ++c)
      steering_channels_.push_back(static_cast<int>(c));
  add_stokes_columns(job.polarimetry, job.scene.nodes().channel_count(), steering_channels_);
  // Light of which Q and U are told is not followed apart from the open sky's.
  if (job.sampler.takes_many_values() && job.polarimetry == nullptr)
    sky_shares_ = open_sky_shares(job.scene, job.camera);
  if (!sky_shares_.empty()) transport_.sky_shares = &sky_shares_;
  if (job.sampler.asks_for_bright_places()) find_bright_places();
  const sampling::TileProblem whole = problem_of({0, 0, job.camera.width_px(), job.camera.height_px()});
  const auto surveyed = [this, &whole] {
    auto field = this->field();
    pilots_near(whole.tile, *field);
    return field;
  };
  survey_ = job.sampler.survey({whole, surveyed, control.threads});
  if (survey_ != nullptr) rays_ += survey_->rays;
  if (!job.wings.empty()) find_wings();
}

Picture::~Picture() = default;

sampling::TileProblem Picture::problem_of(const sampling::PixelRect& tile) const {
  sampling::TileProblem problem;
  problem.tile = tile;
  problem.image = {0, 0, job_.camera.width_px(), job_.camera.height_px()};
  problem.seed = job_.seed;
  problem.footprint = &job_.footprint;
  problem.groups = job_.groups;
  problem.tolerance = job_.tolerance;
  problem.steering_channels = steering_channels_;
  problem.bright = bright_places_.get();
  problem.cancel = cancel_;
  problem.keep_memory = job_.keep_memory;
  return problem;
}

std::unique_ptr<SceneField> Picture::field() const {
  return std::make_unique<SceneField>(job_.scene, job_.camera, transport_, job_.label_detail, told_);
}

std::unique_ptr<SceneField> Picture::tracer() const {
  transport::TransportOptions transport = transport_;
  transport.no_spectra = true;
  return std::make_unique<SceneField>(job_.scene, job_.camera, transport, job_.label_detail, told_);
}

void Picture::find_pilots() {
  const scene::Scene& scene = job_.scene.scene();
  std::vector<math::Vec3> towards_sun;
  if (scene.sun) towards_sun = transport::fixed_disc_points(scene.sun->direction, scene.sun->half_angle_rad);
  const std::vector<math::Vec3> glare = this->glare();
  const auto of = [&](const sensor::Camera& camera) {
    return PilotRays(*scene.world, scene.assignments.size(), camera, towards_sun,
                     job_.scene.sought_assignments(), margin_px_, glare);
  };
  const std::vector<double> instants_s = field()->instants_s();
  if (instants_s.empty()) pilot_rays_.emplace(of(job_.camera));
  std::vector<PilotRays> flown;
  for (const double time_s : instants_s) flown.push_back(of(*camera_at(job_.camera, time_s)));
  flown_pilots_ = FlownPilots(std::move(flown));
}

std::vector<math::Vec3> Picture::glare() const {
  const scene::Scene& scene = job_.scene.scene();
  if (!scene.sun) return {};
  return PilotRays::sun_and_its_images(scene.sun->direction, job_.scene.sun_mirrors());
}

void Picture::find_bright_places() {
  const auto field = this->field();
  // In a picture that is smeared as a whole, things have no place.
  if (!field->instants_s().empty()) return;
  std::vector<WingSpots::Box> boxes = unsampled_.met();
  for (const WingSpots::Box& box : shining_map_places(job_.scene, job_.camera, job_.seed, cancel_, *field))
    boxes.push_back(box);
  const scene::Scene& scene = job_.scene.scene();
  bright_places_ = std::make_unique<sampling::BrightPlaces>(
      bright_places(job_.scene, job_.camera, boxes, glare(), scene.sun ? scene.sun->half_angle_rad : 0.0));
  rays_ += field->counts();
}

PilotRays::Near Picture::pilots_near(const sampling::PixelRect& tile, SceneField& field) const {
  if (flown_pilots_.any()) return flown_pilots_.near(tile, margin_px_, *field.flown());
  return pilot_rays_ ? pilot_rays_->near(tile, margin_px_) : PilotRays::Near{};
}

void Picture::find_wings() {
  const auto field = this->field();
  std::vector<WingSpots::Box> boxes = unsampled_.met();
  for (const WingSpots::Box& box : shining_map_places(job_.scene, job_.camera, job_.seed, cancel_, *field))
    boxes.push_back(box);
  wing_spots_.emplace(WingSpots::find(job_.scene, job_.camera, std::move(boxes)));
  spot_light_.emplace(*wing_spots_, job_.seed, cancel_, *field);
  spot_light_->add(unsampled_.spots(static_cast<std::size_t>(field->columns())));
  rays_ += field->counts();
}

sampling::TileResult Picture::tile(const sampling::PixelRect& tile, std::size_t number) const {
  return this->tile(tile, number, *field());
}

sampling::TileResult Picture::tile(const sampling::PixelRect& tile, std::size_t number,
                                   SceneField& field) const {
  if (cancel_ != nullptr && cancel_->cancelled()) throw Cancelled();
  const PilotRays::Near pilot_rays = pilots_near(tile, field);
  sampling::TileProblem problem = problem_of(tile);
  problem.survey = survey_.get();
  problem.pilot_points = pilot_rays.points;
  problem.pilot_objects = pilot_rays.objects;
  problem.thin_shadows = pilot_rays.thin_shadows;
  sampling::TileResult before;
  if (job_.earlier != nullptr && job_.earlier->read(number, before)) problem.before = &before;

  const auto later = unsampled_.tell(problem.tile, static_cast<std::size_t>(field.blends().first_column()));
  problem.later = later.get();
  sampling::TileResult result;
  const std::vector<double> cut = by_column(job_.cut, field);
  CutRange about_cut;
  std::optional<CutRoom> room;
  const auto look_about = [&] {
    about_cut = cut_range(problem, kCutReach * job_.reach_px(), field);
    const std::vector<double> most = by_column(job_.outshining, field);
    for (std::size_t c = 0; c < most.size(); ++c)
      about_cut.brightest[c] = std::max(about_cut.brightest[c], most[c]);
  };
  if (job_.tolerance != nullptr && !job_.image_wide && leaves_out(cut)) {
    look_about();
    problem.tolerance = &room.emplace(*job_.tolerance, cut, about_cut);
  }
  job_.sampler.sample(problem, field, result);
  if (!room && leaves_out(cut) && result.has_errors()) look_about();
  result.halo_samples += about_cut.paths;
  const std::vector<sampling::Reasons> sampled = result.reasons;
  if (!job_.wings.empty())
    add_wings(job_.wings, problem, job_.tolerance, spot_light_ ? &*spot_light_ : nullptr, field, result);
  widen_by_cut(cut, about_cut, problem.later, job_.tolerance, result);
  result.rays = field.counts();
  result.rays += before.rays;
  field.unseen().settle(job_.tolerance, problem.later, result);
  field.blends().settle(joint_of(job_.tolerance), result);
  unsampled_.add_to(result);
  widen(job_.nodes, job_.tolerance, result);
  unsampled_.settle(result);
  widen(job_.air, job_.tolerance, result);
  result.join_bounds(joint_of(job_.tolerance));
  field.settle(result);
  if (job_.image_wide) judge_as_image(sampled, result);
  if (!result.column_errors.empty()) result.column_errors.resize(static_cast<std::size_t>(result.columns));
  if (job_.thermal_errors) add_thermal_layer(job_.nodes, result);
  if (job_.emissivity) add_emissivity_layer(job_.scene, job_.camera, result);
  if (job_.responses != nullptr) make_channels(*job_.responses, result);
  if (!job_.keep_variances && !job_.keep_memory) result.drop_variances();
  add_truth_layers(job_.collectors, job_.scene.scene(), job_.camera, result);
  return result;
}

}  // namespace ifov::render
