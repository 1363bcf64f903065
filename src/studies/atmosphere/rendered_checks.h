#pragma once

#include <string>
#include <vector>

#include "studies/common/study_options.h"

namespace ifov::studies {

struct EnclosureChannel {
  double centre_um = 0.0;
  double mean = 0.0, standard_error = 0.0;  ///< over the pixels
  double planck = 0.0;                      ///< the black body's radiance in the channel
};

/// A closed room at 300 K full of air at `air_k`, from within: a black body where that is 300 K as well.
std::vector<EnclosureChannel> render_enclosure(const StudyOptions& options, double air_k = 300.0);

struct PlainChannel {
  double centre_um = 0.0;
  double relative_deviation = 0.0;  ///< of single paths, over the pixels
  double drawn_deviation = 0.0;     ///< if each path carried one node at random instead of all
};

/// A uniform Lambertian plain under Sun and sky; the first channel is out of all bands.
std::vector<PlainChannel> render_plain(const StudyOptions& options);

}  // namespace ifov::studies
