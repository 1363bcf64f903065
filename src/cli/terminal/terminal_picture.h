#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace ifov::cli {

enum class TerminalColours { none, of_256, of_24_bit };

/// What standard output shows, by TERM and COLORTERM; none where it is not a terminal.
TerminalColours terminal_colours();

/// A picture as text of at most `columns` columns: each character is an upper half block, two pixels one above the other.
/// `pixels`: 0xRRGGBB, rows from the top.
std::string terminal_picture(int width, int height, std::span<const std::uint32_t> pixels, int columns,
                             TerminalColours colours);

}  // namespace ifov::cli
