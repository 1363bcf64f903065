#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ifov/api.h"

namespace ifov {

/// What a run record (NAME_run.json) says. Texts that it lacks are empty, numbers 0.
struct RunInfo {
  struct Channel {
    std::string name;
    double centre_um = 0.0, fwhm_um = 0.0;
    std::optional<double> minimum, maximum, mean, mean_half_width;  ///< over the image, in `radiance_unit`
    double noise = 0.0;  ///< standard deviation of the sensor's, likewise; 0: none is told
  };
  struct File {
    std::string name, what;
    std::uint64_t bytes = 0;
    std::string sha256;
  };
  std::filesystem::path path;
  std::string version, sampler, document, document_text;
  std::uint64_t seed = 0;
  int width_px = 0, height_px = 0;
  std::string radiance_unit;
  std::vector<Channel> channels;
  std::string accuracy_asked, accuracy_reached;  ///< plain words
  double confidence = 0.0;                       ///< of the intervals
  std::optional<std::uint64_t> pixels;
  std::uint64_t pixels_converged = 0;
  double worst_error_ratio = 0.0;  ///< largest half-width over its limit
  std::string reasons;             ///< why pixels are not converged: "12 samples, 3 air"
  std::string detection;           ///< what could have been missed, in plain words
  double rays = 0.0, samples = 0.0, elapsed_s = 0.0;
  std::vector<std::string> notes;
  std::vector<File> files;
};

/// Throws SystemError where the record cannot be read, InputError where it is none.
IFOV_API RunInfo run_info(const std::filesystem::path& record);

/// What an ENVI file (.img, .hdr) says of itself.
struct CubeInfo {
  std::filesystem::path path;  ///< of the data
  std::string description, unit;
  int width_px = 0, height_px = 0, bands = 0, bytes_per_value = 0;
  std::string interleave;  ///< bsq, bil, bip
  std::vector<std::string> map_info, band_names;
  std::vector<double> wavelength, fwhm;  ///< of each band, or empty
  std::string wavelength_unit;
};

/// Errors as of run_info().
IFOV_API CubeInfo cube_info(const std::filesystem::path& file);

/// Run records in a folder, sorted; where there is none, its ENVI cubes. Throws InputError where there is neither.
IFOV_API std::vector<std::filesystem::path> products_in(const std::filesystem::path& folder);

/// Mean radiances over a region of a run's products.
struct RegionMean {
  struct Channel {
    std::string name;
    std::uint64_t pixels = 0;             ///< that hold a value
    double mean = 0.0, half_width = 0.0;  ///< at the run's confidence; not a number where nothing is known
  };
  std::string region;  ///< as it was asked for
  std::uint64_t pixels = 0, converged = 0;
  std::string reasons;  ///< of those that are not converged
  std::vector<Channel> channels;
};

/// `products`: a folder with one run record, or the record. A region is "x0,y0,x1,y1" (a rectangle, pixels from the upper
/// left corner), "x,y,x,y,x,y,..." (a polygon), either of them after "map:" in map coordinates, or "mask:FILE", an ENVI raster
/// of the image's size that is not 0 inside. Throws InputError on what is none, SystemError on files that cannot be
/// read.
IFOV_API std::vector<RegionMean> region_means(const std::filesystem::path& products,
                                              const std::vector<std::string>& regions);

/// The run record that region_means() and detect() look at. Errors as there.
IFOV_API std::filesystem::path record_of(const std::filesystem::path& products);

/// Makes a file anew, whole or not at all: writes it beside its name and renames it, and follows no link. Throws
/// SystemError.
IFOV_API void write_file(const std::filesystem::path& path, const std::string& content);

/// The input file that is mapped at an address, or null: for a handler of SIGBUS, which a process gets where a file was cut
/// short after it was mapped. Takes no lock and no memory.
IFOV_API const char* mapped_input_at(const void* address);

}  // namespace ifov
