#pragma once

#include <ctime>

namespace sinew::test {

/// Processor time that a function takes, seconds: other programs on the machine do not count.
template <class Work> double cpu_seconds(Work&& work) {
    const auto begin = std::clock();
    work();
    return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

} // namespace sinew::test
