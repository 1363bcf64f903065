#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/run_control.h"
#include "io/json/document_override.h"
#include "math/ray.h"
#include "session/scene_model/document_cuts.h"
#include "session/scene_model/sensor_sketch.h"

namespace ifov::session {

/// What surfaces are painted by: their reflectance as eyes would see it, or colours that tell materials or objects apart.
enum class SurfacePaint { reflectance, material, object };

/// The scene of a document before anything is rendered: what rays meet, where the Sun and the sensor stand. Neither air nor
/// channels are worked out, and what is wrong with the document is left out and said, as far as a scene is left. Immutable; from any
/// thread.
class SceneModel {
 public:
  /// `progress`, which may be null, is told of objects in place of pixels. Throws InputError where no scene is left (`faults`, if not
  /// null, has the mistakes that were left out before), SystemError where the document cannot be read, Cancelled.
  static std::unique_ptr<const SceneModel> load(const std::string& file,
                                                std::span<const io::DocumentOverride> overrides,
                                                ProgressSink* progress, std::vector<DocumentFault>* faults);
  ~SceneModel();

  const std::vector<DocumentFault>& faults() const;
  const std::string& statement() const;  ///< what stands in the scene, a line
  math::Vec3 offset_m() const;           ///< of the document's coordinates from the scene frame
  /// Box about all that is bounded, scene frame; none where nothing is.
  std::optional<std::array<math::Point3, 2>> bounds_m() const;
  const std::optional<math::Vec3>& sun() const;       ///< towards the Sun or Moon where one is up
  const std::optional<SensorSketch>& sensor() const;  ///< none where it is wrong
  /// That with which surfaces are told apart best.
  SurfacePaint usual_paint() const;

  struct Seen {
    float distance_m;      ///< NaN: nothing
    std::uint32_t colour;  ///< 0xRRGGBB of sRGB, shaded, with the Sun's shadow
    std::int32_t object;   ///< index in the document's scene.objects; -1: none of it
  };
  /// One thread; a few hundred rays at a time are best. Rays of the scene frame.
  void look(std::span<const math::Ray> rays, SurfacePaint paint, std::span<Seen> seen) const;

  struct Picked {
    double distance_m = 0.0;
    math::Point3 position_m;  ///< scene frame
    math::Vec3 normal;        ///< unit, on the side that the ray comes from
    std::int32_t object = -1;
    std::string name;  ///< of the object: "'tower' (line 23)"
    int line = 0;      ///< where it begins, in `file`
    std::string file;
    struct Share {
      std::string material;
      double weight = 1.0;
    };
    std::vector<Share> materials;  ///< largest first
  };
  std::optional<Picked> pick(const math::Ray& ray) const;

 private:
  struct Inside;
  explicit SceneModel(std::unique_ptr<const Inside> inside);
  std::unique_ptr<const Inside> inside_;
};

}  // namespace ifov::session
