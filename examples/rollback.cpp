// Two players in one world over a link that is late and loses packets. Each guesses what the other does, and plays
// again from the step where the guess was wrong: in the end both worlds have the hash of a game without delay.
//   c++ -std=c++20 rollback.cpp -o rollback $(pkg-config --cflags --libs sinew)
// rollback STEPS FILE.svg draws what both see before the last packets have arrived, and what there really is.
#include "sinew/snapshot/rollback.h"

#include "sinew/math/random.h"
#include "sinew/sinew.h"
#include "sinew/world/colliders.h"

#include <cstdio>
#include <fstream>
#include <utility>

using Vec = sinew::Vec2<double>;
using sinew::random::whole;

struct Input {
    int walk = 0; // left or right
    bool jumps = false;
    bool operator==(const Input&) const = default;
};
using Inputs = std::array<Input, 2>; // of both players

struct Game {
    sinew::Simulation<2> simulation;
    sinew::World<2, double>& world = simulation.world;
    std::array<sinew::ParticleId, 2> heroes;

    Game() {
        set_gravity(world, {0, -9.81});
        for (const auto& [normal, offset] : {std::pair{Vec{0, 1}, 0.0}, {Vec{1, 0}, -4.0}, {Vec{-1, 0}, -4.0}})
            add_plane(world, {.normal = normal, .offset = offset, .friction = 0.6});
        for (int i = 0; i < 8; ++i)
            build(world, sinew::Box{.mass = 2}, "crate", {.at = {i / 4 - 0.5, 0.3 + 0.6 * (i % 4)}});
        build(world, sinew::Ragdoll{.mass = 20, .pose = "star"}, "rider", {.at = {0, 3.6}});
        build(world, sinew::Ball{.radius = 0.35, .mass = 15}, "one", {.at = {-3, 0.4}});
        build(world, sinew::Ball{.radius = 0.35, .mass = 15}, "two", {.at = {3, 0.4}});
        for (sinew::FigureIndex figure = 0; figure < world.figures.size(); ++figure)
            set_contact(world, figure, {.figures = true});
        heroes = {*find_particle(world, "one/ball"), *find_particle(world, "two/ball")};
    }
    void step(const Inputs& inputs) {
        for (std::size_t player = 0; player < 2; ++player) {
            const bool stands = (*position_of(world, heroes[player]))[1] < 0.5;
            apply_force(world, heroes[player], Vec{inputs[player].walk * 250.0, 0});
            if (inputs[player].jumps && stands) apply_impulse(world, heroes[player], Vec{0, 75});
        }
        simulation.step(1.0 / 60);
    }
};

struct Peer {
    static constexpr std::size_t window = 20; // steps ahead of the other's inputs; beyond, the game waits
    std::size_t own;                          // number of the player
    Game game{};
    sinew::Rollback<2, double> ring{window + 1};
    std::size_t now = 0, repeated = 0;                              // steps taken, and taken again
    std::vector<Input> mine{}, theirs{}, taken{};                   // by step; taken: of the other, known or guessed
    std::vector<std::pair<std::size_t, std::vector<Input>>> mail{}; // packets under way, and when they arrive

    void step(const Input& input) {
        if (now >= theirs.size() + window) return;
        mine.push_back(input);
        ring.keep(game.world);
        play(now++);
    }
    void play(std::size_t step) {
        taken.resize(step + 1);
        taken[step] = step < theirs.size() ? theirs[step] : step > 0 ? taken[step - 1] : Input{}; // a guess: as before
        game.step(own == 0 ? Inputs{mine[step], taken[step]} : Inputs{taken[step], mine[step]});
    }
    void receive(std::size_t tick) {
        for (const auto& [arrives, inputs] : mail)
            if (arrives == tick && inputs.size() > theirs.size()) theirs = inputs;
        const auto known = std::ptrdiff_t(std::min(now, theirs.size()));
        const auto wrong = std::mismatch(taken.begin(), taken.begin() + known, theirs.begin()).first - taken.begin();
        if (wrong < known) play_again(std::size_t(wrong));
    }
    void play_again(std::size_t first) {
        ring.go_back(game.world, now - 1 - first);
        repeated += now - first;
        for (auto step = first; step < now; ++step) {
            if (step > first) ring.keep(game.world);
            play(step);
        }
    }
};

// Every third packet is lost, the others take 2 to 12 frames. Each has all inputs; those of the last 40 steps would do.
void send(const Peer& from, Peer& to, std::size_t tick) {
    if (whole(0, 2, 5, from.own, tick) == 0) return;
    to.mail.push_back({tick + std::size_t(whole(2, 12, 6, from.own, tick)), from.mine});
}

// Towards the other, now and then back, and a jump every 50 steps.
Input of_player(std::size_t player, std::size_t step) {
    return {(player == 0 ? 1 : -1) * int(whole(-1, 2, 7, player, step / 15)), step % 50 == 10 * player};
}

// A panel of a picture in SVG, in metres. Circles: where the players really are.
void draw(std::ostream& out, const Game& game, const Game& honest, int panel, const char* title) {
    out << "<g transform='translate(" << 4.5 + 9 * panel << " 5) scale(1 -1)'><path d='M-4 4.3V0H4V4.3'/>\n"
        << "<text transform='translate(-3.8 3.9) scale(1 -1)'>" << title << "</text>\n";
    for (const auto& figure : game.world.figures)
        for (const auto& piece : figure.pieces) {
            if (piece.hidden) continue;
            out << "<polyline class='" << figure.name << "' stroke-width='" << piece.width << "' points='";
            for (std::size_t i = 0; i < piece.particles.size() + (piece.mark == sinew::Mark::dot); ++i) {
                const auto at = *position_of(game.world, piece.particles[i % piece.particles.size()]);
                out << at[0] << ',' << at[1] << ' '; // a dot is a line of no length
            }
            out << "'/>\n";
        }
    for (const auto at : {*position_of(honest.world, honest.heroes[0]), *position_of(honest.world, honest.heroes[1])})
        out << "<circle cx='" << at[0] << "' cy='" << at[1] << "' r='.37' stroke-width='.04'/>\n";
    out << "</g>\n";
}

constexpr auto head =
    "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 27 5.3' width='1350' font-size='.45'><style>*{fill:none;"
    "stroke:#445;stroke-linecap:round;stroke-linejoin:round}text{fill:#222;stroke:none}path{stroke-width:.05}"
    ".one{stroke:#c43}.two{stroke:#36b}.rider{stroke:#a73}</style>\n";

int main(int count, char** words) {
    const std::size_t steps = count > 1 ? std::stoul(words[1]) : 600;
    Peer one{.own = 0}, two{.own = 1};
    Game honest;
    for (std::size_t step = 0; step < steps; ++step) honest.step({of_player(0, step), of_player(1, step)});
    const auto is_done = [&](const Peer& peer) { return peer.now == steps && peer.theirs.size() == steps; };
    bool drawn = count < 3;
    for (std::size_t tick = 0; !is_done(one) || !is_done(two); ++tick) {
        for (auto* peer : {&one, &two}) {
            peer->receive(tick);
            if (peer->now < steps) peer->step(of_player(peer->own, peer->now));
        }
        send(one, two, tick), send(two, one, tick);
        if (one.now < steps || two.now < steps || std::exchange(drawn, true)) continue;
        std::ofstream out(words[2]);
        out << head;
        draw(out, one.game, honest, 0, "player one"), draw(out, two.game, honest, 1, "player two");
        draw(out, honest, honest, 2, "without delay"), out << "</svg>\n";
    }
    const auto hash = state_hash(honest.world);
    const bool is_same = hash == state_hash(one.game.world) && hash == state_hash(two.game.world);
    std::printf("%zu steps, %zu and %zu of them repeated: %s\n", steps, one.repeated, two.repeated,
                is_same ? "same hash" : "DIFFERENT");
    return is_same ? 0 : 1;
}
