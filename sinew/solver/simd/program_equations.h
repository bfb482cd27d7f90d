#pragma once

#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/simd/lane_swing.h"

/// Equations of a Newton iteration for blocks of one program side by side in lanes: rows, factorisation, and the step.
namespace sinew {
namespace {

template <int D, class V> class ProgramEquations : public LaneSwing<D, V> {
    using Base = LaneSwing<D, V>;

  public:
    using typename Base::Mask;
    using typename Base::Pair;
    using Node = ProgramNode<D, V>;
    using Link = ProgramLink<D, V>;
    using Plane = ProgramPlane<D, V>;
    using Entry = ProgramEntry<D, V>;

    explicit ProgramEquations(ProgramPack<D>& pack)
        : Base(pack), pack_(pack), program_(pack.program), nodes_(reinterpret_cast<Node*>(pack.nodes)),
          links_(reinterpret_cast<Link*>(pack.links)), planes_(reinterpret_cast<Plane*>(pack.planes)),
          entries_(reinterpret_cast<Entry*>(pack.entries)) {}

  protected:
    using Base::far2_, Base::moved2_, Base::min_pull_, Base::number, Base::of, Base::at;
    static constexpr double relative = 0.5e4; ///< penalty of a link, over total mass / length^2

    ProgramPack<D>& pack_;
    const BlockProgram& program_;
    Node* nodes_;
    Link* links_;
    Plane* planes_;

    template <auto where, class Row> Pair span_of(const Row& row) const {
        return at(nodes_[row.b].*where) - at(nodes_[row.a].*where);
    }
    /// Volume of a tetrahedron, as constraint/volume.h has it.
    template <auto where> V volume_of(const std::uint32_t (&corners)[4]) const requires(D == 3) {
        const Pair a = at(nodes_[corners[0]].*where);
        const auto edge = [&](int k) { return at(nodes_[corners[k]].*where) - a; };
        return dot(edge(1), cross(edge(2), edge(3))) * number(1.0 / 6);
    }

    void assemble() {
        for (std::uint32_t i = 0; i < program_.unknowns; ++i) {
            auto& node = nodes_[i];
            Matrix diagonal{};
            diagonal.add_to_diagonal(node.mass);
            diagonal.to(node.diagonal);
            ((at(node.predicted) - at(node.position)) * node.mass).to(node.residual);
        }
        for (std::uint32_t e = 0; e < program_.entries; ++e) {
            Matrix{}.to(entries_[e].lower);
            Matrix{}.to(entries_[e].upper);
        }
        for (std::uint32_t j = 0; j < program_.links; ++j) add(program_.link[j], links_[j]);
        if constexpr (D == 3)
            for (std::uint32_t j = 0; j < program_.planes; ++j) add(program_.plane[j], planes_[j]);
    }
    /// LU by D x D blocks, as in direct/matrices.h.
    void eliminate() {
        const std::uint32_t* pair = program_.pairs;
        for (std::uint32_t i = 0; i < program_.unknowns; ++i) {
            auto& node = nodes_[i];
            V determinant;
            const Matrix adjoint = adjugate(Matrix::of(node.diagonal), determinant);
            const Matrix inverse = adjoint * (number(1) / determinant);
            inverse.to(node.diagonal);
            const Pair y = inverse * at(node.residual);
            y.to(node.displacement);
            const auto end = program_.first_entry[i + 1];
            for (auto e = program_.first_entry[i]; e < end; ++e) {
                const Matrix lower = Matrix::of(entries_[e].lower), right = inverse * Matrix::of(entries_[e].upper);
                auto& other = nodes_[program_.entry_node[e]];
                (lower * right).take_from(other.diagonal);
                (at(other.residual) - lower * y).to(other.residual);
                if (e + 1 == end) continue;
                const Matrix down = lower * inverse;
                for (auto g = e + 1; g < end; ++g) {
                    auto& filled = entries_[*pair++];
                    (Matrix::of(entries_[g].lower) * right).take_from(filled.lower);
                    (down * Matrix::of(entries_[g].upper)).take_from(filled.upper);
                }
            }
        }
    }
    void substitute_back() {
        moved2_ = V{};
        for (auto i = program_.unknowns; i-- > 0;) {
            auto& node = nodes_[i];
            Pair pulled{};
            for (auto e = program_.first_entry[i]; e < program_.first_entry[i + 1]; ++e)
                pulled = pulled + Matrix::of(entries_[e].upper) * at(nodes_[program_.entry_node[e]].displacement);
            const Pair displacement = at(node.displacement) - Matrix::of(node.diagonal) * pulled;
            displacement.to(node.displacement);
            moved2_ = max(dot(displacement, displacement), moved2_);
        }
    }

    /// Newton step of the active lanes, within the trust region. Returns the worst error of a row, relative.
    V take_step(const Mask& active) {
        far2_ = V{};
        for (std::uint32_t j = 0; j < program_.links; ++j) {
            auto& link = links_[j];
            const Pair change = span_of<&Node::displacement>(program_.link[j]);
            far2_ = max(dot(change, change) * link.per_length2, far2_);
            link.next = link.next + link.stiffness * dot(at(link.span), change);
        }
        const V share = Base::trusted_share();
        for (std::uint32_t i = 0; i < program_.unknowns; ++i)
            Base::move(nodes_[i].position, at(nodes_[i].displacement) * share, active);
        V worst{};
        min_pull_ = number(1);
        for (std::uint32_t j = 0; j < program_.links; ++j) {
            auto& link = links_[j];
            const Pair span = span_of<&Node::position>(program_.link[j]);
            span.to(link.span);
            link.pull = active ? link.pull + (link.next - link.pull) * share : link.pull;
            if (program_.link[j].pulls_only) min_pull_ = min(link.pull, min_pull_);
            worst = max(size_of(dot(span, span) - link.length2) * link.per_length2 * number(0.5), worst);
        }
        if constexpr (D == 3) worst = max(step_planes(active, share) * number(small_angle), worst);
        return worst;
    }

  private:
    using Matrix = Square<D, V>;
    static constexpr double small_angle = 1e-2; ///< error of a plane that counts as this fraction of a length's

    Entry* entries_;

    void add(const BlockProgram::Link& row, Link& link) {
        const Pair e = at(link.span), along = (at(link.begun) + e) * number(0.5);
        link.next = link.pull + link.stiffness * (dot(e, e) - link.length2) * number(0.5);
        Matrix stiffness = outer(along * link.stiffness, e);
        stiffness.add_to_diagonal(max(link.pull, V{}) * number(0.5));
        const Pair force = along * link.next;
        if (row.a < program_.unknowns) add(row.a, stiffness, force);
        if (row.b < program_.unknowns) add(row.b, stiffness, Pair{} - force);
        if (row.entry == BlockProgram::none) return;
        stiffness.take_from(entries_[row.entry].lower);
        stiffness.take_from(entries_[row.entry].upper);
    }
    void add(std::uint32_t i, const Matrix& stiffness, const Pair& force) {
        stiffness.add_to(nodes_[i].diagonal);
        (at(nodes_[i].residual) + force).to(nodes_[i].residual);
    }

    /// A plane, along the mean gradient over the substep, exact since a volume is linear in each edge
    /// (direct/angle_rows.h).
    void add(const BlockProgram::Plane& row, Plane& plane) requires(D == 3) {
        Pair begun[4], edge[4], along[4], gradient[4];
        for (int k = 1; k < 4; ++k) {
            begun[k] = at(nodes_[row.nodes[k]].start) - at(nodes_[row.nodes[0]].start);
            edge[k] = at(nodes_[row.nodes[k]].position) - at(nodes_[row.nodes[0]].position);
        }
        const auto mean = [&](int i, int j) {
            return (cross(begun[i] * number(2) + edge[i], begun[j]) + cross(edge[i] * number(2) + begun[i], edge[j])) *
                   (plane.per_unit * number(1.0 / 36));
        };
        const auto now = [&](int i, int j) { return cross(edge[i], edge[j]) * (plane.per_unit * number(1.0 / 6)); };
        along[1] = mean(2, 3), along[2] = mean(3, 1), along[3] = mean(1, 2);
        along[0] = Pair{} - (along[1] + along[2] + along[3]);
        gradient[1] = now(2, 3), gradient[2] = now(3, 1), gradient[3] = now(1, 2);
        gradient[0] = Pair{} - (gradient[1] + gradient[2] + gradient[3]);
        V steepest2{};
        for (int k = 0; k < 4; ++k) {
            gradient[k].to(plane.gradient[k]);
            steepest2 = max(dot(gradient[k], gradient[k]), steepest2);
        }
        plane.volume = dot(edge[1], gradient[1]);
        plane.stiffness = of(pack_.total) * number(relative) / steepest2;
        plane.next = plane.pull + plane.stiffness * plane.volume;
        for (int i = 0, pair = 0; i < 4; ++i) {
            const Pair stiff = along[i] * plane.stiffness;
            add(row.nodes[i], outer(stiff, gradient[i]), Pair{} - along[i] * plane.next);
            for (int j = i + 1; j < 4; ++j, ++pair) {
                auto& entry = entries_[row.entries[pair]];
                outer(along[j] * plane.stiffness, gradient[i]).add_to(entry.lower);
                outer(stiff, gradient[j]).add_to(entry.upper);
            }
        }
    }

    V step_planes(const Mask& active, const V& share) requires(D == 3) {
        V worst{};
        for (std::uint32_t j = 0; j < program_.planes; ++j) {
            auto& plane = planes_[j];
            const auto& corners = program_.plane[j].nodes;
            V change{};
            for (int k = 0; k < 4; ++k)
                change = change + dot(at(plane.gradient[k]), at(nodes_[corners[k]].displacement));
            const V next = plane.next + plane.stiffness * change;
            plane.pull = active ? plane.pull + (next - plane.pull) * share : plane.pull;
            plane.volume = volume_of<&Node::position>(corners) * plane.per_unit;
            worst = max(size_of(plane.volume), worst);
        }
        return worst;
    }
};

} // namespace
} // namespace sinew
