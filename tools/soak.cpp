#include "sinew/world/edit.h"

#include "tools/scene_of_file.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <span>
#include <string>
#include <unistd.h>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

// soak SECONDS FOLDER [SEED]: plays every scene of a folder in turns, with random hands: grabs, throws, cuts, pins,
// additions, removals, other settings, returns to earlier moments. Exit code 1, and the seed of the turn, if a position
// is not finite, a figure is quarantined, a moment gone back to has another future, or memory grows from lap to lap. A
// step that takes much longer than in the first lap is told.
// An hour: soak 3600 scenes

namespace {

using namespace sinew;
using Clock = std::chrono::steady_clock;

Session opened(const std::filesystem::path& path) {
    auto scene = tools::scene_of_file(path);
    if (!scene) std::exit(1);
    return Session(std::move(*scene));
}

/// Private memory in use, megabytes: what the allocator keeps for later is given back first.
double memory() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
    std::ifstream file("/proc/self/statm");
    double pages = 0, resident = 0, shared = 0;
    file >> pages >> resident >> shared;
    return (resident - shared) * double(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// A scene and the hands on it.
class Turn {
  public:
    Turn(Session session, std::uint32_t seed) : session_(std::move(session)), random_(seed) {}

    /// Plays for so many steps; the reason why something is wrong, or empty.
    std::string play(int steps) {
        for (int step = 0; step < steps; ++step) {
            if (one_in(20)) act();
            if (session_.holds()) session_.drag(anywhere());
            if (one_in(100)) moments_.push_back(session_);
            if (moments_.size() > max_moments) moments_.erase(moments_.begin());
            const auto begin = Clock::now();
            session_.step();
            milliseconds_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
            if (auto problem = problem_of(session_); !problem.empty()) return problem;
        }
        return go_back();
    }

    double median() {
        const auto middle = milliseconds_.begin() + std::ptrdiff_t(milliseconds_.size() / 2);
        std::nth_element(milliseconds_.begin(), middle, milliseconds_.end());
        return *middle;
    }

  private:
    static constexpr std::size_t max_moments = 4;
    Session session_;
    std::minstd_rand random_;
    std::vector<Session> moments_;
    std::vector<double> milliseconds_;

    bool one_in(unsigned count) { return random_() % count == 0; }
    double share() { return double(random_() % 10007) / 10006; }
    Point anywhere() {
        const auto& [from, to] = session_.focus();
        Point point{};
        for (int k = 0; k < session_.scene().dimension; ++k) point[k] = from[k] + (to[k] - from[k]) * share();
        return point;
    }

    template <class WorldT> ParticleId any_particle(const WorldT& world) {
        return world.particles.handles.id_of(Row(random_() % world.particles.size()));
    }

    void act() {
        std::visit([&](auto& world) { act_on(world); }, session_.world());
    }

    template <int D, class Real> void act_on(World<D, Real>& world) {
        if (world.particles.size() == 0) return session_.restart();
        const auto particle = any_particle(world);
        switch (random_() % 12) {
        case 0:
        case 1:
        case 2:
            session_.grab(std::span(&particle, 1), anywhere());
            return;
        case 3:
        case 4:
            session_.let_go();
            return;
        case 5:
            session_.cut({anywhere(), anywhere()});
            return;
        case 6:
            pin(world, particle);
            return;
        case 7:
            unpin_all(world, particle);
            return;
        case 8:
            add_particle(world, {.position = *position_of(world, particle), .mass = Real(0.1 + share())});
            return;
        case 9:
            if (one_in(4)) remove_particles(world, std::span(&particle, 1));
            return;
        case 10:
            return change_settings();
        default:
            return one_in(6) ? session_.restart() : void(set_velocity(world, particle, {}));
        }
    }

    void change_settings() {
        auto scene = session_.scene();
        scene.solver.substeps = 1 + int(random_() % 8);
        scene.world.gravity[0] = (share() - 0.5) * scene.world.gravity[1];
        session_.become(std::move(scene));
    }

    /// Two copies of an earlier moment have one future.
    std::string go_back() {
        if (moments_.empty()) return "";
        auto again = moments_.front(), other = again;
        for (int i = 0; i < 5; ++i) again.step(), other.step();
        if (again.report().hash != other.report().hash) return "copies of a moment have two futures";
        session_ = std::move(again);
        return problem_of(session_);
    }

    static std::string problem_of(const Session& session) {
        return std::visit(
            [](const auto& world) -> std::string {
                for (const auto& position : world.particles.position)
                    if (!is_finite(position)) return "a position is not finite";
                for (const auto& figure : world.figures)
                    if (figure.quarantined) return "a figure is quarantined: " + figure.name;
                return "";
            },
            session.world());
    }
};

std::vector<std::filesystem::path> scenes_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".json") paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

} // namespace

int main(int count, char** words) {
    if (count < 3) return std::fputs("usage: soak SECONDS FOLDER [SEED]\n", stderr), 2;
    const double seconds = std::strtod(words[1], nullptr);
    auto seed = std::uint32_t(count > 3 ? std::strtoul(words[3], nullptr, 10) : 1);
    const auto paths = scenes_in(words[2]);
    const auto begin = Clock::now();
    const auto passed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
    constexpr int steps = 300, laps_of_warmth = 2;
    constexpr double flat = 1;   // megabytes
    constexpr double slower = 4; // times: other hands tear more or less
    std::vector<double> first(paths.size());
    double warm = 0, simulated = 0;
    int lap = 0;
    for (; lap == 0 || passed() < seconds; ++lap) {
        for (std::size_t i = 0; i < paths.size() && (lap == 0 || passed() < seconds); ++i, ++seed) {
            Turn turn(opened(paths[i]), seed);
            if (const auto problem = turn.play(steps); !problem.empty()) {
                std::printf("%s, seed %u: %s\n", paths[i].filename().c_str(), seed, problem.c_str());
                return 1;
            }
            simulated += steps / 60.0;
            if (lap == 0) first[i] = turn.median();
            if (const auto now = turn.median(); lap >= laps_of_warmth && now > slower * first[i] && now > 1)
                std::printf("%s: %.2f ms a step, at first %.2f ms\n", paths[i].filename().c_str(), now, first[i]);
        }
        const auto now = memory();
        std::printf("lap %d: %.0f s, %.2f h simulated, %.2f MB\n", lap, passed(), simulated / 3600, now);
        std::fflush(stdout);
        if (lap < laps_of_warmth) warm = std::max(warm, now);
        if (now > warm + flat) return std::puts("memory grows"), 1;
    }
    return 0;
}
