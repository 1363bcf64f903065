#pragma once

namespace ifov::io {

struct Document;

/// Tells the camera which platform of the document carries it (CameraSettings::carried_by). Throws located InputErrors where either is missing.
void mount_camera(Document& document);

}  // namespace ifov::io
