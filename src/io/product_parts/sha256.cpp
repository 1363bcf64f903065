#include "io/product_parts/sha256.h"

#include <openssl/evp.h>

#include "core/error.h"

namespace ifov::io {
namespace {

/// Without memory, or where this machine's settings of the library leave SHA-256 out.
void require(bool done) {
  if (!done) throw SystemError("OpenSSL cannot compute a SHA-256 checksum here");
}

}  // namespace

void Sha256::Free::operator()(evp_md_ctx_st* context) const { EVP_MD_CTX_free(context); }

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
  require(context_ != nullptr && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
}

void Sha256::update(const void* data, std::size_t bytes) {
  require(EVP_DigestUpdate(context_.get(), data, bytes) == 1);
}

std::string Sha256::digest() {
  unsigned char sum[EVP_MAX_MD_SIZE];
  unsigned length = 0;
  require(EVP_DigestFinal_ex(context_.get(), sum, &length) == 1);
  std::string text;
  for (unsigned k = 0; k < length; ++k) text += format("{:02x}", sum[k]);
  return text;
}

}  // namespace ifov::io
