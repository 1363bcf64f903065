#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "render/mirrors/focal_lights.h"
#include "render/mirrors/glint_search.h"
#include "render/mirrors/image_spectra.h"
#include "render/mirrors/sought_instants.h"
#include "render/parts/light_told.h"
#include "transport/separate_images.h"
#include "transport/shining_parts.h"

namespace ifov {
class CancelToken;
}
namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class SpectralScene;
struct TransportOptions;
}  // namespace ifov::transport

namespace ifov::render {

/// Images of what shines (transport::ShiningParts) in mirrors that the sensor sees directly, flat or bent: in a pixel that
/// sees a mirror ball a hot thing is a spot that no path need meet. Where it lies follows from the shapes (GlintSearch);
/// what stands before the mirror and between it and the thing is traced. Paths see through the thing there, and the
/// difference that it makes is added to finished tiles. Images that fill a good part of the pixels that they lie in are
/// left to paths.
class MirrorImages {
 public:
  /// Null where there is nothing to look for. Errors: Cancelled. Keeps references. `margin_px`: a footprint's half width. The result does
  /// not depend on the number of threads.
  static std::unique_ptr<const MirrorImages> find(const transport::SpectralScene& scene,
                                                  const sensor::Camera& camera,
                                                  const transport::TransportOptions& transport,
                                                  double margin_px, std::uint64_t seed, int threads,
                                                  const CancelToken* cancel = nullptr,
                                                  const LightTold& told = {});

  /// For transport::TransportOptions.
  const transport::SeparateImages& apart() const { return apart_; }
  const transport::ShiningParts& parts() const { return parts_; }
  /// Whether a thing is sought in a mirror, or its image left to paths because they meet it.
  bool settled(transport::SeparateImages::Mirror mirror, std::uint32_t object) const;

  /// Whether all that may matter is settled.
  bool all_settled() const { return all_settled_ && parts_.complete(); }

  /// As FocalLights::add_to.
  void add_to(const sampling::ColumnFootprints& footprints, const sampling::Tolerance* tolerance,
              sampling::TileResult& tile, std::span<const double> kept = {}) const {
    lights_.add_to(footprints, tolerance, tile, kept);
  }
  const FocalLights& lights() const { return lights_; }
  /// Where images lie that are left to paths and are no larger than `most_px`: middles of squares of kPlace_px that cover them, each once.
  std::vector<sampling::FocalPoint> places(double most_px) const;
  static constexpr double kPlace_px = 0.5;

  std::size_t count() const { return lights_.lights().size(); }

  /// An image that fills more of the pixels in which it lies is met by paths.
  static constexpr double kMet = 0.25;
  /// More triangles are not made for one part in one mirror.
  static constexpr std::size_t kMostTriangles = 1 << 16;
  /// Places of mirrors that are looked at for all images together, about.
  static constexpr double kMostWork = 1e8;
  /// An image that, were it in view whole, brought less than this share of the usual radiance is not sought.
  static constexpr double kNegligible = 1e-4;

 private:
  MirrorImages(const transport::SpectralScene& scene, const sensor::Camera& camera, const LightTold& told,
               std::uint64_t seed);
  struct Mirror {
    transport::SeparateImages::Mirror name = 0;
    std::vector<std::size_t> rounds, smooths;  // of the survey
    std::size_t triangles = 0;
  };
  struct Pair {
    std::size_t mirror = 0;
    std::size_t first = 0, last = 0;  // parts of one object
    double steps = 0.0;               // across the half-angle of a part
    double work = 0.0;
  };
  enum class Outcome : std::uint8_t { apart, met, given_up };
  using Place = std::pair<std::int32_t, std::int32_t>;  // row and column of a square
  struct Found {
    Outcome outcome = Outcome::apart;
    std::vector<ImageSpectrum> rows;  // of images that are added separately
    std::vector<Place> places;        // of one that is met
  };
  void list_mirrors();
  /// Those that may matter; others are settled.
  std::vector<Pair> pairs();
  bool may_matter(const Mirror& mirror, const transport::ShiningParts::Part& part) const;
  Found search(const Pair& pair, double margin_px, std::uint64_t key) const;
  /// Traces points at which a part may be seen in a mirror; keeps those where it is, with their areas, as lights.
  void trace(const Mirror& mirror, std::uint32_t part, std::vector<GlintPoint>& points,
             std::vector<FocalLights::Light>& seen) const;
  static std::vector<Place> places_of(const std::vector<FocalLights::Light>& seen);
  bool met_by_paths(const std::vector<FocalLights::Light>& seen) const;
  /// Their radiance: what paths find less what they find where they see through what is added separately.
  FocalLights weigh(transport::TransportOptions transport, std::uint64_t key,
                    const std::vector<ImageSpectrum>& rows) const;

  const transport::SpectralScene& scene_;
  const sensor::Camera& camera_;
  SoughtInstants instants_;
  LightTold told_;
  transport::ShiningParts parts_;
  transport::SeparateImages apart_;
  std::vector<Mirror> mirrors_;
  struct Name {
    transport::SeparateImages::Mirror mirror;
    std::uint32_t object;
    friend auto operator<=>(const Name&, const Name&) = default;
  };
  std::vector<Name> settled_;  // sorted
  bool all_settled_ = true;
  FocalLights lights_;
  std::vector<std::vector<Place>> met_;  // by image, sorted
};

}  // namespace ifov::render
