#include "apps/cli/stepping.h"

#include "sinew/simulation.h"
#include "sinew/solver/progress_report.h"

#include "apps/cli/console.h"
#include "canvas/interrupt.h"

#include <cmath>

namespace sinew::cli {
namespace {

/// Tolerance, in steps: 0.1 s at 60 Hz are 6 steps, although rounding gives 6.000000000000001 or 5.999999999999999.
constexpr double rounding = 1e-6;

} // namespace

std::uint64_t steps_before(const Scene& scene, double seconds) {
    return std::uint64_t(std::floor(seconds * scene.solver.rate + rounding));
}

std::uint64_t steps_until(const Scene& scene, double seconds) {
    return std::uint64_t(std::ceil(std::fmax(seconds * scene.solver.rate - rounding, 0)));
}

Run::Run(Opened opened) : session(std::move(opened)) {
    const bool is_large = std::visit(
        [](const auto& world) {
            constexpr std::size_t soon = 30'000; // particles; smaller worlds are prepared in no time
            return world.settings.mode != Mode::classic && world.particles.size() >= soon;
        },
        session.world());
    if (!is_large) return;
    canvas::Progress progress("getting ready", 100);
    const Waiting waiting([&](double share) { progress.update(std::size_t(100 * share)); });
    session.prepare();
}

void Run::step() {
    give_up_if_interrupted();
    if (pointer) pointer->lead(session);
    session.step();
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
