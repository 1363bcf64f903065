#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ifov/document.h"
#include "ifov/outcome.h"
#include "ifov/simulation.h"

namespace ifov {

/// How one document is rendered at several times.
struct SeriesOptions {
  LoadOptions load = {};  ///< of each time; without ranks
  RenderOptions render =
      {};               ///< likewise; `folder` is that of all times. Without share, keep, refine and ranks
  bool strict = false;  ///< render no time whose loading warns
};

struct SeriesOutcome {
  struct Time {
    std::string time;              ///< "2025-06-20T06:15Z"
    std::filesystem::path folder;  ///< of its products
    bool was_there = false;        ///< made by an earlier start: `outcome` tells the verdict alone
    Outcome outcome;
  };
  Verdict verdict = Verdict::done;  ///< the gravest of all times
  std::filesystem::path folder;
  std::vector<Time> times;            ///< in order, those that are made
  std::size_t times_left = 0;         ///< the deadline came first
  std::vector<Product> products;      ///< of the series: animation, temperatures of materials, crossovers
  Progress totals;                    ///< of this start
  std::vector<std::string> warnings;  ///< of loading, each once

  int exit_code() const { return static_cast<int>(verdict); }
};

/// Renders a document at several times, each into a folder of its own below that of the series: the scene is read and built once,
/// and each time's products are those of the document with that "time", byte for byte or, where times are rendered along the same
/// paths (docs/guide/temperatures.md), within the intervals of both. `times`: the first, a step and how many, by ISO 8601: "2025-06-20T00:00Z/PT15M/96". A series that is stopped goes on with
/// RunStart::resume. Errors as of Simulation, with the time that they are about.
IFOV_API SeriesOutcome render_series(const Document& document, const std::string& times,
                                     const SeriesOptions& options = {});

/// What the folder of a series holds, as its record (NAME_series.json) tells it.
struct SeriesInfo {
  struct Time {
    std::string time;              ///< "2025-06-20T06:15Z"
    std::filesystem::path folder;  ///< of its run
    std::filesystem::path record;  ///< of that run; empty: it is not made
  };
  std::filesystem::path folder;
  std::string version, document, name;
  std::vector<Time> times;         ///< in order
  bool complete = false;           ///< all are made, and the products of the series
  std::vector<std::string> files;  ///< these, by name
};

/// Nothing where the folder holds no series. SystemError where its record cannot be read, or makes no sense.
IFOV_API std::optional<SeriesInfo> series_info(const std::filesystem::path& folder);

}  // namespace ifov
