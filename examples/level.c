/* A level for `sinew play`: stairs, a platform that moves, a rope over a gap. The arrows walk, space jumps, h holds on.
 *
 *     sinew play ./level.c                                   compiles it; or
 *     cc -shared -fPIC level.c -o level.so $(pkg-config --cflags sinew-c) && sinew play ./level.so
 *
 * Change a number and save (or compile again): the hero goes on where he is. */
#include <math.h>
#include <sinew_level.h>
#include <stdio.h>

static const char* const scene = "{\"sinew\": 1, \"world\": {\"gravity\": [0, -9.81]},"
                                 " \"view\": {\"center\": [5, 2], \"height\": 9, \"size\": [1280, 720]}}";

static sinew_collider platform;
static uint32_t hero;

/* Kept with the world: going back in time, and a level that is compiled again, find it as it was. */
struct memory {
    uint32_t crossings;
    uint32_t is_across;
};

#define TRY(call)                                                                                                      \
    do {                                                                                                               \
        const sinew_status status = (call);                                                                            \
        if (status != SINEW_OK) return status;                                                                         \
    } while (0)

static sinew_status add_block(sinew_world world, double left, double right, double top, sinew_collider* id) {
    sinew_collider block;
    const double height = 0.4;
    const sinew_collider_spec spec = {.struct_size = sizeof spec,
                                      .shape = SINEW_BOX,
                                      .position = {(left + right) / 2, top - height / 2, 0},
                                      .half = {(right - left) / 2, height / 2, 0},
                                      .friction = 0.7};
    return sinew_world_add_collider(world, &spec, id ? id : &block);
}

static sinew_status add_figure(sinew_world world, const char* prefab, double x, double y,
                               const sinew_parameter* parameters, uint32_t count, uint32_t* figure) {
    const sinew_figure_spec spec = {.struct_size = sizeof spec,
                                    .prefab = prefab,
                                    .position = {x, y, 0},
                                    .parameters = parameters,
                                    .parameter_count = count};
    return sinew_world_add_figure(world, &spec, figure);
}

static sinew_status build(sinew_world world) {
    TRY(add_block(world, -4, 1, 0, NULL));
    for (int i = 0; i < 5; ++i) TRY(add_block(world, 1 + 0.5 * i, 1.5 + 0.5 * i, 0.15 * (i + 1), NULL));
    TRY(add_block(world, 3.5, 5, 0.75, NULL));
    TRY(add_block(world, 5.2, 6.4, 0.75, &platform));
    TRY(add_block(world, 11, 14, 0.75, NULL));
    TRY(add_block(world, -5, 16, -2, NULL));

    const sinew_parameter rope[] = {{"length", 3.6, NULL}, {"segments", 18, NULL}, {"mass", 4, NULL}};
    TRY(add_figure(world, "rope", 9, 6, rope, 3, NULL));
    const sinew_parameter crate[] = {
        {"width", 0.5, NULL}, {"height", 0.5, NULL}, {"mass", 8, NULL}, {"contact.figures", 0, "true"}};
    TRY(add_figure(world, "box", 12.5, 1.1, crate, 4, NULL));
    const sinew_parameter body[] = {{"speed", 4, NULL}, {"contact.figures", 0, "true"}};
    return add_figure(world, "character", -3, 0, body, 2, &hero);
}

static sinew_status step(sinew_world world, const sinew_moment* moment) {
    struct memory* memory = moment->memory;
    const sinew_point at = {5.8 + 1.2 * (1 - cos(moment->seconds)), 0.55, 0};
    TRY(sinew_world_move_collider(world, platform, at, 0, NULL));

    sinew_particle feet;
    sinew_particle_state state = {.struct_size = sizeof state};
    TRY(sinew_world_find_particle(world, "character/feet", &feet));
    TRY(sinew_world_get_particle(world, feet, &state));
    const uint32_t is_across = state.position[0] > 11;
    if (is_across && !memory->is_across) printf("across, for the %u. time\n", ++memory->crossings);
    memory->is_across = is_across;
    if (state.position[1] > -1.5) return SINEW_OK;
    const sinew_point start = {-3, 0.5, 0}; /* fallen: begin again */
    sinew_particle head;
    TRY(sinew_world_find_particle(world, "character/head", &head));
    TRY(sinew_world_set_position(world, feet, start));
    return sinew_world_set_position(world, head, (sinew_point){start.x, start.y + 1.2, 0});
}

SINEW_LEVEL(.scene = scene, .build = build, .step = step, .memory = sizeof(struct memory))
