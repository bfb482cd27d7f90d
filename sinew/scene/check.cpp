#include "sinew/scene/check.h"

#include "sinew/math/color.h"
#include "sinew/math/color_names.h"
#include "sinew/math/format.h"
#include "sinew/scene/check_constraint.h"
#include "sinew/scene/colliders.h"
#include "sinew/scene/types.h"

#include <algorithm>
#include <map>
#include <type_traits>

namespace sinew {
namespace {

std::string colors_like(std::string_view text) {
    std::vector<std::string_view> names(theme_colors.begin(), theme_colors.end());
    for (const auto& named : css_colors) names.push_back(named.name);
    const auto near = nearest(text, names);
    std::string help = near.empty() ? "" : format_text("did you mean {}? ", in_quotes(near));
    auto others = similar(text, names, 6);
    std::erase(others, near);
    for (const auto& other : others) help += concat(other == others.front() ? "near it: " : ", ", other);
    if (!others.empty()) help += "; ";
    return help + "allowed: every name of CSS, ink or paper, #rgb, #rrggbb, #rrggbbaa or none";
}

class ValueCheck {
  public:
    ValueCheck(const Scene& scene, Document& document) : scene_(scene), document_(document) {}

    /// Returns true if a world can be built in spite of the errors.
    bool run() {
        const auto before = document_.diagnostics.count();
        world_type();
        check_sizes(scene_, document_);
        for (std::size_t i = 0; i < scene_.figures.size(); ++i) figure(scene_.figures[i], i);
        for (std::size_t i = 0; i < scene_.constraints.size(); ++i)
            check_constraint(scene_, scene_.constraints[i], under("constraints", i), document_);
        check_motors(scene_.constraints, "", document_);
        bounds();
        for (std::size_t i = 0; i < scene_.colliders.size(); ++i) collider(scene_.colliders[i], i);
        const bool is_buildable = document_.diagnostics.count() == before;
        for (std::size_t i = 0; i < scene_.world.forces.size(); ++i)
            detail::visit_held(scene_.world.forces[i].force,
                               [&](const auto& force) { this->force(force, "/world" + under("forces", i)); });
        for (std::size_t i = 0; i < scene_.looks.size(); ++i)
            check_look(scene_.looks[i].second, "/looks" + json::pointer_step(scene_.looks[i].first));
        for (std::size_t i = 0; i < scene_.pins.size(); ++i)
            detail::visit_held(scene_.pins[i].driver,
                               [&](const auto& driver) { check_driver(driver, under("pins", i, "keys")); });
        for (std::size_t i = 0; i < scene_.events.size(); ++i) event(scene_.events[i], i);
        pairs();
        traces();
        return is_buildable;
    }

  private:
    const Scene& scene_;
    Document& document_;

    void world_type() {
        const auto& wanted = scene_.solver.precision;
        if (has_world(scene_.dimension, wanted)) return;
        if (has_world(5 - scene_.dimension, wanted))
            document_.error("/dimension", format_text("this build has no worlds of {} dimensions", scene_.dimension),
                            "list them in SINEW_WORLDS of the build");
        else
            document_.error("/solver/precision", concat("this module has no worlds of ", wanted),
                            concat("load the module of ", wanted, " beside it, or leave out the precision"));
    }

    void pairs() {
        if (scene_.pairs.size() > max_pairs)
            document_.error("/pairs",
                            format_text("a scene can have {} pairs, found {}", max_pairs, scene_.pairs.size()));
        std::map<std::array<std::string, 2>, std::size_t> seen;
        for (std::size_t i = 0; i < scene_.pairs.size(); ++i) {
            const auto& pair = scene_.pairs[i];
            if (!pair.bounce && !pair.friction)
                document_.error(under("pairs", i), "a pair without numbers", "give it bounce, friction or both");
            auto sides = pair.between;
            if (sides[1] < sides[0]) std::swap(sides[0], sides[1]);
            const auto [first, fresh] = seen.try_emplace(sides, i);
            if (!fresh)
                document_.error(under("pairs", i, "between"),
                                format_text("\"{}\" and \"{}\" are the pair {} already", sides[0], sides[1],
                                            under("pairs", first->second)),
                                "one pair has both bounce and friction");
        }
    }

    void traces() {
        if (scene_.traces.size() > max_traces)
            document_.error("/traces",
                            format_text("a scene can have {} traces, found {}", max_traces, scene_.traces.size()));
        for (std::size_t i = 0; i < scene_.traces.size(); ++i) {
            const auto& trace = scene_.traces[i];
            if (trace.shows == trace_quantities.front()) continue;
            if (scene_.dimension != 2)
                document_.error(under("traces", i, "shows"), "a curve over time is drawn in 2 dimensions only",
                                "in 3 a trace can show a path");
            else if (!trace.box)
                document_.error(under("traces", i), format_text("a curve of the {} needs a \"box\"", trace.shows),
                                "say two opposite corners of its frame");
            if (trace.low && trace.high && !(*trace.low < *trace.high))
                document_.error(under("traces", i, "low"), "low is not below high");
        }
    }

    void figure(const FigureSection& figure, std::size_t i) {
        detail::visit_held(figure.made, [&](const auto& made) {
            if constexpr (requires { made.dimensions; }) {
                if (!made.dimensions.include(scene_.dimension))
                    return document_.error(
                        under("figures", i, "prefab"),
                        format_text("a {} does not exist in {} dimensions", made.name, scene_.dimension));
            }
            if constexpr (requires { made.problem(scene_.dimension); })
                if (const auto problem = made.problem(scene_.dimension)) document_.error(under("figures", i), *problem);
        });
        if (const auto* by_hand = std::get_if<ByHand>(&figure.made)) {
            for (std::size_t k = 0; k < by_hand->constraints.size(); ++k)
                check_constraint(scene_, by_hand->constraints[k], under("figures", i) + under("constraints", k),
                                 document_);
            check_motors(by_hand->constraints, under("figures", i), document_);
            for (std::size_t k = 0; k < by_hand->pieces.size(); ++k)
                piece(by_hand->pieces[k], under("figures", i) + under("pieces", k));
        }
        for (const auto& [part, seen] : figure.looks)
            check_look(seen, under("figures", i, "looks") + json::pointer_step(part));
    }

    /// Checks the number of particles a mark is drawn through. `counts` is in the order of mark_names.
    void piece(const PieceSection& section, const std::string& place) {
        constexpr std::array<std::array<std::size_t, 2>, mark_names.size()> counts = {
            {{2, 1000}, {2, 1000}, {2, 1000}, {2, 1000}, {3, 1000}, {2, 2}, {1, 1000}, {3, 1000}, {4, 4}, {1, 4}}};
        const auto mark = std::find(mark_names.begin(), mark_names.end(), section.mark) - mark_names.begin();
        const auto [min, max] = counts[std::size_t(mark)];
        const auto found = section.through.size();
        if (found < min || found > max)
            document_.error(place + "/through", format_text("a {} goes through {}{} particles, found {}", section.mark,
                                                            min == max ? "" : format_text("{} to ", min), max, found));
        if (section.end_width > 0 && section.width == 0)
            document_.error(place + "/end_width", "an end_width needs a width to begin with");
    }

    void event(const EventSection& section, std::size_t i) {
        const double step = step_length(scene_);
        if (!section.at && !section.on && section.every == 0)
            document_.error(under("events", i), "an event needs a time \"at\", or a contact \"on\"");
        if (section.times > 0 && section.every == 0 && !section.on)
            document_.error(under("events", i, "times"), "what happens several times needs an \"every\"");
        if (section.every > 0 && section.every < step * 0.999)
            document_.error(under("events", i, "every"),
                            format_text("{} is shorter than a step, {:6}", section.every, step));
        if (const auto* join = std::get_if<JoinEvent>(&section.event)) {
            check_constraint(scene_, join->constraint, under("events", i), document_, "join");
            if (join->constraint.drive)
                document_.error(under("events", i, "drive"), "a joined constraint has no drive",
                                "list the constraint in its figure, or give it new limits by an event \"adjust\"");
        }
        if (const auto* gust = std::get_if<GustEvent>(&section.event)) air(*gust, under("events", i));
        if (const auto* adjust = std::get_if<AdjustEvent>(&section.event))
            check_limits(*adjust, under("events", i), document_);
    }

    void check_look(const Look& look, const std::string& place) {
        for (const auto& [key, text] :
             {std::pair("/color", look.color), std::pair("/fill", look.fill), std::pair("/hover", look.hover)})
            if (!text.empty() && !parse_color(text) && std::ranges::find(theme_colors, text) == theme_colors.end())
                document_.error(place + key, format_text("{} is no colour", in_quotes(text)), colors_like(text));
    }

    template <class DriverT> void check_driver(const DriverT& driver, const std::string& place) {
        if constexpr (requires { driver.keys; }) check_keys(driver.keys, place, document_);
        if constexpr (std::is_same_v<DriverT, PathDriver>)
            if (driver.keys.empty()) document_.error(place, "a path needs at least one key");
    }
    void collider(const ColliderSection& section, std::size_t index) {
        check_collider(section, index, scene_.dimension, document_);
        if (!section.motion) return;
        detail::visit_held(section.motion->driver,
                           [&](const auto& driver) { check_driver(driver, under("colliders", index, "motion/keys")); });
    }

    template <class Force> void force(const Force&, const std::string&) {}
    void force(const WindForce& wind, const std::string& place) { air(wind, place); }
    void force(const RandomPushForce& push, const std::string& place) {
        for (int k = 0; k < scene_.dimension; ++k)
            if (push.low[k] > push.high[k])
                document_.error(place + format_text("/low/{}", k),
                                format_text("low ({}) is above high ({})", push.low[k], push.high[k]));
    }
    /// Warns of a drag coefficient without air to press with.
    template <class Wind> void air(const Wind& wind, const std::string& place) {
        const auto coefficient = place + "/drag_coefficient";
        if (wind.density == 0 && json::find(document_.root, coefficient))
            document_.warn(coefficient, "a drag_coefficient does nothing without a density of the air",
                           "give the wind a \"density\", 1.2 kg/m^3 at sea level");
    }

    void bounds() {
        if (!scene_.world.bounds) return;
        if (const auto& box = scene_.world.bounds->box)
            for (int k = 0; k < scene_.dimension; ++k)
                if ((*box)[0][k] == (*box)[1][k])
                    document_.error("/world/bounds/box", "the corners of the box have no room between them");
        const auto& planes = scene_.world.bounds->planes;
        for (std::size_t i = 0; i < planes.size(); ++i)
            if (planes[i].normal == Point{})
                document_.error(under("world/bounds/planes", i, "normal"), "a normal needs a length");
    }
};

} // namespace

std::string under(std::string_view list, std::size_t index, std::string_view key) {
    return key.empty() ? format_text("/{}/{}", list, index) : format_text("/{}/{}/{}", list, index, key);
}

std::string_view name_of(const FigureSection& figure) {
    if (!figure.name.empty()) return figure.name;
    std::string_view name;
    detail::visit_held(figure.made, [&](const auto& made) { name = made.name; });
    return name;
}

std::string full_name(std::string_view name, std::string_view prefix) {
    return name.find('/') == std::string_view::npos ? concat(prefix, name) : std::string(name);
}

bool check_values(const Scene& scene, Document& document) {
    return ValueCheck(scene, document).run();
}

} // namespace sinew
