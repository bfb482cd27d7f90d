#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/direct/eligibility.h"
#include "sinew/world/constraint_graph.h"

#include <algorithm>

namespace sinew::detail {

/// Trees and figures attached to a component with too many loops: ropes on a cloth, a ragdoll in a hammock.
template <int D, class Real> class AttachedPieces {
  public:
    AttachedPieces(const World<D, Real>& world, const BlockGraph<D, Real>& graph,
                   const BlockEligibility<D, Real>& worth, BlockRoom& room)
        : world_(world), particles_(world.particles), graph_(graph), worth_(worth), room_(room) {}

    /// Turns trees, and figures eligible for a block, into blocks with ports (ports/ports.h). SweepState particles at
    /// the other end of a link become nodes, too: all pieces attached to one particle form one block.
    template <class Build> void find(std::span<const Row> members, Build&& build) {
        peel(members);
        auto& direct = room_.direct;
        for (const Row row : members) direct[row] = 0;
        for (const Row row : room_.peeled) direct[row] = 1;
        find_skeletons(members);
        for (const Row row : members) room_.pieces.separate(row), room_.part_of[row] = no_row;
        for (const Row row : members) unite_with_neighbours(row);
        auto& pieces = room_.trees;
        pieces.clear();
        for (const Row row : members)
            if (room_.part_of[row] != no_row) pieces.push_back({room_.pieces.first_of(row), row});
        sinew::sort(pieces.begin(), pieces.end());
        for (const auto& [first, row] : pieces) room_.part_of[row] = no_row;
        for (std::size_t first = 0, end = 0; first < pieces.size(); first = end) {
            room_.tree.clear();
            const Row root = pieces[first].first;
            for (; end < pieces.size() && pieces[end].first == root; ++end) room_.tree.push_back(pieces[end].second);
            if (room_.tree.size() < members.size())
                build_piece(root, build); // the whole component has been judged already
        }
    }

  private:
    using Part = BlockRoom::Part;

    const World<D, Real>& world_;
    const Particles<D, Real>& particles_;
    const BlockGraph<D, Real>& graph_;
    const BlockEligibility<D, Real>& worth_;
    BlockRoom& room_;

    bool mobile(Row particle) const { return graph_.mobile(particle); }

    /// Pieces with many joints, as a rope sewn to a mesh along its length, are left to the sweep.
    template <class Build> void build_piece(Row root, Build&& build) {
        constexpr std::size_t max_joints = 16;
        const auto& all = room_.tree;
        const auto joints =
            std::size_t(std::count_if(all.begin(), all.end(), [&](Row row) { return !room_.direct[row]; }));
        if (joints > max_joints || !build(all, root)) return;
        for (const Row row : all)
            if (room_.direct[row]) room_.attached.push_back(row);
    }

    /// Unites a particle with neighbours over links with a direct end, and over links between different figures. A link
    /// to fixed particles is a piece by itself.
    void unite_with_neighbours(Row row) {
        if (room_.direct[row]) room_.part_of[row] = row;
        for_each_link(world_, row, [&](Row link, Row other) {
            const bool joins = particles_.figure[row] != particles_.figure[other];
            if (!graph_.may_hang(link) || !(room_.direct[row] || joins)) return;
            room_.part_of[row] = row;
            if (!mobile(other)) return;
            room_.part_of[other] = other;
            room_.pieces.join(row, other);
        });
    }

    /// Marks figures joined to others, but eligible for a block alone.
    void find_skeletons(std::span<const Row> members) {
        auto& figures = room_.figures;
        figures.clear();
        for (const Row row : members)
            if (particles_.figure[row] < world_.figures.size()) figures.push_back({particles_.figure[row], row});
        sinew::sort(figures.begin(), figures.end());
        for (std::size_t first = 0, end = 0; first < figures.size(); first = end) {
            while (end < figures.size() && figures[end].first == figures[first].first) ++end;
            const auto own = std::span(figures).subspan(first, end - first);
            if (own.size() == members.size() || !is_skeleton(own)) continue;
            for (const auto& [figure, row] : own) room_.direct[row] = 1;
        }
    }
    /// Judges a figure by the constraints among its particles. A small mesh is left to the sweep: several joined have
    /// too many loops.
    bool is_skeleton(std::span<const std::pair<FigureIndex, Row>> own) const {
        Part part;
        for (const auto& [figure, row] : own) {
            worth_.take_stock(part, row);
            for_each_constraint(world_, row,
                                [&](const auto& table, Row constraint) { take_stock(part, table, constraint, row); });
        }
        return part.suits && worth_.worthwhile(part) && part.inner_links <= 2 * part.particles;
    }
    /// Constraints count at their first movable particle.
    template <class Table> void take_stock(Part& part, const Table& table, Row constraint, Row row) const {
        std::uint32_t moving = 0;
        for (const Row member : table.members[constraint]) {
            if (!mobile(member)) continue;
            if (particles_.figure[member] != particles_.figure[row] || (moving == 0 && member != row)) return;
            ++moving;
        }
        worth_.take_stock(part, table, constraint, moving);
        part.suits = part.suits && graph_.is_rigid(table, constraint);
    }

    /// True if a constraint other than a distance acts on a particle that blocks with ports cannot hold.
    bool is_soft(Row row) const {
        bool found = false;
        for_each_constraint(world_, row, [&]<class Table>(const Table& table, Row constraint) {
            if constexpr (!std::is_same_v<typename Table::Kind, Distance<D>>)
                found = found || !graph_.is_rigid(table, constraint);
        });
        return found;
    }

    /// Removes leaves until none is left; all removed particles form trees.
    void peel(std::span<const Row> members) {
        auto& adjacency = room_.adjacency; // number of links to movable neighbours not yet removed
        auto& peeled = room_.peeled;
        peeled.clear();
        constexpr Row never = 1 << 20; // more than a particle has links
        for (const Row row : members) {
            room_.parent[row] = no_row;
            adjacency[row] = 0;
            for_each_link(world_, row, [&](Row link, Row other) {
                if (mobile(other)) adjacency[row] += graph_.may_hang(link) ? 1 : never;
            });
            if (is_soft(row)) adjacency[row] += never;
            if (adjacency[row] == 1) peeled.push_back(row);
        }
        std::size_t kept = 0;
        for (std::size_t i = 0; i < peeled.size(); ++i) { // grows on the way
            const Row row = peeled[i];
            if (adjacency[row] != 1) continue; // the last of a tree
            const Row parent = neighbour_left(row);
            room_.parent[row] = parent;
            adjacency[row] = 0;
            if (--adjacency[parent] == 1) peeled.push_back(parent);
            peeled[kept++] = row;
        }
        peeled.resize(kept);
    }

    Row neighbour_left(Row row) const {
        Row left = no_row;
        for_each_link(world_, row, [&](Row, Row other) {
            if (left == no_row && mobile(other) && room_.parent[other] == no_row) left = other;
        });
        return left;
    }
};

} // namespace sinew::detail
