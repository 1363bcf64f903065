#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geodesy/utc_time.h"
#include "io/document/atmosphere_document.h"
#include "io/document/document_error.h"
#include "io/document/light_document.h"
#include "io/document/output_document.h"
#include "io/document/sampling_document.h"
#include "io/document/scene_document.h"
#include "io/document/sensor_document.h"
#include "io/document/weather_document.h"
#include "io/json/document_override.h"

namespace ifov::io {
struct PlatformDocument;
struct TemperaturesDocument;

/// Version of the document format that this program reads and writes.
inline constexpr int kDocumentVersion = 1;

/// A key that the user wrote under a name that it had in an earlier version.
struct FormerKey {
  SourcePosition position;
  std::string former, name;
};

/// What the user wrote, checked and in SI units (wavelength in micrometres). Files it names have not been opened.
struct Document {
  int version = kDocumentVersion;
  std::uint64_t seed = 1;
  std::optional<geodesy::UtcTime> time;
  SceneDocument scene;
  LightDocument light;
  AtmosphereDocument atmosphere;
  std::optional<WeatherDocument> weather;
  std::shared_ptr<const TemperaturesDocument> temperatures;  ///< null: as by default
  std::shared_ptr<const PlatformDocument> platform;          ///< null: none; the camera has been told of it
  SensorDocument sensor;
  SamplingDocument sampling;
  OutputDocument output;
  std::vector<std::string> left_out;  ///< of a preview: what of the sensor it does without
  DocumentSources sources;
  /// As read; with all that it includes and that the command line replaced where there is such. Never null.
  std::shared_ptr<const std::string> text;
  std::vector<FormerKey> former_keys;  ///< in the document's order
  std::vector<std::string> files;      ///< that it names or includes, as far as they are there
};

/// Reads a document and what it includes, with values in place of its own (put_together). Throws InputError (located,
/// with an excerpt), SystemError where the file cannot be read.
Document read_document(const std::string& path, std::span<const DocumentOverride> overrides = {});

/// The same from text; `file_name` is used in messages and its folder for relative paths.
Document parse_document(std::string text, const std::string& file_name,
                        std::span<const DocumentOverride> overrides = {});

/// How a document is written.
struct DocumentText {
  std::string comment = {};                ///< above it; its lines without "//"
  std::vector<std::string> include = {};   ///< documents whose values count where this one has none
  std::vector<std::string> sections = {};  ///< what is written: "scene", "light", "seed", ...; empty: all
  bool all_keys = false;                   ///< those with their defaults too
};

/// The document as JSON: parse_document reads the same from it, in the folder of `file_name`, from which files are named.
/// Numbers keep their value exactly and take the unit that makes them short. What several documents made together is one
/// document. InputError, with the path of keys, for a value that no document gives.
std::string document_text(const Document& document, const std::string& file_name,
                          const DocumentText& how = {});

/// The JSON Schema (draft 7) of a document, pretty-printed.
std::string schema_json();

/// The reference of all keys, Markdown.
std::string schema_markdown();

}  // namespace ifov::io
