#pragma once

#include <span>
#include <string>

namespace ifov::io {
class EnviReader;
}
namespace ifov::render {
struct ChannelInfo;
}

namespace ifov::session {

/// InputError, with the cube's name, where its bands are not a document's channels: as many, in their order, centres within a tenth
/// of their widths; or where its values are in another unit than radiance. A cube that tells no unit is taken for radiance.
void require_channels(const io::EnviReader& cube, std::span<const render::ChannelInfo> channels,
                      const std::string& radiance_unit, const std::string& document);

}  // namespace ifov::session
