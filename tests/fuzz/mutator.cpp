#include "fuzz/mutator.h"

#include <algorithm>

#include "sampling/hash.h"

namespace ifov::fuzz {
namespace {

constexpr std::size_t kLongest = 1 << 16;
constexpr const char* kAwkward[] = {"0",          "-1",
                                    "1e308",      "-1e309",
                                    "nan",        "inf",
                                    "4294967295", "2147483648",
                                    "65536",      "99999999999999999999",
                                    "1e-320",     "0x10",
                                    ".5",         "1.",
                                    "-",          "18446744073709551615",
                                    "1",          "2",
                                    "3",          "7",
                                    "255"};

/// Numbers for one run, by their order of use.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t run) : seed_(seed), run_(run) {}
  std::size_t below(std::size_t n) { return n == 0 ? 0 : sampling::hash(seed_, run_, ++used_) % n; }

 private:
  std::uint64_t seed_, run_, used_ = 0;
};

bool is_number_byte(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e'; }

void replace_number(std::string& bytes, Dice& dice) {
  std::size_t at = dice.below(bytes.size());
  while (at < bytes.size() && !is_number_byte(bytes[at])) ++at;
  std::size_t begin = at, end = at;
  while (begin > 0 && is_number_byte(bytes[begin - 1])) --begin;
  while (end < bytes.size() && is_number_byte(bytes[end])) ++end;
  bytes.replace(begin, end - begin, kAwkward[dice.below(std::size(kAwkward))]);
}

void change(std::string& bytes, std::span<const std::string> seeds, std::span<const std::string> words,
            Dice& dice) {
  const std::size_t at = dice.below(bytes.size() + 1), length = 1 + dice.below(1 + dice.below(64));
  switch (dice.below(14)) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << dice.below(8)));
      break;
    case 1:
      if (at < bytes.size()) bytes[at] = static_cast<char>(dice.below(256));
      break;
    case 2: bytes.erase(std::min(at, bytes.size()), length); break;
    case 3: bytes.insert(at, bytes.substr(dice.below(bytes.size() + 1), length)); break;
    case 4: {
      const std::string& other = seeds[dice.below(seeds.size())];
      bytes.insert(at, other.substr(dice.below(other.size() + 1), length));
      break;
    }
    case 5:
      if (!words.empty()) bytes.insert(at, words[dice.below(words.size())]);
      break;
    case 6: bytes.resize(at); break;
    case 7:  // an awkward binary number
      for (std::size_t k = 0; k < 4 && at + k < bytes.size(); ++k)
        bytes[at + k] = static_cast<char>(dice.below(2) == 0 ? 0xff : 0x00);
      break;
    case 8: {  // a piece many times over: depth, length, repetition
      const std::string piece = bytes.substr(at, 1 + dice.below(8));
      const std::size_t times = 1 + dice.below(1 + dice.below(400));
      std::string many;
      for (std::size_t k = 0; k < times; ++k) many += piece;
      bytes.insert(at, many);
      break;
    }
    default:  // most often, since it leaves the file's shape alone
      replace_number(bytes, dice);
  }
}

}  // namespace

std::string mutated(std::span<const std::string> seeds, std::span<const std::string> words,
                    std::uint64_t seed, std::uint64_t run) {
  Dice dice(seed, run);
  std::string bytes = seeds[dice.below(seeds.size())];
  const std::size_t changes = 1 + dice.below(1 + dice.below(8));
  for (std::size_t k = 0; k < changes; ++k) change(bytes, seeds, words, dice);
  if (bytes.size() > kLongest) bytes.resize(kLongest);
  return bytes;
}

}  // namespace ifov::fuzz
