#include "core/printable.h"

#include <cstdint>

#include "core/format.h"

namespace ifov {
namespace {

constexpr std::size_t kMessage_bytes = 8192;

/// A character at the beginning of a text; no bytes where it is not UTF-8 (RFC 3629).
struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7FU >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) {
    if ((byte(k) & 0xC0U) != 0x80U) return {};
    code = code << 6U | (byte(k) & 0x3FU);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < kLeast[bytes] || code > 0x10FFFF || surrogate ? Character{} : Character{code, bytes};
}

bool is_control(std::uint32_t code) {
  return (code < 0x20 && code != '\n' && code != '\t') || (code >= 0x7F && code < 0xA0);
}

/// Directions of writing, separators of lines and marks that do not show (Unicode, Bidi_Control and others).
bool misleads(std::uint32_t code) {
  return code == 0x061C || (code >= 0x200B && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2060 && code <= 0x2069) || code == 0xFEFF || (code >= 0xE0000 && code <= 0xE007F);
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::string shown;
  while (!text.empty()) {
    const Character character = first_character(text);
    if (shown.size() >= most) return shown + "…";
    if (character.bytes == 0)
      shown += format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    else if (is_control(character.code))
      shown += format("\\x{:02x}", character.code);
    else if (misleads(character.code))
      shown += format("\\u{:04x}", character.code);
    else
      shown += text.substr(0, character.bytes);
    text.remove_prefix(character.bytes == 0 ? 1 : character.bytes);
  }
  return shown;
}

std::string printable(std::string_view text) { return printable(text, std::string::npos); }

std::string printable_message(std::string_view text) { return printable(text, kMessage_bytes); }

}  // namespace ifov
