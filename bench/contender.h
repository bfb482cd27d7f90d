#pragma once

#include "bench/measure.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sinew::bench {

/// A solver under comparison.
struct Contender {
    std::string name;
    std::function<std::unique_ptr<Simulation>(const Effort& effort)> make;
};

/// The textbook in list order (the unit of speed), the textbook in shuffled order, and all built peers able to do the
/// work. Valid while `work` lives.
std::vector<Contender> rivals(const Work& work);

} // namespace sinew::bench
