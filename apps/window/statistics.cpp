#include "apps/window/statistics.h"

#include "sinew/world/edit.h"

#include "apps/window/label.h"
#include "player/quantity.h"

#include <algorithm>
#include <cstdio>
#include <type_traits>
#include <vector>

namespace sinew::window {
namespace {

template <class Deque, class Value> void keep(Deque& deque, Value value, std::size_t max) {
    deque.push_back(value);
    if (deque.size() > max) deque.pop_front();
}

/// Draws the background of a graph; returns two corners.
std::array<ImVec2, 2> graph_frame(const Look& look, float height) {
    const auto at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::Dummy({width, height});
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + height}, packed(look.raised, 0.55F), 6);
    return {at, ImVec2{at.x + width, at.y + height}};
}

template <class Values, class ValueOf>
void plot(const std::array<ImVec2, 2>& frame, const Values& values, float low, float high, std::size_t max, ImU32 color,
          float thick, ValueOf&& value_of) {
    if (values.size() < 2 || high <= low) return;
    auto& list = *ImGui::GetWindowDrawList();
    const float inset = 4, width = frame[1].x - frame[0].x, height = frame[1].y - frame[0].y - 2 * inset;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float x = frame[1].x - width * float(values.size() - 1 - i) / float(max - 1);
        const float share = (value_of(values[i]) - low) / (high - low);
        list.PathLineTo({x, frame[1].y - inset - height * std::clamp(share, 0.0F, 1.0F)});
    }
    list.PathStroke(color, 0, thick);
}

double largest_tension(const AnyWorld& world) {
    return std::visit(
        [](const auto& any) {
            double largest = 0;
            constexpr int kind = kind_number<Distance, std::decay_t<decltype(any)>::dimension>;
            const auto& table = std::get<kind>(any.constraints);
            constexpr std::size_t few = 5000; // distances; beyond, the measurement takes too long
            if (any.settings.mode == Mode::classic || table.size() > few) return largest;
            for (Row row = 0; row < table.size(); ++row)
                if (const auto state = constraint_state(any, {kind, table.handles.id_of(row)}))
                    largest = std::max(largest, state->tension);
            return largest;
        },
        world);
}

std::string text(const char* format, double value) {
    char out[64];
    std::snprintf(out, sizeof out, format, value);
    return out;
}

struct Legend {
    std::string name;
    ImVec4 color;
};

/// Title of a graph with the range and a legend, which wraps to another line if too wide.
void graph_title(const char* name, const char* help, const std::string& range, const std::vector<Legend>& legend,
                 const Look& look) {
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    ImGui::TextColored(look.faint, "%s, %s", name, range.c_str());
    tooltip(help);
    for (const auto& [word, color] : legend) {
        const float gap = ImGui::GetFontSize() * 0.5F, end = ImGui::GetItemRectMax().x;
        if (end + gap + ImGui::CalcTextSize(word.c_str()).x < right) ImGui::SameLine(0, gap);
        ImGui::TextColored(color, "%s", word.c_str());
    }
}

} // namespace

std::string kinds_of(const AnyWorld& world) {
    std::string kinds;
    std::visit(
        [&](const auto& any) {
            for_each_table(any, [&](const auto& table) {
                if (table.size() == 0) return;
                const std::string name = std::decay_t<decltype(table)>::Kind::name;
                kinds += (kinds.empty() ? "" : ", ") + std::to_string(table.size()) + " " + name;
            });
        },
        world);
    return kinds;
}

void Statistics::steps(double seconds, std::uint64_t count, const PhaseTimes& phases) {
    if (count == 0 || phases.steps == 0) return;
    const double each = seconds * 1000 / double(count);
    step_ += (each - step_) * 0.1;
    StepTimes times{};
    double sum = 0;
    for (std::size_t i = 0; i < phases.seconds.size(); ++i)
        times[i] = float(sum += phases.seconds[i] * 1000 / double(phases.steps));
    times.back() = std::max(float(each), times[times.size() - 2]);
    keep(step_times_, times, max);
}

void Statistics::sample(play::Play& play) {
    constexpr double every = 0.1; // seconds of real time
    const auto revision = play.timeline().revision();
    const bool begins = play.session().seconds() == 0 && report_.seconds > 0;
    if (play.scene_name() != scene_ || (begins && revision != sampled_)) {
        energies_.clear(), step_times_.clear();
        for (auto& plot : plots_) plot.values.clear();
        sampled_ = ~0ULL, since_ = -every;
    }
    scene_ = play.scene_name();
    if (ImGui::GetTime() - since_ < every || revision == sampled_) return;
    since_ = ImGui::GetTime();
    sampled_ = revision;
    report_ = play.session().report();
    for (auto& plot : plots_)
        if (const auto value = play::value_of(plot.quantity, play, report_)) keep(plot.values, float(*value), max);
    largest_tension_ = largest_tension(play.session().world());
    const auto units = play.session().scene().measures();
    const double joules = units.per_second * units.per_second / (units.per_metre * units.per_metre);
    keep(energies_,
         Energies{float(report_.kinetic * joules), float(report_.potential * joules), float(report_.stored * joules)},
         max);
}

void Statistics::show(play::Play& play, const Look& look, const Fonts& fonts, float scale) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(8 * scale, 3 * scale));
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(6 * scale, 0));
    numbers(play, look);
    hash(play, look, fonts);
    ImGui::PopStyleVar();
    ImGui::Dummy({0, 2 * scale});
    ImGui::PushFont(fonts.small);
    times(look, scale);
    energies(look, scale);
    ImGui::PopFont();
    ImGui::PopStyleVar();
}

void Statistics::numbers(play::Play& play, const Look& look) const {
    const auto units = play.session().scene().measures();
    const double newtons = units.per_second * units.per_second / units.per_metre;
    row("particles", "how many the world has", std::to_string(report_.particles), look);
    const auto kinds = kinds_of(play.session().world());
    row("constraints", "how many of each kind", kinds.empty() ? "none" : kinds, look);
    row("stretch", "largest of any distance, of its rest length", text("%.3g %%", report_.stretch_max * 100), look);
    if (largest_tension_ > 0)
        row("tension", "largest pull of any distance", text("%.4g N", largest_tension_ * newtons), look);
    if (report_.energy_lost > 0)
        row("lost to blows", "energy given up where things struck, since the start",
            text("%.4g J", report_.energy_lost * newtons / units.per_metre), look);
    row("step", "time that a step takes to work out", text("%.3f ms", step_), look);
    row("frame", "time from one picture to the next",
        text("%.1f ms", frame_) + text(", %.0f a second", 1000 / std::max(frame_, 0.01)), look);
}

/// Shows the hash of the state: equal hashes, equal bits.
void Statistics::hash(play::Play& play, const Look& look, const Fonts& fonts) const {
    label("hash", "one number over the whole state: equal on every machine", look.faint);
    char hash[17];
    std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(report_.hash));
    ImGui::PushFont(fonts.fixed);
    const bool pressed = ImGui::Selectable((elided(hash, ImGui::GetContentRegionAvail().x) + "##hash").c_str());
    ImGui::PopFont();
    tooltip(std::string(hash) + ": press to copy it");
    if (pressed) play.copy_hash();
}

void Statistics::plots(play::Play& play, const Look& look, const Fonts& fonts, float scale) {
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##quantity", "plot a quantity")) {
        for (const auto& quantity : play::quantities_of(play)) {
            const auto known = std::ranges::find(plots_, quantity.name, [](const Plot& plot) { return plot.quantity; });
            if (ImGui::Selectable(quantity.name.c_str(), known != plots_.end())) {
                if (known == plots_.end())
                    plots_.push_back({quantity.name, {}});
                else
                    plots_.erase(known);
            }
            tooltip(quantity.about);
        }
        ImGui::EndCombo();
    }
    ImGui::PushFont(fonts.small);
    std::size_t gone = plots_.size();
    for (std::size_t i = 0; i < plots_.size(); ++i) {
        const auto& values = plots_[i].values;
        float low = 0, high = 0;
        if (!values.empty()) low = *std::ranges::min_element(values), high = *std::ranges::max_element(values);
        const auto now = values.empty() ? std::string("no value yet") : text("%.4g", double(values.back()));
        graph_title(plots_[i].quantity.c_str(), "press it to take it away",
                    values.empty() ? now
                                   : now + text(", %.3g to ", double(low)) + text("%.3g ", double(high)) +
                                         play::unit_of(plots_[i].quantity, play),
                    {}, look);
        if (ImGui::IsItemClicked()) gone = i;
        const auto frame = graph_frame(look, 56 * scale);
        if (high <= low) low -= 0.5F, high += 0.5F; // a level line
        plot(frame, values, low, high, max, packed(look.accent), 1.6F * scale, [](float value) { return value; });
    }
    ImGui::PopFont();
    if (gone < plots_.size()) plots_.erase(plots_.begin() + std::ptrdiff_t(gone));
}

/// Times of the phases stacked, below a line for the whole step.
void Statistics::times(const Look& look, float scale) const {
    const std::array<ImVec4, 5> colors = {look.faint, look.accent, look.cool, look.good, look.text};
    float slowest = 0.05F;
    for (const auto& time : step_times_) slowest = std::max(slowest, time.back());
    std::vector<Legend> legend;
    for (std::size_t i = 0; i < phase_names.size(); ++i) legend.push_back({std::string(phase_names[i]), colors[i]});
    legend.push_back({"all", colors.back()});
    graph_title("time of a step", "how long its phases took to work out, one on the other",
                text("to %.2g ms", double(slowest)), legend, look);
    const auto frame = graph_frame(look, 52 * scale);
    for (std::size_t i = 0; i < colors.size(); ++i)
        plot(frame, step_times_, 0, slowest, max, packed(colors[i]), 1.3F * scale,
             [i](const StepTimes& time) { return time[i]; });
}

void Statistics::energies(const Look& look, float scale) const {
    float low = 0, high = 0;
    const auto total = [](const Energies& e) { return e.kinetic + e.potential + e.stored; };
    const float origin = energies_.empty() ? 0 : energies_.front().potential; // only differences have a meaning
    for (const auto& e : energies_)
        for (const float value : {e.kinetic, e.potential - origin, total(e) - origin})
            low = std::min(low, value), high = std::max(high, value);
    graph_title("energy", "of all particles; the potential one counts from where the graph began",
                text("%.3g to ", double(low)) + text("%.3g J", double(high)),
                {{"kinetic", look.accent}, {"potential", look.cool}, {"total", look.good}}, look);
    const auto frame = graph_frame(look, 80 * scale);
    plot(frame, energies_, low, high, max, packed(look.cool), 1.5F * scale,
         [&](const Energies& e) { return e.potential - origin; });
    plot(frame, energies_, low, high, max, packed(look.accent), 1.5F * scale,
         [](const Energies& e) { return e.kinetic; });
    plot(frame, energies_, low, high, max, packed(look.good), 2 * scale,
         [&](const Energies& e) { return total(e) - origin; });
}

} // namespace sinew::window
