#include "sinew/scene/fill_rule.h"

namespace sinew {
namespace {

using collide::Corners;

/// Outlines by the area that they enclose.
class Nesting {
  public:
    Nesting(const std::vector<SvgOutline>& outlines, bool is_even_odd)
        : outlines_(outlines), is_even_odd_(is_even_odd) {}

    bool cross(std::size_t i, std::size_t k) const {
        return collide::cross_each_other(outlines_[i].points, outlines_[k].points);
    }
    bool turn_alike(std::size_t i, std::size_t k) const { return winding(i) == winding(k); }
    /// True for outline i inside outline k.
    bool is_inside(std::size_t i, std::size_t k) const {
        return i != k && !cross(i, k) && collide::is_inside(outlines_[k].points, outlines_[i].points.front());
    }
    bool is_filled_inside(std::size_t i) const { return is_filled(around(i) + winding(i)); }
    bool is_filled_outside(std::size_t i) const { return is_filled(around(i)); }
    double area(std::size_t i) const { return std::abs(collide::twice_area(outlines_[i].points)); }

  private:
    const std::vector<SvgOutline>& outlines_;
    bool is_even_odd_;

    int winding(std::size_t i) const { return collide::twice_area(outlines_[i].points) < 0 ? -1 : 1; }
    int around(std::size_t i) const {
        int sum = 0;
        for (std::size_t k = 0; k < outlines_.size(); ++k)
            if (is_inside(i, k)) sum += winding(k);
        return sum;
    }
    bool is_filled(int windings) const { return is_even_odd_ ? windings % 2 != 0 : windings != 0; }
};

} // namespace

SolidOutlines solids_of(const std::vector<SvgOutline>& outlines, std::string_view fill_rule) {
    const bool is_even_odd = fill_rule == fill_rules[1];
    const Nesting nesting(outlines, is_even_odd);
    SolidOutlines found;
    std::vector<std::size_t> owner;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k)
            if (nesting.cross(i, k) && (is_even_odd || !nesting.turn_alike(i, k)))
                found.error = "outlines of this path cross where one of them is a hole; let them not cross";
        if (nesting.is_filled_outside(i) || !nesting.is_filled_inside(i)) continue;
        found.solids.push_back({outlines[i].points, {}});
        owner.push_back(i);
    }
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        if (nesting.is_filled_inside(i) || !nesting.is_filled_outside(i)) continue;
        std::size_t best = owner.size();
        for (std::size_t k = 0; k < owner.size(); ++k)
            if (nesting.is_inside(i, owner[k]) &&
                (best == owner.size() || nesting.area(owner[k]) < nesting.area(owner[best])))
                best = k;
        if (best < owner.size()) found.solids[best].holes.push_back(outlines[i].points);
    }
    return found;
}

} // namespace sinew
