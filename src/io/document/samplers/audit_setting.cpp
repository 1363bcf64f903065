#include "io/document/samplers/audit_setting.h"

#include "core/format.h"
#include "io/document/schema/record.h"
#include "sampling/image/audited_sampler.h"

namespace ifov::io {

SchemaType<int> audit_type() { return integer(20, 100000); }

std::unique_ptr<sampling::PixelSampler> audited(std::unique_ptr<sampling::PixelSampler> sampler,
                                                std::optional<int> pixels) {
  if (!pixels) return sampler;
  return std::make_unique<sampling::AuditedSampler>(std::move(sampler), *pixels);
}

std::string audit_words(std::optional<int> pixels) {
  return pixels ? format(", {} pixels audited", *pixels) : std::string();
}

}  // namespace ifov::io
