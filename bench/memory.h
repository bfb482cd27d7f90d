#pragma once

#include <cstddef>

namespace sinew::bench {

/// How much more memory the process took at its peak than when this began. Linux only; elsewhere nothing is known.
class PeakMemory {
  public:
    PeakMemory();
    /// Bytes; 0: not known.
    std::size_t risen() const;

  private:
    std::size_t begun_ = 0;
};

} // namespace sinew::bench
