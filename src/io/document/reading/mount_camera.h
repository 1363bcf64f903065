#pragma once

namespace ifov::io {

struct Document;

/// Tells the camera which platform of the document carries it, when and where. Throws located InputErrors where one of both is missing
/// (CameraSettings::carried_by).
void mount_camera(Document& document);

}  // namespace ifov::io
