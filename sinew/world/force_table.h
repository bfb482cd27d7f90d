#pragma once

#include "sinew/table/id.h"
#include "sinew/world/force.h"

#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

namespace sinew {

struct ForceTag;
using ForceId = Id<ForceTag>;

/// Force fields of a world, each with an id. Rows keep their order when others are removed.
template <int D, class Real> class ForceTable {
  public:
    using Law = Force<D, Real>;
    static constexpr std::uint32_t no_tag = ~std::uint32_t(0);

    ForceTable() = default;
    ForceTable(std::initializer_list<Law> laws) {
        for (const auto& law : laws) push_back(law);
    }

    /// `tag`: chosen by the owner; in a scene 0 for its gravity, and 1 and up for its list of forces.
    ForceId push_back(const Law& law, std::uint32_t tag = no_tag) {
        laws_.push_back(law);
        tags_.push_back(tag);
        return handles_.append();
    }
    /// False for an unknown id.
    bool remove(ForceId id) {
        const auto row = row_of(id);
        if (!row) return false;
        std::vector<char> gone(size(), 0);
        gone[*row] = 1;
        erase(gone);
        return true;
    }
    /// Removes the fields for which is_gone(law) is true.
    template <class IsGone> void erase_if(const IsGone& is_gone) {
        std::vector<char> gone;
        for (const auto& law : laws_) gone.push_back(is_gone(law) ? 1 : 0);
        erase(gone);
    }
    void clear() {
        erase_if([](const Law&) { return true; });
    }

    /// A field for reading and for changing; null for an unknown id.
    Law* find(ForceId id) {
        const auto row = row_of(id);
        return row ? &laws_[*row] : nullptr;
    }
    const Law* find(ForceId id) const { return const_cast<ForceTable*>(this)->find(id); }
    std::optional<Row> row_of(ForceId id) const { return handles_.find(id); }
    ForceId id_of(Row row) const { return handles_.id_of(row); }
    std::uint32_t tag_of(Row row) const { return tags_[row]; }

    std::size_t size() const { return laws_.size(); }
    bool empty() const { return laws_.empty(); }
    Law& operator[](Row row) { return laws_[row]; }
    const Law& operator[](Row row) const { return laws_[row]; }
    auto begin() { return laws_.begin(); }
    auto end() { return laws_.end(); }
    auto begin() const { return laws_.begin(); }
    auto end() const { return laws_.end(); }

    /// Gives the rows ids of another table: HandleMap::take_over.
    void take_over(std::span<const ForceId> wanted) { handles_.take_over(wanted); }
    void pass_generations() const { handles_.pass_generations(); }

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        auto& [laws, tags, handles] = self;
        visit(laws, tags, handles);
    }

  private:
    std::vector<Law> laws_;
    std::vector<std::uint32_t> tags_;
    HandleMap<ForceTag> handles_;

    void erase(std::span<const char> gone) {
        erase_rows(laws_, gone);
        erase_rows(tags_, gone);
        handles_.erase(gone);
    }
};

} // namespace sinew
