#pragma once

#include "sinew/world/changes.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sinew {

/// Vertex split: the new owner of each neighbour of a split particle.
struct VertexSplit {
    Row row = 0;
    std::vector<Row> neighbours; ///< sorted
    std::vector<Row> goes_to;    ///< the split particle, or one of the doubles

    /// Owner of a neighbour; nothing for other rows.
    std::optional<Row> side_of(Row neighbour) const {
        const auto found = std::lower_bound(neighbours.begin(), neighbours.end(), neighbour);
        if (found == neighbours.end() || *found != neighbour) return std::nullopt;
        return goes_to[std::size_t(found - neighbours.begin())];
    }
};

/// The vertex splits of one cut, at most one of a particle.
class VertexSplits {
  public:
    VertexSplits() = default;
    /// `particles`: number of rows before the splits.
    explicit VertexSplits(std::size_t particles) : index_(particles, none) {}

    void add(VertexSplit split) {
        index_[split.row] = splits_.size();
        splits_.push_back(std::move(split));
    }
    bool empty() const { return splits_.empty(); }
    /// The split of a particle; null if there is none.
    const VertexSplit* at(Row row) const {
        return row < index_.size() && index_[row] != none ? &splits_[index_[row]] : nullptr;
    }

  private:
    static constexpr std::size_t none = ~std::size_t(0);
    std::vector<VertexSplit> splits_;
    std::vector<std::size_t> index_; ///< by row: index of the split, or none
};

/// Moves constraints and drawn pieces to the doubles of split particles.
template <int D, class Real> class SplitFollower {
  public:
    /// Keeps references to world and splits.
    SplitFollower(World<D, Real>& world, const VertexSplits& splits) : world_(world), splits_(splits) {}

    void follow() {
        follow_constraints();
        for (auto& figure : world_.figures) follow_pieces(figure);
    }

  private:
    World<D, Real>& world_;
    const VertexSplits& splits_;

    /// Moves constraints to the particle on the side of their other members; removes constraints with members on
    /// several sides.
    void follow_constraints() {
        std::vector<ConstraintId> torn_apart;
        int kind = 0;
        std::vector<Row> moved;
        for_each_table(world_, [&](auto& table) {
            for (Row row = 0; row < table.size(); ++row) {
                const auto members = table.members[row];
                moved.assign(members.begin(), members.end());
                bool whole = true;
                for (std::size_t i = 0; i < members.size(); ++i)
                    if (const auto* parting = splits_.at(members[i]))
                        whole = follow(*parting, members, moved[i]) && whole;
                if (!whole) torn_apart.push_back({kind, table.handles.id_of(row)});
                for (std::size_t i = 0; i < members.size(); ++i) move(table, kind, row, i, moved[i]);
            }
            ++kind;
        });
        remove_constraints(world_, std::span<const ConstraintId>(torn_apart));
    }

    template <class Table> void move(Table& table, int kind, Row row, std::size_t member, Row to) {
        Row& from = table.members[row][member];
        if (from == to) return;
        detail::note_member_gone(world_, table, kind, row, from);
        detail::note_member(world_, table, kind, row, to);
        from = to;
    }

    static bool follow(const VertexSplit& parting, std::span<const Row> members, Row& moved) {
        bool followed = false;
        for (const Row member : members) {
            const auto side = parting.side_of(member);
            if (!side) continue;
            if (followed && *side != moved) return false;
            moved = *side;
            followed = true;
        }
        return true;
    }

    /// Divides a line at a split particle if the two sides have different owners.
    void follow_pieces(Figure& figure) {
        std::vector<Piece> pieces;
        pieces.reserve(figure.pieces.size());
        for (auto& piece : figure.pieces) {
            const bool parted = std::any_of(piece.particles.begin(), piece.particles.end(), [&](ParticleId id) {
                const auto row = row_of(world_, id);
                return row && splits_.at(*row);
            });
            if (parted && piece.mark == Mark::fragment)
                pieces.push_back(followed(std::move(piece)));
            else if (parted && piece.mark != Mark::dot)
                follow(piece, pieces);
            else
                pieces.push_back(std::move(piece));
        }
        figure.pieces = std::move(pieces);
    }

    /// Moves a fragment's particles to the side of their neighbours within the fragment.
    Piece followed(Piece piece) const {
        IdList<ParticleId> ids;
        for (const auto id : piece.particles) {
            const auto row = row_of(world_, id);
            const auto* parting = row ? splits_.at(*row) : nullptr;
            std::optional<Row> side;
            for (const auto other : piece.particles)
                if (const auto near = row_of(world_, other); parting && near && !side) side = parting->side_of(*near);
            ids.push_back(side ? world_.particles.handles.id_of(*side) : id);
        }
        piece.particles = std::move(ids);
        return piece;
    }

    void follow(const Piece& piece, std::vector<Piece>& pieces) const {
        const bool closed = piece.mark == Mark::loop || piece.mark == Mark::fill || is_cloth(piece.mark);
        const auto& ids = piece.particles;
        const std::size_t size = ids.size();
        const auto id_on = [&](const VertexSplit& parting, ParticleId other) -> std::optional<ParticleId> {
            const auto row = row_of(world_, other);
            const auto side = row ? parting.side_of(*row) : std::nullopt;
            return side ? std::optional(world_.particles.handles.id_of(*side)) : std::nullopt;
        };
        Piece part = piece;
        part.particles.clear();
        for (std::size_t i = 0; i < size; ++i) {
            const auto row = row_of(world_, ids[i]);
            const auto* parting = row ? splits_.at(*row) : nullptr;
            const bool has_last = closed || i > 0, has_next = closed || i + 1 < size;
            const auto from = parting && has_last ? id_on(*parting, ids[(i + size - 1) % size]) : std::nullopt;
            const auto on = parting && has_next ? id_on(*parting, ids[(i + 1) % size]) : std::nullopt;
            part.particles.push_back(from ? *from : on ? *on : ids[i]);
            if (closed || !from || !on || *from == *on) continue;
            pieces.push_back(part);
            part.particles = {*on};
        }
        pieces.push_back(std::move(part));
    }
};

} // namespace sinew
