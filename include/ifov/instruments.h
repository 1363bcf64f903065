#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ifov/api.h"
#include "ifov/outcome.h"
#include "ifov/simulation.h"

namespace ifov {

/// Names of the instruments of a document that has several ("instruments") and of which `set` chooses none
/// ("instrument=NAME"); else none. Errors as of Document::read.
IFOV_API std::vector<std::string> instruments_of(const std::filesystem::path& file,
                                                 const std::vector<std::string>& set = {});

/// How the instruments of a document are rendered.
struct InstrumentsOptions {
  LoadOptions load = {};      ///< of each; without ranks
  RenderOptions render = {};  ///< likewise; products are in a folder of each instrument's name below `folder`
  bool strict = false;        ///< render none whose loading warns
};

struct InstrumentsOutcome {
  struct One {
    std::string name;
    Outcome outcome;
  };
  Verdict verdict = Verdict::done;  ///< the gravest of all
  std::vector<One> instruments;     ///< in the document's order, those that are made
  std::size_t left = 0;             ///< the deadline came first

  int exit_code() const { return static_cast<int>(verdict); }
};

/// Renders all instruments of a document, one after the other, of one scene that is read and built once where nothing in it moves. The products
/// of each are those of the document with that "instrument" alone, byte for byte. Errors as of Simulation, with the instrument that they are
/// about; InputError where the document has none to choose among.
IFOV_API InstrumentsOutcome render_instruments(const std::filesystem::path& file,
                                               const std::vector<std::string>& set = {},
                                               const InstrumentsOptions& options = {});

}  // namespace ifov
