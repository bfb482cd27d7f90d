#pragma once

#include "sinew/scene/text.h"

#include "files/in/import.h"

#include <map>
#include <utility>

namespace sinew::files {

/// Notes of a reader; many of one kind become one with their number and the first place.
class Notes {
  public:
    void add(std::string place, std::string message) {
        if (list_.size() >= ImportLimits::notes)
            ++dropped_;
        else
            list_.push_back({std::move(place), std::move(message)});
    }

    /// Counts something of a kind: "texture coordinates are not taken".
    void count(const std::string& place, const std::string& message) {
        if (counted_.size() >= ImportLimits::notes && !counted_.contains(message)) return void(++dropped_);
        ++counted_.try_emplace(message, place, 0).first->second.second;
    }

    std::vector<Note> taken() {
        for (const auto& [message, seen] : counted_) {
            const auto more = seen.second > 1 ? concat(" (and ", seen.second - 1, " more)") : std::string();
            list_.push_back({seen.first, message + more});
        }
        if (dropped_ > 0) list_.push_back({"", concat(dropped_, " more such notes")});
        counted_.clear();
        return std::move(list_);
    }

  private:
    std::vector<Note> list_;
    std::map<std::string, std::pair<std::string, std::size_t>> counted_;
    std::size_t dropped_ = 0;
};

} // namespace sinew::files
