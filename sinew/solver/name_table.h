#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

/// Names in the order they were given, each found in logarithmic time. Of equal names the first counts.
template <class Id> class NameTable {
  public:
    using Entry = std::pair<std::string, Id>;

    NameTable() = default;
    NameTable(std::initializer_list<Entry> entries) {
        for (const auto& [name, id] : entries) emplace_back(name, id);
    }

    void emplace_back(std::string_view name, Id id) {
        entries_.emplace_back(name, id);
        found_.emplace(name, id);
    }

    std::optional<Id> find(std::string_view name) const {
        const auto entry = found_.find(name);
        return entry == found_.end() ? std::nullopt : std::optional(entry->second);
    }

    /// Forgets every name whose id passes the test. Allocates nothing.
    template <class Test> void erase_if(Test&& test) {
        std::erase_if(entries_, [&](const Entry& entry) { return test(entry.second); });
        std::erase_if(found_, [&](const auto& entry) { return test(entry.second); });
    }

    auto begin() const { return entries_.begin(); }
    auto end() const { return entries_.end(); }
    std::size_t size() const { return entries_.size(); }
    bool empty() const { return entries_.empty(); }

  private:
    std::vector<Entry> entries_;
    std::map<std::string, Id, std::less<>> found_;
};

} // namespace sinew
