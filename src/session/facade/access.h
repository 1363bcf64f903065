#pragma once

#include <memory>
#include <optional>

#include "core/call_scope.h"
#include "ifov/assets.h"
#include "ifov/atmosphere.h"
#include "ifov/brdf.h"
#include "ifov/document.h"
#include "ifov/runs.h"
#include "io/atmosphere_report/atmosphere_report.h"
#include "io/brdf_report/brdf_report.h"
#include "io/document/document.h"
#include "io/files/inputs.h"
#include "session/runs/coordinator.h"

namespace ifov {

struct Document::Inside {
  io::Document document;
  std::shared_ptr<const io::Inputs> inputs;  ///< of all that is read for it; never null
};

struct Assets::Inside {
  io::Assets assets;
};

struct AtmosphereReport::Inside {
  io::AtmosphereReport report;
};

struct BrdfReport::Inside {
  io::BrdfReport report;
};

struct Ranks::Inside {
  std::unique_ptr<cluster::Communicator> communicator;
  std::optional<session::Coordinator> coordinator;  ///< of the rank that leads
};

/// What public classes keep, for the functions of the facade alone.
struct FacadeAccess {
  static const Document::Inside& inside(const Document& document) { return *document.inside_; }
  static Document document(Document::Inside inside) {
    return Document(std::make_shared<const Document::Inside>(std::move(inside)));
  }
  static const io::Assets& inside(const Assets& assets) { return assets.inside_->assets; }
  static session::Coordinator* coordinator(const Ranks* ranks) {
    return ranks != nullptr && ranks->inside_->coordinator ? &*ranks->inside_->coordinator : nullptr;
  }
  static void set(AtmosphereReport& report, io::AtmosphereReport inside) {
    report.inside_ = std::make_shared<const AtmosphereReport::Inside>(std::move(inside));
  }
  static void set(BrdfReport& report, io::BrdfReport inside) {
    report.inside_ = std::make_shared<const BrdfReport::Inside>(std::move(inside));
  }
};

}  // namespace ifov
