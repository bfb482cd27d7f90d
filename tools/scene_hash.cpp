#include "sinew/session/session.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>

// scene_hash SECONDS SCENE [KEY=VALUE...]: prints the hash of the final world, and nothing else. Needs the library
// alone: a cross compiler without other libraries can build the program (tools/same_bits).

namespace {

using namespace sinew;

std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

int fail(const char* what, const std::string& which) {
    std::fprintf(stderr, "scene_hash: %s %s\n", what, which.c_str());
    return 1;
}

} // namespace

int main(int count, char** words) {
    if (count < 3) return fail("usage: scene_hash SECONDS", "SCENE [KEY=VALUE...]");
    const double seconds = std::strtod(words[1], nullptr);
    const std::string path = words[2], folder = path.substr(0, path.rfind('/') + 1);
    std::vector<Override> overrides;
    for (const char* word : std::span(words, std::size_t(count)).subspan(3)) overrides.push_back({word});

    auto document = load(text_of(path), path, overrides);
    // images do not affect the motion
    const auto any_image = [](const std::string&, const Limits&) {
        return ReadImage{with_halves({1, 1, {0xffffffff}}), "", ""};
    };
    const auto model = [&](const std::string& name, const Limits& limits) {
        return read_model(text_of(folder + name), name, limits);
    };
    auto opened = open_scene(document, any_image, model);
    if (!opened) return fail("cannot open", path);
    const auto steps = std::uint64_t(std::ceil(seconds * opened->scene.solver.rate - 1e-9));
    Session session(std::move(*opened));
    for (std::uint64_t step = 0; step < steps; ++step) session.step();
    std::printf("%016llx\n", static_cast<unsigned long long>(session.report().hash));
}
