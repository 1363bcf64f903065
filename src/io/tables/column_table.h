#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ifov::io {

/// What a channel's numbers may be.
struct ChannelRange {
  std::string_view channel;
  double lowest = 0.0, highest = 0.0;
};

/// Numbers of detector columns by channel, [channel][column]: a text table with a line for each column and a field for each
/// channel; comments, empty lines and a heading (a first line without any number) are passed over. InputError at the line and column
/// of the file where lines or fields are missing or too many, or a number is none or out of its channel's range. `of_what`:
/// "centre, nm".
std::vector<std::vector<double>> read_column_table(const std::filesystem::path& path,
                                                   std::string_view of_what,
                                                   std::span<const ChannelRange> channels, int columns);

}  // namespace ifov::io
