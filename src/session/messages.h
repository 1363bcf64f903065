#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/run_control.h"
#include "io/product_parts/image_error.h"
#include "sampling/reason_words.h"

namespace ifov::io {
struct RunPlan;
}  // namespace ifov::io

namespace ifov::session {

struct Parts;

/// What was loaded, a few lines for people.
std::string describe(const Parts& parts);

/// "sensor: 400 x 300 pixels, 3 channels in 4 spectral nodes"
std::string sensor_statement(const Parts& parts);

/// What was asked for, what was reached, and where it was not and why; `reasons` counts the pixels that are done and not
/// converged, `why_gaps` says why pixels are not done, where some are not; `errors` of the image, where it is judged as a whole or
/// audited.
std::string accuracy_statement(const io::RunPlan& plan, const Progress& totals,
                               const sampling::ReasonCounts& reasons, const std::string& why_gaps,
                               const std::vector<io::ImageError>& errors = {});

/// Floors and assumptions that enter the result.
std::vector<std::string> notes(const Parts& parts);

}  // namespace ifov::session
