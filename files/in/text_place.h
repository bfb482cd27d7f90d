#pragma once

#include "sinew/scene/text.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::files {

/// Lines and columns of a text. A file can have a million places to tell: none is looked for from the beginning.
class TextPlaces {
  public:
    explicit TextPlaces(std::string_view text) {
        for (std::size_t i = 0; i < text.size(); ++i)
            if (text[i] == '\n') starts_.push_back(i + 1);
    }

    /// Line and column of a byte, from 1: "12:5". Columns count bytes.
    std::string at(std::size_t offset) const {
        const auto line = std::ranges::upper_bound(starts_, offset) - starts_.begin();
        return concat(line, ":", offset - starts_[std::size_t(line) - 1] + 1);
    }

  private:
    std::vector<std::size_t> starts_{0};
};

} // namespace sinew::files
