#pragma once

#include <memory>
#include <vector>

#include "render/field/blend_columns.h"
#include "render/field/label_detail.h"
#include "render/field/seen_through.h"
#include "render/field/surface_label.h"
#include "render/parts/light_told.h"
#include "render/unseen/unseen_light.h"
#include "sampling/field.h"
#include "scene/scene.h"

namespace ifov::sampling {
struct TileResult;
}
namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class MirrorLight;
class PathTracer;
class SpectralScene;
struct PathKey;
struct TransportOptions;
}  // namespace ifov::transport

namespace ifov::render {

class MapDetail;
class FlownExposure;
class MovingCover;
class SceneLight;
class SceneField;
class SurfaceMaps;

/// Where a field's values come from that it shares with others.
class SharedValues {
 public:
  virtual ~SharedValues() = default;
  virtual void values(SceneField& of, std::span<const sampling::PathRequest> requests,
                      std::span<sampling::Label> labels, std::span<float> values) = 0;
};

/// The picture on a camera's focal plane: answers a sampler's queries by tracing the scene. One tile, one thread.
class SceneField final : public sampling::Field {
 public:
  /// Keeps references to all; they must outlive this.
  SceneField(const transport::SpectralScene& scene, const sensor::Camera& camera,
             transport::TransportOptions transport, LabelDetail detail, const LightTold& told = {});
  ~SceneField() override;

  /// The channels, Q, U and V of all of them and their parts where they are told (StokesColumns), then the shares of materials that
  /// are mixed somewhere (BlendColumns), then light that is not sought (UnseenLight).
  int columns() const override { return blends_.first_column() + blends_.count() + unseen_.count(); }
  int leader(int column) const override;
  int channel_of(int column) const override;
  void labels(std::span<const sampling::FocalPoint> points, std::span<sampling::Label> labels) override;
  void values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values) override;
  void values_expecting(std::span<const sampling::PathRequest> requests,
                        std::span<const sampling::Label> expected, std::span<sampling::Label> labels,
                        std::span<float> values) override;
  void values_and_materials(std::span<const sampling::PathRequest> requests,
                            std::span<sampling::Label> labels, std::span<float> values) override;
  bool values_in_shadow(std::span<const sampling::PathRequest> requests, std::span<float> values) override;
  void levels(const sampling::LevelRequests& requests, sampling::LevelSums& sums) override;
  void known_detail(const sampling::FieldRect& pixels, sampling::KnownDetail& detail) override;
  std::unique_ptr<sampling::MappedSurface> mapped_surface(sampling::Label label,
                                                          const sampling::FocalPoint& seen) override;
  /// By number in scene::TruthMaterials. Rays that met nothing stand on the material of the surroundings, the last
  /// of the scene; surface assignments that mix stand on none: BlendColumns::kNoMaterial.
  std::uint32_t material_of(sampling::Label label) const override;
  bool uneven(sampling::Label label) const override {
    return SurfaceLabel::is_uneven(label, mirror_light_ != nullptr || through_.any_mirror());
  }
  bool may_be_shaded(sampling::Label label) const override;
  /// The instance, where labels hold its whole number.
  std::uint32_t object_of(sampling::Label label) const override;
  bool may_have_corners(sampling::Label a, sampling::Label b) const override;
  const BlendColumns& blends() const { return blends_; }
  const UnseenLight& unseen() const { return unseen_; }
  /// Null where the camera stands still while a point is exposed.
  FlownExposure* flown() { return flown_.get(); }
  std::vector<double> instants_s() const;  ///< FlownExposure's; empty without it
  /// As StokesColumns::settle().
  void settle(sampling::TileResult& tile) const;
  sampling::RayCounts counts() const override { return counts_; }

  /// Values come from there from now on, with labels as of whole paths; `count()` says what they took.
  void share(SharedValues* values) { shared_ = values; }
  void count(const sampling::RayCounts& rays) { counts_ += rays; }
  /// The paths of some requests, until the next call; labels where they begin.
  const transport::PathRecord& trace(std::span<const sampling::PathRequest> requests,
                                     std::span<sampling::Label> labels);
  /// The light of path k of those, or of what was made of them, which `by` has traced: a row of values.
  void write(const SceneField& by, const transport::PathRecord& paths, std::size_t k, float* row);
  /// Paths found together: many, so that the ray tracer's own data stay in the cache; few enough that what they met does.
  static constexpr std::size_t kMostTraced = 512;

 private:
  const transport::PathRecord& trace_paths(std::span<const sampling::PathRequest> requests);
  /// Whether sunlight on a surface is seen from the side that is viewed, and whether light from behind is, too.
  bool shows_sunlight(const scene::ResolvedSurface& surface, bool& transmits) const;
  void values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values, LabelDetail detail, std::span<const sampling::Label> expected);
  void moving_values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
                     std::span<float> values, LabelDetail detail);
  static std::shared_ptr<MovingCover> find_moving(const scene::Scene& scene, const sensor::Camera& camera);
  static std::shared_ptr<FlownExposure> find_flown(const scene::Scene& scene, const sensor::Camera& camera);
  /// Rays through points (rays_) and what they meet (hits_).
  void meet(std::span<const sampling::FocalPoint> points);
  void flown_values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
                    std::span<float> values, LabelDetail detail, std::span<const sampling::Label> expected);
  void flown_labels(std::span<const sampling::FocalPoint> points, LabelDetail detail,
                    std::span<sampling::Label> labels);
  /// Where what moves may cover the points (covered_), whose rays and hits are known.
  void find_covered(std::span<const sampling::FocalPoint> points);
  /// `expected`: the labels that paths which begin with these hits are taken to show; empty: none.
  void label_hits(std::span<const sampling::FocalPoint> points, std::span<const geometry::SurfacePoint> hits,
                  LabelDetail detail, std::span<sampling::Label> labels,
                  std::span<const sampling::Label> expected = {}, const transport::PathRecord* paths = {});

  const transport::SpectralScene& scene_;
  const sensor::Camera& camera_;
  LabelDetail detail_;
  const std::unique_ptr<transport::PathTracer> tracer_;
  const std::unique_ptr<SceneLight> light_;
  scene::TruthMaterials truth_;
  const std::shared_ptr<MovingCover> moving_;   // null: all is alike while a point is exposed, or
  const std::shared_ptr<FlownExposure> flown_;  // null: the camera stands still meanwhile
  BlendColumns blends_;
  std::shared_ptr<MapDetail> map_detail_;  // once asked for
  UnseenLight unseen_;
  std::shared_ptr<const SurfaceMaps> maps_;  // once asked for
  SeenThrough through_;
  std::unique_ptr<transport::MirrorLight> mirror_light_;  // null where mirrors throw none
  struct Sunlight {
    bool shows, passes;  ///< whether it is seen where it falls on a material, and from behind
  };
  std::vector<Sunlight> sunlight_;       // by material
  std::vector<math::Vec3> disc_points_;  // directions to the fixed points of the Sun's disc
  SharedValues* shared_ = nullptr;
  sampling::RayCounts counts_;
  std::vector<sampling::FocalPoint> points_;
  std::vector<math::Ray> rays_, sun_rays_, ways_;
  std::vector<transport::PathKey> keys_;
  std::vector<geometry::SurfacePoint> hits_, seen_;
  std::vector<std::uint64_t> passed_;            // by hit: what it is seen through
  std::vector<std::uint8_t> covered_, blocked_;  // the former by hit, where moving_ or flown_ is
  std::vector<std::uint32_t> owner_;             // of each group of sun rays: index of its hit
};

}  // namespace ifov::render
