#include "io/city/city_model.h"

#include <algorithm>

#include "core/format.h"

namespace ifov::io {

const std::string* city_slot(const CityObject& object, std::string_view slot,
                             const std::vector<std::string>& names) {
  const auto given = [&](const std::string& name) -> const std::string* {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? nullptr : &*found;
  };
  const bool by_attribute = std::any_of(
      names.begin(), names.end(), [](const std::string& n) { return n.find('[') != std::string::npos; });
  if (by_attribute) {
    for (const bool with_slot : {true, false})
      for (const auto& [key, value] : object.attributes) {
        const std::string rule = format("{}[{}={}]", object.type, key, value);
        if (const std::string* name = given(with_slot ? format("{}/{}", rule, slot) : rule)) return name;
      }
  }
  for (const std::string& name :
       {format("{}/{}", object.type, slot), std::string(slot), object.type, std::string("other")})
    if (const std::string* found = given(name)) return found;
  return nullptr;
}

}  // namespace ifov::io
