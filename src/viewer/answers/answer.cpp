#include "viewer/answers/answer.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/names.h"
#include "io/json/json_writer.h"

namespace ifov::viewer {

static_assert(std::endian::native == std::endian::little);

const std::string& Query::value(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) throw Refused(400, format("the request does not say '{}'", name));
  return found->second;
}

int Query::integer(const std::string& name, int low, int high) const {
  const std::string& text = value(name);
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < low || number > high)
    throw Refused(400, format("'{}' is '{}'; expected a whole number from {} to {}", name, text.substr(0, 40),
                              low, high));
  return number;
}

int Query::integer(const std::string& name, int low, int high, int otherwise) const {
  return has(name) ? integer(name, low, high) : otherwise;
}

double Query::number(const std::string& name, double low, double high) const {
  const std::string& text = value(name);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number) || number < low ||
      number > high)
    throw Refused(400, format("'{}' is '{}'; expected a number from {:g} to {:g}", name, text.substr(0, 40),
                              low, high));
  return number;
}

std::string Query::text(const std::string& name, std::size_t most) const {
  const std::string& text = value(name);
  if (text.size() > most)
    throw Refused(400, format("'{}' has {} bytes; expected {} at most", name, text.size(), most));
  return text;
}

std::string Query::choice(const std::string& name, std::span<const std::string_view> choices) const {
  const std::string& text = value(name);
  if (std::find(choices.begin(), choices.end(), text) == choices.end())
    throw Refused(400, format("'{}' is '{}'; expected {}", name, text.substr(0, 40),
                              list_names(std::vector<std::string>(choices.begin(), choices.end()), "or")));
  return text;
}

std::string why_refused(const std::string& why) { return "{\"error\":" + io::json_string(why) + "}"; }

std::size_t thinned_place(std::size_t k, std::size_t step, std::size_t count) {
  return std::min(k * step + (step - 1) / 2, count - 1);
}

Answer numbers(std::span<const float> values, std::string about) {
  return {"application/octet-stream",
          std::string(reinterpret_cast<const char*>(values.data()), values.size_bytes()), std::move(about)};
}

}  // namespace ifov::viewer
