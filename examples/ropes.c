/* Ropes, a ragdoll and a ball in C11 with SDL2, without a scene file: a world built by calls, drawn by callbacks,
 * thrown about with the mouse. cc ropes.c -o ropes $(pkg-config --cflags --libs sinew-c sdl2) ropes FRAMES FILE.bmp
 * plays by itself, a step a frame, and keeps the last picture (SDL_VIDEODRIVER=dummy: without a screen). */
#include <SDL.h>
#include <math.h>
#include <sinew.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 800, HEIGHT = 600 };
static const double pixels = 100; /* a metre */

static SDL_FPoint on_screen(sinew_point p) {
    return (SDL_FPoint){(float)(WIDTH / 2 + p.x * pixels), (float)(HEIGHT - 60 - p.y * pixels)};
}
static sinew_point from_screen(int x, int y) {
    return (sinew_point){(x - WIDTH / 2) / pixels, (HEIGHT - 60 - y) / pixels, 0};
}

static void color(SDL_Renderer* renderer, uint32_t rgb) {
    SDL_SetRenderDrawColor(renderer, (Uint8)(rgb >> 16), (Uint8)(rgb >> 8), (Uint8)rgb, 255);
}
static void segment(void* renderer, sinew_point from, sinew_point to, double radius, uint32_t rgb) {
    const SDL_FPoint a = on_screen(from), b = on_screen(to);
    (void)radius;
    color(renderer, rgb);
    SDL_RenderDrawLineF(renderer, a.x, a.y, b.x, b.y);
}
static void disc(void* renderer, sinew_point center, double radius, uint32_t rgb) {
    const SDL_FPoint c = on_screen(center);
    const double r = fmax(radius * pixels, 2);
    color(renderer, rgb);
    for (int y = (int)-r; y <= r; ++y) {
        const float half = (float)sqrt(r * r - y * y);
        SDL_RenderDrawLineF(renderer, c.x - half, c.y + (float)y, c.x + half, c.y + (float)y);
    }
}
static void polygon(void* renderer, const sinew_point* corners, size_t count, uint32_t rgb) {
    for (size_t i = 0; i < count; ++i) segment(renderer, corners[i], corners[(i + 1) % count], 0, rgb);
}

/* Every failure ends the program: a game would log it. */
static void complain(void* context, sinew_status status, const char* message) {
    (void)context;
    if (status == SINEW_NOT_FOUND) return; /* nothing under the mouse */
    fprintf(stderr, "sinew: %s\n", message);
    exit(1);
}

static void add(sinew_world world, const char* prefab, double x, double y, const sinew_parameter* parameters,
                uint32_t count) {
    const sinew_figure_spec spec = {.struct_size = sizeof spec,
                                    .prefab = prefab,
                                    .position = {x, y, 0},
                                    .parameters = parameters,
                                    .parameter_count = count};
    sinew_world_add_figure(world, &spec, NULL);
}

static sinew_world make_world(void) {
    sinew_world world;
    const sinew_world_spec spec = {.struct_size = sizeof spec, .gravity = {0, -9.81, 0}, .damping = 0.1};
    sinew_world_create(&spec, &world);

    sinew_collider floor_and_ramp;
    const sinew_point ground[] = {{-5, 1.5, 0}, {-2.5, 0, 0}, {2.5, 0, 0}, {5, 1.5, 0}};
    const sinew_collider_spec terrain = {
        .struct_size = sizeof terrain, .shape = SINEW_TERRAIN_2D, .points = ground, .point_count = 4, .friction = 0.5};
    sinew_world_add_collider(world, &terrain, &floor_and_ramp);

    for (int i = 0; i < 5; ++i) {
        const sinew_parameter rope[] = {{"length", 1.2 + 0.3 * i, NULL}, {"segments", 12, NULL}, {"weight", 2, NULL}};
        add(world, "rope", -3 + i * 0.6, 4.5, rope, 3);
    }
    add(world, "ragdoll", 1.5, 2, NULL, 0);

    sinew_particle ball;
    const sinew_particle_spec heavy = {
        .struct_size = sizeof heavy, .position = {-3.5, 2.5, 0}, .mass = 20, .radius = 0.3};
    sinew_world_add_particle(world, &heavy, &ball);
    return world;
}

/* The mouse, or for the first frames of a test a hand that pulls the third rope aside. */
static int play(sinew_world world, int frame, int alone) {
    SDL_Event event;
    while (SDL_PollEvent(&event)) {
        if (event.type == SDL_QUIT) return 0;
        if (event.type == SDL_MOUSEBUTTONDOWN)
            sinew_world_grab(world, from_screen(event.button.x, event.button.y), 0.3);
        if (event.type == SDL_MOUSEMOTION) sinew_world_drag(world, from_screen(event.motion.x, event.motion.y));
        if (event.type == SDL_MOUSEBUTTONUP) sinew_world_let_go(world);
    }
    if (alone && frame == 0) {
        sinew_particle end;
        sinew_world_find_particle(world, "rope_3/end", &end);
        sinew_world_grab_particle(world, end);
    }
    if (alone && frame < 40) sinew_world_drag(world, (sinew_point){-1.8 + frame * 0.03, 3, 0});
    if (alone && frame == 40) sinew_world_let_go(world);
    return 1;
}

int main(int count, char** words) {
    const int frames = count > 1 ? atoi(words[1]) : 0;
    if (SDL_Init(SDL_INIT_VIDEO) != 0) return 1;
    SDL_Window* window = SDL_CreateWindow("ropes", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, WIDTH, HEIGHT, 0);
    SDL_Renderer* renderer = SDL_CreateRenderer(window, -1, frames ? SDL_RENDERER_SOFTWARE : SDL_RENDERER_PRESENTVSYNC);
    sinew_set_log(complain, NULL);
    const sinew_world world = make_world();
    const sinew_debug_draw draw = {
        .struct_size = sizeof draw, .context = renderer, .segment = segment, .sphere = disc, .polygon = polygon};
    double due = 0; /* steps of 1/60 s */
    Uint64 last = SDL_GetTicks64();
    for (int frame = 0; (!frames || frame < frames) && play(world, frame, frames); ++frame) {
        const Uint64 now = SDL_GetTicks64();
        due += frames ? 1 : fmin(0.06 * (double)(now - last), 6); /* no backlog after a pause */
        last = now;
        sinew_world_step(world, (uint32_t)due);
        due -= floor(due);
        color(renderer, 0xf5f3ee);
        SDL_RenderClear(renderer);
        sinew_world_draw_debug(world, &draw, 5);
        SDL_RenderPresent(renderer);
    }
    if (count > 2) {
        SDL_Surface* picture = SDL_CreateRGBSurfaceWithFormat(0, WIDTH, HEIGHT, 32, SDL_PIXELFORMAT_ARGB8888);
        SDL_RenderReadPixels(renderer, NULL, SDL_PIXELFORMAT_ARGB8888, picture->pixels, picture->pitch);
        SDL_SaveBMP(picture, words[2]);
    }
    sinew_report report = {.struct_size = sizeof report};
    sinew_world_get_report(world, &report);
    printf("%.0f steps, stretch %.4f %%\n", report.steps, 100 * report.stretch_max);
    sinew_world_close(world);
    SDL_Quit();
    return 0;
}
