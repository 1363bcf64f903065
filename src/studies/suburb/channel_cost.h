#pragma once

#include "studies/common/figures.h"
#include "studies/common/study_options.h"

namespace ifov::io {
struct Document;
}

namespace ifov::studies {

/// What all channels of a document cost over one of them at the same paths: renders both in turn, a grid of rays in
/// part of the image, and compares the fastest times. Adds the figure `channels_over_one`, and by how much the numbers of
/// their rays differ.
void add_channel_cost(const io::Document& document, const StudyOptions& options, bool quick,
                      FigureTable& figures);

}  // namespace ifov::studies
