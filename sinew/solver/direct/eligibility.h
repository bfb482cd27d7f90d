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
        } else if constexpr (std::is_same_v<Kind, Pulley<D>>) {
            part.links += 2;
            part.inner_links += moving - 1;
            part.suits = part.suits && Graph::natural(table, row);
        } else if constexpr (std::is_same_v<Kind, Angle<D>>) {
            part.suits = part.suits && Graph::natural(table, row) && !Graph::opens(table, row);
        } else if constexpr (std::is_same_v<Kind, Volume<D>>) {
            part.suits = part.suits && Graph::is_fold(table, row);
        } else {
            part.suits = false;
        }
    }

    /// True if a direct solution pays. A single link is solved exactly by one step of the sweep; with many loops the
    /// factors fill in.
    static bool worthwhile(const Part& part) {
        const auto loops = part.inner_links + 1 > part.particles ? part.inner_links + 1 - part.particles : 0;
        if (part.wanted) return part.suits && part.links >= 1;
        return part.suits && part.links >= 2 && loops <= part.particles / 2 + 32;
    }

  private:
    const Graph& graph_;
};

} // namespace sinew::detail
