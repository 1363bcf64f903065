#pragma once

#include "io/document/map_document.h"
#include "io/document/schema/schema_type.h"

namespace ifov::io {

struct OpacityDocument;
struct ParameterMap;

/// The tables of keys of what lies on surfaces.
SchemaType<TemperatureMap> temperature_map_type();
/// Of a parameter that is a number, an angle or a length.
enum class ParameterKind { number, angle, length };
SchemaType<ParameterMap> parameter_map_type(ParameterKind kind);
SchemaType<TextureDocument> texture_type();
SchemaType<ReliefDocument> relief_type();
SchemaType<OpacityDocument> opacity_type();
SchemaType<MaterialBinding> binding_type();
SchemaType<TerrainShape> terrain_type();

}  // namespace ifov::io
