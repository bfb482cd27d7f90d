#include "sinew/solver/level_structure.h"

#include "sinew/math/sort.h"

#include <algorithm>
#include <tuple>

namespace sinew {
namespace {

constexpr std::uint32_t unknown = ~std::uint32_t(0);

} // namespace

void LevelStructure::find(const RowLists<std::uint32_t>& near) {
    near_ = &near;
    const auto count = near.size();
    position_.assign(count, unknown);
    pull_.assign(count, 0);
    edge_.assign(1, min_joined());
    spread_from_edge();
    follow_edge();
    spread_from_edge();
    for (std::size_t i = 0; i < size(); ++i) arrange(std::span(order_).subspan(begin_[i], begin_[i + 1] - begin_[i]));
}

/// Particle with the fewest neighbours: a corner, if there is one.
std::uint32_t LevelStructure::min_joined() const {
    std::uint32_t found = 0;
    for (std::uint32_t i = 1; i < near_->size(); ++i)
        if (near(i).size() < near(found).size()) found = i;
    return found;
}

/// Extends the first level along the side of the corner whose end has the lowest number. In a mesh without boundary the
/// first level is a single particle.
void LevelStructure::follow_edge() {
    auto begun = unknown, first = unknown;
    for (const auto side : near(edge_.front())) {
        if (!on_edge(side)) continue;
        auto end = side;
        along_edge(side, [&](std::uint32_t at) { end = at; });
        if (end < first) first = end, begun = side;
    }
    along_edge(begun, [&](std::uint32_t at) { edge_.push_back(at); });
}

/// Walks along the boundary, away from the start, up to a corner: a particle with fewer neighbours than the one before.
template <class Visit> void LevelStructure::along_edge(std::uint32_t side, Visit&& visit) const {
    for (auto at = side, before = side; at != unknown; before = at, at = next_along(at)) {
        visit(at);
        if (near(at).size() < near(before).size()) return;
    }
}

std::uint32_t LevelStructure::next_along(std::uint32_t from) const {
    auto min = std::pair(near_->entries(), unknown);
    for (const auto other : near(from))
        if (level_[other] > level_[from] && on_edge(other)) min = std::min(min, std::pair(near(other).size(), other));
    return min.second;
}

/// True for a particle with fewer neighbours than average.
bool LevelStructure::on_edge(std::uint32_t i) const {
    return near(i).size() * near_->size() < near_->entries();
}

void LevelStructure::spread_from_edge() {
    level_.assign(near_->size(), unknown);
    for (const auto i : edge_) level_[i] = 0;
    order_.assign(edge_.begin(), edge_.end());
    begin_.assign(1, 0);
    for (std::size_t i = 0; i < order_.size(); ++i) {
        const auto at = order_[i], next = level_[at] + 1;
        if (next > begin_.size()) begin_.push_back(std::uint32_t(i));
        for (const auto other : near(at)) {
            if (level_[other] != unknown) continue;
            level_[other] = next;
            order_.push_back(other);
        }
    }
    begin_.push_back(std::uint32_t(order_.size()));
}

/// Orders a level like the level before, then along the links within.
void LevelStructure::arrange(std::span<std::uint32_t> level) {
    for (const auto i : level) {
        double sum = 0, count = 0;
        for (const auto other : near(i))
            if (level_[other] < level_[i]) sum += position_[other], ++count;
        pull_[i] = count > 0 ? sum / count : 0;
    }
    sinew::sort(level.begin(), level.end(),
                [&](auto a, auto b) { return std::pair(pull_[a], a) < std::pair(pull_[b], b); });
    along_.clear();
    for (const std::uint32_t max : {1U, unknown})
        for (const auto i : level)
            if (position_[i] == unknown && ways_on(i) <= max) follow(i);
    std::copy(along_.begin(), along_.end(), level.begin());
}

/// Follows links within the level, always to the neighbour with the fewest continuations, which would be left out
/// otherwise.
void LevelStructure::follow(std::uint32_t from) {
    for (auto next = from; next != unknown;) {
        const auto at = next;
        position_[at] = std::uint32_t(along_.size());
        along_.push_back(at);
        next = unknown;
        auto min = std::tuple(unknown, 0.0, unknown);
        for (const auto other : near(at)) {
            if (level_[other] != level_[at] || position_[other] != unknown) continue;
            const auto key = std::tuple(ways_on(other), pull_[other], other);
            if (key < min) min = key, next = other;
        }
    }
}

/// Number of unplaced neighbours in the same level.
std::uint32_t LevelStructure::ways_on(std::uint32_t from) const {
    std::uint32_t ways = 0;
    for (const auto other : near(from)) ways += level_[other] == level_[from] && position_[other] == unknown;
    return ways;
}

} // namespace sinew
