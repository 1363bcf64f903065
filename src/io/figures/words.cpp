#include "io/figures/words.h"

#include <algorithm>

namespace ifov::io {

std::vector<std::string> wrapped(const Canvas& canvas, const std::string& words, double size, double width,
                                 bool bold) {
  std::vector<std::string> lines{""};
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    const std::string word = words.substr(at, end - at),
                      longer = lines.back().empty() ? word : lines.back() + ' ' + word;
    if (lines.back().empty() || canvas.text_width(longer, size, bold) <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
    at = end + 1;
  }
  return lines;
}

std::string fitted(const Canvas& canvas, std::string words, double size, double width) {
  if (canvas.text_width(words, size) <= width) return words;
  const auto is_within_letter = [&] { return (static_cast<unsigned char>(words.back()) & 0xC0u) == 0x80u; };
  do {
    while (words.size() > 1 && is_within_letter()) words.pop_back();
    words.pop_back();
  } while (!words.empty() && canvas.text_width(words + "...", size) > width);
  return words + "...";
}

}  // namespace ifov::io
