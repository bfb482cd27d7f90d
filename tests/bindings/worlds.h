/* Worlds, particles and hashes for the programs in C. */
#pragma once

#include "tests/bindings/check.h"

static inline sinew_world opened(const char* scene) {
    sinew_world world = {0};
    CHECK(sinew_world_open(scene, NULL, &world) == SINEW_OK);
    return world;
}
static inline sinew_particle called(sinew_world world, const char* name) {
    sinew_particle particle = 0;
    CHECK(sinew_world_find_particle(world, name, &particle) == SINEW_OK);
    return particle;
}
static inline sinew_particle_state state_of(sinew_world world, sinew_particle particle) {
    sinew_particle_state state = {.struct_size = sizeof state};
    CHECK(sinew_world_get_particle(world, particle, &state) == SINEW_OK);
    return state;
}
static inline uint64_t hash_of(sinew_world world) {
    uint64_t hash = 0;
    CHECK(sinew_world_state_hash(world, &hash) == SINEW_OK);
    return hash;
}
