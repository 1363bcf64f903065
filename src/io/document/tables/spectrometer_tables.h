#pragma once

#include "io/document/schema/schema_type.h"

namespace ifov::io {

struct KeystoneDocument;
struct MosaicDocument;
struct SmileDocument;

SchemaType<SmileDocument> smile_type(bool of_sensor);  ///< else of a channel
SchemaType<KeystoneDocument> keystone_type(bool of_sensor);
SchemaType<MosaicDocument> mosaic_type();

}  // namespace ifov::io
