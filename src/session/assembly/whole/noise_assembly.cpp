#include "session/assembly/whole/noise_assembly.h"

#include "io/document/sensor_document.h"
#include "session/assembly/shared/spectrum_assembly.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {

std::vector<double> assemble_noise(const io::DocumentSources& sources,
                                   std::span<const io::ChannelDocument> written,
                                   const std::vector<radiometry::Channel>& channels) {
  constexpr double kWarm_k = 300.0;
  std::vector<double> noise(channels.size(), 0.0);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const io::ChannelDocument& source = written[c];
    if (source.noise)
      noise[c] = with_position(sources, source.position, [&] {
        return assemble_spectrum(sources, *source.noise, "noise").at(channels[c].centre_um);
      });
    else if (source.noise_k)
      noise[c] = *source.noise_k * radiometry::channel_planck_slope_w_m2_sr_um_k(channels[c], kWarm_k);
  }
  return noise;
}

}  // namespace ifov::session
