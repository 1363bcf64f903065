#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "io/envi/envi_header.h"

namespace ifov::render {
struct ImageInfo;
}
namespace ifov::sampling {
struct TileResult;
}
namespace ifov::truth {
struct Collector;
}

namespace ifov::io {

struct Acquisition;

/// What a quantity's values are made of: a tile that is done, and what is known of the image.
struct FinishedTile {
  const sampling::TileResult& tile;
  const render::ImageInfo& image;
  const Acquisition& acquisition;
};

/// Where the values of a tile go, as [pixel][band]; one of these once, of the quantity's type.
class ValueSink {
 public:
  virtual ~ValueSink() = default;
  virtual void put(std::span<const float> values) = 0;
  virtual void put(std::span<const double> values) = 0;
  virtual void put(std::span<const std::uint32_t> values) = 0;
  virtual void put(std::span<const std::uint16_t> values) = 0;
  virtual void put(std::span<const std::uint8_t> values) = 0;
};

/// One thing that can be told of every pixel, and so a cube that a run can leave. All there are stand in
/// quantity_table.cpp; documents, cubes, headers, disk space, runs that go on and merged shares follow from that row.
struct Quantity {
  /// What it is to the image.
  enum class Role {
    radiance,   ///< what the sensor measures
    error,      ///< how far that may be off
    share,      ///< part of the pixel
    count,      ///< what it cost
    judgement,  ///< whether it is what was asked for
    truth,      ///< what the scene holds there
  };
  /// How a pixel's value comes of what lies in its footprint.
  enum class Statistic {
    mean,
    standard_error,
    half_width,
    middle,  ///< of the ray through the pixel's middle
    pixel    ///< said of the pixel as a whole
  };
  /// `stokes`: I, Q, U and V of all channels, component by component.
  enum class Bands { channels, stokes, materials, named };
  /// Whether it is written where a document names nothing.
  enum class Usual { yes, no, where_no_map_tells };
  /// What there must be for it.
  struct Needs {
    bool errors = false;     ///< a way of sampling that knows its error
    bool variances = false;  ///< tiles that keep them apart
    bool air = false;        ///< an atmosphere that knows its error
    bool materials = false;
    bool stokes = false;      ///< a sensor that tells polarization
    bool emissivity = false;  ///< tiles that tell the emissivity of what is seen
    bool solved = false;      ///< temperatures that were solved
    bool parts = false;      ///< tiles that tell the parts of their light, which irradiances at points do not
    bool radiance = false;   ///< pixels that are radiances, which irradiances at points are not
    bool sunlight = false;   ///< the Sun above the horizon, and what it sends before the air took some
    bool mosaic = false;     ///< a sensor with a mosaic of filters
    bool responses = false;  ///< the responses of channels, which a run's plan then keeps
  };

  std::string_view name;  ///< in documents, and of the cube: NAME_<name>.img
  std::string_view what;  ///< in headers and lists of files
  std::string_view unit;  ///< empty: the radiance unit
  Role role;
  Statistic statistic;
  EnviType type;
  Bands bands;
  std::span<const std::string_view> band_names;  ///< where they are named
  Usual usual = Usual::no;
  Needs needs = {};
  const truth::Collector* collector = nullptr;  ///< of what has to be noted while the scene is there
  void (*values)(const FinishedTile& tile, ValueSink& sink);
  /// Where there is more to say.
  void (*complete_header)(EnviHeader& header, const render::ImageInfo& image) = nullptr;

  bool is_spectral() const { return bands == Bands::channels; }
  int band_count(const render::ImageInfo& image) const;
};

}  // namespace ifov::io
