#pragma once

#include <optional>
#include <string>

#include "io/document/sampling_document.h"

namespace ifov::studies {

/// A way of sampling that a study compares: its name in tables, what it is told, the document's part.
struct SamplingWay {
  std::string name, text;
  io::SamplingDocument sampling;
};

/// n x n rays a pixel, of 1 one ray; `audit`: of so many pixels, or none.
SamplingWay grid_way(int n, std::optional<int> audit = {});
/// The paper's scheme: 25 sub-elements, at most 100 samples, compared in one channel by a share of the average.
SamplingWay adaptive_way(const std::string& channel, double difference);
/// Every pixel within an error of reflectance.
SamplingWay accuracy_way(double error);
/// The root mean square error over the image, in shares of the channels' noise; pooled.
SamplingWay image_way(double noises, std::optional<int> audit = {});

}  // namespace ifov::studies
