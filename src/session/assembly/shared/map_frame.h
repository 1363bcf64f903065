#pragma once

#include <array>
#include <optional>
#include <string>

#include "io/document/origin_document.h"
#include "io/raster/map_reference.h"

namespace ifov::io {
struct DocumentSources;
}

namespace ifov::session {

/// How map coordinates relate to the scene.
class MapFrame {
 public:
  /// Throws InputError, at the origin's place in the document, where its reference is unknown or not in metres.
  MapFrame(const io::DocumentSources& sources, const io::OriginDocument& origin);

  /// What coordinates of the document are lessened by to be about the scene's origin, metres.
  math::Vec3 document_offset_m() const { return document_offset_m_; }

  /// Map coordinates of the scene's origin, metres.
  math::Vec3 offset_m() const { return offset_m_; }
  /// Null where the document states none.
  const io::MapReference* reference() const { return reference_ ? &*reference_ : nullptr; }

  /// The way from a raster's reference to the scene's; null where the raster's coordinates are the scene's. Throws
  /// InputError, naming the raster, where it is not in metres and the scene states no reference to take it to.
  std::unique_ptr<io::MapTransform> transform_from(const std::string& projection,
                                                   const std::string& raster) const;

 private:
  std::optional<io::MapReference> reference_;
  math::Vec3 document_offset_m_, offset_m_;
};

/// The system of a scene's map coordinates, for its products, as well-known text: the one that the origin names; else a
/// projection about its latitude and longitude, in which the origin has the easting and northing that it states. Or
/// "Arbitrary", where nothing says where the scene stands.
std::string map_system(const io::OriginDocument& origin);

}  // namespace ifov::session
