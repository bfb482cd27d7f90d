#pragma once

#include "sinew/math/sort.h"
#include "sinew/world/contacts.h"

#include <algorithm>
#include <vector>

namespace sinew {

/// Sorts a list of touches and unites those of the same two figures: impulses add up.
inline void merge_touches(std::vector<FigureTouch>& touches) {
    sinew::sort(touches.begin(), touches.end(), [](const FigureTouch& a, const FigureTouch& b) {
        return std::tie(a.first, a.second, a.particle) < std::tie(b.first, b.second, b.particle);
    });
    std::size_t count = 0;
    for (const auto& touch : touches) {
        if (count == 0 || touches[count - 1] != touch) {
            touches[count++] = touch;
            continue;
        }
        auto& united = touches[count - 1];
        united.strength.impulse += touch.strength.impulse;
        if (touch.hardest > united.hardest)
            united.hardest = touch.hardest, united.particle = touch.particle, united.place = touch.place;
    }
    touches.resize(count);
}

} // namespace sinew
