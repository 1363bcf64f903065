#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "core/call_scope.h"
#include "ifov/assets.h"
#include "ifov/document.h"

namespace ifov::io {
class Assets;
struct AtmosphereReport;
struct BrdfReport;
struct Document;
struct TemperatureReport;
}  // namespace ifov::io
namespace ifov::session {
class Coordinator;
class SharedScene;
}  // namespace ifov::session

namespace ifov {

class AtmosphereReport;
class BrdfReport;
struct LoadOptions;
class Ranks;
class Simulation;
class TemperatureReport;

/// What public classes keep, for the functions of the facade alone. Each `Inside` is defined where its class is, that of a
/// document in document_inside.h.
struct FacadeAccess {
  static const Document::Inside& inside(const Document& document) { return *document.inside_; }
  static Document document(Document::Inside inside);
  /// What is read for a document, and how it is read anew with another time in place of its own.
  static std::shared_ptr<const Call::Data> inputs(const Document& document);
  static std::function<io::Document(const std::string& time)> at_times(const Document& document);
  /// As Simulation::load; null: the scene is its own.
  static Simulation load(const Document& document, const LoadOptions& options, session::SharedScene* shared);
  static const io::Assets& inside(const Assets& assets);
  /// Of the rank that leads; null on the others, and for null.
  static session::Coordinator* coordinator(const Ranks* ranks);
  static void set(AtmosphereReport& report, io::AtmosphereReport inside);
  static void set(BrdfReport& report, io::BrdfReport inside);
  static void set(TemperatureReport& report, io::TemperatureReport inside);
};

}  // namespace ifov
