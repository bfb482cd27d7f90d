#pragma once

#include "bench/measure.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sinew::bench {

/// Somebody who can do a case's work.
struct Contender {
    std::string name;
    std::function<std::unique_ptr<Simulation>(const Effort& effort)> make;
};

/// The textbook in list order, by which speed is told; the textbook in any order; the peers that are built and can do
/// it. They are good as long as the work is.
std::vector<Contender> rivals(const Work& work);

} // namespace sinew::bench
