#pragma once

#include "sinew/solver/contact/contact_row.h"
#include "sinew/solver/workers.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace sinew::detail {

/// Rows of contact by strips of the world along the first axis. Rows within a strip come first, then rows between a
/// strip and the next, of even and then of odd strips, then all others: parts of one phase share no particle, and are
/// solved by as many threads as there are. The strips depend on the places at the start of a step alone.
template <int D, class Real> class ContactParts {
  public:
    static constexpr std::uint32_t count = contact_parts, strips = count / 2;
    static constexpr std::size_t worth_it = 512; ///< particles from which there is more than one strip
    std::array<ContactPart<D, Real>, count> list;
    std::vector<Real> across, sorted;                             ///< scratch: per particle, its place or its figure's
    std::vector<std::uint32_t> first_of_figure, first_of_cluster; ///< scratch: particle per figure, per cluster

    /// Part of a row on particles of the lowest and highest of these strips.
    static std::uint32_t part_of(std::uint32_t low, std::uint32_t high) {
        if (low == high) return low;
        return high == low + 1 ? strips + low : count - 1;
    }

    template <class Work> void run(int threads, const Work& work) {
        run_phase<0>(threads, work);
        run_phase<1>(threads, work);
        run_phase<2>(threads, work);
        work(list[count - 1]);
    }
    /// Calls work(part) in any order, for work that does not write to particles.
    template <class Work> void run_all(int threads, const Work& work) {
        Workers::run(threads, int(count), [&](int i) { work(list[std::size_t(i)]); });
    }

  private:
    template <int phase, class Work> void run_phase(int threads, const Work& work) {
        constexpr std::uint32_t first = phase == 0 ? 0 : strips + phase - 1, stride = phase == 0 ? 1 : 2;
        constexpr std::uint32_t end = phase == 0 ? strips : count - 1;
        constexpr int parts = int((end - first + stride - 1) / stride);
        Workers::run(threads, parts, [&](int i) { work(list[first + std::size_t(i) * stride]); });
    }
};

} // namespace sinew::detail
