#include "core/format.h"
#include "geodesy/utc_time.h"
#include "io/document/document.h"
#include "io/document/platform_document.h"
#include "io/document/schema/record.h"
#include "io/document/schema/shared_target.h"
#include "io/document/tables/tables.h"
#include "io/document/thermal_document.h"

namespace ifov::io {
namespace {

constexpr std::int64_t kLargestSeed = 9007199254740991;  // what every JSON reader keeps exactly

SchemaType<int> version_type() {
  const SchemaType<int> plain = integer(kDocumentVersion, kDocumentVersion);
  ValueDescription d = *plain.description;
  d.expected = format("{}, the version of the format that this program reads", kDocumentVersion);
  d.short_name = format("{}", kDocumentVersion);
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  return {description,
          [description](const DocumentNode& node) {
            const bool right = node.type() == DocumentNode::Type::number && node.is_integer() &&
                               node.integer() == kDocumentVersion;
            if (!right) node.fail_expected(description->expected);
            return kDocumentVersion;
          },
          plain.write};
}

/// Documents are put together before this table is read (put_together).
SchemaType<std::vector<DocumentFile>> included_type() {
  const SchemaType<DocumentFile> one = file();
  return either(converted<std::vector<DocumentFile>>(
                    one, [](DocumentFile f) { return std::vector{std::move(f)}; },
                    [](const std::vector<DocumentFile>& files) { return files.front(); }),
                list(one, 1, 256));
}

}  // namespace

SchemaType<geodesy::UtcTime> time_type() {
  const auto text = text_like(
      "^[0-9]{4}-[0-9]{2}-[0-9]{2}(T[0-9]{2}:[0-9]{2}(:[0-9]{2}(\\.[0-9]+)?)?(Z|[+-][0-9]{2}:[0-9]{2}))?$",
      "a time such as \"2026-06-21T17:00:00Z\"", "time, ISO 8601");
  return {text.description,
          [read = text.read](const DocumentNode& node) {
            const std::string& written = read(node);
            try {
              return geodesy::parse_utc(written);
            } catch (const InputError& error) {
              node.fail(format("{}: {}", node.title(), error.what()));
            }
          },
          [](const geodesy::UtcTime& time, Writing&) { return JsonValue(geodesy::format_utc(time)); }};
}

SchemaType<Document> document_type() {
  Record<Document> record("document", "A scene, its light, the sensor that looks at it and how accurately.");
  record.required("ifov", &Document::version, version_type(), "version of this format")
      .optional("$schema", only_read([](Document&, const std::string&) {}), label(),
                "for editors: where the schema is")
      .optional(
          "include", only_read([](Document&, const std::vector<DocumentFile>&) {}), included_type(),
          "documents whose values count where this one has none: objects are put together key by key, and a null takes a "
          "key away; of several the last counts most")
      .with_default("seed",
                    via([](Document& d, std::int64_t seed) { d.seed = static_cast<std::uint64_t>(seed); },
                        [](const Document& d) { return static_cast<std::int64_t>(d.seed); }),
                    long_integer(0, kLargestSeed), "1",
                    "of all random numbers: the same seed gives the same result")
      .optional("time", &Document::time, time_type(), "when the image is taken")
      .required("scene", &Document::scene, scene_type(), "geometry and materials")
      .with_default("light", &Document::light, light_type(), "{}", "Sun and sky")
      .with_default("atmosphere", &Document::atmosphere, atmosphere_type(), "{}", "air")
      .optional("weather", &Document::weather, weather_type(), "air at the ground over time")
      .with_default("temperatures",
                    via(
                        [](Document& d, TemperaturesDocument how) {
                          d.temperatures = std::make_shared<const TemperaturesDocument>(std::move(how));
                        },
                        [](const Document& d) { return d.temperatures.get(); }),
                    temperatures_type(), "{}", "how `ifov temperature` solves for those of surfaces")
      .optional("platform", shared(&Document::platform), platform_type(), "what carries a camera that scans")
      .required("sensor", &Document::sensor, sensor_type(), "camera and channels")
      .optional(
          "instruments",
          only_read([](Document&, const std::vector<std::pair<std::string, SensorDocument>>&) {}),
          map_of(sensor_type(), "instruments", 100),
          "in place of `sensor` several of them on one platform, by name: each has its products in a folder of its name")
      .optional(
          "instrument", only_read([](Document&, const std::string&) {}), label(),
          "which of the `instruments` this document is of; without it `ifov render`, `check` and `sensor` take all of them")
      .with_default("sampling", &Document::sampling, sampling_type(), "{}", "rays")
      .with_default("output", &Document::output, output_type(), "{}", "products");
  const SchemaType<Document> type = record.type();
  return {type.description, type.read, [record](const Document& document, Writing& writing) {
            return record.written(document, writing, writing.sections);
          }};
}

}  // namespace ifov::io
