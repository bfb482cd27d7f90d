#pragma once

#include "sinew/assert/assert.h"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

/// Table of names in the order of insertion, with look-up in logarithmic time. Of equal names the first counts. Up to
/// `few` names are searched without an index, which would take more memory than the names in each of many figures.
template <class Id> class NameTable {
  public:
    using Entry = std::pair<std::string, Id>;

    NameTable() = default;
    NameTable(std::initializer_list<Entry> entries) {
        for (const auto& [name, id] : entries) emplace_back(name, id);
    }

    void emplace_back(std::string_view name, Id id) {
        entries_.emplace_back(name, id);
        if (!found_.empty())
            found_.emplace(name, id);
        else if (entries_.size() > few)
            found_.insert(entries_.begin(), entries_.end());
    }

    std::optional<Id> find(std::string_view name) const {
        if (found_.empty()) {
            const auto entry = std::ranges::find(entries_, name, &Entry::first);
            return entry == entries_.end() ? std::nullopt : std::optional(entry->second);
        }
        const auto entry = found_.find(name);
        return entry == found_.end() ? std::nullopt : std::optional(entry->second);
    }

    /// Erases every name whose id passes the test. Allocates nothing, as long as no name was given twice.
    template <class Test> void erase_if(Test&& test) {
        std::erase_if(entries_, [&](const Entry& entry) { return test(entry.second); });
        const auto erased = std::erase_if(found_, [&](const auto& entry) { return test(entry.second); });
        if (erased > 0 && found_.size() < entries_.size())
            for (const auto& [name, id] : entries_) found_.try_emplace(name, id);
        SINEW_ASSERT(found_.size() <= entries_.size(), "the index holds names of the table only");
    }

    auto begin() const { return entries_.begin(); }
    auto end() const { return entries_.end(); }
    std::size_t size() const { return entries_.size(); }
    bool empty() const { return entries_.empty(); }

  private:
    static constexpr std::size_t few = 8;
    std::vector<Entry> entries_;
    std::map<std::string, Id, std::less<>> found_; ///< index; empty up to `few` names
};

} // namespace sinew
