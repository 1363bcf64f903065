#pragma once

#include <memory>

#include "session/assembly/whole/sampling_assembly.h"

namespace ifov::io {
struct Document;
struct RunPlan;
}  // namespace ifov::io
namespace ifov::render {
class AccuracyTolerance;
struct RenderJob;
}  // namespace ifov::render

namespace ifov::session {

struct Parts;

/// What a document says of sampling, for the scene of another one.
class OtherSampling {
 public:
  /// Keeps a reference to the document. Errors: InputError where the scene was loaded for what knows less.
  OtherSampling(const Parts& parts, const io::Document& document);
  ~OtherSampling();
  void tell(io::RunPlan& plan) const;
  render::RenderJob job(const Parts& parts) const;

 private:
  const io::Document& document_;
  SamplingPlan plan_;
  std::unique_ptr<render::AccuracyTolerance> tolerance_;
};

}  // namespace ifov::session
