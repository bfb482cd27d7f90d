#pragma once

#include "sinew/math/format.h"
#include "sinew/scene/check.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

/// Warnings of events without a chance to happen, or without effect.
namespace sinew {

/// Contacts impossible for figures, and blows to held particles.
template <int D, class Real> class EventCheck {
  public:
    EventCheck(const Scene& scene, const World<D, Real>& world, Document& document)
        : scene_(scene), world_(world), document_(document) {}

    void run() {
        for (const auto& section : scene_.events) note(section);
        for (std::size_t i = 0; i < scene_.events.size(); ++i) {
            const auto& section = scene_.events[i];
            if (section.on) contact(*section.on, under("events", i, "on"));
            if (const auto* kick = std::get_if<KickEvent>(&section.event)) blow(kick->target, "kick", i);
            if (const auto* impulse = std::get_if<ImpulseEvent>(&section.event)) blow(impulse->target, "impulse", i);
        }
        layers();
    }

  private:
    const Scene& scene_;
    const World<D, Real>& world_;
    Document& document_;
    std::map<std::uint32_t, double> let_go_; ///< by index of a particle: earliest time at which an event may free it
    bool adds_figures_ = false;

    void note(const EventSection& section) {
        const auto* grab = std::get_if<GrabEvent>(&section.event);
        const auto* release = std::get_if<ReleaseEvent>(&section.event);
        adds_figures_ = adds_figures_ || std::holds_alternative<AddEvent>(section.event);
        if (!grab && !release) return;
        const auto id = find_particle(world_, grab ? grab->particle : release->particle);
        if (!id) return;
        auto& earliest = let_go_.try_emplace(id->index, section.first()).first->second;
        earliest = std::min(earliest, section.first());
    }

    std::string name(FigureIndex figure) const { return in_quotes(world_.figures[figure].name); }

    /// Figure called so, or with a particle called so.
    std::optional<FigureIndex> figure_of(std::string_view name) const {
        return find_figure(world_, name.substr(0, name.find('/')));
    }

    void contact(const ContactRule& rule, const std::string& place) {
        const auto of = figure_of(rule.of);
        if (!of) return;
        if (rule.with.empty()) return contact_with_anything(*of, place);
        if (rule.with == bounds_name && !world_.bounds.empty()) return;
        bool is_collider = false;
        for (const auto& collider : world_.colliders) {
            if (collider.name != rule.with) continue;
            if (touch(world_.figures[*of].filter, collider.filter)) return;
            is_collider = true;
        }
        const auto with = figure_of(rule.with);
        if (with) return contact_of_figures(*of, *with, place);
        if (is_collider) warn_of_layers(name(*of), in_quotes(rule.with), place);
    }

    void contact_with_anything(FigureIndex of, const std::string& place) {
        const auto& figure = world_.figures[of];
        const auto touches = [&](const auto& other) { return touch(figure.filter, other.filter); };
        const bool is_classic = world_.settings.mode == Mode::classic;
        const auto is_met = [&](const Figure& other) {
            return &other != &figure && other.in_use() && other.collides && touches(other);
        };
        if (!world_.bounds.empty() || figure.touches_itself || std::ranges::any_of(world_.colliders, touches)) return;
        if (!is_classic && figure.collides && (adds_figures_ || std::ranges::any_of(world_.figures, is_met))) return;
        document_.warn(place + "/of",
                       format_text("this event never happens: nothing in the scene touches {}", name(of)),
                       "it touches colliders, the bounds, and with \"contact\": {\"figures\": true} figures that "
                       "have it, too");
    }
    void contact_of_figures(FigureIndex of, FigureIndex with, const std::string& place) {
        const auto& a = world_.figures[of];
        const auto& b = world_.figures[with];
        if (of == with) {
            if (!a.touches_itself)
                document_.warn(place + "/with",
                               format_text("this event never happens: {} has no contact with itself", name(of)),
                               concat("give ", name(of), " \"contact\": {\"itself\": true}"));
            return;
        }
        if (world_.settings.mode == Mode::classic)
            return document_.warn(place + "/with",
                                  "this event never happens: figures do not touch each other in classic mode",
                                  "name a collider or \"bounds\", or choose the mode \"physical\"");
        if (!a.collides || !b.collides) {
            const auto lacking = a.collides   ? name(with)
                                 : b.collides ? name(of)
                                              : format_text("{} and {}", name(of), name(with));
            return document_.warn(place + "/with",
                                  format_text("this event never happens: {} and {} cannot touch", name(of), name(with)),
                                  concat("give ", lacking, " \"contact\": {\"figures\": true}"));
        }
        if (!touch(a.filter, b.filter)) warn_of_layers(name(of), name(with), place);
    }
    void warn_of_layers(const std::string& one, const std::string& other, const std::string& place) {
        document_.warn(place + "/with",
                       format_text("this event never happens: the layers of {} and {} do not touch", one, other),
                       "each touches the other only if its \"touches\" has a layer of the other's \"layers\"");
    }

    /// Contact with figures through empty layers.
    void layers() {
        std::uint32_t used = collide::Filter{}.layers; // the usual layer, of whatever players and programs add
        for (const auto& figure : world_.figures) used |= figure.filter.layers;
        for (const auto& collider : world_.colliders) used |= collider.filter.layers;
        for (std::size_t i = 0; i < scene_.figures.size(); ++i) {
            const auto& contact = scene_.figures[i].contact;
            if (!contact.figures || !contact.touches || contact.touches->empty()) continue;
            if ((world_.figures[i].filter.mask & used) == 0)
                document_.warn(under("figures", i, "contact/touches"),
                               format_text("{} touches nothing: no figure and no collider is in these layers",
                                           name(FigureIndex(i))),
                               "\"touches\" lists the \"layers\" of others; [] is for a figure that touches nothing");
        }
    }

    /// A blow to held particles alone, unless an event may have freed one.
    void blow(const std::string& target, std::string_view what, std::size_t i) {
        const auto& section = scene_.events[i];
        const auto is_held = [&](ParticleId id) {
            const auto row = row_of(world_, id);
            const auto freed = let_go_.find(id.index);
            const bool is_free =
                freed != let_go_.end() && (section.on || section.every > 0 || freed->second <= section.first());
            return !row || (world_.particles.mobility[*row] == Real(0) && !is_free);
        };
        const auto are_held = [&](const auto& ids) {
            return ids.size() > 0 && std::all_of(ids.begin(), ids.end(), is_held);
        };
        const auto figure = find_figure(world_, target);
        if (figure ? are_held(world_.figures[*figure].particles) : are_held(find_particles(world_, target)))
            document_.warn(under("events", i, what),
                           format_text("{} is pinned: this {} does nothing", in_quotes(target), what),
                           "release it before, or name what is free");
    }
};

} // namespace sinew
