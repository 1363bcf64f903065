#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/document/map_document.h"
#include "io/document/origin_document.h"
#include "io/document/spectrum_document.h"
#include "math/vec3.h"

namespace ifov::io {

struct OpacityDocument;
struct PresenceDocument;
struct ParameterMap;
struct ThermalDocument;
/// A model of materials::bsdf_models() with its parameters.
struct ScatteringDocument {
  std::string model = "lambertian";
  /// By key; angles in radians, lengths in metres.
  using Value = std::variant<double, std::shared_ptr<const ParameterMap>, SpectrumDocument, std::string,
                             DocumentFile, bool>;
  std::vector<std::pair<std::string, Value>> values;
};

struct MaterialDocument {
  std::string name;
  std::optional<std::pair<DocumentName, DocumentName>> sides;  ///< front and back; then nothing else is given
  bool is_emissivity = false;  ///< the spectrum is emissivity; else reflectance. Opaque: the two sum to 1.
  /// May be left out where the model takes it as a factor alone (BsdfModel::reflectance_is_factor).
  SpectrumDocument spectrum{ConstantSpectrum{1.0}, SpectrumOf::reflectance, {}, OutsideRange::error, {}};
  std::optional<SpectrumDocument> transmittance;  ///< of a thin leaf; with reflectance only; absent: opaque
  std::vector<SpectrumDocument> further_curves;   ///< of the same quantity; with them a texture, which picks
  std::optional<TextureDocument> texture;
  std::optional<ReliefDocument> relief;
  std::shared_ptr<const OpacityDocument> opacity;  ///< null: it has no holes
  std::optional<TemperatureDocument> temperature;  ///< absent here and on the object: 0 K, emits nothing
  std::shared_ptr<const ThermalDocument> thermal;  ///< what its temperature would follow from; null: not told
  ScatteringDocument scattering;
  std::optional<bool> emitter;  ///< light is sought from it; absent: where it is twice as bright as the scene
  SourcePosition position;
};

class PrimitiveSettings;

/// A shape that a few measures tell: a sphere, a box.
struct PrimitiveShape {
  std::string model;                                  ///< its key
  std::shared_ptr<const PrimitiveSettings> settings;  ///< of one of primitive_models(); never null once read
};
struct MeshShape {
  DocumentFile file;    ///< its extension names the format, see read_mesh
  double unit_m = 1.0;  ///< metres per unit of the file
  /// File axes (x, y, z) become scene axes (x, -z, y); absent: as the format says.
  std::optional<bool> y_is_up;
};
/// All objects of a city model, each placed on its own.
struct CityShape {
  DocumentFile file;               ///< CityJSON
  std::string lod;                 ///< level of detail; empty: the finest of each object
  std::vector<std::string> types;  ///< of the objects to place; empty: all
};
/// One copy of a prototype.
struct InstanceShape {
  DocumentName of;
};
/// Many copies of a prototype: one of the three lists.
struct InstancesShape {
  DocumentName of;
  std::vector<math::Point3> at_m;      ///< where each copy's own origin goes
  std::optional<DocumentFile> csv;     ///< a text list, see read_instance_csv
  std::optional<DocumentFile> binary;  ///< a binary list, see InstanceFile
};

/// How many things grow where, from a raster.
struct DensityMap {
  RasterDocument raster;
  int band = 1;                    ///< from 1
  double density_of_one_m2 = 1.0;  ///< what the number 1 of the raster means
};
/// Copies of prototypes at random.
struct RandomPlacement {
  struct Weighted {
    DocumentName prototype;
    double weight = 1.0;
  };
  std::vector<Weighted> of;                     ///< one or more; weights above zero
  std::variant<double, DensityMap> density_m2;  ///< copies per square metre
  SourcePosition density_position;
  double minimum_distance_m = 0.0;          ///< of copies from each other, on the map
  std::array<double, 2> low_m{}, high_m{};  ///< corners of the area, x and y
  std::optional<DocumentName> on;           ///< objects of the scene by name; absent: at `height_m`
  double height_m = 0.0;
  std::array<double, 2> scale{1.0, 1.0};  ///< from, to
  bool turn = true;                       ///< about the vertical
  std::uint64_t seed = 0;
};

using ShapeDocument = std::variant<PrimitiveShape, MeshShape, CityShape, TerrainShape, InstanceShape,
                                   InstancesShape, RandomPlacement>;

/// Scene from object: first scale, then rotate (right-handed about `axis`), then translate.
struct TransformDocument {
  math::Vec3 translate_m;
  math::Vec3 rotation_axis{0.0, 0.0, 1.0};  ///< any length above zero
  double rotation_rad = 0.0;
  math::Vec3 scale{1.0, 1.0, 1.0};  ///< each above zero
};

struct ObjectDocument {
  std::string name;  ///< may be empty
  ShapeDocument shape;
  std::optional<MaterialBinding> material;  ///< always there except on instances, whose prototype has its own
  std::optional<TemperatureDocument> temperature;  ///< instead of the material's
  TransformDocument transform;
  std::optional<bool> pilot_ray;  ///< sent at it where it is smaller than a pixel; absent: by its shape
  std::shared_ptr<const PresenceDocument> present;  ///< null: always; never of what a prototype consists of
  std::shared_ptr<const struct PlatformDocument> motion;  ///< of what carries it; null: it stands still
  SourcePosition position;
  SourcePosition shape_position;
};

struct PrototypeDocument {
  std::string name;
  std::vector<ObjectDocument> objects;  ///< about its own origin; copies of others, never of it
  SourcePosition position;
};

/// The scene repeats without end in x and y.
struct PeriodicDocument {
  double width_m = 0.0, height_m = 0.0;             ///< of the cell, towards +x and +y
  std::optional<std::array<double, 2>> low_left_m;  ///< of the cell; absent: it is centred on the origin
  SourcePosition position;
};

struct SceneDocument {
  OriginDocument origin;
  std::optional<PeriodicDocument> periodic;
  std::vector<MaterialDocument> materials;    ///< in the document's order; names are unique
  std::vector<PrototypeDocument> prototypes;  ///< likewise
  std::vector<ObjectDocument> objects;
  SourcePosition position;
};

}  // namespace ifov::io
