/* Colliders of every shape by calls, and those that are refused. */
#include "tests/bindings/worlds.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static sinew_world created(uint32_t dimension, uint32_t real_bytes) {
    const sinew_world_spec spec = {
        .struct_size = sizeof spec, .dimension = dimension, .real_bytes = real_bytes, .gravity = {0, -10, 0}};
    sinew_world world = {0};
    CHECK(sinew_world_create(&spec, &world) == SINEW_OK);
    return world;
}
static sinew_particle ball_at(sinew_world world, double x, double y, double z) {
    const sinew_particle_spec spec = {.struct_size = sizeof spec, .position = {x, y, z}, .mass = 1, .radius = 0.25};
    sinew_particle ball = 0;
    CHECK(sinew_world_add_particle(world, &spec, &ball) == SINEW_OK);
    return ball;
}

static const sinew_point square[] = {{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}};
static const uint32_t upwards[] = {0, 1, 2, 0, 2, 3}, downwards[] = {0, 2, 1, 0, 3, 2};
static const double flat[] = {0, 0, 0, 0, 0, 0}, valley[] = {1, 0, 1, 1, 0, 1};

/* A ball lies on a surface by its radius above it; from the other side it falls through. */
static void surfaces_carry(void) {
    const sinew_collider_spec specs[] = {{.struct_size = sizeof *specs,
                                          .shape = SINEW_MESH_3D,
                                          .points = square,
                                          .point_count = 4,
                                          .triangles = upwards,
                                          .triangle_count = 2},
                                         {.struct_size = sizeof *specs,
                                          .shape = SINEW_HEIGHT_FIELD_3D,
                                          .heights = flat,
                                          .columns = 3,
                                          .rows = 2,
                                          .spacing = 4,
                                          .position = {-4, 0, -2}}};
    for (uint32_t bytes = 4; bytes <= 8; bytes += 4)
        for (size_t i = 0; i < sizeof specs / sizeof *specs; ++i) {
            const sinew_world world = created(3, bytes);
            sinew_collider floor;
            const sinew_particle ball = ball_at(world, 0.3, 0.5, 0.2);
            CHECK(sinew_world_add_collider(world, &specs[i], &floor) == SINEW_OK);
            CHECK(sinew_world_run_until(world, 2) == SINEW_OK);
            CHECK(fabs(state_of(world, ball).position[1] - 0.25) < 1e-3);
            const uint8_t* saved;
            size_t size;
            sinew_world twin;
            CHECK(sinew_world_save(world, &saved, &size) == SINEW_OK);
            CHECK(sinew_world_load(saved, size, NULL, &twin) == SINEW_OK && hash_of(twin) == hash_of(world));
            CHECK(sinew_world_set(world, "view.theme=dark") == SINEW_OK && hash_of(world) == hash_of(twin));
            CHECK(sinew_world_remove_collider(world, floor) == SINEW_OK && sinew_world_run_until(world, 3) == SINEW_OK);
            CHECK(state_of(world, ball).position[1] < -1);
            CHECK(sinew_world_close(world) == SINEW_OK && sinew_world_close(twin) == SINEW_OK);
        }
    const sinew_world world = created(3, 8);
    sinew_collider_spec ceiling = specs[0];
    ceiling.triangles = downwards;
    sinew_collider collider;
    const sinew_particle ball = ball_at(world, 0.3, 1, 0.2);
    CHECK(sinew_world_add_collider(world, &ceiling, &collider) == SINEW_OK &&
          sinew_world_run_until(world, 1) == SINEW_OK);
    CHECK(state_of(world, ball).position[1] < -1);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* Rows follow z, numbers x: a ball rolls to the middle column. */
static void heights_have_their_places(void) {
    const sinew_world world = created(3, 8);
    const sinew_collider_spec spec = {.struct_size = sizeof spec,
                                      .shape = SINEW_HEIGHT_FIELD_3D,
                                      .heights = valley,
                                      .columns = 3,
                                      .rows = 2,
                                      .spacing = 2,
                                      .friction = 1};
    sinew_collider ground;
    CHECK(sinew_world_add_collider(world, &spec, &ground) == SINEW_OK);
    const double x[] = {1, 2, 3}, y[] = {0.5, 0, 0.5};
    for (int i = 0; i < 3; ++i) {
        sinew_ray_hit hit = {.struct_size = sizeof hit};
        CHECK(sinew_world_cast_ray(world, (sinew_point){x[i], 5, 1}, (sinew_point){x[i], -5, 1}, 0, ~0u, &hit) ==
              SINEW_OK);
        CHECK(hit.collider == ground && fabs(hit.point.y - y[i]) < 1e-9);
    }
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* The closing edge carries, if the points are clockwise. */
static void a_closed_terrain_is_solid_inside(void) {
    const sinew_point clockwise[] = {{2, 0, 0}, {2, -1, 0}, {-2, -1, 0}, {-2, 0, 0}},
                      other_way[] = {{-2, 0, 0}, {-2, -1, 0}, {2, -1, 0}, {2, 0, 0}};
    for (int i = 0; i < 3; ++i) {
        const sinew_world world = created(2, 8);
        const sinew_collider_spec spec = {.struct_size = sizeof spec,
                                          .shape = SINEW_TERRAIN_2D,
                                          .points = i == 1 ? other_way : clockwise,
                                          .point_count = 4,
                                          .is_closed = i < 2};
        sinew_collider collider;
        const sinew_particle ball = ball_at(world, 0.3, 0.5, 0);
        CHECK(sinew_world_add_collider(world, &spec, &collider) == SINEW_OK);
        CHECK(sinew_world_run_until(world, 2) == SINEW_OK);
        CHECK((fabs(state_of(world, ball).position[1] - 0.25) < 1e-3) == (i == 0));
        CHECK(sinew_world_close(world) == SINEW_OK);
    }
}

/* A belt takes up to its speed what lies on it. A program of the first version knows no belts. */
static void belts_run(void) {
    for (int is_old = 0; is_old < 2; ++is_old) {
        const sinew_world world = created(2, 8);
        const sinew_collider_spec spec = {.struct_size = is_old ? (uint32_t)offsetof(sinew_collider_spec, triangles)
                                                                : (uint32_t)sizeof spec,
                                          .shape = SINEW_BOX,
                                          .half = {50, 1, 0},
                                          .position = {0, -1, 0},
                                          .friction = 1,
                                          .surface_velocity = {3, 0, 0}};
        const sinew_particle_spec crate = {.struct_size = sizeof crate, .mass = 1};
        sinew_collider belt;
        sinew_particle particle;
        CHECK(sinew_world_add_collider(world, &spec, &belt) == SINEW_OK);
        CHECK(sinew_world_add_particle(world, &crate, &particle) == SINEW_OK);
        CHECK(sinew_world_run_until(world, 2) == SINEW_OK);
        CHECK(fabs(state_of(world, particle).velocity[0] - (is_old ? 0 : 3)) < 1e-3);
        CHECK(sinew_world_close(world) == SINEW_OK);
    }
}

/* Refused, with the place, and nothing is changed. */
static void refused(uint32_t dimension, uint32_t real_bytes, sinew_collider_spec spec, const char* why) {
    const sinew_world world = created(dimension, real_bytes);
    const uint64_t before = hash_of(world);
    sinew_collider collider = 77;
    spec.struct_size = sizeof spec;
    CHECK(sinew_world_add_collider(world, &spec, &collider) == SINEW_BAD_ARGUMENT && collider == 77);
    CHECK(strstr(sinew_message(), why) != NULL && hash_of(world) == before);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

static void meshes_that_are_none(void) {
    const sinew_point nowhere[] = {{0, 0, 0}, {1, 0, 0}, {0, NAN, 1}}, far[] = {{0, 0, 0}, {1, 0, 0}, {0, 1e9, 1}},
                      line[] = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, tiny[] = {{0, 0, 0}, {1e-30, 0, 0}, {0, 0, 1e-30}};
    const uint32_t one[] = {0, 1, 2}, beyond[] = {0, 1, 2, 0, 2, 4}, twice[] = {0, 1, 1};
    sinew_collider_spec mesh = {
        .shape = SINEW_MESH_3D, .points = square, .point_count = 4, .triangles = upwards, .triangle_count = 2};
    refused(2, 8, mesh, "no shape of this dimension");
    mesh.triangles = beyond;
    refused(3, 8, mesh, "triangles[1] names point 4 of 4");
    mesh.triangles = twice, mesh.triangle_count = 1;
    refused(3, 8, mesh, "triangles[0] has no area");
    mesh.triangles = NULL;
    refused(3, 8, mesh, "found 1");
    mesh.triangles = one, mesh.triangle_count = 0;
    refused(3, 8, mesh, "triangles, found 0");
    mesh.triangle_count = ~0u;
    refused(3, 8, mesh, "triangles, found 4294967295");
    mesh.triangle_count = 1, mesh.point_count = 2;
    refused(3, 8, mesh, "from 3 to 1048576 points, found 2");
    mesh.point_count = 1u << 21;
    refused(3, 8, mesh, "found 2097152");
    mesh.point_count = 3, mesh.points = nowhere;
    refused(3, 8, mesh, "points[2]");
    mesh.points = far;
    refused(3, 4, mesh, "points[2]");
    mesh.points = line;
    refused(3, 4, mesh, "triangles[0] has no area");
    mesh.points = tiny; /* in float the area is 0 */
    refused(3, 4, mesh, "triangles[0] has no area");
    mesh.points = NULL;
    refused(3, 8, mesh, "null");
}

static void height_fields_that_are_none(void) {
    const double odd[] = {0, 1, 2, INFINITY}, high[] = {0, 1e9, 0, 0};
    sinew_collider_spec field = {.shape = SINEW_HEIGHT_FIELD_3D, .heights = flat, .columns = 2, .rows = 2};
    refused(3, 8, field, "spacing is above 0");
    field.spacing = NAN;
    refused(3, 8, field, "spacing is above 0");
    field.spacing = 1;
    refused(2, 8, field, "no shape of this dimension");
    field.heights = odd;
    refused(3, 8, field, "heights[3]");
    field.heights = high;
    refused(3, 8, field, "heights[1]");
    field.rows = 1;
    refused(3, 8, field, "found 1 x 2");
    field.rows = field.columns = 1u << 16;
    refused(3, 8, field, "found 65536 x 65536");
    field.rows = field.columns = 2, field.heights = NULL;
    refused(3, 8, field, "height field");
}

static void lines_and_numbers_that_are_none(void) {
    const sinew_point dented[] = {{0, 0, 0}, {2, 0, 0}, {1, 0.5, 0}, {0, 2, 0}, {-1, 1, 0}},
                      still[] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}};
    sinew_collider_spec line = {.shape = SINEW_POLYGON_2D, .points = dented, .point_count = 5};
    refused(2, 8, line, "points[2]");
    line = (sinew_collider_spec){.shape = SINEW_TERRAIN_2D, .points = still, .point_count = 3};
    refused(2, 8, line, "points[1] and points[2]");
    line.points = still + 2, line.point_count = 1;
    refused(2, 8, line, "found 1");
    const sinew_point back[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}};
    line = (sinew_collider_spec){.shape = SINEW_TERRAIN_2D, .points = back, .point_count = 4, .is_closed = 1};
    refused(2, 8, line, "points[3] and points[0]");
    refused(2, 8, (sinew_collider_spec){.shape = SINEW_SPHERE, .radius = 1e9}, "radius");
    refused(3, 8, (sinew_collider_spec){.shape = SINEW_BOX, .half = {1, 1, 0}}, "a box has edges above 0");
    refused(2, 8, (sinew_collider_spec){.shape = SINEW_SPHERE, .radius = 1, .turn = NAN}, "turn");
    refused(2, 8, (sinew_collider_spec){.shape = SINEW_SPHERE, .radius = 1, .surface_velocity = {INFINITY, 0, 0}},
            "surface_velocity");
    refused(2, 8, (sinew_collider_spec){.shape = SINEW_SPHERE, .radius = NAN}, "radius");
}

int main(void) {
    surfaces_carry();
    heights_have_their_places();
    a_closed_terrain_is_solid_inside();
    belts_run();
    meshes_that_are_none();
    height_fields_that_are_none();
    lines_and_numbers_that_are_none();
    if (failures == 0) printf("all right\n");
    return failures != 0;
}
