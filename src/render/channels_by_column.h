#pragma once

namespace ifov::sampling {
struct TileResult;
}
namespace ifov::sensor {
class ColumnResponses;
}

namespace ifov::render {

/// Makes the channels of a tile of the responses that paths carried: each pixel's by the weights of its column. Errors are added as if
/// they were all one, times the weights without their signs, and half-widths grow by what the sums leave out.
void make_channels(const sensor::ColumnResponses& responses, sampling::TileResult& tile);

}  // namespace ifov::render
