#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "math/ray.h"
#include "sampling/field.h"
#include "sampling/warp.h"
#include "transport/mirrors/sun_images.h"
#include "transport/path_record.h"
#include "transport/surface_lobe.h"
#include "transport/transport_options.h"

namespace ifov::transport {

class EmitterMirrors;
class LobeView;
class Emitters;
class MirrorTracer;
class SkySampler;
class SpectralScene;
class SunLobes;
class SunMirrors;

/// The random numbers of a path: element `index` of the scrambled sequence `sequence`.
struct PathKey {
  std::uint64_t sequence = 0;
  std::uint32_t index = 0;
};

/// Finds paths, breadth first: a batch advances together, one surface at a time, so that the ray tracer sees large
/// batches. Next-event estimation to the Sun (uniform in projected solid angle of its disc) and to what outshines the
/// scene (Emitters), scattering for sky and other emission; the estimate is unbiased (Kajiya 1986). No decision needs a spectrum, only the highest factors of a
/// surface: what a path met is recorded, and PathLight makes radiance of it in all spectral nodes.
/// An object serves one thread.
class PathTracer {
 public:
  /// Keeps a reference to the scene, which must outlive this.
  PathTracer(const SpectralScene& scene, TransportOptions options);
  ~PathTracer();
  PathTracer(const PathTracer&) = delete;
  PathTracer& operator=(const PathTracer&) = delete;

  /// The Sun's images in flat mirrors that are sought; none where there are no mirrors or no Sun.
  const SunImages& sun_images() const { return images_; }

  /// The paths of rays from the sensor; the record holds until the next call. `first_hits` receives what each ray met.
  /// Adds shadow and continuation rays to `counts`. `whole`: by ray, 0 where the path is wanted as far as its first surface alone
  /// (PathLight::direct()), which is what it is there for others; empty: all are wanted whole.
  const PathRecord& trace(std::span<const math::Ray> rays, std::span<const PathKey> keys,
                          std::span<geometry::SurfacePoint> first_hits, sampling::RayCounts& counts,
                          std::span<const std::uint8_t> whole = {});

 private:
  struct Sides;  // path_sides.h
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr double kGrazing = 1e-6;  // the least cosine by which an area is seen

  // What it keeps of paths and rays (path_parts.h).
  struct Departure;
  struct Way;
  struct Path;
  struct SurfaceEvent;
  struct Seek;
  struct MirrorSeek;
  struct SunRay;
  struct MirrorRay;
  struct UnseenRay;
  struct Thrower;
  struct PassingRay;
  /// Which side of a boundary a path goes on to: by chance, or, at a fork, each.
  enum class Branch : std::uint8_t { by_chance, reflected, transmitted };
  void trace_segment(sampling::RayCounts& counts, int depth);
  void advance(int depth, sampling::RayCounts& counts);
  void escape(const Path& path, int depth);
  /// Whether what a path met is added separately where it is seen by this way: then it goes on as if nothing were there.
  bool passes(const Path& path, const geometry::SurfacePoint& hit) const;
  void pass(const Path& path, const geometry::SurfacePoint& hit);
  PathVertex vertex_of(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe, math::Vec3 outgoing);
  /// Index of a surface whose spectra are not kept.
  std::uint32_t add_mixed(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                          math::Vec3 outgoing);
  /// The factors of a vertex whose spectra are kept.
  void take_factors(const scene::ResolvedSurface& surface, PathVertex& vertex) const;
  /// Where a vertex keeps its events; null where its lobe is separable.
  PathRecord::Events* events_of(const PathVertex& vertex);
  /// Bsdf::grey() of how a path goes on, which its weight is multiplied by; 1 of a separable lobe, whose weight holds it.
  double continuation_grey(const SurfaceLobe& lobe, const PathVertex& vertex);
  /// The random number that picks one of unlike models at a surface.
  static double shape_choice(const PathKey& key, const scene::ResolvedSurface& surface, int depth);
  /// What becomes of a path at a surface: an event is added, of no weights where it ends there without sunlight.
  void scatter(const Path& path, std::uint32_t path_index, const scene::ResolvedSurface& surface, int depth,
               Branch branch, std::uint32_t number);
  /// Whether both sides of a boundary are followed, so that neither is left to chance where the sensor sees it.
  bool forks(const Path& path, const geometry::SurfacePoint& hit,
             const scene::ResolvedSurface& surface) const;
  /// Another path of the record that has come the same way, and brings nothing from there.
  std::uint32_t fork(std::uint32_t number);
  void send_to_sun(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                   const geometry::SurfacePoint& hit, int depth, sampling::Point2 u, SurfaceEvent& event);
  /// Share of sunlight from a direction that belongs to these paths (TransportOptions::highlights).
  double sunlight_share(const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit,
                        int depth, math::Vec3 direction, bool transmitted) const;
  /// What a lobe that throws_rarely() makes of sunlight from a direction, where paths come to it so seldom that they do not know how
  /// seldom: on other surfaces than the first, and where it bends.
  struct RareSunlight {
    double share = 0.0;    ///< of the event's sunlight that is left out of images
    double widened = 0.0;  ///< the lobe so wide that paths find it, 1/sr
  };
  RareSunlight rare_sunlight(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                             const geometry::SurfacePoint& hit, int depth, math::Vec3 direction,
                             bool transmitted, bool by_mirror) const;
  /// The same of sunlight by way of a mirror: leaves its share out and marks the path.
  void leave_rare(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                  const geometry::SurfacePoint& hit, int depth, SunRay& light);
  /// `towards_sun` the middle of the disc, or of an image of it.
  SunRay sun_ray(const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit,
                 math::Vec3 towards_sun, sampling::Point2 u) const;
  /// Light from a direction, its weight the cosine and what a sampled direction counts.
  SunRay light_ray(const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit,
                   math::Vec3 direction, double weight_sr) const;

  // By way of mirrors (path_tracer_mirrors.cpp).
  void send_to_images(const Path& path, const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                      const Sides& sides, const geometry::SurfacePoint& hit, int depth, sampling::Point2 u);
  void send_to_rounds(const Path& path, const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                      const Sides& sides, const geometry::SurfacePoint& hit, int depth, sampling::Point2 u);
  void send_by_mirrors(MirrorRay way, const SunRay& light, double weight,
                       const scene::ResolvedSurface& surface, const SurfaceLobe& lobe, const Sides& sides);
  // To narrow lobes that throw sunlight (path_tracer_lobes.cpp).
  /// Whether a surface sends rays there, by lobe_view_, which is filled then.
  bool look_for_lobes(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                      const geometry::SurfacePoint& hit, int depth);
  /// Adds an event that goes on with such a ray, of a path of its own. Invalidates events.
  void send_to_lobes(const Path& path, std::uint32_t number, const scene::ResolvedSurface& surface,
                     const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit,
                     int depth, std::uint32_t path_index);
  /// Share of sunlight that a scattered ray finds there, and rays that are sent do not.
  double found_by_chance(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction,
                         bool transmitted) const;
  /// What such a ray met.
  void meet_lobe(const Path& path, std::uint32_t path_index, int depth);
  void drop(const Path& path);
  void send_to_unseen(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                      const geometry::SurfacePoint& hit, int depth);
  /// Along which mirrors the path goes on, and whether it may meet the Sun there.
  void note_chain(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                  const geometry::SurfacePoint& hit, SurfaceEvent& event);
  void trace_mirror_rays(sampling::RayCounts& counts);

  // Through panes and media (path_tracer_passes.cpp).
  /// How a path goes on that came through a surface: whether what it meets there is sought by other rays.
  void note_passage(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                    const geometry::SurfacePoint& hit, SurfaceEvent& event);
  /// Sunlight that reaches a surface in a medium through the flat boundaries of it.
  /// `which` of a surface's sides lie in the medium.
  enum class MediumSides : std::uint8_t { before, behind, both };
  void send_from_medium(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                        const geometry::SurfacePoint& hit, int depth, const scene::ResolvedSurface& surface,
                        sampling::Point2 u, std::uint32_t medium, MediumSides which);
  void send_from_media(const Path& path, const SurfaceLobe& lobe, const Sides& sides,
                       const geometry::SurfacePoint& hit, int depth, const scene::ResolvedSurface& surface,
                       sampling::Point2 u);
  /// Follows rays to the Sun that panes and parallel faces let pass.
  void pass_shadow_rays(sampling::RayCounts& counts);
  void trace_passing(sampling::RayCounts& counts);
  bool pass(PassingRay& way, const geometry::SurfacePoint& hit, const scene::ResolvedSurface& surface);
  /// Of the wide Sun what a ray finds that is refracted by what it met, 1/sr: 0 where that bounds no medium.
  float refracted_light(math::Ray ray, geometry::SurfacePoint hit, sampling::RayCounts& counts) const;
  /// The same for rays to emitters, straight on alone.
  void pass_seeks(sampling::RayCounts& counts);
  /// Index of a new entry of the record before `next`.
  std::uint32_t add_pass(const scene::ResolvedSurface& surface, math::Vec3 away,
                         const geometry::SurfacePoint& hit, std::uint32_t next);
  std::uint32_t add_segment(std::uint32_t medium, double length_m);
  /// The medium that a path is in after a surface; kNone: none.
  std::uint32_t medium_after(std::uint32_t before, const SurfaceLobe& lobe,
                             const scene::ResolvedSurface& surface);
  /// What the narrow lobes of a surface throw back along a ray of the Sun's irradiance, 1/sr, widened.
  double thrown_by_lobes(const scene::ResolvedSurface& surface, const math::Ray& ray,
                         const geometry::SurfacePoint& hit) const;
  void trace_unseen_rays(sampling::RayCounts& counts);
  /// Of a lobe that may transmit, with which a path goes on by one side, chosen at random.
  static double side_probability(const SurfaceLobe& lobe, const Sides& sides, bool transmitted);
  /// Direction, side and weight of the continued path, before any roulette; false where it ends.
  bool continue_path(const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit,
                     sampling::Point2 u, Branch branch, SurfaceEvent& event);
  /// Ends a continued path or lets it weigh more; it keeps `kept` of its light at this surface.
  static void end_by_chance(const PathKey& key, int depth, double kept, SurfaceEvent& event);
  /// Whether a path takes a share of the open sky at the first surface (TransportOptions::sky_shares); 0: no.
  float open_sky_share(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe, const Sides& sides,
                       Branch branch, int depth) const;
  /// Sends a ray to an emitter.
  void seek(const SurfaceLobe& lobe, const Sides& sides, const geometry::SurfacePoint& hit,
            const PathKey& key, int depth, SurfaceEvent& event);
  void trace_seeks(sampling::RayCounts& counts);
  /// The same by way of one mirror (path_tracer_mirror_seek.cpp).
  void seek_by_planes(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe, const Sides& sides,
                      const geometry::SurfacePoint& hit, const PathKey& key, int depth, SurfaceEvent& event);
  void seek_by_rounds(const scene::ResolvedSurface& surface, const SurfaceLobe& lobe, const Sides& sides,
                      const geometry::SurfacePoint& hit, const PathKey& key, int depth, SurfaceEvent& event);
  void trace_mirror_seeks(sampling::RayCounts& counts);
  bool reflects(MirrorSeek& seek, const geometry::SurfacePoint& hit, const scene::ResolvedSurface& surface);
  /// A path that came straight from where emitters were sought meets a mirror: what is known of what it meets next.
  Departure by_mirror(const Departure& left, const geometry::SurfacePoint& hit,
                      const scene::ResolvedSurface& surface) const;
  bool shows_mirror(const scene::ResolvedSurface& surface) const;
  /// What a mirror leaves of light that it reflects from or to a direction away from it.
  PathRecord::Mirrored::Factor mirror_factor(const scene::ResolvedSurface& surface, math::Vec3 away,
                                             const geometry::SurfacePoint& hit);
  PathRecord::Mirrored::Factor delta_factor(const scene::ResolvedSurface& surface, math::Vec3 away,
                                            const geometry::SurfacePoint& hit, SurfaceLobe::Deltas deltas);
  /// What the surface of an event makes of light that reaches it by way of mirrors.
  PathRecord::Mirrored::Factor surface_factor(const scene::ResolvedSurface& surface, const PathVertex& vertex,
                                              const LobeEvent& event, bool transmitted);
  /// The probability of one plane to be sought by from one surface.
  double mirror_probability() const;
  /// Notes how the next ray leaves: by reflection or not, the side chosen at random with a probability.
  void leave(const SurfaceLobe& lobe, const Sides& sides, bool transmitted, double probability,
             SurfaceEvent& event) const;
  /// Share of what a path's ray met that is not sought from where it comes from: all or nothing, by the maximum heuristic.
  float unsought(const Path& path, const geometry::SurfacePoint& hit) const;
  /// The event of light from a direction that reaches a surface geometrically: of irradiance on the shading normal's plane, or of radiance, weighed by cosines.
  static LobeEvent arriving(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction,
                            bool transmitted);
  static LobeEvent scattering(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction,
                              bool transmitted);
  /// Scattered by the lobe from a direction on a side, shape times cosine (1 of a directional one, whose event holds the
  /// cosine); and the density with which continue_path() takes it, the choice of the side not included.
  static double scattered(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction,
                          bool transmitted);
  double continuation_density(const SurfaceLobe& lobe, const Sides& sides, math::Vec3 direction,
                              bool transmitted) const;
  double sky_share(const materials::Bsdf& bsdf, const materials::BsdfEvent& view, bool perturbed) const;
  materials::BsdfSample sample_continuation(const materials::Bsdf& bsdf, const materials::BsdfEvent& view,
                                            bool perturbed, sampling::Point2 u) const;
  sampling::LightSample sample_sun(math::Vec3 towards_sun, math::Vec3 normal, bool either_side,
                                   sampling::Point2 u) const;

  const SpectralScene& scene_;
  TransportOptions options_;
  std::optional<sampling::SolarDisc> disc_;
  const SkySampler* sky_ = nullptr;     // of a sky that is not uniform
  const Emitters* emitters_ = nullptr;  // null: none are sought
  PathRecord record_;
  std::span<const std::uint8_t> whole_;  // by ray, of the first surface; empty: all paths go on
  std::vector<Path> paths_, next_paths_, passing_;
  std::vector<math::Ray> rays_, shadow_rays_;
  std::vector<geometry::SurfacePoint> hits_;
  std::vector<SurfaceEvent> events_;
  std::vector<PathRecord::Directions> directions_;  // by event, where they are kept
  std::vector<std::uint8_t> blocked_;
  std::vector<Seek> seeks_;
  std::vector<math::Ray> seek_rays_;
  std::vector<geometry::SurfacePoint> seek_hits_;
  const SunMirrors* mirrors_ = nullptr;   // null: there are none, or no Sun
  const SunLobes* rare_lobes_ = nullptr;  // null: none throws_rarely()
  const SunLobes* lobes_ = nullptr;       // null: no ray is sent to narrow lobes
  std::unique_ptr<LobeView> lobe_view_;   // from the surface at hand
  std::vector<Thrower> throwers_;
  SunImages images_;
  std::unique_ptr<MirrorTracer> mirror_tracer_;
  const EmitterMirrors* emitter_mirrors_ = nullptr;  // null where nothing is sought by way of mirrors
  std::vector<MirrorSeek> mirror_seeks_;
  std::vector<MirrorRay> mirror_rays_;
  std::vector<UnseenRay> unseen_rays_, next_unseen_rays_;
  bool passages_ = false;  // some surface lets light pass
  std::vector<PassingRay> passing_rays_, next_passing_;
  std::vector<PathRecord::Mirrored> sunken_;  // light of rays from within media, by PassingRay::light
  std::vector<scene::Constituent> media_;     // that paths are in
  std::vector<std::uint32_t> seen_images_;
  std::vector<std::uint8_t> hidden_;
};

}  // namespace ifov::transport
