/* Grabs in the plane and in space, one of the pointer and others beside it. */
#include "tests/bindings/worlds.h"

#include <math.h>
#include <string.h>

static double distance_to(sinew_world world, sinew_particle particle, sinew_point to) {
    const sinew_particle_state state = state_of(world, particle);
    const double x = state.position[0] - to.x, y = state.position[1] - to.y, z = state.position[2] - to.z;
    return sqrt(x * x + y * y + z * z);
}

/* A place on the way: a hand moves evenly, since the force of a grab has a limit. */
static sinew_point between(sinew_point from, sinew_point to, double share) {
    return (sinew_point){from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share,
                         from.z + (to.z - from.z) * share};
}

/* Balls on the z axis, the first of which is fixed; stones without a radius beside them. */
static const char* const space =
    "{\"sinew\": 1, \"dimension\": 3, \"world\": {\"gravity\": [0, -10, 0]}, \"figures\": ["
    "{\"name\": \"wall\", \"particles\": {\"p\": {\"at\": [0, 0, 1], \"radius\": 0.3, \"pinned\": true}}},"
    "{\"name\": \"front\", \"particles\": {\"p\": {\"at\": [0.2, 0, 2], \"radius\": 0.3}}},"
    "{\"name\": \"back\", \"particles\": {\"p\": {\"at\": [0, 0, 4], \"radius\": 0.3}}},"
    "{\"name\": \"near\", \"particles\": {\"p\": {\"at\": [1, 0, 3]}}},"
    "{\"name\": \"far\", \"particles\": {\"p\": {\"at\": [1.5, 0, 3]}}}]}";

static void rays_pick_the_nearest(void) {
    const sinew_world world = opened(space);
    const sinew_point eye = {0, 0, 0}, aside = {1.2, 0, 0};
    sinew_particle found = 77;
    double share = 0;
    CHECK(sinew_world_pick(world, eye, (sinew_point){0, 0, 10}, 0.1, &found, &share) == SINEW_OK);
    CHECK(found == called(world, "front/p") && fabs(share - 0.2) < 1e-12);
    CHECK(sinew_world_pick(world, aside, (sinew_point){1.2, 0, 10}, 0.3, &found, NULL) == SINEW_OK);
    CHECK(found == called(world, "near/p"));
    found = 77;
    CHECK(sinew_world_pick(world, aside, (sinew_point){1.2, 0, 10}, 0.1, &found, &share) == SINEW_NOT_FOUND);
    CHECK(sinew_world_pick(world, eye, (sinew_point){0, 0, 1}, 0.1, &found, &share) == SINEW_NOT_FOUND);
    CHECK(sinew_world_pick(world, eye, (sinew_point){0, NAN, 1}, 0.1, &found, &share) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_pick(world, eye, eye, NAN, &found, &share) == SINEW_BAD_ARGUMENT && found == 77);
    CHECK(sinew_world_pick(world, eye, eye, 1, NULL, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* The pointer drags a particle to a point in space, and lets it fall. */
static void the_pointer_drags_in_space(void) {
    const sinew_world world = opened(space);
    const sinew_particle near = called(world, "near/p");
    const sinew_point target = {2, 3, -1};
    CHECK(sinew_world_grab(world, (sinew_point){1.1, 0, 3}, 0.05) == SINEW_NOT_FOUND);
    CHECK(sinew_world_grab(world, (sinew_point){1.1, 0, 3}, 0.2) == SINEW_OK);
    for (int i = 1; i <= 60; ++i)
        CHECK(sinew_world_drag(world, between((sinew_point){1, 0, 3}, target, i / 60.0)) == SINEW_OK &&
              sinew_world_step(world, 1) == SINEW_OK);
    CHECK(distance_to(world, near, target) < 0.01);
    CHECK(sinew_world_let_go(world) == SINEW_OK && sinew_world_step(world, 120) == SINEW_OK);
    CHECK(state_of(world, near).position[1] < -1);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* Several grabs hold at once, in copies, loaded worlds and edited scenes, beside the pointer's. */
static void grabs_hold_at_once(void) {
    const sinew_world world = opened(space);
    const char* const names[] = {"front/p", "back/p", "far/p"};
    const sinew_point starts[] = {{0.2, 0, 2}, {0, 0, 4}, {1.5, 0, 3}, {1, 0, 3}},
                      targets[] = {{-3, 1, 0}, {0, 2, 5}, {4, 3, 3}, {2, 4, -1}};
    sinew_grab grabs[3];
    for (int i = 0; i < 3; ++i) CHECK(sinew_world_add_grab(world, called(world, names[i]), &grabs[i]) == SINEW_OK);
    CHECK(sinew_world_grab_particle(world, called(world, "near/p")) == SINEW_OK);
    for (int step = 1; step <= 60; ++step) {
        for (int i = 0; i < 3; ++i)
            CHECK(sinew_world_move_grab(world, grabs[i], between(starts[i], targets[i], step / 60.0)) == SINEW_OK);
        CHECK(sinew_world_drag(world, between(starts[3], targets[3], step / 60.0)) == SINEW_OK);
        CHECK(sinew_world_step(world, 1) == SINEW_OK);
    }
    const uint8_t* bytes;
    size_t size;
    sinew_world worlds[3] = {world};
    CHECK(sinew_world_save(world, &bytes, &size) == SINEW_OK);
    CHECK(sinew_world_load(bytes, size, NULL, &worlds[1]) == SINEW_OK);
    CHECK(sinew_world_copy(world, &worlds[2]) == SINEW_OK);
    CHECK(sinew_world_step(world, 50) == SINEW_OK);
    for (int k = 1; k < 3; ++k)
        CHECK(sinew_world_step(worlds[k], 50) == SINEW_OK && hash_of(worlds[k]) == hash_of(world));
    CHECK(distance_to(world, called(world, "near/p"), targets[3]) < 0.01);
    CHECK(sinew_world_set(world, "figures.3.particles.p.mass=2") == SINEW_OK &&
          sinew_world_step(world, 30) == SINEW_OK);
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) {
            CHECK(distance_to(worlds[k], called(worlds[k], names[i]), targets[i]) < 0.01);
            CHECK(sinew_world_remove_grab(worlds[k], grabs[i]) == SINEW_OK);
            CHECK(sinew_world_remove_grab(worlds[k], grabs[i]) == SINEW_BAD_ID);
        }
    for (int k = 0; k < 3; ++k) {
        CHECK(sinew_world_step(worlds[k], 60) == SINEW_OK);
        CHECK(state_of(worlds[k], called(worlds[k], "back/p")).position[1] < 0);
        CHECK(sinew_world_close(worlds[k]) == SINEW_OK);
    }
}

static void grabs_end(void) {
    const sinew_world world = opened(space);
    const sinew_particle near = called(world, "near/p");
    sinew_grab grab = 77, second;
    CHECK(sinew_world_add_grab(world, called(world, "wall/p"), &grab) == SINEW_NOT_FOUND);
    CHECK(sinew_world_add_grab(world, SINEW_NO_ID, &grab) == SINEW_BAD_ID && grab == 77);
    CHECK(sinew_world_add_grab(world, near, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_add_grab(world, near, &grab) == SINEW_OK);
    CHECK(sinew_world_move_grab(world, grab, (sinew_point){0, 0, NAN}) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_add_grab(world, near, &second) == SINEW_OK && second != grab);
    CHECK(sinew_world_move_grab(world, grab, (sinew_point){0, 0, 0}) == SINEW_OK);
    CHECK(sinew_world_remove_particle(world, near) == SINEW_OK);
    CHECK(sinew_world_move_grab(world, grab, (sinew_point){0, 0, 0}) == SINEW_BAD_ID);
    CHECK(sinew_world_move_grab(world, second, (sinew_point){0, 0, 0}) == SINEW_BAD_ID);
    CHECK(sinew_world_add_grab(world, called(world, "far/p"), &grab) == SINEW_OK);
    CHECK(sinew_world_restart(world) == SINEW_OK && sinew_world_step(world, 60) == SINEW_OK);
    CHECK(sinew_world_move_grab(world, grab, (sinew_point){0, 0, 0}) == SINEW_BAD_ID);
    CHECK(state_of(world, called(world, "far/p")).position[1] < -4);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* In 2D, too: two fingers lift a rope. */
static void two_fingers_pull(void) {
    const sinew_world world = opened("{\"sinew\": 1, \"figures\": [{\"prefab\": \"rope\", \"name\": \"rope\", "
                                     "\"pinned\": \"none\", \"length\": 2, \"angle\": 0}]}");
    const sinew_particle ends[] = {called(world, "rope/start"), called(world, "rope/end")};
    const sinew_point starts[] = {{0, 0, 0}, {2, 0, 0}}, targets[] = {{0.2, 1, 0}, {1.8, 1, 0}};
    sinew_grab grabs[2];
    for (int i = 0; i < 2; ++i) CHECK(sinew_world_add_grab(world, ends[i], &grabs[i]) == SINEW_OK);
    for (int step = 1; step <= 120; ++step) {
        for (int i = 0; i < 2; ++i)
            CHECK(sinew_world_move_grab(world, grabs[i], between(starts[i], targets[i], step / 120.0)) == SINEW_OK);
        CHECK(sinew_world_step(world, 1) == SINEW_OK);
    }
    for (int i = 0; i < 2; ++i) CHECK(distance_to(world, ends[i], targets[i]) < 0.01);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

int main(void) {
    rays_pick_the_nearest();
    the_pointer_drags_in_space();
    grabs_hold_at_once();
    grabs_end();
    two_fingers_pull();
    if (failures == 0) printf("all right\n");
    return failures != 0;
}
