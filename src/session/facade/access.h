#pragma once

#include <memory>
#include <utility>

#include "ifov/assets.h"
#include "ifov/document.h"

namespace ifov::io {
class Assets;
struct AtmosphereReport;
struct BrdfReport;
struct TemperatureReport;
}  // namespace ifov::io
namespace ifov::session {
class Coordinator;
}

namespace ifov {

class AtmosphereReport;
class BrdfReport;
class Ranks;
class TemperatureReport;

/// What public classes keep, for the functions of the facade alone. Each `Inside` is defined where its class is, that of a
/// document in document_inside.h.
struct FacadeAccess {
  static const Document::Inside& inside(const Document& document) { return *document.inside_; }
  static Document document(Document::Inside inside);
  static const io::Assets& inside(const Assets& assets);
  /// Of the rank that leads; null on the others, and for null.
  static session::Coordinator* coordinator(const Ranks* ranks);
  static void set(AtmosphereReport& report, io::AtmosphereReport inside);
  static void set(BrdfReport& report, io::BrdfReport inside);
  static void set(TemperatureReport& report, io::TemperatureReport inside);
};

}  // namespace ifov
