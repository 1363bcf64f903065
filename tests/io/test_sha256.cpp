#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "io/product_parts/sha256.h"

namespace ifov::io::test_sha256 {
namespace {

TEST(Sha256, PublishedDigests) {  // FIPS 180-4, examples
  const auto digest = [](const std::string& text) {
    Sha256 sum;
    for (std::size_t i = 0; i < text.size(); i += 37)
      sum.update(text.data() + i, std::min<std::size_t>(37, text.size() - i));
    return sum.digest();
  };
  EXPECT_EQ(digest(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(digest(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

}  // namespace
}  // namespace ifov::io::test_sha256
