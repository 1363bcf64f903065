#include "cli/terminal/terminal_picture.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "core/format.h"

namespace ifov::cli {
namespace {

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

std::uint32_t part(std::uint32_t pixel, int shift) { return (pixel >> shift) & 0xFFU; }

/// The nearest colour of the cube of 6 x 6 x 6 that terminals of 256 colours have from number 16 on.
std::uint32_t of_cube(std::uint32_t pixel) {
  const auto level = [&](int shift) { return (part(pixel, shift) * 5U + 127U) / 255U; };
  return 16U + 36U * level(16) + 6U * level(8) + level(0);
}

std::string colour(std::uint32_t pixel, int plane, TerminalColours colours) {
  if (colours == TerminalColours::of_256) return format("\x1b[{};5;{}m", plane, of_cube(pixel));
  return format("\x1b[{};2;{};{};{}m", plane, part(pixel, 16), part(pixel, 8), part(pixel, 0));
}

}  // namespace

TerminalColours terminal_colours() {
  if (isatty(STDOUT_FILENO) != 1 || variable("TERM").empty() || variable("TERM") == "dumb" ||
      !variable("NO_COLOR").empty())
    return TerminalColours::none;
  const std::string_view depth = variable("COLORTERM");
  return depth == "truecolor" || depth == "24bit" ? TerminalColours::of_24_bit : TerminalColours::of_256;
}

std::string terminal_picture(int width, int height, std::span<const std::uint32_t> pixels, int columns,
                             TerminalColours colours) {
  constexpr int kFront = 38, kBack = 48;
  const int shown = std::min(width, columns);
  const int rows =
      std::max(1, static_cast<int>(static_cast<std::int64_t>(height) * shown / std::max(width, 1)));
  const auto at = [&](int x, int y) {
    const std::int64_t from_x = (2LL * x + 1) * width / (2LL * shown),
                       from_y = (2LL * y + 1) * height / (2LL * rows);
    return pixels[static_cast<std::size_t>(std::min<std::int64_t>(from_y, height - 1) * width + from_x)];
  };
  std::string text;
  for (int y = 0; y < rows; y += 2) {
    for (int x = 0; x < shown; ++x) {
      text += colour(at(x, y), kFront, colours);
      if (y + 1 < rows) text += colour(at(x, y + 1), kBack, colours);
      text += "\u2580";
    }
    text += "\x1b[0m\n";
  }
  return text;
}

}  // namespace ifov::cli
