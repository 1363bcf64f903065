#pragma once

#include <cstdint>
#include <map>
#include <memory>

namespace ifov::thermal {
class SurfaceClasses;
}

namespace ifov::session {

/// What solved temperatures are looked up in, by the number of the material.
using SolvedClasses = std::map<std::uint32_t, std::shared_ptr<const thermal::SurfaceClasses>>;

}  // namespace ifov::session
