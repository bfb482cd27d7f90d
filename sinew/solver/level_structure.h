#pragma once

#include "sinew/assert/assert.h"
#include "sinew/table/row_lists.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sinew {

/// Level structure of a mesh given by adjacency only (breadth first: Cuthill and McKee 1969). The first level follows
/// the boundary of the mesh from one corner to the next; every other level has an equal distance from the first,
/// counted in links, and is ordered along links. Neighbours are close together; in a regular mesh levels are straight
/// rows, and links between two levels connect consecutive particles.
class LevelStructure {
  public:
    /// `near` lists the neighbours of each particle, and must outlive the structure. The mesh must be connected.
    void find(const RowLists<std::uint32_t>& near);

    void reserve(std::size_t particles) {
        for (auto* column : {&order_, &begin_, &level_, &along_, &position_, &edge_}) column->reserve(particles + 1);
        pull_.reserve(particles);
    }

    std::size_t size() const { return begin_.size() - 1; }
    std::span<const std::uint32_t> operator[](std::size_t level) const {
        SINEW_ASSERT(level < size(), "the level exists");
        return std::span(order_).subspan(begin_[level], begin_[level + 1] - begin_[level]);
    }

  private:
    const RowLists<std::uint32_t>* near_ = nullptr;
    std::vector<std::uint32_t> order_, begin_, level_, along_;
    std::vector<std::uint32_t> edge_;     ///< the first level
    std::vector<std::uint32_t> position_; ///< position in the level; `unknown` before placement
    std::vector<double> pull_;            ///< mean position of the neighbours in the level before

    std::span<const std::uint32_t> near(std::uint32_t i) const { return (*near_)[i]; }
    std::uint32_t min_joined() const;
    void spread_from_edge();
    void follow_edge();
    template <class Visit> void along_edge(std::uint32_t side, Visit&& visit) const;
    std::uint32_t next_along(std::uint32_t from) const;
    bool on_edge(std::uint32_t i) const;
    void arrange(std::span<std::uint32_t> level);
    void follow(std::uint32_t from);
    std::uint32_t ways_on(std::uint32_t from) const;
};

} // namespace sinew
