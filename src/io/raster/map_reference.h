#pragma once

#include <memory>
#include <span>
#include <string>

namespace ifov::io {

/// Two map coordinates: easting and northing in the unit of the reference's axes, or longitude and latitude in
/// degrees; always in this order, whatever order the reference itself declares.
struct MapPoint {
  double x = 0.0, y = 0.0;
};

/// A coordinate reference system, by PROJ through GDAL.
class MapReference {
 public:
  /// From any text that PROJ knows: "EPSG:25832", a WKT, a PROJ string. Throws InputError.
  explicit MapReference(const std::string& text);
  /// A transverse Mercator projection about a place (WGS 84, degrees), true to scale there, whose map coordinates at the
  /// place are `false_origin`.
  static MapReference around(double latitude_deg, double longitude_deg, MapPoint false_origin);
  ~MapReference();
  MapReference(MapReference&&) noexcept;
  MapReference& operator=(MapReference&&) noexcept;

  bool is_projected() const;   ///< axes are lengths on a plane
  bool is_geographic() const;  ///< axes are angles
  double metres_per_unit() const;
  std::string name() const;  ///< "ETRS89 / UTM zone 32N"
  std::string wkt() const;
  bool same_as(const MapReference& other) const;

 private:
  friend class MapTransform;
  MapReference();
  struct Content;
  std::unique_ptr<Content> content_;
};

/// Takes points from one reference to another. Heights are not changed: no geoid is applied.
class MapTransform {
 public:
  /// Throws InputError where there is no way from one to the other.
  MapTransform(const MapReference& from, const MapReference& to);
  ~MapTransform();
  MapTransform(const MapTransform&) = delete;
  MapTransform& operator=(const MapTransform&) = delete;

  /// In place; throws InputError, with the first point that cannot be taken over.
  void apply(std::span<MapPoint> points) const;
  MapPoint operator()(MapPoint point) const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace ifov::io
