#pragma once

#include "io/document/cameras/framed_places.h"

namespace ifov::io {
struct DocumentSources;
}

namespace ifov::session {

/// Takes coordinates of maps to a scene as rasters are taken (MapFrame): the scene's plane is its map. Without a `crs` of the origin that is
/// the one of its products, about its latitude and longitude. What it is made of must outlive it.
class MapsOfScene final : public io::SceneMaps {
 public:
  MapsOfScene(const io::DocumentSources& sources, const io::OriginDocument& origin)
      : sources_(sources), origin_(origin) {}
  void to_scene(const io::DocumentName& crs, std::span<math::Point3> places) const override;

 private:
  const io::DocumentSources& sources_;
  const io::OriginDocument& origin_;
};

}  // namespace ifov::session
