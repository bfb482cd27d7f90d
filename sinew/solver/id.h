#pragma once

#include "sinew/solver/columns.h"
#include "sinew/solver/stamp.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sinew {

/// A handle of a row that outlives the row's moves. Copies of a world know the ids it handed out before the copy; an id
/// of a removed row, of another world, or handed out in a future that was undone resolves to nothing.
template <class Tag> struct Id {
    std::uint32_t slot = ~std::uint32_t(0);
    std::uint32_t generation = Stamp::none; ///< the table's stamp when the row was added
    friend constexpr bool operator==(const Id&, const Id&) = default;
};

using Row = std::uint32_t;

/// Which row an id stands for. Rows are dense and keep their order when others are removed. Until one is, or a copy is
/// added to, slots are rows of one generation and nothing has to be remembered.
template <class Tag> class Slots {
  public:
    /// The id of a new row at the end.
    Id<Tag> append() {
        const auto stamp = stamp_.get();
        if (rows_ == 0) plain_generation_ = stamp;
        if (stamp != plain_generation_) remember();
        if (plain_) return {rows_++, stamp};
        if (first_free_ == entries_.size()) entries_.push_back({.row = first_free_ + 1});
        const std::uint32_t slot = first_free_;
        first_free_ = entries_[slot].row;
        entries_[slot] = {.row = rows_++, .generation = stamp};
        slot_of_row_.push_back(slot);
        return {slot, stamp};
    }

    /// Any bits may be asked for: what was not handed out by this table, or is gone, is not found.
    std::optional<Row> find(Id<Tag> id) const {
        if (id.slot >= slots() || generation(id.slot) != id.generation || !in_use(id.slot)) return std::nullopt;
        return row_at(id.slot);
    }

    Id<Tag> id_of(Row row) const { return {slot_of(row), generation(slot_of(row))}; }

    std::uint32_t slot_of(Row row) const { return plain_ ? row : slot_of_row_[row]; }
    Row row_at(std::uint32_t slot) const { return plain_ ? slot : entries_[slot].row; } ///< of a slot that is in use
    bool in_use(std::uint32_t slot) const {
        const Row row = row_at(slot);
        return row < rows_ && slot_of(row) == slot;
    }
    std::size_t slots() const { return plain_ ? rows_ : entries_.size(); } ///< in use or free

    /// Forgets the rows whose flag in `gone` is set; the rest close up in order.
    void erase(std::span<const char> gone) {
        Row kept = Row(next_flag(gone, 0, 1));
        if (kept == gone.size()) return;
        remember();
        stamp_.forget();
        for (Row row = kept; row < rows_; ++row) {
            const std::uint32_t slot = slot_of_row_[row];
            if (gone[row]) {
                entries_[slot] = {.row = first_free_};
                first_free_ = slot;
            } else {
                entries_[slot].row = kept;
                slot_of_row_[kept++] = slot;
            }
        }
        slot_of_row_.resize(kept);
        rows_ = kept;
    }

    /// From now on erasing allocates nothing.
    void remember() {
        if (!plain_) return;
        plain_ = false;
        slot_of_row_.resize(rows_);
        entries_.resize(rows_);
        for (Row row = 0; row < rows_; ++row) {
            slot_of_row_[row] = row;
            entries_[row] = {.row = row, .generation = plain_generation_};
        }
        first_free_ = rows_;
    }

    void reserve(std::size_t rows) {
        if (plain_) return;
        slot_of_row_.reserve(rows);
        entries_.reserve(rows);
    }

  private:
    struct Entry {
        Row row = 0; ///< of a slot that is free: the next free slot
        std::uint32_t generation = Stamp::none;
    };
    Row rows_ = 0;
    bool plain_ = true;                            ///< slots are rows, and the rest is empty
    Stamp stamp_;                                  ///< of the rows that are added next
    std::uint32_t plain_generation_ = Stamp::none; ///< of all rows while slots are rows
    std::vector<std::uint32_t> slot_of_row_;
    std::vector<Entry> entries_;
    std::uint32_t first_free_ = 0; ///< entries_.size(): none is

    std::uint32_t generation(std::uint32_t slot) const {
        return plain_ ? plain_generation_ : entries_[slot].generation;
    }
};

struct ParticleTag;
struct ConstraintTag;
struct PinTag;
using ParticleId = Id<ParticleTag>;
using PinId = Id<PinTag>;

/// Constraints of different kinds live in different tables: the kind is part of the id.
struct ConstraintId {
    int kind = -1; ///< position in Kinds<D>
    Id<ConstraintTag> id;
    friend constexpr bool operator==(const ConstraintId&, const ConstraintId&) = default;
};

/// A figure's place in World::figures. It stays while the figure lives; once that is removed, another may come there.
using FigureIndex = std::uint32_t;
inline constexpr FigureIndex no_figure = ~FigureIndex(0); ///< loose particles belong to no figure

/// A figure's handle, which is never another's.
struct FigureTag;
using FigureId = Id<FigureTag>;

} // namespace sinew
