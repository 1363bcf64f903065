#include "io/raster/map_reference.h"

#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/raster/gdal_reference.h"
#include "io/raster/quiet_gdal.h"

namespace ifov::io {

namespace {

struct ReleaseTransform {
  void operator()(void* transform) const { late::OCTDestroyCoordinateTransformation(transform); }
};

}  // namespace

struct MapReference::Content {
  ReferenceHandle handle;
};

MapReference::MapReference(const std::string& text) : content_(std::make_unique<Content>()) {
  const QuietGdal gdal;
  content_->handle.reset(late::OSRNewSpatialReference(nullptr));
  // PROJ's own tables only: the text is not looked up as a file or an address.
  std::error_code error;
  const bool as_wkt = text.find('[') != std::string::npos;
  const bool elsewhere = text.find('/') != std::string::npos || std::filesystem::exists(text, error);
  char* wkt = const_cast<char*>(text.c_str());
  const bool known =
      as_wkt ? late::OSRImportFromWkt(content_->handle.get(), &wkt) == OGRERR_NONE
             : !elsewhere && late::OSRSetFromUserInput(content_->handle.get(), text.c_str()) == OGRERR_NONE;
  if (!known)
    throw InputError(
        format("'{}' is no coordinate reference system that PROJ knows ({}); expected one such as "
               "\"EPSG:25832\"",
               text, gdal.message()));
  late::OSRSetAxisMappingStrategy(content_->handle.get(), OAMS_TRADITIONAL_GIS_ORDER);
}
MapReference::MapReference() : content_(std::make_unique<Content>()) {
  content_->handle.reset(late::OSRNewSpatialReference(nullptr));
  late::OSRSetAxisMappingStrategy(content_->handle.get(), OAMS_TRADITIONAL_GIS_ORDER);
}
MapReference::~MapReference() = default;
MapReference::MapReference(MapReference&&) noexcept = default;
MapReference& MapReference::operator=(MapReference&&) noexcept = default;

MapReference MapReference::around(double latitude_deg, double longitude_deg, MapPoint false_origin) {
  const QuietGdal gdal;
  MapReference result;
  const double longitude = std::remainder(longitude_deg, 360.0);
  void* const handle = result.content_->handle.get();
  const std::string name = format("Local map about {:.6f} {:.6f}", latitude_deg, longitude);
  if (late::OSRSetProjCS(handle, name.c_str()) != OGRERR_NONE ||
      late::OSRSetWellKnownGeogCS(handle, "WGS84") != OGRERR_NONE ||
      late::OSRSetTM(handle, latitude_deg, longitude, 1.0, false_origin.x, false_origin.y) != OGRERR_NONE)
    throw SystemError(
        format("PROJ makes no map projection about {:g}, {:g}: {}", latitude_deg, longitude, gdal.message()));
  return result;
}

bool MapReference::is_projected() const { return late::OSRIsProjected(content_->handle.get()) != 0; }
bool MapReference::is_geographic() const { return late::OSRIsGeographic(content_->handle.get()) != 0; }
double MapReference::metres_per_unit() const {
  return late::OSRGetLinearUnits(content_->handle.get(), nullptr);
}

std::string MapReference::name() const {
  const char* name = late::OSRGetName(content_->handle.get());
  return name != nullptr ? name : "unnamed";
}

std::string MapReference::wkt() const {
  char* text = nullptr;
  late::OSRExportToWkt(content_->handle.get(), &text);
  const std::string result = text != nullptr ? text : "";
  late::VSIFree(text);
  return result;
}

bool MapReference::same_as(const MapReference& other) const {
  return late::OSRIsSame(content_->handle.get(), other.content_->handle.get()) != 0;
}

struct MapTransform::Content {
  std::unique_ptr<void, ReleaseTransform> handle;
  std::string from, to;
};

MapTransform::MapTransform(const MapReference& from, const MapReference& to)
    : content_(std::make_unique<Content>()) {
  const QuietGdal gdal;
  content_->from = from.name();
  content_->to = to.name();
  content_->handle.reset(
      late::OCTNewCoordinateTransformation(from.content_->handle.get(), to.content_->handle.get()));
  if (!content_->handle)
    throw InputError(
        format("there is no way from '{}' to '{}': {}", content_->from, content_->to, gdal.message()));
}
MapTransform::~MapTransform() = default;

void MapTransform::apply(std::span<MapPoint> points) const {
  const QuietGdal gdal;
  std::vector<double> x, y;
  std::vector<int> done(points.size());
  for (const MapPoint& point : points) {
    x.push_back(point.x);
    y.push_back(point.y);
  }
  late::OCTTransformEx(content_->handle.get(), static_cast<int>(points.size()), x.data(), y.data(), nullptr,
                       done.data());
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (done[k] == 0 || !std::isfinite(x[k]) || !std::isfinite(y[k]))
      throw InputError(format("the point {}, {} of '{}' has no place in '{}'", points[k].x, points[k].y,
                              content_->from, content_->to));
    points[k] = {x[k], y[k]};
  }
}

MapPoint MapTransform::operator()(MapPoint point) const {
  apply({&point, 1});
  return point;
}

}  // namespace ifov::io
