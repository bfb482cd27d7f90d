#include "sinew/session/history.h"

#include "sinew/assert/assert.h"
#include "sinew/world/edit.h"
#include "sinew/world/measure.h"

#include <algorithm>

namespace sinew {
namespace {

template <int D, class Real> Vec3<double> in_space(const Vec<D, Real>& vector) {
    Vec3<double> wide{};
    for (int i = 0; i < D; ++i) wide[i] = double(vector[i]);
    return wide;
}

/// A named particle, or all remaining particles of a figure.
template <class WorldT> std::vector<ParticleId> members_of(const WorldT& world, const std::string& of) {
    if (const auto id = find_particle(world, of)) return {*id};
    std::vector<ParticleId> members;
    if (const auto figure = find_figure(world, of))
        for (const auto id : world.figures[*figure].particles)
            if (row_of(world, id)) members.push_back(id);
    return members;
}

/// Mean of a vector quantity; `members` must not be empty.
template <class Value> Vec3<double> mean_over(std::span<const ParticleId> members, Value&& value) {
    SINEW_ASSERT(!members.empty(), "a mean needs a member");
    Vec3<double> sum{};
    for (const auto id : members) sum += in_space(*value(id));
    return sum * (1 / double(members.size()));
}

template <class WorldT> Energy energy_called(const WorldT& world, const std::string& of) {
    if (const auto id = find_particle(world, of)) return energy_of(world, *id);
    const auto figure = find_figure(world, of);
    return figure ? energy_of(world, *figure) : Energy{};
}

/// Empty if no particle remains.
template <class WorldT>
std::optional<Vec3<double>> measured(const WorldT& world, const std::string& of, std::string_view shows) {
    const auto members = members_of(world, of);
    if (members.empty()) return std::nullopt;
    if (shows == "path") return mean_over(members, [&](ParticleId id) { return position_of(world, id); });
    if (shows == "speed")
        return Vec3<double>{{norm(mean_over(members, [&](ParticleId id) { return velocity_of(world, id); }))}};
    const auto energy = energy_called(world, of);
    if (shows == "kinetic") return Vec3<double>{{energy.kinetic}};
    if (shows == "potential") return Vec3<double>{{energy.potential + energy.stored}};
    return Vec3<double>{{energy.total()}};
}

/// Doubles the spacing: drops every second sample.
void thin_out(std::vector<Sample>& samples, std::uint64_t& spacing) {
    SINEW_ASSERT(!samples.empty(), "a series that is full has samples");
    spacing *= 2;
    const auto first = samples.front().step;
    std::erase_if(samples, [&](const Sample& sample) { return (sample.step - first) % spacing != 0; });
}

} // namespace

void History::restart(const Scene& scene, const AnyWorld& world) {
    series_.clear();
    for (const auto& trace : scene.traces) {
        series_.push_back({trace.of, trace.shows, 1, {}});
        series_.back().samples.reserve(max_samples + 1);
    }
    record(scene, world);
}

bool History::is_of(const Scene& scene) const {
    return std::ranges::equal(series_, scene.traces, [](const Series& series, const TraceSection& trace) {
        return series.of == trace.of && series.shows == trace.shows;
    });
}

bool History::is_sound() const {
    return std::ranges::all_of(series_, [](const Series& series) {
        return series.spacing > 0 && series.samples.size() <= max_samples &&
               std::ranges::is_sorted(series.samples, {}, &Sample::step);
    });
}

void History::record(const Scene& scene, const AnyWorld& world) {
    std::visit(
        [&](const auto& known) {
            const double seconds = known.time / scene.measures().per_second;
            for (auto& [of, shows, spacing, samples] : series_) {
                while (!samples.empty() && samples.back().step >= known.steps) samples.pop_back();
                const bool between =
                    samples.size() > 1 && samples.back().step - samples[samples.size() - 2].step < spacing;
                if (between) samples.pop_back(); // kept only while the latest
                const auto value = measured(known, of, shows);
                if (value) samples.push_back({known.steps, seconds, *value});
                if (samples.size() > max_samples) thin_out(samples, spacing);
            }
        },
        world);
}

} // namespace sinew
