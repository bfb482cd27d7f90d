#include "apps/cli/report_text.h"

#include "sinew/scene/text.h"

#include <fmt/format.h>

namespace sinew::cli {
namespace {

constexpr Unit energy_unit{.length = 2, .mass = 1, .time = -2};

std::string hash_text(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

} // namespace

std::string scene_text(const Scene& scene) {
    const auto units = scene.measures();
    const auto& solver = scene.solver;
    const auto effort = solver.mode == "classic" ? fmt::format("{} passes", solver.passes)
                        : solver.substeps == 0   ? std::string("as many substeps as it takes")
                                                 : fmt::format("{} substeps", solver.substeps);
    return fmt::format("{}D, in {}, {} and {}; {}, {}, {:g} steps a second of {}", scene.dimension, units.length,
                       units.mass, units.time, solver.mode, solver.precision, solver.rate, effort);
}

std::string quantity(double value, Unit unit, const Scene& scene) {
    const auto name = scene.measures().text(unit);
    return fmt::format("{:.5g}{}{}", value, name.empty() ? "" : " ", name);
}

std::string percent(double fraction) {
    return fmt::format("{:.3g} %", 100 * fraction);
}

std::vector<std::vector<std::string>> report_rows(const Report& report, const Scene& scene) {
    const auto energy = [&](double value) { return quantity(value, energy_unit, scene); };
    return {
        {"simulated", fmt::format("{:g} s in {} steps", report.seconds, report.steps)},
        {"particles", std::to_string(report.particles)},
        {"constraints", std::to_string(report.constraints)},
        {"energy", energy(report.kinetic + report.potential + report.stored)},
        {"  kinetic", energy(report.kinetic)},
        {"  potential", energy(report.potential)},
        {"  stored", energy(report.stored)},
        {"  lost to blows", energy(report.energy_lost)},
        {"largest stretch", percent(report.stretch_max)},
        {"mean stretch", percent(report.stretch_mean)},
        {"top speed", quantity(report.max_speed, unit::speed, scene)},
        {"hash", hash_text(report.hash)},
    };
}

json::Object scene_json(const std::string& name, const Scene& scene) {
    const auto units = scene.measures();
    return {
        {"scene", printable(name, 4096)},
        {"mode", scene.solver.mode},
        {"precision", scene.solver.precision},
        {"dimension", scene.dimension},
        {"units", json::Object{{"length", units.length}, {"mass", units.mass}, {"time", units.time}}},
    };
}

json::Object report_json(const Report& report) {
    const json::Object energy{{"kinetic", report.kinetic},
                              {"potential", report.potential},
                              {"stored", report.stored},
                              {"total", report.kinetic + report.potential + report.stored}};
    return {
        {"seconds", report.seconds},           {"steps", report.steps},
        {"particles", report.particles},       {"constraints", report.constraints},
        {"hash", hash_text(report.hash)},      {"energy", energy},
        {"energy_lost", report.energy_lost},   {"stretch_max", report.stretch_max},
        {"stretch_mean", report.stretch_mean}, {"max_speed", report.max_speed},
    };
}

} // namespace sinew::cli
