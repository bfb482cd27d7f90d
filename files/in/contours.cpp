#include "files/in/contours.h"

#include <array>
#include <cstdint>
#include <unordered_map>

namespace sinew::files {
namespace {

/// Side of a square between four neighbouring pixels; a square is at its top left pixel.
enum CellSide : int { top, right, bottom, left };

struct CellCut {
    int from = 0, to = 0; ///< sides of a cell
};

/// Cuts of a cell by the corners above the level: 1 top left, 2 top right, 4 bottom right, 8 bottom left. Two opposite
/// corners: joined if the middle is above the level, too.
std::vector<CellCut> cuts_of(int corners, bool is_middle_above) {
    switch (corners) {
    case 1:
        return {{top, left}};
    case 2:
        return {{right, top}};
    case 3:
        return {{right, left}};
    case 4:
        return {{bottom, right}};
    case 5:
        return is_middle_above ? std::vector<CellCut>{{top, right}, {bottom, left}}
                               : std::vector<CellCut>{{top, left}, {bottom, right}};
    case 6:
        return {{bottom, top}};
    case 7:
        return {{bottom, left}};
    case 8:
        return {{left, bottom}};
    case 9:
        return {{top, bottom}};
    case 10:
        return is_middle_above ? std::vector<CellCut>{{right, bottom}, {left, top}}
                               : std::vector<CellCut>{{right, top}, {left, bottom}};
    case 11:
        return {{right, bottom}};
    case 12:
        return {{left, right}};
    case 13:
        return {{top, right}};
    case 14:
        return {{left, top}};
    default:
        return {};
    }
}

class ContourTracer {
  public:
    ContourTracer(const PixelField& field, double level) : field_(field), level_(level) {}

    std::vector<Outline> all() {
        for (int y = -1; y < field_.height; ++y)
            for (int x = -1; x < field_.width; ++x) cut(x, y);
        std::vector<Outline> outlines;
        for (const auto start : order_) {
            Outline outline;
            for (auto key = start; true;) {
                const auto found = next_.find(key);
                if (found == next_.end()) break;
                outline.push_back(point_on(key));
                key = found->second;
                next_.erase(found);
            }
            if (outline.size() > 2) outlines.push_back(std::move(outline));
        }
        return outlines;
    }

  private:
    using Key = std::uint64_t; ///< of the line between two pixels: the first one, and whether the other is below
    const PixelField& field_;
    const double level_;
    std::unordered_map<Key, Key> next_;
    std::vector<Key> order_;

    double value(int x, int y) const {
        return x < 0 || y < 0 || x >= field_.width || y >= field_.height ? 0 : field_.at(x, y);
    }
    Key key_of(int x, int y, int side) const {
        const bool is_down = side == left || side == right;
        if (side == right) ++x;
        if (side == bottom) ++y;
        return (Key(std::uint32_t(y + 1)) << 33U) | (Key(std::uint32_t(x + 1)) << 1U) | Key(is_down);
    }
    Vec2<double> point_on(Key key) const {
        const int x = int(std::uint32_t(key >> 1U)) - 1, y = int(key >> 33U) - 1;
        const bool is_down = (key & 1U) != 0;
        const double a = value(x, y), b = is_down ? value(x, y + 1) : value(x + 1, y);
        const double share = (level_ - a) / (b - a);
        return {{x + 0.5 + (is_down ? 0 : share), y + 0.5 + (is_down ? share : 0)}};
    }

    void cut(int x, int y) {
        const std::array corners{value(x, y), value(x + 1, y), value(x + 1, y + 1), value(x, y + 1)};
        int above = 0;
        for (std::size_t i = 0; i < 4; ++i) above |= corners[i] > level_ ? 1 << i : 0;
        if (above == 0 || above == 15) return;
        const double middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
        for (const auto& [from, to] : cuts_of(above, middle > level_)) {
            const auto key = key_of(x, y, from);
            next_[key] = key_of(x, y, to);
            order_.push_back(key);
        }
    }
};

} // namespace

std::vector<Outline> contours(const PixelField& field, double level) {
    return ContourTracer(field, level).all();
}

} // namespace sinew::files
