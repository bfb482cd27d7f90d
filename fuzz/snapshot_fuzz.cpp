#include "sinew/math/hash.h"
#include "sinew/session/session_snapshot.h"
#include "sinew/simulation.h"
#include "sinew/snapshot/snapshot.h"
#include "sinew/world/measure.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace {

using namespace sinew;
using Bytes = std::vector<std::byte>;

constexpr std::size_t head = 16, header = 64;

/// Sets lengths and checksums to the true ones, or no input would get any further.
void mend(Bytes& bytes) {
    std::size_t at = header;
    for (std::size_t part = 0; part < 3; ++part) {
        std::uint64_t size = 0;
        std::memcpy(&size, bytes.data() + head + 16 * part, sizeof size);
        size = part == 2 ? bytes.size() - at : std::min<std::uint64_t>(size, bytes.size() - at);
        Hash hash;
        hash.add(std::span(bytes).first(head));
        hash.add(std::span(bytes).subspan(at, std::size_t(size)));
        const auto sum = hash.value();
        std::memcpy(bytes.data() + head + 16 * part, &size, sizeof size);
        std::memcpy(bytes.data() + head + 8 + 16 * part, &sum, sizeof sum);
        at += std::size_t(size);
    }
}

/// An accepted snapshot is saved as it was restored, and steps on, finite.
template <int D, class Real> void check(const Bytes& bytes) {
    Simulation<D, Real> simulation;
    if (restore(simulation.world, bytes, {.memory = 50'000'000})) return;
    const auto saved = save(simulation.world);
    World<D, Real> again;
    if (restore(again, saved) || save(again) != saved) std::abort();
    if (state_hash(again) != state_hash(simulation.world)) std::abort();
    if (simulation.world.settings.substeps > 32 || simulation.world.settings.iterations > 8) return; // takes too long
    for (int i = 0; i < 10; ++i) simulation.step(Real(1.0 / 60));
    const auto& positions = simulation.world.particles.position;
    if (!std::all_of(positions.begin(), positions.end(), [](const auto& p) { return is_finite(p); })) std::abort();
}

/// Small scenes only: a fuzzer's seconds are for readers.
std::optional<Opened> opened(const std::string& text, const std::string&) {
    auto document = load(text, "fuzz.json");
    if (document.limits.particles > 2000) document.limits.particles = 2000;
    return open_scene(document);
}

/// The same for a session.
void check_session(const Bytes& bytes) {
    SnapshotError error;
    auto session = session_of(bytes, opened, error, {.memory = 50'000'000});
    if (!session) return;
    const auto saved = save(*session);
    const auto again = session_of(saved, opened, error);
    if (!again || save(*again) != saved) std::abort();
    const bool is_quick = std::visit(
        [](const auto& world) {
            return world.settings.substeps <= 32 && world.settings.iterations <= 8 &&
                   world.settings.classic.passes <= 100;
        },
        session->world());
    for (int i = 0; is_quick && i < 10; ++i) session->step();
}

} // namespace

/// Any bytes are restored as a world or a session that goes on, or refused.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < header) return 0;
    Bytes bytes(size);
    std::memcpy(bytes.data(), data, size);
    mend(bytes);
    check<2, float>(bytes);
    check<2, double>(bytes);
    check<3, float>(bytes);
    check<3, double>(bytes);
    check_session(bytes);
    return 0;
}
