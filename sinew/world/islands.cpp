#include "sinew/world/islands.h"

#include "sinew/assert/assert.h"
#include "sinew/math/union_find.h"

namespace sinew {

template <int D, class Real> std::vector<std::size_t> islands(const World<D, Real>& world) {
    const auto& figure = world.particles.figure;
    UnionFind joined(world.particles.size());
    std::vector<std::size_t> count(world.figures.size(), 0);
    for (const auto index : figure)
        if (index < count.size()) ++count[index];
    for_each_table(world, [&](const auto& table) {
        for (Row row = 0; row < table.size(); ++row) {
            if constexpr (std::is_same_v<typename std::decay_t<decltype(table)>::Kind, Distance<D>>)
                if (!ties(table, row)) continue;
            const auto members = table.members[row];
            for (std::size_t i = 1; i < members.size(); ++i) {
                const auto index = figure[members[i]];
                if (index >= count.size() || index != figure[members[0]] || !joined.join(members[0], members[i]))
                    continue;
                SINEW_ASSERT(count[index] > 1, "two islands become one");
                --count[index];
            }
        }
    });
    return count;
}

#define SINEW_ISLANDS(D, Real) template std::vector<std::size_t> islands(const World<D, Real>&);
SINEW_INSTANTIATE(SINEW_ISLANDS)

} // namespace sinew
