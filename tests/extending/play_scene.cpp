#include "sinew/scene/layout.h"
#include "sinew/scene/scene.h"
#include "sinew/solver/solver.h"
#include "sinew/world/edit.h"
#include "sinew/world/measure.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <variant>
#include <vector>

/// Plays the scene of docs/how/extending.md and checks what its text says of it: play_scene FILE [KEY=VALUE]...
namespace {

int wrong = 0;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::printf("does not hold: %s\n", what);
    ++wrong;
}

template <int D, class Real> void check(sinew::World<D, Real>& world, double seconds) {
    sinew::Solver<D, Real> solver;
    for (int i = 0; i < int(seconds * 60); ++i) solver.step(world, Real(1.0 / 60));
    const auto ball = *position_of(world, *find_particle(world, "ball/middle"));
    expect(std::abs(double(ball[1]) - 1) < 1e-5, "the ball keeps its height");
    expect(double(ball[0]) > -1.5, "the ball slides");
    double lowest = 1e9, highest = -1e9;
    for (const auto id : find_particles(world, "rope/*")) {
        const auto y = double((*position_of(world, id))[1]);
        lowest = std::fmin(lowest, y);
        highest = std::fmax(highest, y);
    }
    expect(lowest > -1e-5, "the rope does not fall through its floor");
    expect(highest < 1e-2, "the rope lies on its floor");
    expect(stretch(world).max < 1e-3, "the rope does not stretch");
}

} // namespace

int main(int count, char** words) {
    std::ifstream file(words[1]);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::vector<sinew::Override> overrides;
    for (int i = 2; i < count; ++i) overrides.push_back({words[i]});
    auto document = sinew::load(text, words[1], overrides);
    auto opened = sinew::open_scene(document);
    if (!opened) return std::printf("%s", to_text(document.diagnostics).c_str()), 1;
    std::visit([&](auto& world) { check(world, opened->scene.seconds); }, opened->world);

    const auto schema = to_text(sinew::schema_of(sinew::scene_layout(), "scene", true));
    expect(schema.find("\"height\"") != std::string::npos, "the schema knows the kind");
    auto slip = sinew::load(text, words[1], std::vector<sinew::Override>{{"constraints.0.kind=hieght"}});
    expect(!sinew::open_scene(slip), "a slip is an error");
    expect(to_text(slip.diagnostics).find("did you mean \"height\"?") != std::string::npos, "a slip is told its word");
    return wrong;
}
