#pragma once

#include <gtest/gtest.h>

#include <string>

#include "io/document/document.h"

namespace ifov::test {

/// A document that uses most kinds of keys, one value a line, so that messages about it stay short.
inline const std::string kDocument = R"({
  // A comment, to begin with.
  "ifov": 1,
  "seed": 7,
  "time": "2026-06-21T17:00:00Z",
  "scene": {
    "origin": {"latitude": "43 deg", "longitude": "-77 deg"},
    "materials": {
      "soil": {"reflectance": 0.25, "temperature": "20 degC"},
      "leaf": {"emissivity": {"csv": "leaf.csv", "wavelength_unit": "nm", "scale": 0.01}}
    },
    "prototypes": {
      "tree": [{"sphere": {"center": ["0 m", "0 m", "2 m"], "radius": "1 m"}, "material": "leaf"}]
    },
    "objects": [
      {"plane": {}, "material": "soil"},
      {
        "name": "ball",
        "sphere": {
          "center": ["1 m", "2 m", "300 cm"],
          "radius": "50 cm"
        },
        "material": "leaf"
      },
      {"instances": {"of": "tree", "at": [["1 m", "1 m", "0 m"]]}}
    ]
  },
  "light": {
    "sun": {"disc": {"zenith": "30 deg", "azimuth": "180 deg"}},
    "sky": {"temperature": "-10 degC"}
  },
  "sensor": {
    "camera": {"orthographic": {"gsd": "1 m", "pixels": [30, 20]}},
    "channels": [
      {"name": "red", "gaussian": {"center": "650 nm", "fwhm": "0.02 um"}},
      {"series": {"gaussian": {"from": "400 nm", "to": "500 nm", "count": 3, "fwhm": "10 nm"}}},
      {"monochromatic": {"at": "8.5 um"}}
    ],
    "psf": {"gaussian": {"sigma": "0.6 px"}}
  },
  "sampling": {"accuracy": {"error": "0.1 K", "channel": "8.5 um"}},
  "output": {"folder": "products", "quicklook": {"channels": ["red"]}}
}
)";

/// The document with its first `from` replaced by `to`.
inline std::string document_with(const std::string& from, const std::string& to) {
  std::string text = kDocument;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "the document has no " << from;
    return text;
  }
  return text.replace(at, from.size(), to);
}

inline io::Document parsed_with(const std::string& from, const std::string& to) {
  return io::parse_document(document_with(from, to), "folder/a.json");
}

/// The message about the document with `from` replaced by `to`.
inline std::string message_with(const std::string& from, const std::string& to) {
  try {
    parsed_with(from, to);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace ifov::test
