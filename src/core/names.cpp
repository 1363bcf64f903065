#include "core/names.h"

#include <algorithm>
#include <vector>

#include "core/format.h"

namespace ifov {
namespace {

constexpr std::size_t kLongestWord = 64;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size();
  std::vector<int> before(n + 1), last(n + 1), row(n + 1);
  for (std::size_t j = 0; j <= n; ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1])) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[n];
}

std::string nearest_name(std::string_view word, std::span<const std::string> choices) {
  if (word.size() > kLongestWord) return {};
  std::string nearest;
  int least = 0;
  for (const std::string& choice : choices) {
    if (choice.size() > kLongestWord) continue;
    const int distance = edit_distance(word, choice);
    const int allowed = std::max(1, static_cast<int>(std::min(word.size(), choice.size())) / 3);
    const bool resembles = distance <= allowed && distance < static_cast<int>(choice.size());
    if (resembles && (nearest.empty() || distance < least)) {
      nearest = choice;
      least = distance;
    }
  }
  return nearest;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> choices) {
  const std::string nearest = nearest_name(word, choices);
  return nearest.empty() ? std::string() : format("; did you mean '{}'?", nearest);
}

std::string list_names(std::span<const std::string> names, std::string_view last_word, std::size_t most) {
  std::string text;
  const std::size_t shown = names.size() > most ? most : names.size();
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += i + 1 == names.size() ? format(" {} ", last_word) : ", ";
    text += format("'{}'", names[i]);
  }
  if (shown < names.size()) text += format(" and {} more", names.size() - shown);
  return text;
}

}  // namespace ifov
