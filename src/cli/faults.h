#pragma once

namespace ifov::cli {

/// What the system would end the program for without a word: a file that is cut short while it is read gets a message
/// and exit code 2; a file that grows beyond `ulimit -f` becomes an error of the write.
void answer_faults();

}  // namespace ifov::cli
