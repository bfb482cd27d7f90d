#pragma once

#include "sinew/solver/direct/find_program.h"
#include "sinew/solver/direct/lane_step.h"

/// Step of the blocks that have programs, side by side in lanes.
namespace sinew::detail {

template <int D, class Real> class ProgramStep : LaneStep<ProgramStep<D, Real>, D, Real> {
    using Base = LaneStep<ProgramStep, D, Real>;
    friend Base;

  public:
    ProgramStep(World<D, Real>& world, Solver<D, Real>& solver, ProgramSpace<D>& space, double frame, int substeps)
        : Base(world, solver, space.pack, frame, substeps), space_(space), pack_(space.pack),
          programs_(solver.blocks.programs) {}

    static bool are_alike(const ProgramTurn& a, const ProgramTurn& b) { return a.group == b.group; }

    /// Moves the blocks of `turns`, all of the same program.
    template <class Whole, class Redo>
    void run(std::span<const ProgramTurn> turns, double report_substep, Whole&& whole, Redo&& redo) {
        const auto& kernel = Base::kernel_;
        const bool single = turns.size() == 1;
        const auto& first = programs_.list[Base::blocks_.list[turns.front().block].program];
        pack_.width = single ? min_block_lanes : kernel.block_lanes;
        pack_.program = read_program(programs_.numbers.data() + first.first);
        pack_.is_free = pack_.program.nodes == pack_.program.unknowns;
        pack_.lay_out(space_.aligned());
        Base::template exchange_with<Node>(pack_.nodes, pack_.program.unknowns, space_.rows.data());
        const auto swing = [&] { single ? kernel.swing_program(pack_) : kernel.swing_programs(pack_); };
        Base::run(turns, report_substep, swing, whole, redo);
    }

  private:
    using Node = ProgramNode<D, double>;
    using Link = ProgramLink<D, double>;
    using Plane = ProgramPlane<D, double>;
    using Limit = ProgramLimit<double>;

    ProgramSpace<D>& space_;
    ProgramPack<D>& pack_;
    Programs<D>& programs_;

    template <class Record> LaneTable table(double* numbers, int lane) const {
        return LaneTable::of<Record>(numbers, pack_.width, lane);
    }
    std::span<DistanceRow<D>> links_of(const Block& block) const {
        return std::span(Base::blocks_.links).subspan(block.first_link, block.links);
    }
    std::span<AngleRow<D>> bends_of(const Block& block) const {
        return std::span(Base::blocks_.bends).subspan(block.first_bend, block.bends);
    }

    std::span<const BlockNode<D>> nodes_of(const Block& block) const {
        return std::span(std::as_const(Base::blocks_.nodes)).subspan(block.first_node, block.nodes);
    }
    LaneTable nodes(int lane) const { return table<Node>(pack_.nodes, lane); }
    LaneTable links(int lane) const { return table<Link>(pack_.links, lane); }
    LaneTable planes(int lane) const { return table<Plane>(pack_.planes, lane); }
    LaneTable limits(int lane) const { return table<Limit>(pack_.limits, lane); }

    template <class Visit> void each_particle(const Block& block, Visit&& visit) const {
        for (const auto& node : nodes_of(block).first(block.unknowns)) visit(node.row);
    }
    template <class Visit> void each_held(const Block& block, Visit&& visit) const {
        for (const auto& node : nodes_of(block).subspan(block.unknowns)) visit(node.row);
    }
    double length_of(const Block& block) const {
        double length = 0;
        for (const auto& link : links_of(block)) length += link.length;
        return length;
    }
    /// Calls link(row, i), plane(row, i) or limit(row, i) for each row of a block, i the index in the lane's table.
    template <class Visit, class VisitPlane, class VisitLimit>
    void each_row(const Block& block, Visit&& link, VisitPlane&& plane, VisitLimit&& limit) const {
        std::size_t i = 0, planes = 0, limits = 0;
        for (auto& row : links_of(block)) row.is_range() ? limit(row, limits++) : link(row, i++);
        for (auto& row : bends_of(block)) row.replaces_link ? plane(row, planes++) : limit(row, limits++);
    }

    void load(int lane, const Block& block) {
        const auto rows = nodes_of(block);
        for (std::size_t i = block.unknowns; i < rows.size(); ++i)
            nodes(lane).template put<D>(i, offsetof(Node, start), Base::held_position(rows[i].row));
        each_row(
            block,
            [&](const DistanceRow<D>& row, std::size_t i) {
                links(lane).at(i, offsetof(Link, length2)) = square(row.length);
                links(lane).at(i, offsetof(Link, per_length2)) = row.per_length2;
            },
            [&](const AngleRow<D>& row, std::size_t i) {
                planes(lane).at(i, offsetof(Plane, per_unit)) = 1 / row.unit;
            },
            [&](const auto& row, std::size_t i) { load_limit(row, lane, i); });
    }
    void load_limit(const DistanceRow<D>& row, int lane, std::size_t i) const {
        constexpr double margin = 2e-4, far = 1e30;
        limits(lane).at(i, offsetof(Limit, low)) = square(row.low) * (1 + margin);
        limits(lane).at(i, offsetof(Limit, high)) = min(square(row.high), far) * (1 - margin);
        limits(lane).at(i, offsetof(Limit, per_unit)) = 1 / (row.low * row.length);
    }
    void load_limit(const AngleRow<D>& row, int lane, std::size_t i) const {
        constexpr double margin = 1e-5;
        limits(lane).at(i, offsetof(Limit, low)) = (row.low + margin) * row.unit;
        limits(lane).at(i, offsetof(Limit, high)) = (row.high - margin) * row.unit;
        limits(lane).at(i, offsetof(Limit, per_unit)) = 1 / row.unit;
    }

    void load_tensions(int lane, const Block& block, double per) const {
        BlockTensions<D, Real>(Base::world_, Base::blocks_, block).load(per);
        take_tensions(lane, block);
    }
    void report_tensions(int lane, const Block& block, double substep) const {
        put_tensions(lane, block);
        BlockTensions<D, Real>(Base::world_, Base::blocks_, block).report(substep);
    }
    /// A limit with a tension keeps the block out of the lanes (ProgramLimit); within, none has one.
    void take_tensions(int lane, const Block& block) const {
        each_row(
            block, [&](const auto& row, std::size_t i) { links(lane).at(i, offsetof(Link, tension)) = row.before; },
            [&](const auto& row, std::size_t i) { planes(lane).at(i, offsetof(Plane, tension)) = row.before; },
            [&](const auto& row, std::size_t i) { limits(lane).at(i, offsetof(Limit, tension)) = row.before; });
    }
    void put_tensions(int lane, const Block& block) const {
        each_row(
            block, [&](auto& row, std::size_t i) { row.before = links(lane).at(i, offsetof(Link, tension)); },
            [&](auto& row, std::size_t i) { row.before = planes(lane).at(i, offsetof(Plane, tension)); },
            [](auto&, std::size_t) {});
    }
};

} // namespace sinew::detail
