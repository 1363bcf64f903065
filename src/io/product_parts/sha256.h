#pragma once

#include <cstddef>
#include <memory>
#include <string>

struct evp_md_ctx_st;

namespace ifov::io {

/// SHA-256 (FIPS 180-4), as `sha256sum` prints it. Uses the processor's SHA instructions where it has them.
class Sha256 {
 public:
  Sha256();
  void update(const void* data, std::size_t bytes);
  /// Hexadecimal digest of all that was given; call once.
  std::string digest();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

}  // namespace ifov::io
