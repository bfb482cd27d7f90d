#pragma once

#include "sinew/scene/check.h"
#include "sinew/scene/types.h"

#include <algorithm>
#include <string>
#include <vector>

namespace sinew {

/// Checks a scene with errors for whatever does not follow from them: values in sections without an error, and names,
/// in a world without the sections that have one. An author is told all mistakes at once, and none that is not there.
class CheckRest {
  public:
    CheckRest(const Scene& scene, Document& document) : scene_(scene), document_(document) {
        for (auto& error : document.diagnostics.in_order()) wrong_.push_back(std::move(error.path));
    }

    void run() {
        if (document_.diagnostics.full()) return; // errors beyond those stored have unknown consequences
        unsound_ = wrong_;
        // A given name is no consequence of a mistake beside.
        check_names(scene_, document_, [&](std::size_t i) { return has_name(scene_.figures[i], under("figures", i)); });
        const auto* figures = json::find(document_.root, "/figures");
        if (!figures || !figures->as<json::Array>()) return;
        Document values = silent_copy();
        check_values(scene_, values);
        for (const auto& error : values.diagnostics.in_order()) unsound_.push_back(error.path);
        tell(values, wrong_);
        Scene sound = scene_;
        leave_out_unsound(sound);
        Document names = silent_copy();
        check_sizes(sound, names);
        if (!names.diagnostics.ok() || !has_world(sound.dimension, sound.solver.precision)) return;
        check_references(sound, instantiate(sound), names, incomplete_);
        tell(names, unsound_);
    }

  private:
    const Scene& scene_;
    Document& document_;
    std::vector<std::string> wrong_;      ///< places of the errors told so far
    std::vector<std::string> unsound_;    ///< of these, and of wrong values
    std::vector<std::string> incomplete_; ///< figures that are left out; an empty name for one whose name is not known

    /// The document without its errors.
    Document silent_copy() const {
        Document copy = document_;
        copy.diagnostics = {};
        for (std::uint32_t i = 0; i < document_.diagnostics.source_count(); ++i) {
            const auto& source = document_.diagnostics.source(i);
            copy.diagnostics.add_source(source.name, source.text);
        }
        return copy;
    }
    void tell(const Document& found, const std::vector<std::string>& places) {
        for (auto& error : found.diagnostics.in_order())
            if (!follows(error.path, places))
                document_.diagnostics.error(error.span, error.path, error.message, error.help);
    }

    static bool is_within(std::string_view place, std::string_view whole) {
        return place.starts_with(whole) && (place.size() == whole.size() || place[whole.size()] == '/');
    }
    /// True if an error may follow from one of those at `places`: at, above or below. Unknown words at the root hurt
    /// nothing else.
    static bool follows(std::string_view error, const std::vector<std::string>& places) {
        return std::ranges::any_of(places, [&](const std::string& place) {
            return !place.empty() && (is_within(error, place) || is_within(place, error));
        });
    }
    bool is_unsound(const std::string& place) const {
        return std::ranges::any_of(unsound_, [&](const std::string& unsound) { return is_within(unsound, place); });
    }

    /// Replaces sections with errors by harmless ones of the same name.
    void leave_out_unsound(Scene& sound) {
        for (std::size_t i = 0; i < sound.figures.size(); ++i) leave_out_unsound(sound.figures[i], under("figures", i));
        each_unsound("constraints", sound.constraints, leave_members);
        each_unsound("colliders", sound.colliders, [](auto& section) {
            ColliderSection nothing;
            nothing.name = section.name;
            section = std::move(nothing);
        });
        if (is_unsound("/world")) sound.world = harmless(scene_.world);
        if (is_unsound("/solver")) sound.solver = {};
    }
    /// A world with the names of a given one, of figures pulled by forces and of walls.
    static WorldSection harmless(const WorldSection& given) {
        WorldSection world;
        world.forces = given.forces;
        if (given.bounds) world.bounds.emplace().planes.emplace_back();
        return world;
    }
    static void leave_members(ConstraintSection& section) {
        ConstraintSection nothing;
        nothing.name = section.name;
        nothing.between = section.between;
        section = std::move(nothing);
    }
    template <class Section, class Change>
    void each_unsound(std::string_view list, std::vector<Section>& sections, Change&& change) {
        for (std::size_t i = 0; i < sections.size(); ++i)
            if (is_unsound(under(list, i))) change(sections[i]);
    }

    /// Particles listed by hand have their names, whatever is wrong with one of them; and two figures of one name both
    /// have theirs.
    void leave_out_unsound(FigureSection& figure, const std::string& place) {
        const auto hurts = [&](const std::string& unsound) {
            return is_within(unsound, place) && (figure.name.empty() || unsound != place + "/name");
        };
        if (std::ranges::none_of(unsound_, hurts)) return;
        auto* by_hand = std::get_if<ByHand>(&figure.made);
        if (by_hand && !figure.name.empty() && !by_hand->particles.empty() && !is_wrong(place + "/particles"))
            return each_unsound(place.substr(1) + "/constraints", by_hand->constraints, leave_members);
        FigureSection nothing;
        nothing.name = name_of(figure);
        incomplete_.push_back(has_name(figure, place) ? nothing.name : "");
        figure = std::move(nothing);
    }
    bool is_wrong(const std::string& place) const { return std::ranges::find(unsound_, place) != unsound_.end(); }
    bool has_name(const FigureSection& figure, const std::string& place) const {
        return !figure.name.empty() || !(is_wrong(place) || is_wrong(place + "/name") || is_wrong(place + "/prefab"));
    }
};

} // namespace sinew
