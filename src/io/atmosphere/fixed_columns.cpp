#include "io/atmosphere/fixed_columns.h"

#include <algorithm>

#include "core/error.h"
#include "io/atmosphere/spectral_table.h"

namespace ifov::io {
namespace {

std::size_t distance(std::size_t a, std::size_t b) { return a > b ? a - b : b - a; }

/// Pieces of a word that holds several touching numbers.
std::vector<Field> pieces_of(const Field& word, const std::vector<std::size_t>& ends) {
  if (fortran_number(word.text)) return {word};
  const std::size_t first = static_cast<std::size_t>(word.column - 1), last = first + word.text.size();
  std::vector<Field> pieces;
  std::size_t at = first;
  for (const std::size_t end : ends)
    if (end > at && end < last) {
      pieces.push_back({word.text.substr(at - first, end - at), static_cast<int>(at) + 1});
      at = end;
    }
  pieces.push_back({word.text.substr(at - first), static_cast<int>(at) + 1});
  return pieces;
}

}  // namespace

std::vector<Field> cells_under(const TextFile& file, int line, const std::vector<std::size_t>& ends,
                               std::size_t slack) {
  std::vector<Field> cells(ends.size());
  for (const Field& word : split(file.line(line), ' '))
    for (const Field& piece : pieces_of(word, ends)) {
      const std::size_t end = static_cast<std::size_t>(piece.column - 1) + piece.text.size();
      const auto nearest = std::min_element(ends.begin(), ends.end(), [&](std::size_t a, std::size_t b) {
        return distance(a, end) < distance(b, end);
      });
      if (nearest == ends.end() || distance(*nearest, end) > slack) {
        if (!ends.empty() && end > ends.back()) continue;
        file.fail(line, piece.column, format("found '{}', which stands under no heading", piece.text));
      }
      Field& cell = cells[static_cast<std::size_t>(nearest - ends.begin())];
      if (!cell.text.empty())
        file.fail(
            line, piece.column,
            format("found '{}' and '{}' under one heading; expected one number", cell.text, piece.text));
      cell = piece;
    }
  return cells;
}

}  // namespace ifov::io
