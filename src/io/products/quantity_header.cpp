#include "io/products/quantity_header.h"

#include <cctype>

#include "core/format.h"
#include "io/product_parts/map_info.h"
#include "io/product_parts/product_headers.h"
#include "io/quantities/location_quantities.h"

namespace ifov::io {
namespace {

std::string capitalised(std::string_view text) {
  std::string result(text);
  if (!result.empty()) result[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(result[0])));
  return result;
}

}  // namespace

EnviHeader header_of(const Quantity& quantity, const render::ImageInfo& image, const RunIdentity& identity,
                     const std::string& statement) {
  EnviHeader header = image_header(quantity.what, image, identity, statement);
  header.data_type = quantity.type;
  header.data_units = quantity.unit.empty() ? image.radiance_unit : std::string(quantity.unit);
  header.bands = quantity.band_count(image);
  switch (quantity.bands) {
    case Quantity::Bands::channels: add_channels(header, image); break;
    case Quantity::Bands::stokes: add_stokes(header, image); break;
    case Quantity::Bands::materials: header.band_names = image.materials; break;
    case Quantity::Bands::named:
      header.band_names.assign(quantity.band_names.begin(), quantity.band_names.end());
      break;
  }
  if (quantity.type == EnviType::float32 || quantity.type == EnviType::float64)
    header.other["data ignore value"] = "nan";
  if (quantity.is_spectral())
    header.other["z plot titles"] =
        format("Wavelength (Micrometers), {} ({})", capitalised(quantity.what), header.data_units);
  if (const std::string held = render::what_intervals_hold(image);
      !held.empty() && quantity.role == Quantity::Role::error)
    header.other["ifov interval"] = held;
  if (quantity.needs.stokes) add_stokes_convention(header, identity.acquisition.camera);
  const bool is_place = &quantity == &quantities::kLocation || &quantity == &quantities::kTrueLocation;
  if (is_place && !image.has_map) header.coordinate_system = esri_coordinate_system_text(image);
  if (quantity.complete_header != nullptr) quantity.complete_header(header, image);
  return header;
}

}  // namespace ifov::io
