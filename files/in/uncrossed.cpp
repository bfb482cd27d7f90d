#include "files/in/uncrossed.h"

#include "sinew/collide/decompose.h"
#include "sinew/scene/fill_rule.h"

#include "files/in/segment_cuts.h"

#include <algorithm>
#include <limits>
#include <map>

namespace sinew::files {
namespace {

/// A piece of outlines between two crossings, and how often more they run along it than back.
struct Border {
    Spot from, to;
    int passes = 0;
};

std::vector<Border> borders_of(const std::vector<Segment>& pieces) {
    std::map<Segment, int> passes;
    for (const auto& [a, b] : pieces) {
        if (a < b)
            ++passes[{a, b}];
        else
            --passes[{b, a}];
    }
    std::vector<Border> borders;
    for (const auto& [ends, count] : passes)
        if (count != 0) borders.push_back({ends.first, ends.second, count});
    return borders;
}

/// Winding numbers beside a border.
struct Windings {
    int left = 0, right = 0;
};

/// Counts passes across a ray from the middle of a border, along x or along y, whichever is more across it.
Windings windings_at(const std::vector<Border>& borders, const Border& at) {
    const bool is_along_x = std::abs(at.to.second - at.from.second) >= std::abs(at.to.first - at.from.first);
    const auto along = [&](const Spot& s) { return double(is_along_x ? s.second : s.first); };
    const double middle_x = double(at.from.first + at.to.first) / 2;
    const double middle_y = double(at.from.second + at.to.second) / 2;
    const double level = is_along_x ? middle_y : middle_x;
    int beyond = 0; // winding number just beside the border, on the ray's side
    for (const auto& b : borders) {
        if (&b == &at || (along(b.from) > level) == (along(b.to) > level)) continue;
        const double turn = double(b.to.first - b.from.first) * (middle_y - double(b.from.second)) -
                            double(b.to.second - b.from.second) * (middle_x - double(b.from.first));
        const bool is_rising = along(b.to) > along(b.from);
        // A rising border is beyond where the middle is left of it, along y right of it.
        if ((turn > 0) != (is_rising == is_along_x)) continue;
        beyond += is_rising == is_along_x ? b.passes : -b.passes;
    }
    const bool is_rising = along(at.to) > along(at.from);
    if (is_rising == is_along_x) return {beyond + at.passes, beyond};
    return {beyond, beyond - at.passes};
}

/// Borders that are filled on their left alone, by their beginnings.
std::multimap<Spot, Spot> directed_borders(const std::vector<Border>& borders, bool is_even_odd) {
    const auto is_filled = [&](int winding) { return is_even_odd ? winding % 2 != 0 : winding != 0; };
    std::multimap<Spot, Spot> directed;
    for (const auto& border : borders) {
        const auto windings = windings_at(borders, border);
        const bool left = is_filled(windings.left), right = is_filled(windings.right);
        if (left && !right) directed.insert({border.from, border.to});
        if (right && !left) directed.insert({border.to, border.from});
    }
    return directed;
}

/// True if the way from `at` to `a` comes before that to `b`, clockwise from the way back to `before`.
bool is_sooner(const Spot& before, const Spot& at, const Spot& a, const Spot& b) {
    const auto is_late = [&](const Spot& to) { return turn_of(at, before, to) > 0; };
    if (is_late(a) != is_late(b)) return is_late(b);
    return turn_of(at, a, b) < 0;
}

/// Closed loops of directed borders. Where several meet, a loop goes round the nearest filled corner: areas that touch
/// at a corner come apart, and a hole that touches its outline is a bay of it.
std::vector<Outline> loops_of(std::multimap<Spot, Spot> directed) {
    std::vector<Outline> loops;
    while (!directed.empty()) {
        const Segment first = *directed.begin();
        auto border = first;
        Outline& loop = loops.emplace_back();
        for (bool is_closed = false; !is_closed;) {
            loop.push_back(place_of(border.first));
            const auto& [before, at] = border;
            const auto [begin, end] = directed.equal_range(at);
            if (begin == end) return {}; // never: as many borders begin at a spot as end there
            const auto next = std::min_element(
                begin, end, [&](const auto& a, const auto& b) { return is_sooner(before, at, a.second, b.second); });
            border = *next;
            directed.erase(next);
            is_closed = border == first;
        }
    }
    return loops;
}

/// Each hole lies in the smallest outline around it.
std::vector<Area> nested(const std::vector<Outline>& loops) {
    std::vector<Area> areas;
    for (const auto& loop : loops)
        if (collide::twice_area(loop) > 0) areas.push_back({loop});
    for (const auto& loop : loops) {
        if (!(collide::twice_area(loop) < 0)) continue;
        const auto middle = (loop[0] + loop[1]) * 0.5; // of a border, which no other loop has
        Area* around = nullptr;
        double least = std::numeric_limits<double>::infinity();
        for (auto& area : areas) {
            const double size = collide::twice_area(area[0]);
            if (size < least && collide::is_inside(area[0], middle)) around = &area, least = size;
        }
        if (around) around->push_back(loop);
    }
    return areas;
}

} // namespace

bool have_crossings(const std::vector<Outline>& outlines) {
    std::vector<Segment> segments;
    for (const auto& outline : outlines)
        for (std::size_t i = 0; i < outline.size(); ++i)
            segments.push_back({spot_of(outline[i]), spot_of(outline[(i + 1) % outline.size()])});
    const auto are_across = [](const Segment& a, const Segment& b) {
        const auto one = turn_of(a.first, a.second, b.first), other = turn_of(a.first, a.second, b.second);
        return (one > 0 && other < 0) || (one < 0 && other > 0);
    };
    for (std::size_t i = 0; i < segments.size(); ++i)
        for (std::size_t k = i + 1; k < segments.size(); ++k)
            if (are_across(segments[i], segments[k]) && are_across(segments[k], segments[i])) return true;
    return false;
}

std::optional<std::vector<Area>> uncrossed(const std::vector<Outline>& outlines, std::string_view fill_rule) {
    std::vector<Segment> segments;
    for (const auto& outline : outlines)
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Segment segment{spot_of(outline[i]), spot_of(outline[(i + 1) % outline.size()])};
            if (segment.first != segment.second) segments.push_back(segment);
        }
    const auto pieces = cut_at_crossings(std::move(segments));
    if (!pieces) return std::nullopt;
    return nested(loops_of(directed_borders(borders_of(*pieces), fill_rule == fill_rules[1])));
}

} // namespace sinew::files
