#pragma once

namespace ifov {

/// What to do where a folder holds the finished tiles of a run.
enum class RunStart {
  fresh,    ///< refuse: nothing finished is thrown away unasked
  resume,   ///< go on with it; where there is none, begin
  restart,  ///< throw it away and begin
};

}  // namespace ifov
