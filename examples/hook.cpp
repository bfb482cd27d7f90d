// A grappling hook in C++ with SDL2: the mouse aims, its left button holds, the wheel shortens the rope, A and D walk.
//   c++ hook.cpp -o hook $(pkg-config --cflags --libs sinew sdl2)
// hook FRAMES FILE.bmp plays by itself, a step a frame, and keeps the last picture (SDL_VIDEODRIVER=dummy: no screen).
#include "sinew/sinew.h"
#include "sinew/world/colliders.h"
#include "sinew/world/query.h"

#include <SDL.h>
#include <cstdio>
#include <optional>

using Vec = sinew::Vec2<double>;
namespace collide = sinew::collide;

constexpr int width = 960, height = 540;
constexpr double pixels = 40; // a metre

struct Block {
    Vec at, size;
};
constexpr Block blocks[] = {{{{5, 10}}, {{3, 0.6}}},
                            {{{12, 11}}, {{4, 0.6}}},
                            {{{19, 9}}, {{3, 0.6}}},
                            {{{9, 1.5}}, {{1.5, 3}}},
                            {{{16, 2}}, {{1.5, 4}}}};

struct Input {
    Vec aim{};
    double walk = 0, reel = 0; // left or right; metres to shorten the rope by
    bool holds = false, quits = false;
};

struct Level {
    sinew::Simulation<2> simulation;
    sinew::World<2, double>& world = simulation.world;
    sinew::ParticleId hero, hook;
    std::optional<sinew::ConstraintId> rope;
    double length = 0;

    Level() {
        set_gravity(world, {0, -9.81});
        add_plane(world, {.normal = {0, 1}, .offset = 0, .friction = 0.6});
        for (const auto& [at, size] : blocks)
            add_collider(world, {.shape = collide::Box<2, double>{size}, .target = {.position = at}, .friction = 0.6});
        hero = add_particle(world, sinew::ParticleSpec<2, double>{.position = {2, 3}, .mass = 60, .radius = 0.4});
    }

    Vec place(sinew::ParticleId id) const { return *position_of(world, id); }

    // A pinned particle where the ray meets a wall, and a distance of at most the length to it.
    void shoot(const Vec& aim) {
        const auto from = place(hero), way = direction(aim - from) * 15.0;
        const auto hit = cast_ray(world, from + way * (0.5 / norm(way)), way, 0.0, {.layers = ~0U, .mask = 1});
        if (!hit || !hit->is_collider) return;
        length = distance(from, hit->point);
        hook = add_particle(world, sinew::ParticleSpec<2, double>{.position = hit->point});
        pin(world, hook);
        rope = sinew::add<sinew::Distance>(world, {hook, hero}, {.limits = sinew::at_most(length)});
    }
    void let_go() {
        if (rope) remove_particles(world, std::span(&hook, 1)); // and with it pin and rope
        rope.reset();
    }

    void wind(double by) {
        if (rope && by != 0) set_limits(world, *rope, sinew::at_most(length = std::max(1.0, length - by)));
    }
    void step(const Input& input) {
        if (input.holds && !rope) shoot(input.aim);
        if (!input.holds) let_go();
        apply_force(world, hero, Vec{{input.walk * 400, 0}});
        simulation.step(1.0 / 60);
    }
};

SDL_FPoint on_screen(const Vec& p) {
    return {float(p[0] * pixels), float(height - p[1] * pixels)};
}

void draw(SDL_Renderer* renderer, const Level& level) {
    SDL_SetRenderDrawColor(renderer, 245, 243, 238, 255);
    SDL_RenderClear(renderer);
    SDL_SetRenderDrawColor(renderer, 90, 100, 120, 255);
    for (const auto& [at, size] : blocks) {
        const auto corner = on_screen({{at[0] - size[0] / 2, at[1] + size[1] / 2}});
        const SDL_FRect box{corner.x, corner.y, float(size[0] * pixels), float(size[1] * pixels)};
        SDL_RenderFillRectF(renderer, &box);
    }
    const auto hero = on_screen(level.place(level.hero));
    if (level.rope) {
        const auto anchor = on_screen(level.place(level.hook));
        SDL_SetRenderDrawColor(renderer, 160, 110, 60, 255);
        SDL_RenderDrawLineF(renderer, hero.x, hero.y, anchor.x, anchor.y);
    }
    SDL_SetRenderDrawColor(renderer, 210, 70, 60, 255);
    for (int y = -16; y <= 16; ++y) { // a disc, line by line
        const float half = float(SDL_sqrt(double(16 * 16 - y * y)));
        SDL_RenderDrawLineF(renderer, hero.x - half, hero.y + float(y), hero.x + half, hero.y + float(y));
    }
    SDL_RenderPresent(renderer);
}

Input from_player() {
    static Input input; // keys and buttons stay down between events
    input.reel = 0;
    for (SDL_Event event; SDL_PollEvent(&event);) {
        if (event.type == SDL_QUIT) input.quits = true;
        if (event.type == SDL_MOUSEWHEEL) input.reel += 0.3 * event.wheel.y;
    }
    int x = 0, y = 0;
    input.holds = (SDL_GetMouseState(&x, &y) & SDL_BUTTON_LMASK) != 0;
    input.aim = {{x / pixels, (height - y) / pixels}};
    const auto* keys = SDL_GetKeyboardState(nullptr);
    input.walk = keys[SDL_SCANCODE_D] - keys[SDL_SCANCODE_A];
    return input;
}

// From platform to platform, 75 frames each: holds on, winds in, lets go.
Input by_itself(int frame) {
    return {.aim = blocks[frame / 75 % 3].at, .walk = 1, .reel = 0.02, .holds = frame % 75 < 65};
}

int main(int count, char** words) {
    const int frames = count > 1 ? SDL_atoi(words[1]) : 0;
    if (SDL_Init(SDL_INIT_VIDEO) != 0) return std::fprintf(stderr, "%s\n", SDL_GetError()), 1;
    auto* window = SDL_CreateWindow("hook", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width, height, 0);
    auto* renderer = SDL_CreateRenderer(window, -1, frames ? SDL_RENDERER_SOFTWARE : SDL_RENDERER_PRESENTVSYNC);
    if (!renderer) return std::fprintf(stderr, "%s\n", SDL_GetError()), 1;
    Level level;
    double highest = 0, due = 0; // steps of 1/60 s
    auto last = SDL_GetTicks64();
    for (int frame = 0; !frames || frame < frames; ++frame) {
        const auto input = frames ? by_itself(frame) : from_player();
        if (input.quits) break;
        const auto now = SDL_GetTicks64();
        due += frames ? 1 : std::min(0.06 * double(now - std::exchange(last, now)), 6.0); // no backlog after a pause
        level.wind(input.reel);
        for (; due >= 1; --due) level.step(input);
        draw(renderer, level);
        highest = std::max(highest, level.place(level.hero)[1]);
    }
    if (count > 2) {
        auto* picture = SDL_CreateRGBSurfaceWithFormat(0, width, height, 32, SDL_PIXELFORMAT_ARGB8888);
        SDL_RenderReadPixels(renderer, nullptr, SDL_PIXELFORMAT_ARGB8888, picture->pixels, picture->pitch);
        SDL_SaveBMP(picture, words[2]);
    }
    std::printf("highest %.2f m, %zu particles\n", highest, level.world.particles.size());
    SDL_Quit();
}
