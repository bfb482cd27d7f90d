#include "apps/window/inspector.h"

#include "sinew/world/edit.h"

#include "apps/window/label.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace sinew::window {
namespace {

template <class WorldT> class Shown {
  public:
    Shown(play::Play& play, const WorldT& world, ParticleId id, Row at, const Look& look)
        : play_(play), world_(world), id_(id), row_(at), look_(look) {}

    /// Shows the particle; returns the player's change, if any.
    std::optional<play::Tweak> particle() {
        const auto& p = world_.particles;
        const auto units = play_.session().scene().measures();
        ImGui::TextColored(look_.accent, "%s", play::name_of(play_.session().world(), id_).c_str());
        std::array<double, 3> position{}, velocity{};
        for (int i = 0; i < D; ++i) {
            position[std::size_t(i)] = double(p.position[row_][i]);
            velocity[std::size_t(i)] = double(p.velocity[row_][i]);
        }
        play::Tweak tweak{.particle = row_, .position = {}, .velocity = {}, .mass = {}};
        if (numbers("position", position, units.text(unit::length))) tweak.position = Point{position};
        if (numbers("velocity", velocity, units.text(unit::speed))) tweak.velocity = Point{velocity};
        double mass = double(inverse_or_zero(p.inverse_mass[row_]));
        window::label("mass", "how heavy it is", look_.faint);
        const auto format = number_format("%.4g", units.text(unit::mass));
        constexpr double min = 1e-6, max = 1e9;
        if (mass <= 0)
            ImGui::TextColored(look_.faint, "nothing moves it");
        else if (ImGui::DragScalar("##mass", ImGuiDataType_Double, &mass, float(mass * 0.01), &min, &max,
                                   format.c_str()))
            tweak.mass = mass;
        return tweak.position || tweak.velocity || tweak.mass ? std::optional(tweak) : std::nullopt;
    }

    /// Lists the constraints of the particle, at most 6 of them.
    void constraints() {
        int kind = 0, shown = 0;
        for_each_table(world_, [&](const auto& table) { of_kind(table, kind++, shown); });
    }

  private:
    static constexpr int D = WorldT::dimension;
    play::Play& play_;
    const WorldT& world_;
    ParticleId id_;
    Row row_;
    const Look& look_;

    template <class Table> void of_kind(const Table& table, int kind, int& shown) {
        using Kind = typename Table::Kind;
        constexpr int max = 6;
        const auto units = play_.session().scene().measures();
        constexpr Unit measured{.length = Kind::length_power, .angle = Kind::period > 0};
        for (Row i = 0; i < table.size() && shown < max; ++i) {
            const auto members = table.members[i];
            if (std::find(members.begin(), members.end(), row_) == members.end()) continue;
            const auto state = constraint_state(world_, {kind, table.handles.id_of(i)});
            if (!state) continue;
            ++shown;
            window::label(Kind::name + to_others(members),
                          "measured, and its strain, in " + std::string(Kind::name) + between(members), look_.faint);
            const auto format = number_format("%.4g", units.text(measured));
            ImGui::Text(format.c_str(), state->measure * in_file(measured));
            if (std::fabs(state->strain) <= 1e-6) continue;
            ImGui::SameLine();
            ImGui::TextColored(look_.accent, "%+.3g %%", state->strain * 100);
        }
    }

    std::string name_of(Row member) const {
        return play::name_of(play_.session().world(), world_.particles.handles.id_of(member));
    }

    /// For a constraint of two particles, the other one, by the last part of the name.
    std::string to_others(std::span<const Row> members) const {
        if (members.size() != 2) return "";
        const auto name = name_of(members[0] == row_ ? members[1] : members[0]);
        return " to " + name.substr(name.find_last_of('/') + 1);
    }

    std::string between(std::span<const Row> members) const {
        std::string names;
        for (const auto member : members) names += (names.empty() ? " of " : ", ") + name_of(member);
        return names;
    }

    bool numbers(const std::string& name, std::array<double, 3>& values, const std::string& unit) const {
        window::label(name + ", " + unit, name + " in " + unit + ": drag the numbers", look_.faint);
        double largest = 0.1;
        for (const double value : values) largest = std::max(largest, std::fabs(value));
        return ImGui::DragScalarN(("##" + name).c_str(), ImGuiDataType_Double, values.data(), D, float(largest * 0.005),
                                  nullptr, nullptr, "%.4g");
    }
};

} // namespace

void inspector(play::Play& play, const Look& look, const Fonts& fonts) {
    const auto& picked = play.selected ? play.selected : play.hovered;
    if (!picked) {
        ImGui::PushFont(fonts.small);
        ImGui::TextColored(look.faint, "press a particle to see it here");
        ImGui::PopFont();
        return;
    }
    const auto id = picked->members.front();
    const auto tweak = std::visit(
        [&](const auto& world) -> std::optional<play::Tweak> {
            const auto row = row_of(world, id);
            if (!row) return ImGui::TextColored(look.faint, "it is gone"), std::nullopt;
            Shown shown(play, world, id, *row, look);
            auto change = shown.particle();
            shown.constraints();
            return change;
        },
        play.session().world());
    if (tweak) play.edit(*tweak, "change a particle");
}

} // namespace sinew::window
