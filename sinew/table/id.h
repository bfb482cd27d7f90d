#pragma once

#include "sinew/assert/assert.h"
#include "sinew/table/columns.h"
#include "sinew/table/stamp.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sinew {

/// Handle of a row, valid wherever the row moves. Copies of a world know the ids handed out before the copy; an id of a
/// removed row, of another world, or handed out in an undone future resolves to nothing.
template <class Tag> struct Id {
    std::uint32_t slot = ~std::uint32_t(0);
    std::uint32_t generation = Stamp::none; ///< stamp of the table when the row was added
    friend constexpr bool operator==(const Id&, const Id&) = default;
};

using Row = std::uint32_t;

/// Map from ids to rows. Rows are dense and keep their order when others are removed. Until a row is removed, or a copy
/// of a world is added to, slots equal rows, all of one generation, and no entry is stored.
template <class Tag> class Slots {
  public:
    /// Id of a new row at the end.
    Id<Tag> append() {
        const auto stamp = stamp_.get();
        if (rows_ == 0) plain_generation_ = stamp;
        if (stamp != plain_generation_) remember();
        if (plain_) return {rows_++, stamp};
        if (first_free_ == entries_.size()) entries_.push_back({.row = first_free_ + 1});
        const std::uint32_t slot = first_free_;
        SINEW_ASSERT(entries_[slot].row <= entries_.size(), "a free slot names the next free slot");
        first_free_ = entries_[slot].row;
        entries_[slot] = {.row = rows_++, .generation = stamp};
        slot_of_row_.push_back(slot);
        return {slot, stamp};
    }

    /// Row of an id; nothing for an id not handed out by this table, or removed. Any bits are safe.
    std::optional<Row> find(Id<Tag> id) const {
        if (id.slot >= slots() || generation(id.slot) != id.generation || !in_use(id.slot)) return std::nullopt;
        return row_at(id.slot);
    }

    Id<Tag> id_of(Row row) const { return {slot_of(row), generation(slot_of(row))}; }

    std::uint32_t slot_of(Row row) const {
        SINEW_ASSERT(row < rows_, "the row is in the table");
        return plain_ ? row : slot_of_row_[row];
    }
    /// The slot must be in use.
    Row row_at(std::uint32_t slot) const {
        SINEW_ASSERT(slot < slots(), "the slot has been handed out");
        return plain_ ? slot : entries_[slot].row;
    }
    bool in_use(std::uint32_t slot) const {
        const Row row = row_at(slot);
        return row < rows_ && slot_of(row) == slot;
    }
    std::size_t slots() const { return plain_ ? rows_ : entries_.size(); } ///< in use or free

    /// Forgets the rows whose flag in `gone` is set; the others close up in order.
    void erase(std::span<const char> gone) {
        SINEW_ASSERT(gone.size() == rows_, "every row has a flag");
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
        SINEW_ASSERT(rows_ <= entries_.size(), "every row has a slot");
    }

    /// Allocates the entries: afterwards erase() allocates nothing.
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
        Row row = 0; ///< free slot: the next free slot
        std::uint32_t generation = Stamp::none;
    };
    Row rows_ = 0;
    bool plain_ = true;                            ///< slots equal rows, and no entry is stored
    Stamp stamp_;                                  ///< generation of the next row
    std::uint32_t plain_generation_ = Stamp::none; ///< common to all rows while slots equal rows
    std::vector<std::uint32_t> slot_of_row_;
    std::vector<Entry> entries_;
    std::uint32_t first_free_ = 0; ///< entries_.size(): no slot is free

    std::uint32_t generation(std::uint32_t slot) const {
        return plain_ ? plain_generation_ : entries_[slot].generation;
    }
};

struct ParticleTag;
struct ConstraintTag;
struct PinTag;
using ParticleId = Id<ParticleTag>;
using PinId = Id<PinTag>;

/// Handle of a constraint. Kinds have separate tables, so the kind is part of the id.
struct ConstraintId {
    int kind = -1; ///< position in Kinds<D>
    Id<ConstraintTag> id;
    friend constexpr bool operator==(const ConstraintId&, const ConstraintId&) = default;
};

/// Index of a figure in World::figures, stable while the figure lives; a later figure may reuse the index.
using FigureIndex = std::uint32_t;
inline constexpr FigureIndex no_figure = ~FigureIndex(0); ///< loose particles belong to no figure

/// Handle of a figure, never reused.
struct FigureTag;
using FigureId = Id<FigureTag>;

} // namespace sinew
