#pragma once

#include <cstddef>

namespace sinew::bench {

/// Rise of the process's peak memory since construction. Linux only; elsewhere unknown.
class PeakMemory {
  public:
    PeakMemory();
    /// Bytes; 0: unknown.
    std::size_t risen() const;

  private:
    std::size_t begun_ = 0;
};

} // namespace sinew::bench
