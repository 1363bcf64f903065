#pragma once

#include <memory>
#include <optional>
#include <string>

namespace ifov::sampling {
class PixelSampler;
}

namespace ifov::io {

template <class V>
struct SchemaType;

/// How many pixels are measured once more.
SchemaType<int> audit_type();
/// The sampler, audited where that is asked for.
std::unique_ptr<sampling::PixelSampler> audited(std::unique_ptr<sampling::PixelSampler> sampler,
                                                std::optional<int> pixels);
/// ", 200 pixels audited"; nothing without.
std::string audit_words(std::optional<int> pixels);

}  // namespace ifov::io
