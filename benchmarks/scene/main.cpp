// Whole scenes, timed. Each command prints one JSON object as its last line; benchmarks/drivers judge it.
//   bench_scene prepare FOLDER            writes the forest's files
//   bench_scene single FOLDER             single rays, direct Sun: 1 and 210 bands, 1 and 2 threads, and the
//   answer bench_scene converge FOLDER BANDS PIXELS SIDE_M ERROR REFERENCE_SAMPLES
//                                         full transport to an accuracy: time, and RMS error per band
//   bench_scene description FOLDER BANDS PIXELS SIDE_M    the same scene for other programs
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "scene/converge.h"
#include "scene/forest.h"
#include "scene/single_ray.h"

int main(int argc, char** argv) {
  using namespace ifov::benchmarks;
  const std::string command = argc > 2 ? argv[1] : "";
  const auto number = [&](int k) { return argc > k ? std::atof(argv[k]) : 0.0; };
  try {
    if (command == "prepare" && argc == 3) {
      write_forest(argv[2]);
    } else if (command == "single" && argc == 3) {
      std::puts(time_single_rays(argv[2]).c_str());
    } else if (command == "converge" && argc == 8) {
      std::puts(converge(argv[2], {static_cast<int>(number(3)), static_cast<int>(number(4)), number(5)},
                         argv[6], static_cast<int>(number(7)))
                    .c_str());
    } else if (command == "description" && argc == 6) {
      std::puts(describe({static_cast<int>(number(3)), static_cast<int>(number(4)), number(5)}).c_str());
    } else {
      std::fprintf(stderr, "usage: bench_scene prepare|single|converge|description FOLDER ...\n");
      return 2;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
