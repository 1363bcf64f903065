#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "render/wings/wing_spots.h"
#include "transport/transport_options.h"

namespace ifov {
class CancelToken;
}
namespace ifov::sampling {
struct LaterLight;
struct PixelRect;
struct TileResult;
}  // namespace ifov::sampling

namespace ifov::render {

class Glints;
class Highlights;
class MirrorImages;
class UnseenBends;
class UnseenEmitters;
class UnseenImages;
class UnseenLobes;
struct RenderJob;

/// Light that a job's paths leave out: glints and images in mirrors, and highlights in narrow lobes, which are worked out beside them, and what may not be
/// found at all.
class UnsampledLight {
 public:
  /// Keeps a reference to the job. Throws Cancelled.
  UnsampledLight(const RenderJob& job, int threads, const CancelToken* cancel);
  ~UnsampledLight();

  /// The job's, of paths that leave that light out.
  const transport::TransportOptions& transport() const { return transport_; }

  /// What add_to() will add to the pixels of a tile that has so many columns of light; null where that is nothing. From any
  /// thread.
  std::shared_ptr<const sampling::LaterLight> tell(const sampling::PixelRect& tile,
                                                   std::size_t columns) const;

  /// To the radiances of a finished tile that has light alone (StokesColumns), and to its half-widths. From any thread.
  void add_to(sampling::TileResult& tile) const;
  /// All that add_to() may add, for the wings of pixels far from it: of so many columns.
  std::vector<SpotLight::Spot> spots(std::size_t columns) const;
  /// Where mirrors show small things that shine and whose images are left to paths, for those wings: squares.
  std::vector<WingSpots::Box> met() const;
  /// Widens half-widths by what may not have been found at all. From any thread.
  void settle(sampling::TileResult& tile) const;

 private:
  const RenderJob& job_;
  transport::TransportOptions transport_;
  std::vector<int> channels_;  // by column of light
  std::unique_ptr<const Glints> glints_;
  std::unique_ptr<const Highlights> highlights_;
  std::unique_ptr<const MirrorImages> mirror_images_;
  std::unique_ptr<const UnseenImages> unseen_images_;
  std::unique_ptr<const UnseenEmitters> unseen_emitters_;
  std::unique_ptr<const UnseenLobes> unseen_lobes_;
  std::unique_ptr<const UnseenBends> unseen_bends_;
};

}  // namespace ifov::render
