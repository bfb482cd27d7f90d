#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/direct/newton.h"

/// Response of a block's ports to impulses there, with the links held: W = J (M + h^2 K)^-1 J^T, from the factorised
/// equations and unit impulses.
namespace sinew::detail {

/// Selection of the links and limits held in a response.
enum class Held {
    as_solved, ///< all constraints taut in the solution, with their geometric stiffness
    at_least   ///< only constraints taut in every solution of this substep: an upper bound of the ports' mobility
};

template <int D> class PortResponse {
  public:
    PortResponse(BlockEquations<D>& equations, Blocks<D>& blocks, const Block& block)
        : equations_(equations), blocks_(blocks), block_(block) {}

    /// Factorises the equations at the present positions. The chord method goes on with the factors.
    void factorise(Held held) {
        const double per_h2 = 1 / square(equations_.substep());
        for (auto& node : equations_.unknowns()) {
            node.diagonal = Matrix<D, double>::diagonal(node.mass * per_h2);
            node.residual = {};
        }
        equations_.clear_entries();
        for (auto& link : equations_.links().all()) {
            link.stiffness = holds(link, held) ? equations_.links().stiffness() * link.per_length2 : 0;
            if (link.stiffness == 0) continue;
            link.along = equations_.node(link.b).position - equations_.node(link.a).position;
            auto matrix = outer(link.along * link.stiffness, link.along);
            if (held == Held::as_solved) matrix += Matrix<D, double>::diagonal(max(link.tension, 0.0));
            equations_.links().add(link, matrix, Vector{});
        }
        equations_.bends().stiffen(held == Held::as_solved, equations_.links().stiffness());
        equations_.solve();
    }
    void find() {
        for (std::uint32_t p = 0; p < block_.ports; ++p)
            for (int axis = 0; axis < D; ++axis) respond(p, axis);
    }

    /// Response of port q to an impulse at port p.
    static Matrix<D, double>& response(Blocks<D>& blocks, const Block& block, std::uint32_t q, std::uint32_t p) {
        SINEW_ASSERT(q < block.ports && p < block.ports, "both ports belong to the block");
        SINEW_ASSERT(block.first_response + block.ports * block.ports <= blocks.ports.responses.size(),
                     "the block has a matrix of responses");
        return blocks.ports.responses[block.first_response + q * block.ports + p];
    }

  private:
    using Vector = Vec<D, double>;
    BlockEquations<D>& equations_;
    Blocks<D>& blocks_;
    const Block& block_;

    Port<D>& port(std::uint32_t p) const { return blocks_.ports.list[block_.first_port + p]; }

    static bool holds(const DistanceRow<D>& link, Held held) {
        if (!link.one_sided()) return true;
        return held == Held::at_least ? !link.slackened : link.tension * link.side > 0;
    }

    void respond(std::uint32_t p, int axis) {
        const double per_h2 = 1 / square(equations_.substep());
        for (auto& node : equations_.unknowns()) node.residual = {};
        blocks_.nodes[port(p).node].residual = Vector::axis(axis) * per_h2;
        solve_block_again(blocks_, block_);
        for (std::uint32_t q = 0; q < block_.ports; ++q)
            response(blocks_, block_, q, p).column[std::size_t(axis)] = blocks_.nodes[port(q).node].displacement;
    }
};

} // namespace sinew::detail
