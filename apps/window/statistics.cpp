#include "apps/window/statistics.h"

#include "sinew/solver/edit.h"

#include <algorithm>
#include <cstdio>

namespace sinew::window {
namespace {

template <class Deque, class Value> void keep(Deque& deque, Value value, std::size_t most) {
    deque.push_back(value);
    if (deque.size() > most) deque.pop_front();
}

/// A frame for a graph; its corners.
std::array<ImVec2, 2> graph_frame(const Look& look, float height) {
    const auto at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::Dummy({width, height});
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + height}, packed(look.raised, 0.55F), 6);
    return {at, ImVec2{at.x + width, at.y + height}};
}

template <class Values, class ValueOf>
void plot(const std::array<ImVec2, 2>& frame, const Values& values, float low, float high, std::size_t most,
          ImU32 color, float thick, ValueOf&& value_of) {
    if (values.size() < 2 || high <= low) return;
    auto& list = *ImGui::GetWindowDrawList();
    const float inset = 4, width = frame[1].x - frame[0].x, height = frame[1].y - frame[0].y - 2 * inset;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float x = frame[1].x - width * float(values.size() - 1 - i) / float(most - 1);
        const float share = (value_of(values[i]) - low) / (high - low);
        list.PathLineTo({x, frame[1].y - inset - height * std::clamp(share, 0.0F, 1.0F)});
    }
    list.PathStroke(color, 0, thick);
}

double largest_tension(const AnyWorld& world) {
    return std::visit(
        [](const auto& any) {
            double largest = 0;
            const auto& table = std::get<0>(any.constraints);
            constexpr std::size_t few = 5000; // more takes too long for what it tells
            if (any.settings.mode == Mode::classic || table.size() > few) return largest;
            for (Row row = 0; row < table.size(); ++row)
                if (const auto state = constraint_state(any, {0, table.slots.id_of(row)}))
                    largest = std::max(largest, state->tension);
            return largest;
        },
        world);
}

void row(const char* name, const std::string& value, const Look& look) {
    ImGui::TextColored(look.faint, "%s", name);
    ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.42F);
    ImGui::TextUnformatted(value.c_str());
}

std::string text(const char* format, double value) {
    char out[64];
    std::snprintf(out, sizeof out, format, value);
    return out;
}

} // namespace

void Statistics::steps(double seconds, std::uint64_t count, const PhaseTimes& phases) {
    if (count == 0 || phases.steps == 0) return;
    const double each = seconds * 1000 / double(count);
    step_ += (each - step_) * 0.1;
    StepTimes times{};
    double sum = 0;
    for (std::size_t i = 0; i < phases.seconds.size(); ++i)
        times[i] = float(sum += phases.seconds[i] * 1000 / double(phases.steps));
    times.back() = std::max(float(each), times[times.size() - 2]);
    keep(step_times_, times, most);
}

void Statistics::sample(play::Play& play) {
    constexpr double every = 0.1; // seconds of the player
    if (play.scene_name() != scene_) energies_.clear(), step_times_.clear(), sampled_ = ~0ULL;
    scene_ = play.scene_name();
    if (ImGui::GetTime() - since_ < every || play.tape().now() == sampled_) return;
    since_ = ImGui::GetTime();
    sampled_ = play.tape().now();
    report_ = play.session().report();
    largest_tension_ = largest_tension(play.session().world());
    keep(energies_, Energies{float(report_.kinetic), float(report_.potential), float(report_.stored)}, most);
}

void Statistics::show(play::Play& play, const Look& look, const Fonts& fonts, float scale) {
    const auto& scene = play.session().scene();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(8 * scale, 3 * scale));
    row("particles", std::to_string(report_.particles), look);
    std::string kinds;
    std::visit(
        [&](const auto& world) {
            std::size_t kind = 0;
            for_each_table(world, [&](const auto& table) {
                if (table.size() > 0)
                    kinds += (kinds.empty() ? "" : ", ") + std::to_string(table.size()) + " " +
                             std::string(kind_names[kind]);
                ++kind;
            });
        },
        play.session().world());
    row("constraints", kinds.empty() ? "none" : kinds, look);
    row("stretch", text("%.3g %%", report_.stretch_max * 100), look);
    if (largest_tension_ > 0) {
        const auto units = scene.measures();
        row("tension", text("%.4g N", largest_tension_ * units.per_second * units.per_second / units.per_metre), look);
    }
    if (report_.energy_lost > 0) {
        const auto units = scene.measures();
        const double per_joule = units.per_metre * units.per_metre / (units.per_second * units.per_second);
        row("lost to blows", text("%.4g J", report_.energy_lost / per_joule), look);
    }
    row("step", text("%.3f ms", step_), look);
    row("frame", text("%.1f ms", frame_) + text(", %.0f a second", 1000 / std::max(frame_, 0.01)), look);
    ImGui::TextColored(look.faint, "hash");
    ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.42F);
    ImGui::PushFont(fonts.fixed);
    char hash[17];
    std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(report_.hash));
    ImGui::TextUnformatted(hash);
    ImGui::PopFont();
    ImGui::Dummy({0, 2 * scale});

    ImGui::PushFont(fonts.small);
    // One on the other: the uppermost line is all of a step.
    const std::array<ImVec4, 5> colors = {look.faint, look.accent, look.cool, look.good, look.text};
    ImGui::TextColored(look.faint, "time of a step: ");
    for (std::size_t i = 0; i < phase_names.size(); ++i)
        ImGui::SameLine(0, 0), ImGui::TextColored(colors[i], "%s ", std::string(phase_names[i]).c_str());
    ImGui::SameLine(0, 0), ImGui::TextColored(colors.back(), "all");
    const auto times = graph_frame(look, 52 * scale);
    float slowest = 0.05F;
    for (const auto& time : step_times_) slowest = std::max(slowest, time.back());
    for (std::size_t i = 0; i < colors.size(); ++i)
        plot(times, step_times_, 0, slowest, most, packed(colors[i]), 1.3F * scale,
             [i](const StepTimes& time) { return time[i]; });

    ImGui::TextColored(look.faint, "energy: ");
    ImGui::SameLine(0, 0), ImGui::TextColored(look.accent, "kinetic ");
    ImGui::SameLine(0, 0), ImGui::TextColored(look.cool, "potential ");
    ImGui::SameLine(0, 0), ImGui::TextColored(look.good, "total");
    const auto frame = graph_frame(look, 80 * scale);
    float low = 0, high = 0;
    const auto total = [](const Energies& e) { return e.kinetic + e.potential + e.stored; };
    const float origin = energies_.empty() ? 0 : energies_.front().potential; // only changes of it mean anything
    for (const auto& e : energies_)
        for (const float value : {e.kinetic, e.potential - origin, total(e) - origin})
            low = std::min(low, value), high = std::max(high, value);
    plot(frame, energies_, low, high, most, packed(look.cool), 1.5F * scale,
         [&](const Energies& e) { return e.potential - origin; });
    plot(frame, energies_, low, high, most, packed(look.accent), 1.5F * scale,
         [](const Energies& e) { return e.kinetic; });
    plot(frame, energies_, low, high, most, packed(look.good), 2 * scale,
         [&](const Energies& e) { return total(e) - origin; });
    ImGui::PopFont();
    ImGui::PopStyleVar();
}

} // namespace sinew::window
