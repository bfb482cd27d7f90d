#pragma once

#include "sinew/assert/assert.h"
#include "sinew/table/columns.h"
#include "sinew/table/stamp.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sinew {

/// Handle of a row, valid wherever the row moves. Copies of a world know the ids handed out before the copy; an id of a
/// removed row, of another world, or handed out in an undone future resolves to nothing.
template <class Tag> struct Id {
    std::uint32_t index = ~std::uint32_t(0);
    std::uint32_t generation = Stamp::none; ///< stamp of the table when the row was added
    friend constexpr bool operator==(const Id&, const Id&) = default;
};

using Row = std::uint32_t;

/// Map from ids to rows. Rows are dense and keep their order when others are removed. Until a row is removed, or a copy
/// of a world is added to, indices equal rows, all of one generation, and no entry is stored.
template <class Tag> class HandleMap {
  public:
    /// Id of a new row at the end.
    Id<Tag> append() {
        const auto stamp = stamp_.get();
        if (rows_ == 0) plain_generation_ = stamp;
        if (stamp != plain_generation_) remember();
        if (plain_) return {rows_++, stamp};
        if (first_free_ == entries_.size()) entries_.push_back({.row = first_free_ + 1});
        const std::uint32_t index = first_free_;
        SINEW_ASSERT(entries_[index].row <= entries_.size(), "a free index names the next free one");
        first_free_ = entries_[index].row;
        entries_[index] = {.row = rows_++, .generation = stamp};
        index_of_row_.push_back(index);
        return {index, stamp};
    }

    /// Row of an id; nothing for an id not handed out by this table, or removed. Any bits are safe.
    std::optional<Row> find(Id<Tag> id) const {
        if (id.index >= indices() || generation(id.index) != id.generation || !in_use(id.index)) return std::nullopt;
        return row_at(id.index);
    }

    Id<Tag> id_of(Row row) const { return {index_of(row), generation(index_of(row))}; }

    std::uint32_t index_of(Row row) const {
        SINEW_ASSERT(row < rows_, "the row is in the table");
        return plain_ ? row : index_of_row_[row];
    }
    /// The index must be in use.
    Row row_at(std::uint32_t index) const {
        SINEW_ASSERT(index < indices(), "the index has been handed out");
        return plain_ ? index : entries_[index].row;
    }
    bool in_use(std::uint32_t index) const {
        const Row row = row_at(index);
        return row < rows_ && index_of(row) == index;
    }
    std::size_t indices() const { return plain_ ? rows_ : entries_.size(); } ///< in use or free

    /// Forgets the rows whose flag in `gone` is set; the others close up in order.
    void erase(std::span<const char> gone) {
        SINEW_ASSERT(gone.size() == rows_, "every row has a flag");
        Row kept = Row(next_flag(gone, 0, 1));
        if (kept == gone.size()) return;
        remember();
        stamp_.forget();
        for (Row row = kept; row < rows_; ++row) {
            const std::uint32_t index = index_of_row_[row];
            if (gone[row]) {
                entries_[index] = {.row = first_free_};
                first_free_ = index;
            } else {
                entries_[index].row = kept;
                index_of_row_[kept++] = index;
            }
        }
        index_of_row_.resize(kept);
        rows_ = kept;
        SINEW_ASSERT(rows_ <= entries_.size(), "every row has an index");
    }

    /// Allocates the entries: afterwards erase() allocates nothing.
    void remember() {
        if (!plain_) return;
        plain_ = false;
        index_of_row_.resize(rows_);
        entries_.resize(rows_);
        for (Row row = 0; row < rows_; ++row) {
            index_of_row_[row] = row;
            entries_[row] = {.row = row, .generation = plain_generation_};
        }
        first_free_ = rows_;
    }

    void reserve(std::size_t rows) {
        if (plain_) return;
        index_of_row_.reserve(rows);
        entries_.reserve(rows);
    }

    /// Gives the rows ids that another table has handed out, all different; a row without one (Id{}) gets a new id.
    void take_over(std::span<const Id<Tag>> wanted) {
        SINEW_ASSERT(wanted.size() == rows_, "every row has an entry");
        stamp_.forget();
        if (rows_ == 0) return;
        plain_ = is_plain(wanted);
        plain_generation_ = wanted[0].generation;
        index_of_row_.clear();
        entries_.clear();
        first_free_ = 0;
        if (!plain_) number(wanted);
    }

    /// Everything but the stamp of the next row, which a copy draws anew. Whoever writes calls is_sound() afterwards.
    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.rows_, self.plain_, self.plain_generation_, self.index_of_row_, self.entries_, self.first_free_);
    }
    /// False unless every row has an index of its own, and every other index is free.
    bool is_sound() const {
        if (plain_) return index_of_row_.empty() && entries_.empty();
        if (index_of_row_.size() != rows_ || rows_ > entries_.size()) return false;
        for (Row row = 0; row < rows_; ++row)
            if (index_of_row_[row] >= entries_.size() || entries_[index_of_row_[row]].row != row) return false;
        auto free = first_free_;
        for (auto left = entries_.size() - rows_; left > 0; --left) {
            if (free >= entries_.size() || in_use(free)) return false;
            free = entries_[free].row;
        }
        return free == entries_.size();
    }
    /// Makes sure that no later row of this process gets a generation of the table's.
    void pass_generations() const {
        Stamp::pass(plain_generation_);
        for (const auto& entry : entries_) Stamp::pass(entry.generation);
    }

    struct Entry {
        Row row = 0; ///< of a free index: the next free one
        std::uint32_t generation = Stamp::none;
    };

  private:
    Row rows_ = 0;
    bool plain_ = true;                            ///< indices equal rows, and no entry is stored
    Stamp stamp_;                                  ///< generation of the next row
    std::uint32_t plain_generation_ = Stamp::none; ///< common to all rows while indices equal rows
    std::vector<std::uint32_t> index_of_row_;
    std::vector<Entry> entries_;
    std::uint32_t first_free_ = 0; ///< entries_.size(): no index is free

    /// True if indices equal rows, and all are of one generation.
    static bool is_plain(std::span<const Id<Tag>> ids) {
        for (Row row = 0; row < ids.size(); ++row)
            if (ids[row] != Id<Tag>{row, ids[0].generation}) return false;
        return ids[0].generation != Stamp::none;
    }
    /// Fills the entries, which are empty: the wanted ids, then new ones at free indices, then the list of the free.
    void number(std::span<const Id<Tag>> wanted) {
        constexpr Row unused = ~Row(0);
        const auto is_wanted = [](const Id<Tag>& id) { return id.generation != Stamp::none; };
        index_of_row_.assign(rows_, 0);
        for (Row row = 0; row < rows_; ++row) {
            const auto& [index, generation] = wanted[row];
            if (!is_wanted(wanted[row])) continue;
            if (index >= entries_.size()) entries_.resize(std::size_t(index) + 1, {.row = unused});
            entries_[index] = {.row = row, .generation = generation};
            index_of_row_[row] = index;
        }
        std::uint32_t next = 0;
        for (Row row = 0; row < rows_; ++row) {
            if (is_wanted(wanted[row])) continue;
            while (next < entries_.size() && entries_[next].row != unused) ++next;
            if (next == entries_.size()) entries_.emplace_back();
            entries_[next] = {.row = row, .generation = stamp_.get()};
            index_of_row_[row] = next;
        }
        first_free_ = std::uint32_t(entries_.size());
        for (auto index = first_free_; index-- > 0;)
            if (entries_[index].row == unused) entries_[index] = {.row = std::exchange(first_free_, index)};
    }

    std::uint32_t generation(std::uint32_t index) const {
        return plain_ ? plain_generation_ : entries_[index].generation;
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
