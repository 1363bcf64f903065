#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace ifov::io {

/// SHA-256 (FIPS 180-4), as `sha256sum` prints it. Uses the processor's SHA instructions where it has them.
class Sha256 {
 public:
  void update(const void* data, std::size_t bytes);
  /// Hexadecimal digest of all that was given; call once.
  std::string digest();

 private:
  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> block_{};
  std::uint64_t total_ = 0;
};

}  // namespace ifov::io
