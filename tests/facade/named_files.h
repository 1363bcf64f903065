#pragma once

#include <map>
#include <string>
#include <vector>

namespace facade_test {

/// Parts of a small document, as text.
struct Parts {
  std::string material = R"("reflectance": 0.3, "temperature": "20 degC")";
  std::string more_materials = "";
  std::string object = R"({"plane": {"height": "-9 m"}, "material": "m"})";
  std::string sun = R"({"point": {"zenith": "40 deg", "azimuth": "120 deg"}})";
  std::string sky = R"("sky": {"none": {}})";
  std::string channel = R"({"name": "c", "gaussian": {"center": "0.55 um", "fwhm": "20 nm"}})";
  std::string thermal = R"({"name": "T", "top_hat": {"from": "0.6 um", "to": "0.62 um"}})";
  /// None, where it is empty.
  std::string camera = R"({"orthographic": {"gsd": "2 m", "pixels": [4, 4]}})";
  std::string sensor = "", scene = "", more = "";
};

/// A document that names files, whose names begin with FILE, and these files by the rest of their names.
struct Named {
  std::string section, key;  ///< where the reference of documents tells of it
  Parts parts;
  std::map<std::string, std::string> files;

  std::string document(const std::string& in_place_of_FILE) const;
};

/// Each key of documents that names a file.
std::vector<Named> all_named();
const Named& named(const std::vector<Named>& all, const std::string& section);

/// `text` with `by` in place of every `what`.
std::string replaced_all(std::string text, const std::string& what, const std::string& by);

}  // namespace facade_test
