/* Force fields added, changed and removed by calls. */
#include "tests/bindings/worlds.h"

#include <math.h>
#include <string.h>

static const char* const dragged =
    "{\"sinew\": 1, \"world\": {\"gravity\": [0, -10], \"forces\": [{\"force\": \"drag\", \"strength\": 2}]}, "
    "\"figures\": [{\"name\": \"stone\", \"particles\": {\"p\": {\"at\": [0, 0]}}}, "
    "{\"name\": \"other\", \"particles\": {\"p\": {\"at\": [5, 0]}}}]}";

static sinew_world created(void) {
    const sinew_world_spec spec = {.struct_size = sizeof spec, .gravity = {0, -10, 0}};
    sinew_world world = {0};
    CHECK(sinew_world_create(&spec, &world) == SINEW_OK);
    return world;
}
static sinew_particle stone_in(sinew_world world) {
    const sinew_particle_spec spec = {.struct_size = sizeof spec, .mass = 1};
    sinew_particle stone = 0;
    CHECK(sinew_world_add_particle(world, &spec, &stone) == SINEW_OK);
    return stone;
}

/* A stone in a strong wind moves with the air; in drag it falls at m g / strength. */
static void every_kind_acts(void) {
    const sinew_force_spec specs[] = {
        {.struct_size = sizeof *specs, .kind = SINEW_GRAVITY, .acceleration = {0, 10, 0}},
        {.struct_size = sizeof *specs, .kind = SINEW_DRAG, .strength = 2},
        {.struct_size = sizeof *specs, .kind = SINEW_WIND, .strength = 50, .velocity = {3, 0, 0}},
        {.struct_size = sizeof *specs, .kind = SINEW_ATTRACTOR, .strength = 100, .center = {4, 0, 0}, .softness = 4},
        {.struct_size = sizeof *specs, .kind = SINEW_RANDOM_PUSH, .low = {5, 0, 0}, .high = {5, 0, 0}, .seed = 3}};
    const double vx[] = {0, 0, 3, 0, 5}, vy[] = {0, -5, -0.2, -10, -10};
    for (size_t i = 0; i < sizeof specs / sizeof *specs; ++i) {
        const sinew_world world = created();
        const sinew_particle stone = stone_in(world);
        sinew_force force;
        CHECK(sinew_world_add_force(world, &specs[i], &force) == SINEW_OK);
        CHECK(sinew_world_step(world, i == 1 || i == 2 ? 600 : 60) == SINEW_OK);
        const sinew_particle_state state = state_of(world, stone);
        if (specs[i].kind == SINEW_ATTRACTOR)
            CHECK(state.velocity[0] > 1);
        else
            CHECK(fabs(state.velocity[0] - vx[i]) < 0.1 && fabs(state.velocity[1] - vy[i]) < 0.1);
        CHECK(sinew_world_remove_force(world, force) == SINEW_OK);
        CHECK(sinew_world_remove_force(world, force) == SINEW_BAD_ID);
        CHECK(sinew_world_close(world) == SINEW_OK);
    }
}

/* A world built by calls has the hash of the scene that says the same. */
static void forces_are_hashed_as_those_of_scenes(void) {
    const sinew_world scene = opened(
        "{\"sinew\": 1, \"world\": {\"gravity\": [0, -10], \"forces\": [{\"force\": \"wind\", \"velocity\": [1, 0], "
        "\"strength\": 0.5, \"gust\": [1, 1], \"seed\": 7}, {\"force\": \"attractor\", \"center\": [1, 2]}]}}");
    const sinew_world world = opened("{\"sinew\": 1, \"world\": {\"gravity\": [0, -10]}}");
    const sinew_force_spec wind = {.struct_size = sizeof wind,
                                   .kind = SINEW_WIND,
                                   .velocity = {1, 0, 0},
                                   .strength = 0.5,
                                   .gust = {1, 1, 0},
                                   .seed = 7};
    const sinew_force_spec pull = {
        .struct_size = sizeof pull, .kind = SINEW_ATTRACTOR, .center = {1, 2, 0}, .strength = 1};
    sinew_force first, second;
    CHECK(hash_of(world) != hash_of(scene));
    CHECK(sinew_world_add_force(world, &wind, &first) == SINEW_OK);
    CHECK(sinew_world_add_force(world, &pull, &second) == SINEW_OK && first != second);
    CHECK(hash_of(world) == hash_of(scene));
    CHECK(sinew_world_close(world) == SINEW_OK && sinew_world_close(scene) == SINEW_OK);
}

static void forces_are_read_and_changed(void) {
    const sinew_world world = opened(dragged);
    sinew_force gravity = 0, drag = 0, none = 77;
    sinew_force_spec spec = {.struct_size = sizeof spec};
    CHECK(sinew_world_force_at(world, 0, &gravity) == SINEW_OK && sinew_world_force_at(world, 1, &drag) == SINEW_OK);
    CHECK(sinew_world_force_at(world, 2, &none) == SINEW_NOT_FOUND && none == 77);
    CHECK(sinew_world_get_force(world, drag, &spec) == SINEW_OK && spec.kind == SINEW_DRAG && spec.strength == 2);
    spec.strength = 5;
    CHECK(sinew_world_set_force(world, drag, &spec) == SINEW_OK && sinew_world_step(world, 600) == SINEW_OK);
    CHECK(fabs(state_of(world, called(world, "stone/p")).velocity[1] + 2) < 0.01);
    CHECK(sinew_world_get_force(world, gravity, &spec) == SINEW_OK && spec.kind == SINEW_GRAVITY);
    CHECK(spec.acceleration.y == -10 && spec.strength == 0 && spec.figure == NULL);
    spec.kind = SINEW_DRAG;
    CHECK(sinew_world_set_force(world, gravity, &spec) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_remove_force(world, gravity) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_set_gravity(world, (sinew_point){0, 0, 0}) == SINEW_OK);
    CHECK(sinew_world_get_force(world, gravity, &spec) == SINEW_OK && spec.acceleration.y == 0);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

static void wrong_numbers_change_nothing(void) {
    const sinew_world world = opened(dragged);
    const uint64_t before = hash_of(world);
    const sinew_force_spec wrong[] = {
        {.struct_size = sizeof *wrong, .kind = 5},
        {.struct_size = sizeof *wrong - 8, .kind = SINEW_DRAG},
        {.struct_size = sizeof *wrong, .kind = SINEW_DRAG, .strength = -1},
        {.struct_size = sizeof *wrong, .kind = SINEW_DRAG, .strength = NAN},
        {.struct_size = sizeof *wrong, .kind = SINEW_GRAVITY, .acceleration = {0, INFINITY, 0}},
        {.struct_size = sizeof *wrong, .kind = SINEW_WIND, .velocity = {1e300, 0, 0}},
        {.struct_size = sizeof *wrong, .kind = SINEW_WIND, .gust_period = -1},
        {.struct_size = sizeof *wrong, .kind = SINEW_ATTRACTOR, .softness = 1e9},
        {.struct_size = sizeof *wrong, .kind = SINEW_RANDOM_PUSH, .low = {NAN, 0, 0}}};
    sinew_force drag, force = 77;
    CHECK(sinew_world_force_at(world, 1, &drag) == SINEW_OK);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        CHECK(sinew_world_add_force(world, &wrong[i], &force) == SINEW_BAD_ARGUMENT && force == 77);
        CHECK(sinew_world_set_force(world, drag, &wrong[i]) == SINEW_BAD_ARGUMENT);
    }
    CHECK(strstr(sinew_message(), "low is from") != NULL);
    const sinew_force_spec pull = {
        .struct_size = sizeof pull, .kind = SINEW_ATTRACTOR, .strength = 1, .figure = "nobody"};
    CHECK(sinew_world_add_force(world, &pull, &force) == SINEW_NOT_FOUND);
    CHECK(sinew_world_add_force(world, NULL, &force) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_add_force(world, &pull, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(hash_of(world) == before);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* Ids, and what calls have changed, hold in copies, loaded worlds and edited scenes. */
static void forces_outlast_an_edit(void) {
    static const char forces[] = "world.forces=[{\"force\":\"wind\",\"velocity\":[0,0],\"strength\":0},"
                                 "{\"force\":\"drag\",\"strength\":2}]";
    const char* const edits[] = {"view.theme=dark", "world.damping=0.1", forces};
    for (size_t i = 0; i < sizeof edits / sizeof *edits; ++i) {
        sinew_world world = opened(dragged), twin;
        sinew_force drag, wind;
        sinew_force_spec spec = {.struct_size = sizeof spec, .kind = SINEW_DRAG, .strength = 5};
        const sinew_force_spec blow = {
            .struct_size = sizeof blow, .kind = SINEW_WIND, .velocity = {3, 0, 0}, .strength = 1};
        const uint8_t* bytes;
        size_t size;
        CHECK(sinew_world_force_at(world, 1, &drag) == SINEW_OK);
        CHECK(sinew_world_set_force(world, drag, &spec) == SINEW_OK);
        CHECK(sinew_world_add_force(world, &blow, &wind) == SINEW_OK && sinew_world_step(world, 10) == SINEW_OK);
        CHECK(sinew_world_save(world, &bytes, &size) == SINEW_OK);
        CHECK(sinew_world_load(bytes, size, NULL, &twin) == SINEW_OK && hash_of(twin) == hash_of(world));
        CHECK(sinew_world_set(world, edits[i]) == SINEW_OK && sinew_world_set(world, edits[i]) == SINEW_OK);
        CHECK(i > 0 || hash_of(world) == hash_of(twin));
        for (int k = 0; k < 2; ++k) {
            const sinew_world each = k == 0 ? world : twin;
            CHECK(sinew_world_get_force(each, drag, &spec) == SINEW_OK && spec.strength == 5);
            CHECK(sinew_world_get_force(each, wind, &spec) == SINEW_OK && spec.velocity.x == 3);
            CHECK(sinew_world_remove_force(each, wind) == SINEW_OK && sinew_world_remove_force(each, drag) == SINEW_OK);
        }
        CHECK(sinew_world_set(world, "view.theme=light") == SINEW_OK);
        CHECK(sinew_world_get_force(world, drag, &spec) == SINEW_BAD_ID);
        CHECK(sinew_world_restart(world) == SINEW_OK && sinew_world_force_at(world, 1, &drag) == SINEW_OK);
        CHECK(sinew_world_close(world) == SINEW_OK && sinew_world_close(twin) == SINEW_OK);
    }
}

/* An attractor pulls its figure alone, whatever number that has after an edit, and goes with it. */
static void an_attractor_goes_with_its_figure(void) {
    const sinew_world world = opened(dragged);
    const sinew_force_spec pull = {.struct_size = sizeof pull,
                                   .kind = SINEW_ATTRACTOR,
                                   .strength = 100,
                                   .center = {5, 100, 0},
                                   .softness = 50,
                                   .figure = "other"};
    sinew_force_spec spec = {.struct_size = sizeof spec};
    sinew_force force;
    uint32_t figure;
    CHECK(sinew_world_add_force(world, &pull, &force) == SINEW_OK && sinew_world_step(world, 60) == SINEW_OK);
    CHECK(state_of(world, called(world, "other/p")).position[1] >
          state_of(world, called(world, "stone/p")).position[1]);
    CHECK(sinew_world_set(world, "world.damping=0.1") == SINEW_OK);
    CHECK(sinew_world_get_force(world, force, &spec) == SINEW_OK && strcmp(spec.figure, "other") == 0);
    CHECK(sinew_world_find_figure(world, "other", &figure) == SINEW_OK);
    CHECK(sinew_world_remove_figure(world, figure) == SINEW_OK);
    CHECK(sinew_world_get_force(world, force, &spec) == SINEW_BAD_ID);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* A gust is one of the forces; it ends when it is due, whatever was removed before it. */
static void gusts_end(void) {
    const sinew_world world =
        opened("{\"sinew\": 1, \"world\": {\"forces\": [{\"force\": \"drag\", \"strength\": 0}, {\"force\": \"drag\", "
               "\"strength\": 0}]}, \"figures\": [{\"name\": \"stone\", \"particles\": {\"p\": {\"at\": [0, 0]}}}], "
               "\"events\": [{\"at\": 0.1, \"gust\": [1, 0], \"strength\": 1, \"duration\": 0.5}]}");
    sinew_force first, second, gust, none;
    CHECK(sinew_world_force_at(world, 1, &first) == SINEW_OK && sinew_world_force_at(world, 2, &second) == SINEW_OK);
    CHECK(sinew_world_force_at(world, 3, &gust) == SINEW_NOT_FOUND && sinew_world_run_until(world, 0.3) == SINEW_OK);
    CHECK(sinew_world_force_at(world, 3, &gust) == SINEW_OK && sinew_world_remove_force(world, first) == SINEW_OK);
    CHECK(sinew_world_set(world, "world.damping=0.1") == SINEW_OK);
    CHECK(sinew_world_force_at(world, 2, &none) == SINEW_OK && none == gust);
    CHECK(sinew_world_run_until(world, 1) == SINEW_OK);
    CHECK(sinew_world_force_at(world, 2, &none) == SINEW_NOT_FOUND);
    CHECK(sinew_world_force_at(world, 1, &none) == SINEW_OK && none == second);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

int main(void) {
    every_kind_acts();
    forces_are_hashed_as_those_of_scenes();
    forces_are_read_and_changed();
    wrong_numbers_change_nothing();
    forces_outlast_an_edit();
    an_attractor_goes_with_its_figure();
    gusts_end();
    if (failures == 0) printf("all right\n");
    return failures != 0;
}
