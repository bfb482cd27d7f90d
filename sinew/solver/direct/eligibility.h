#pragma once

#include "sinew/solver/block.h"
#include "sinew/solver/direct/graph.h"

/// Eligibility for a block: few loops of links, angles and folds, all with the default split and relaxation.
namespace sinew::detail {

template <int D, class Real> class BlockEligibility {
  public:
    using Part = BlockRoom::Part;
    using Graph = BlockGraph<D, Real>;

    explicit BlockEligibility(const Graph& graph) : graph_(graph) {}

    /// Counts a particle of a part.
    void take_stock(Part& part, Row particle) const {
        const auto direct = graph_.direct_of(particle);
        ++part.particles;
        part.mass += graph_.mass_of(particle);
        part.suits = part.suits && direct != Direct::off;
        part.wanted = part.wanted || direct == Direct::on;
    }
    /// Counts a constraint of a part, with the number of mobile members.
    template <class Table> void take_stock(Part& part, const Table& table, Row row, std::uint32_t moving) const {
        using Kind = typename Table::Kind;
        if constexpr (std::is_same_v<Kind, Distance<D>>) {
            ++part.links;
            part.inner_links += moving == 2;
            part.suits = part.suits && Graph::natural(table, row) && graph_.has_length(row);
            if (moving == 1) part.lightest_end = min(part.lightest_end, graph_.mass_at_end(row));
        } else if constexpr (std::is_same_v<Kind, Pulley<D>>) {
            part.links += 2;
            part.inner_links += moving - 1;
            part.suits = part.suits && Graph::natural(table, row);
        } else if constexpr (std::is_same_v<Kind, Angle<D>>) {
            part.suits = part.suits && Graph::natural(table, row) && !Graph::opens(table, row);
        } else if constexpr (std::is_same_v<Kind, Volume<D>>) {
            part.suits = part.suits && Graph::is_fold(table, row);
            ++part.folds;
        } else {
            part.suits = false;
        }
    }

    /// True if a direct solution pays. A single link is solved exactly by one step of the sweep; with many loops the
    /// factors fill in. A skeleton in space that hangs on a thread of a thousandth of its mass is left to the sweep,
    /// and its thread is a block with a port: as one block Newton's method often finds no solution, because links of
    /// the thread alternate between taut and slack while the joints reach their limits (docs/measured/joined.md).
    static bool worthwhile(const Part& part) {
        const auto loops = part.inner_links + 1 > part.particles ? part.inner_links + 1 - part.particles : 0;
        if (part.wanted) return part.suits && part.links >= 1;
        constexpr double thread = 3e-3; // of the mass
        if (part.folds > 0 && part.lightest_end < thread * part.mass) return false;
        return part.suits && part.links >= 2 && loops <= part.particles / 2 + 32;
    }

  private:
    const Graph& graph_;
};

} // namespace sinew::detail
