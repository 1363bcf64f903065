#pragma once

namespace ifov::io {

struct FramedPoint;
struct OriginDocument;

/// InputError where a place ("a point about the Earth") needs more of the scene's origin than there is.
void check_frame(const FramedPoint& point, const char* what, const OriginDocument& origin);

}  // namespace ifov::io
