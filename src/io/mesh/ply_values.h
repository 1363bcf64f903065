#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/mesh/ply_header.h"

namespace ifov::io {

/// The values of a PLY file one after another, as text or as bytes. Errors are InputError with the line and
/// column of a text, the offset of a byte.
class PlyValues {
 public:
  PlyValues(std::string_view bytes, const PlyHeader& header, std::string name);

  double number(PlyType type);
  double finite_number(PlyType type, const char* what);

  /// The count of a list whose items have this type; they fit into what is left of the file.
  std::uint64_t list_count(PlyType count_type, PlyType item_type);

  void skip(const PlyProperty& property);

  /// Throws InputError at the value that was read last.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string_view text_word();

  std::string_view bytes_;
  PlyEncoding encoding_;
  std::string name_;
  std::size_t at_ = 0;
  std::size_t value_begin_ = 0;  ///< of the value read last
  std::size_t line_begin_ = 0;
  int line_ = 0;
};

}  // namespace ifov::io
