#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "geometry/shapes.h"
#include "io/document/scene_document.h"
#include "math/transform.h"

namespace ifov::io {

template <class V>
struct SchemaType;

/// What a document says of a shape that a few measures tell, from no file.
class PrimitiveSettings {
 public:
  virtual ~PrimitiveSettings() = default;

  /// The shape in a frame where it is simple, and its way into that of the object.
  struct Built {
    geometry::Shape shape;
    math::Transform object_from_shape{};
  };
  virtual Built build() const = 0;
};

/// A kind of primitive, by its key in objects.
struct PrimitiveModel {
  std::string_view key;  ///< "sphere"
  /// The table of its keys, which says what it is.
  SchemaType<std::shared_ptr<const PrimitiveSettings>> (*type)() = nullptr;
};

/// Settings of any kind read as such.
template <class Settings, class Base = PrimitiveSettings>
SchemaType<std::shared_ptr<const Base>> primitive_type(const SchemaType<Settings>& type) {
  return converted<std::shared_ptr<const Base>>(
      type, [](Settings settings) { return std::make_shared<const Settings>(std::move(settings)); },
      [](const std::shared_ptr<const Base>& settings) {
        const auto* own = dynamic_cast<const Settings*>(settings.get());
        return own != nullptr ? std::optional(*own) : std::nullopt;
      });
}

/// All kinds, in the order of the reference page.
std::span<const PrimitiveModel* const> primitive_models();

/// Whether the shape is a primitive of this kind.
bool is_primitive(const ShapeDocument& shape, const PrimitiveModel& model);

/// The settings where the shape is a primitive and they are a T, else null.
template <class T>
const T* primitive_as(const ShapeDocument& shape) {
  const auto* primitive = std::get_if<PrimitiveShape>(&shape);
  return primitive != nullptr ? dynamic_cast<const T*>(primitive->settings.get()) : nullptr;
}

}  // namespace ifov::io
