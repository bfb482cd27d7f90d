#include "files/out/trace_rows.h"

#include "sinew/math/format.h"
#include "sinew/scene/json.h"
#include "sinew/session/pick.h"
#include "sinew/world/edit.h"

#include <array>
#include <string_view>

namespace sinew::files {
namespace {

/// A field of a CSV file (RFC 4180).
std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

void add_list(std::string& text, std::span<const double> numbers) {
    const char* before = "";
    for (const double number : numbers) {
        text += before;
        text += number_text(number);
        before = ",";
    }
}

} // namespace

std::string TraceRows::heading() const {
    if (!is_table_) return {};
    constexpr std::string_view axes = "xyz";
    std::string places, speeds;
    for (const char axis : axes.substr(0, std::size_t(dimension_))) {
        places += std::string(",") + axis;
        speeds += std::string(",v") + axis;
    }
    return "time,name" + places + speeds + "\n";
}

void TraceRows::trace(const Session& session, ParticleId particle) {
    const auto name = name_of(session.world(), particle);
    traced_.push_back({particle, is_table_ ? csv_field(name) : json::to_text(json::Value(name))});
}

void TraceRows::trace_all(const Session& session) {
    std::visit(
        [&](const auto& world) {
            if (traced_.size() == world.particles.size()) return;
            traced_.clear();
            for (Row row = 0; row < world.particles.size(); ++row) trace(session, world.particles.handles.id_of(row));
        },
        session.world());
}

void TraceRows::add(const Session& session, std::string& text) const {
    std::visit(
        [&]<class WorldT>(const WorldT& world) {
            std::array<double, WorldT::dimension> position{}, velocity{};
            for (const auto& [particle, name] : traced_) {
                const auto row = row_of(world, particle);
                if (!row) continue;
                for (std::size_t i = 0; i < position.size(); ++i) {
                    position[i] = double(world.particles.position[*row][int(i)]);
                    velocity[i] = double(world.particles.velocity[*row][int(i)]);
                }
                add_row(world.time, name, position, velocity, text);
            }
        },
        session.world());
}

void TraceRows::add_row(double time, const std::string& name, std::span<const double> position,
                        std::span<const double> velocity, std::string& text) const {
    text += is_table_ ? "" : R"({"time":)";
    text += number_text(time);
    text += is_table_ ? "," : R"(,"name":)";
    text += name;
    text += is_table_ ? "," : R"(,"position":[)";
    add_list(text, position);
    text += is_table_ ? "," : R"(],"velocity":[)";
    add_list(text, velocity);
    text += is_table_ ? "\n" : "]}\n";
}

} // namespace sinew::files
