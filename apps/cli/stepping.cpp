#include "apps/cli/stepping.h"

#include "sinew/simulation.h"
#include "sinew/solver/simd/kernel.h"

#include "apps/cli/console.h"
#include "canvas/interrupt.h"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

/// Tolerance, in steps: 0.1 s at 60 Hz are 6 steps, although rounding gives 6.000000000000001 or 5.999999999999999.
constexpr double rounding = 1e-6;

/// The instruction set named by the environment, where this processor has it; else the best.
Simd wanted_simd() {
    const char* const name = std::getenv("SINEW_SIMD");
    return (name ? simd_called(name) : std::nullopt).value_or(best_simd());
}

} // namespace

std::uint64_t steps_before(const Scene& scene, double seconds) {
    return std::uint64_t(std::floor(seconds * scene.solver.rate + rounding));
}

std::uint64_t steps_until(const Scene& scene, double seconds) {
    return std::uint64_t(std::ceil(std::fmax(seconds * scene.solver.rate - rounding, 0)));
}

Run::Run(Session begun, int threads) : session(std::move(begun)) {
    taken = std::visit([](const auto& world) { return world.steps; }, session.world());
    session.set_options({.threads = threads, .simd = wanted_simd()});
    const bool is_large = std::visit(
        [](const auto& world) {
            constexpr std::size_t soon = 30'000; // particles; smaller worlds are prepared in no time
            return world.settings.mode != Mode::classic && world.particles.size() >= soon;
        },
        session.world());
    if (!is_large) return;
    canvas::Progress progress("getting ready", 100);
    session.set_reports({.times = {}, .preparing = [&](double share) { progress.update(std::size_t(100 * share)); }});
    session.prepare();
    session.set_reports({});
}

void Run::expect_ahead(std::string_view option, double seconds) const {
    if (taken <= steps_until(session.scene(), seconds)) return;
    const double now = session.seconds();
    usage_error(fmt::format("{} {:.6g} has passed: the scene stands at {:.6g} s", option, seconds, now),
                fmt::format("seconds count from the scene's start; {} {:.6g} goes on for {:.6g} s", option,
                            now + seconds, seconds));
}

void Run::step() {
    give_up_if_interrupted();
    if (pointer)
        for (const auto& action : pointer->moves(session)) {
            play::carry_out(action, session);
            if (witness) witness->act(action, session);
        }
    session.step();
    if (witness) witness->step(session);
}

void Run::advance(std::uint64_t steps) {
    for (; taken < steps; ++taken) step();
}

void Run::advance(std::uint64_t steps, canvas::Progress& progress, std::uint64_t others) {
    for (; taken < steps; ++taken) {
        step();
        progress.update(std::size_t(others + taken));
    }
}

void give_up_if_interrupted() {
    if (canvas::interrupted()) throw CommandError{canvas::interrupt_exit_code(), "sinew: interrupted\n"};
}

} // namespace sinew::cli
