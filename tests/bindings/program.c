/* The functions of programs (SINEW_PROGRAM_API): worlds built by calls, user data, debug drawing, hooks. */
#include "tests/bindings/check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static sinew_world created(void) {
    const sinew_world_spec spec = {.struct_size = sizeof spec, .gravity = {0, -10, 0}, .substeps = 8};
    sinew_world world = {0};
    CHECK(sinew_world_create(&spec, &world) == SINEW_OK);
    return world;
}

static double height_of(sinew_world world, sinew_particle particle) {
    sinew_particle_state state = {.struct_size = sizeof state, .position = {0, NAN, 0}};
    CHECK(sinew_world_get_particle(world, particle, &state) == SINEW_OK);
    return state.position[1];
}

/* y = -g t^2 / 2; a step of Verlet's is exact for a constant force, from rest on. */
static void an_empty_world_falls(void) {
    const sinew_world world = created();
    const sinew_particle_spec spec = {.struct_size = sizeof spec, .mass = 2};
    sinew_particle stone;
    CHECK(sinew_world_add_particle(world, &spec, &stone) == SINEW_OK);
    CHECK(sinew_world_step(world, 60) == SINEW_OK);
    CHECK(fabs(height_of(world, stone) + 5) < 0.02); /* a substep's half: g h t / 2 with h = 1 / 480 */
    CHECK(sinew_world_set_gravity(world, (sinew_point){0, 0, 0}) == SINEW_OK);
    CHECK(sinew_world_step(world, 60) == SINEW_OK);
    CHECK(fabs(height_of(world, stone) + 15) < 0.03);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

static void wrong_sizes_and_numbers_are_errors(void) {
    sinew_world world = {77};
    sinew_world_spec spec = {.struct_size = 4};
    CHECK(sinew_world_create(NULL, &world) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_create(&spec, &world) == SINEW_BAD_ARGUMENT);
    spec = (sinew_world_spec){.struct_size = sizeof spec, .dimension = 4};
    CHECK(sinew_world_create(&spec, &world) == SINEW_BAD_ARGUMENT);
    spec = (sinew_world_spec){.struct_size = sizeof spec, .gravity = {0, NAN, 0}};
    CHECK(sinew_world_create(&spec, &world) == SINEW_BAD_ARGUMENT);
    spec = (sinew_world_spec){.struct_size = sizeof spec, .rate = 1e9};
    CHECK(sinew_world_create(&spec, &world) == SINEW_BAD_SCENE);
    spec = (sinew_world_spec){.struct_size = sizeof spec, .rate = -60};
    CHECK(sinew_world_create(&spec, &world) == SINEW_BAD_SCENE);
    CHECK(world.id == 77);
}

static void structs_of_a_later_version_are_read_as_far_as_they_are_known(void) {
    struct {
        sinew_world_spec spec;
        double later;
    } longer = {.spec = {.struct_size = sizeof longer, .dimension = 3}};
    sinew_world world;
    CHECK(sinew_world_create(&longer.spec, &world) == SINEW_OK);
    CHECK(sinew_world_close(world) == SINEW_OK);
    longer.later = 1;
    CHECK(sinew_world_create(&longer.spec, &world) == SINEW_BAD_ARGUMENT);
    longer.spec.struct_size = 1u << 31;
    CHECK(sinew_world_create(&longer.spec, &world) == SINEW_BAD_ARGUMENT);
}

/* A caller of an older version gets the fields it knows, and one of a later version zeros. */
static void structs_of_any_version_are_filled_as_far_as_they_are_known(void) {
    const sinew_world world = created();
    struct {
        sinew_info info;
        double later;
    } longer = {.info = {.struct_size = sizeof longer}, .later = 7};
    sinew_info shorter = {.struct_size = 8}, none = {0};
    sinew_report report = {.struct_size = 5000};
    CHECK(sinew_world_get_info(world, &longer.info) == SINEW_OK);
    CHECK(longer.info.struct_size == sizeof longer && longer.info.dimension == 2 && longer.later == 0);
    CHECK(sinew_world_get_info(world, &shorter) == SINEW_BAD_ARGUMENT && shorter.dimension == 0);
    CHECK(strstr(sinew_message(), "struct_size") != NULL);
    CHECK(sinew_world_get_info(world, &none) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_get_report(world, &report) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

static sinew_status add_rope(sinew_world world, const char* name, const sinew_parameter* parameters, uint32_t count,
                             uint32_t* figure) {
    const sinew_figure_spec spec = {.struct_size = sizeof spec,
                                    .prefab = "rope",
                                    .name = name,
                                    .position = {3, 1, 0},
                                    .parameters = parameters,
                                    .parameter_count = count};
    return sinew_world_add_figure(world, &spec, figure);
}

static void prefabs_take_parameters(void) {
    const sinew_world world = created();
    const sinew_parameter parameters[] = {{"length", 2, NULL}, {"segments", 8, NULL}, {"contact.figures", 0, "true"}};
    uint32_t figure = 99, again = 99;
    sinew_figure known = {.struct_size = sizeof known};
    sinew_particle end;
    CHECK(add_rope(world, NULL, parameters, 3, &figure) == SINEW_OK);
    CHECK(sinew_world_figure_at(world, figure, &known) == SINEW_OK && known.particles == 9);
    CHECK(strcmp(known.name, "rope") == 0);
    CHECK(add_rope(world, NULL, NULL, 0, NULL) == SINEW_OK);
    CHECK(sinew_world_find_figure(world, "rope_2", &again) == SINEW_OK && again != figure);
    CHECK(add_rope(world, "rope", NULL, 0, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_find_particle(world, "rope/end", &end) == SINEW_OK);
    CHECK(sinew_world_run_until(world, 5) == SINEW_OK && height_of(world, end) < -0.5);
    const sinew_parameter wrong[] = {{"segmnts", 8, NULL}}, below[] = {{"segments", -5, NULL}};
    CHECK(add_rope(world, NULL, wrong, 1, NULL) == SINEW_BAD_SCENE && strstr(sinew_message(), "segments") != NULL);
    CHECK(add_rope(world, NULL, below, 1, NULL) == SINEW_BAD_SCENE && sinew_diagnostic_count() == 1);
    CHECK(sinew_world_remove_figure(world, figure) == SINEW_OK);
    CHECK(sinew_world_remove_figure(world, figure) == SINEW_BAD_ID &&
          sinew_world_remove_figure(world, 1u << 30) == SINEW_BAD_ID);
    CHECK(sinew_world_find_particle(world, "rope/end", &end) == SINEW_NOT_FOUND);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

static void a_parameter_may_name_a_figure(void) {
    const sinew_world world = created();
    const sinew_parameter named[] = {{"name", 0, "second"}};
    uint32_t first = 99, second = 99, again = 99, found = 99;
    CHECK(add_rope(world, "first", NULL, 0, &first) == SINEW_OK);
    CHECK(add_rope(world, "other", named, 1, &second) == SINEW_OK && second != first);
    CHECK(sinew_world_find_figure(world, "second", &found) == SINEW_OK && found == second);
    CHECK(add_rope(world, "third", named, 1, &again) == SINEW_BAD_ARGUMENT && again == 99);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* A ball lies on each shape by its radius above the surface, and falls once the collider is gone. */
static void colliders_carry(void) {
    const sinew_point line[] = {{-2, 0, 0}, {2, 0, 0}};
    const sinew_point corners[] = {{-1, -1, 0}, {1, -1, 0}, {1, 0, 0}, {-1, 0, 0}};
    const sinew_collider_spec shapes[] = {
        {.struct_size = sizeof shapes[0], .shape = SINEW_HALF_SPACE},
        {.struct_size = sizeof shapes[0], .shape = SINEW_BOX, .half = {1, 0.5, 0}, .position = {0, -0.5, 0}},
        {.struct_size = sizeof shapes[0],
         .shape = SINEW_CAPSULE,
         .half = {1, 0, 0},
         .radius = 0.25,
         .position = {0, -0.25, 0}},
        {.struct_size = sizeof shapes[0], .shape = SINEW_SPHERE, .radius = 1, .position = {0, -1, 0}},
        {.struct_size = sizeof shapes[0], .shape = SINEW_POLYGON_2D, .points = corners, .point_count = 4},
        {.struct_size = sizeof shapes[0], .shape = SINEW_TERRAIN_2D, .points = line, .point_count = 2}};
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; ++i) {
        const sinew_world world = created();
        const sinew_particle_spec spec = {
            .struct_size = sizeof spec, .position = {0, 0.5, 0}, .mass = 1, .radius = 0.25};
        sinew_particle ball;
        sinew_collider collider;
        CHECK(sinew_world_add_collider(world, &shapes[i], &collider) == SINEW_OK);
        CHECK(sinew_world_add_particle(world, &spec, &ball) == SINEW_OK);
        CHECK(sinew_world_run_until(world, 2) == SINEW_OK && fabs(height_of(world, ball) - 0.25) < 1e-3);
        CHECK(sinew_world_remove_collider(world, collider) == SINEW_OK);
        CHECK(sinew_world_remove_collider(world, collider) == SINEW_BAD_ID);
        CHECK(sinew_world_run_until(world, 3) == SINEW_OK && height_of(world, ball) < -1);
        CHECK(sinew_world_close(world) == SINEW_OK);
    }
    const sinew_world world = created();
    sinew_collider none = 5;
    sinew_collider_spec wrong = {.struct_size = sizeof wrong, .shape = SINEW_SPHERE};
    CHECK(sinew_world_add_collider(world, &wrong, &none) == SINEW_BAD_ARGUMENT);
    wrong = (sinew_collider_spec){.struct_size = sizeof wrong, .shape = 99, .radius = 1};
    CHECK(sinew_world_add_collider(world, &wrong, &none) == SINEW_BAD_ARGUMENT);
    const sinew_point clockwise[] = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    wrong = (sinew_collider_spec){
        .struct_size = sizeof wrong, .shape = SINEW_POLYGON_2D, .points = clockwise, .point_count = 3};
    CHECK(sinew_world_add_collider(world, &wrong, &none) == SINEW_BAD_ARGUMENT && none == 5);
    const double numbers[][2] = {{-0.1, 0}, {1.1, 0}, {0, -0.1}, {NAN, 0}, {0, INFINITY}}; /* bounce, friction */
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i) {
        wrong = (sinew_collider_spec){.struct_size = sizeof wrong, .bounce = numbers[i][0], .friction = numbers[i][1]};
        CHECK(sinew_world_add_collider(world, &wrong, &none) == SINEW_BAD_ARGUMENT && none == 5);
    }
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* A beam along x, turned a quarter about z, stands 2 high. */
static void axes_have_any_length(void) {
    const double lengths[] = {1e-300, 1e-25, 1, 1e25, 1e300};
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; ++i) {
        const sinew_world_spec space = {.struct_size = sizeof space, .dimension = 3, .real_bytes = i % 2 ? 4 : 8};
        const sinew_collider_spec beam = {.struct_size = sizeof beam,
                                          .shape = SINEW_BOX,
                                          .half = {2, 0.1, 0.1},
                                          .axis = {0, 0, lengths[i]},
                                          .turn = 1.5707963267948966};
        sinew_world world;
        sinew_collider collider;
        sinew_ray_hit hit = {.struct_size = sizeof hit};
        CHECK(sinew_world_create(&space, &world) == SINEW_OK);
        CHECK(sinew_world_add_collider(world, &beam, &collider) == SINEW_OK);
        CHECK(sinew_world_cast_ray(world, (sinew_point){0, 9, 0}, (sinew_point){0, -9, 0}, 0, ~0u, &hit) == SINEW_OK);
        CHECK(fabs(hit.point.y - 2) < 1e-5);
        CHECK(sinew_world_close(world) == SINEW_OK);
    }
}

static void user_data_belongs_to_an_object(void) {
    const sinew_world world = created();
    int mine = 0;
    void* found = &failures;
    uint32_t figure;
    sinew_particle end;
    CHECK(add_rope(world, NULL, NULL, 0, &figure) == SINEW_OK);
    CHECK(sinew_world_find_particle(world, "rope/end", &end) == SINEW_OK);
    CHECK(sinew_world_get_user_data(world, SINEW_OF_PARTICLE, end, &found) == SINEW_OK && found == NULL);
    CHECK(sinew_world_set_user_data(world, SINEW_OF_PARTICLE, end, &mine) == SINEW_OK);
    CHECK(sinew_world_set_user_data(world, SINEW_OF_FIGURE, figure, &failures) == SINEW_OK);
    CHECK(sinew_world_get_user_data(world, SINEW_OF_PARTICLE, end, &found) == SINEW_OK && found == &mine);
    CHECK(sinew_world_get_user_data(world, SINEW_OF_FIGURE, figure, &found) == SINEW_OK && found == &failures);
    CHECK(sinew_world_set_user_data(world, SINEW_OF_CONSTRAINT, end ^ 1u << 20, &mine) == SINEW_BAD_ID);
    CHECK(sinew_world_set_user_data(world, (sinew_object)9, end, &mine) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_remove_figure(world, figure) == SINEW_OK);
    CHECK(sinew_world_get_user_data(world, SINEW_OF_PARTICLE, end, &found) == SINEW_BAD_ID);
    CHECK(add_rope(world, NULL, NULL, 0, &figure) == SINEW_OK); /* takes the freed index */
    CHECK(sinew_world_get_user_data(world, SINEW_OF_FIGURE, figure, &found) == SINEW_OK && found == NULL);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

typedef struct counts {
    int segments, spheres, polygons;
} counts;
static void count_segment(void* context, sinew_point from, sinew_point to, double radius, uint32_t color) {
    ((counts*)context)->segments += isfinite(from.x + from.y + to.x + to.y + radius) && color < 1u << 24;
}
static void count_sphere(void* context, sinew_point center, double radius, uint32_t color) {
    ((counts*)context)->spheres += isfinite(center.x + center.y) && radius >= 0 && color < 1u << 24;
}
static void count_polygon(void* context, const sinew_point* corners, size_t count, uint32_t color) {
    ((counts*)context)->polygons += isfinite(corners[count - 1].x) && color < 1u << 24;
}

static void everything_is_drawn(void) {
    const sinew_world world = created();
    const sinew_parameter parameters[] = {{"segments", 8, NULL}};
    const sinew_collider_spec box = {
        .struct_size = sizeof box, .shape = SINEW_BOX, .half = {1, 1, 0}, .position = {9, 0, 0}};
    sinew_collider collider;
    counts seen = {0, 0, 0};
    CHECK(add_rope(world, NULL, parameters, 1, NULL) == SINEW_OK);
    CHECK(sinew_world_add_collider(world, &box, &collider) == SINEW_OK);
    sinew_debug_draw draw = {.struct_size = sizeof draw,
                             .context = &seen,
                             .segment = count_segment,
                             .sphere = count_sphere,
                             .polygon = count_polygon};
    CHECK(sinew_world_draw_debug(world, &draw, 10) == SINEW_OK);
    CHECK(seen.segments == 8 && seen.spheres == 9 && seen.polygons == 1);
    draw.parts = SINEW_DRAW_PARTICLES;
    draw.sphere = NULL;
    CHECK(sinew_world_draw_debug(world, &draw, 10) == SINEW_OK && seen.segments == 8 && seen.spheres == 9);
    CHECK(sinew_world_draw_debug(world, &draw, -1) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

struct closing {
    sinew_world world;
    int shapes;
};
static void close_within_a_segment(void* context, sinew_point from, sinew_point to, double radius, uint32_t color) {
    struct closing* closing = context;
    (void)from, (void)to, (void)radius, (void)color;
    CHECK(sinew_world_close(closing->world) == (closing->shapes++ == 0 ? SINEW_OK : SINEW_BAD_HANDLE));
}
static void close_within_a_sphere(void* context, sinew_point center, double radius, uint32_t color) {
    close_within_a_segment(context, center, center, radius, color);
}
static void drawing_may_close_the_world(void) {
    struct closing closing = {created(), 0};
    const sinew_debug_draw draw = {.struct_size = sizeof draw,
                                   .context = &closing,
                                   .segment = close_within_a_segment,
                                   .sphere = close_within_a_sphere};
    const sinew_parameter parameters[] = {{"segments", 8, NULL}};
    CHECK(add_rope(closing.world, NULL, parameters, 1, NULL) == SINEW_OK);
    CHECK(sinew_world_draw_debug(closing.world, &draw, 10) == SINEW_OK && closing.shapes == 17);
}

static void count_failure(void* context, sinew_status status, const char* message) {
    *(int*)context += status == SINEW_BAD_HANDLE && message[0] != 0;
}
static void one_after_the_other(void* context, void (*task)(void*, uint32_t), void* task_context, uint32_t count) {
    ++*(int*)context;
    for (uint32_t i = 0; i < count; ++i) task(task_context, i);
}

/* A log whose own calls fail. */
static void fail_within_the_log(void* context, sinew_status status, const char* message) {
    const size_t length = strlen(message);
    CHECK(status == SINEW_BAD_ARGUMENT && strcmp(message, sinew_message()) == 0);
    CHECK(sinew_world_step((sinew_world){0}, 1) == SINEW_BAD_HANDLE && strlen(message) == length);
    ++*(int*)context;
}
static void a_log_hears_of_failures_alone(void) {
    const sinew_world world = created();
    sinew_constraint constraint;
    int told = 0;
    CHECK(add_rope(world, NULL, NULL, 0, NULL) == SINEW_OK);
    sinew_set_log(fail_within_the_log, &told);
    CHECK(sinew_world_constraint_at(world, SINEW_DISTANCE, 0, &constraint) == SINEW_OK && told == 0);
    CHECK(sinew_world_set_mass(world, 0, -1) == SINEW_BAD_ARGUMENT && told == 1);
    CHECK(strcmp(sinew_message(), "a mass is at least 1e-30") == 0);
    sinew_set_log(NULL, NULL);
    CHECK(sinew_world_constraint_at(world, SINEW_DISTANCE, 1u << 20, &constraint) == SINEW_NOT_FOUND);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* Threads of the caller that would close the world they step. */
struct meddling {
    sinew_world world;
    int calls, refused;
};
static void close_between_tasks(void* context, void (*task)(void*, uint32_t), void* task_context, uint32_t count) {
    struct meddling* meddling = context;
    sinew_particle particle;
    const sinew_particle_spec spec = {.struct_size = sizeof spec, .mass = 1};
    ++meddling->calls;
    meddling->refused += sinew_world_close(meddling->world) == SINEW_READ_ONLY &&
                         sinew_world_step(meddling->world, 1) == SINEW_READ_ONLY &&
                         sinew_world_add_particle(meddling->world, &spec, &particle) == SINEW_READ_ONLY;
    for (uint32_t i = 0; i < count; ++i) task(task_context, i);
}
static sinew_world world_of_a_cloth(uint32_t threads) {
    const sinew_world world = created();
    const sinew_parameter parameters[] = {{"columns", 100, NULL}, {"rows", 100, NULL}};
    const sinew_figure_spec spec = {
        .struct_size = sizeof spec, .prefab = "cloth", .parameters = parameters, .parameter_count = 2};
    CHECK(sinew_world_set_threads(world, threads) == SINEW_OK);
    CHECK(sinew_world_add_figure(world, &spec, NULL) == SINEW_OK);
    return world;
}
static void threads_leave_the_world_alone(void) {
    struct meddling meddling = {world_of_a_cloth(4), 0, 0};
    sinew_set_parallel(close_between_tasks, &meddling);
    CHECK(sinew_world_step(meddling.world, 1) == SINEW_OK);
    CHECK(meddling.calls > 0 && meddling.refused == meddling.calls);
    sinew_set_parallel(NULL, NULL);
    CHECK(sinew_world_close(meddling.world) == SINEW_OK);
}

static void close_the_player_between_tasks(void* context, void (*task)(void*, uint32_t), void* task_context,
                                           uint32_t count) {
    const sinew_player player = *(const sinew_player*)context;
    CHECK(sinew_player_close(player) == SINEW_READ_ONLY && sinew_player_advance(player, 1) == SINEW_READ_ONLY);
    for (uint32_t i = 0; i < count; ++i) task(task_context, i);
}
static void threads_leave_the_player_alone(void) {
    const char* scene = "{\"sinew\": 1, \"figures\": [{\"prefab\": \"cloth\", \"columns\": 100, \"rows\": 100}]}";
    sinew_player player;
    CHECK(sinew_player_create(scene, NULL, &player) == SINEW_OK);
    sinew_set_parallel(close_the_player_between_tasks, &player);
    CHECK(sinew_player_advance(player, 0.04) == SINEW_OK);
    sinew_set_parallel(NULL, NULL);
    CHECK(sinew_player_close(player) == SINEW_OK && sinew_player_close(player) == SINEW_BAD_HANDLE);
}

/* A cloth of 10,000 particles is worth several threads; the caller's do it to the same bits. */
static uint64_t hash_of_a_cloth(uint32_t threads) {
    const sinew_world world = world_of_a_cloth(threads);
    uint64_t hash = 0;
    CHECK(sinew_world_step(world, 2) == SINEW_OK);
    CHECK(sinew_world_state_hash(world, &hash) == SINEW_OK);
    CHECK(sinew_world_close(world) == SINEW_OK);
    return hash;
}

static void hooks_are_called(void) {
    int told = 0, shared = 0;
    sinew_set_log(count_failure, &told);
    CHECK(sinew_world_step((sinew_world){0}, 1) == SINEW_BAD_HANDLE && told == 1);
    sinew_set_log(NULL, NULL);
    CHECK(sinew_world_step((sinew_world){0}, 1) == SINEW_BAD_HANDLE && told == 1);
    const uint64_t alone = hash_of_a_cloth(1);
    sinew_set_parallel(one_after_the_other, &shared);
    CHECK(hash_of_a_cloth(4) == alone && shared > 0);
    sinew_set_parallel(NULL, NULL);
}

/* A task system that runs each task when it is waited for: handles are its numbers, from 1. */
struct waiting {
    void (*task)(void*, uint32_t);
    void* context;
    uint32_t index;
};
static struct waiting waiting[64];
static size_t waiting_count, finished_count;
static void* enqueue(void* context, void (*task)(void*, uint32_t), void* task_context, uint32_t index) {
    ++*(int*)context;
    waiting[waiting_count % 64] = (struct waiting){task, task_context, index};
    return &waiting[waiting_count++ % 64];
}
static void finish(void* context, void* handle) {
    const struct waiting* one = handle;
    (void)context;
    one->task(one->context, one->index);
    ++finished_count;
}
static void tasks_are_enqueued_and_finished(void) {
    int enqueued = 0;
    const uint64_t alone = hash_of_a_cloth(1);
    CHECK(sinew_set_task_system(enqueue, NULL, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_set_task_system(enqueue, finish, &enqueued) == SINEW_OK);
    CHECK(hash_of_a_cloth(4) == alone && enqueued > 0 && finished_count == (size_t)enqueued);
    CHECK(sinew_set_task_system(NULL, NULL, NULL) == SINEW_OK);
    const int before = enqueued;
    CHECK(hash_of_a_cloth(1) == alone && enqueued == before);
}

/* A task system of one world alone, not of its copy: two worlds with one each, and a third with the library's. */
static void worlds_have_their_own_tasks(void) {
    int shared = 0, enqueued = 0;
    const sinew_world worlds[] = {world_of_a_cloth(4), world_of_a_cloth(4), world_of_a_cloth(1)};
    sinew_world copy;
    uint64_t hashes[4];
    finished_count = 0;
    CHECK(sinew_world_set_parallel(worlds[0], one_after_the_other, &shared) == SINEW_OK);
    CHECK(sinew_world_set_task_system(worlds[1], enqueue, NULL, &enqueued) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_set_task_system(worlds[1], enqueue, finish, &enqueued) == SINEW_OK);
    CHECK(sinew_world_step(worlds[0], 2) == SINEW_OK && shared > 0 && enqueued == 0);
    const int before = shared;
    CHECK(sinew_world_copy(worlds[0], &copy) == SINEW_OK && sinew_world_step(copy, 1) == SINEW_OK);
    CHECK(sinew_world_step(worlds[1], 2) == SINEW_OK && enqueued > 0 && finished_count == (size_t)enqueued);
    CHECK(sinew_world_step(worlds[2], 2) == SINEW_OK && shared == before);
    for (int i = 0; i < 3; ++i) CHECK(sinew_world_state_hash(worlds[i], &hashes[i]) == SINEW_OK);
    CHECK(hashes[0] == hashes[1] && hashes[0] == hashes[2]);
    CHECK(sinew_world_set_parallel(worlds[0], NULL, NULL) == SINEW_OK && sinew_world_step(worlds[0], 1) == SINEW_OK);
    CHECK(shared == before && sinew_world_state_hash(copy, &hashes[3]) == SINEW_OK);
    CHECK(sinew_world_state_hash(worlds[0], &hashes[0]) == SINEW_OK && hashes[0] == hashes[3]);
    for (int i = 0; i < 3; ++i) CHECK(sinew_world_close(worlds[i]) == SINEW_OK);
    CHECK(sinew_world_close(copy) == SINEW_OK);
}

/* The instruction set is a simulation's own, and changes no bit. */
static void instruction_sets_agree(void) {
    const char* const names[] = {"one", "sse2", "neon", "avx2", "avx512"};
    uint64_t first = 0, hash = 0;
    int tried = 0;
    for (int i = 0; i < 5; ++i) {
        const sinew_world world = created();
        const sinew_status status = sinew_world_set_simd(world, names[i]);
        CHECK(status == SINEW_OK || status == SINEW_NOT_FOUND);
        if (status == SINEW_OK) {
            CHECK(add_rope(world, NULL, NULL, 0, NULL) == SINEW_OK && sinew_world_step(world, 60) == SINEW_OK);
            CHECK(sinew_world_state_hash(world, &hash) == SINEW_OK && (tried == 0 || hash == first));
            if (tried++ == 0) first = hash;
        }
        CHECK(sinew_world_close(world) == SINEW_OK);
    }
    const sinew_world world = created();
    CHECK(tried > 0 && sinew_world_set_simd(world, NULL) == SINEW_OK &&
          sinew_world_set_simd(world, sinew_simd()) == SINEW_OK);
    CHECK(sinew_world_set_simd(world, "mmx") == SINEW_NOT_FOUND && strstr(sinew_message(), "mmx") != NULL);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* All memory comes from the caller, and goes back there; a step takes none. */
struct counter {
    size_t taken, released, blocks;
    int refuses;
};
static void* take(void* context, size_t size, size_t alignment) {
    struct counter* counter = context;
    if (counter->refuses) return NULL;
    counter->taken += size, ++counter->blocks;
    return aligned_alloc(alignment, size);
}
static void give(void* context, void* memory, size_t size) {
    struct counter* counter = context;
    counter->released += size;
    free(memory);
}
static void memory_is_the_callers(void) {
    static struct counter counter; /* outlives the test: handles and a message go back to it later */
    CHECK(sinew_set_allocator(take, NULL, NULL) == SINEW_BAD_ARGUMENT);
    const sinew_world before = created();
    CHECK(sinew_set_allocator(take, give, &counter) == SINEW_OK);
    const sinew_world world = created();
    CHECK(add_rope(world, NULL, NULL, 0, NULL) == SINEW_OK && sinew_world_step(world, 60) == SINEW_OK);
    CHECK(counter.taken > 10000 && counter.released > 0);
    const size_t blocks = counter.blocks;
    CHECK(sinew_world_step(world, 120) == SINEW_OK && counter.blocks == blocks);
    CHECK(sinew_world_close(before) == SINEW_OK && sinew_world_close(world) == SINEW_OK);
    CHECK(counter.taken - counter.released < 5000); /* handles, and the thread's last message */
    CHECK(sinew_set_allocator(NULL, NULL, NULL) == SINEW_OK);
    const size_t after = counter.blocks;
    CHECK(sinew_world_close(created()) == SINEW_OK && counter.blocks == after);
}

/* A character of the C face walks at its speed and stands on the ground; a car drives. */
static void figures_are_steered(void) {
    const sinew_world world = created();
    const sinew_collider_spec ground = {.struct_size = sizeof ground, .friction = 0.8};
    const sinew_parameter speed[] = {{"speed", 3, NULL}};
    const sinew_figure_spec hero = {
        .struct_size = sizeof hero, .prefab = "character", .parameters = speed, .parameter_count = 1};
    const sinew_figure_spec racer = {.struct_size = sizeof racer, .prefab = "car", .position = {20, 0, 0}};
    sinew_controls controls = {.struct_size = sizeof controls, .along = 1};
    sinew_collider id;
    sinew_particle feet, rear;
    sinew_particle_state state = {.struct_size = sizeof state}, wheel = {.struct_size = sizeof wheel};
    sinew_footing footing = {.struct_size = sizeof footing};
    uint32_t character = 0, car = 0, rope = 0;
    CHECK(sinew_world_add_collider(world, &ground, &id) == SINEW_OK);
    CHECK(sinew_world_add_figure(world, &hero, &character) == SINEW_OK &&
          sinew_world_add_figure(world, &racer, &car) == SINEW_OK);
    CHECK(add_rope(world, NULL, NULL, 0, &rope) == SINEW_OK);
    CHECK(sinew_world_step(world, 30) == SINEW_OK);
    CHECK(sinew_world_steer(world, character, &controls) == SINEW_OK &&
          sinew_world_steer(world, car, &controls) == SINEW_OK);
    CHECK(sinew_world_step(world, 60) == SINEW_OK);
    CHECK(sinew_world_get_footing(world, character, &footing) == SINEW_OK && footing.on_ground == 1);
    CHECK(footing.is_holding == 0 && footing.figure == ~0u);
    CHECK(sinew_world_find_particle(world, "character/feet", &feet) == SINEW_OK);
    CHECK(sinew_world_find_particle(world, "car/rear_wheel", &rear) == SINEW_OK);
    CHECK(sinew_world_get_particle(world, feet, &state) == SINEW_OK &&
          sinew_world_get_particle(world, rear, &wheel) == SINEW_OK);
    CHECK(fabs(state.velocity[0] - 3) < 0.1);
    CHECK(wheel.velocity[0] > 2);
    CHECK(sinew_world_steer(world, character, NULL) == SINEW_OK && sinew_world_step(world, 30) == SINEW_OK);
    CHECK(sinew_world_get_particle(world, feet, &state) == SINEW_OK && fabs(state.velocity[0]) < 0.05);
    CHECK(sinew_world_steer(world, rope, &controls) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_steer(world, 1u << 30, &controls) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_get_footing(world, car, &footing) == SINEW_BAD_ARGUMENT);
    controls.along = NAN;
    CHECK(sinew_world_steer(world, character, &controls) == SINEW_BAD_ARGUMENT);
    controls.struct_size = 4;
    CHECK(sinew_world_steer(world, character, &controls) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* A figure at the index of a removed character is not steered by what was said of that one. */
static void controls_go_with_their_figure(void) {
    const sinew_world world = created();
    const sinew_collider_spec ground = {.struct_size = sizeof ground, .friction = 0.8};
    const sinew_figure_spec hero = {.struct_size = sizeof hero, .prefab = "character"};
    const sinew_controls controls = {.struct_size = sizeof controls, .along = 1};
    sinew_collider id;
    sinew_footing footing = {.struct_size = sizeof footing};
    sinew_particle feet;
    sinew_particle_state state = {.struct_size = sizeof state, .velocity = {9, 0, 0}};
    uint32_t first, second, rope;
    CHECK(sinew_world_add_collider(world, &ground, &id) == SINEW_OK);
    CHECK(sinew_world_add_figure(world, &hero, &first) == SINEW_OK);
    CHECK(sinew_world_steer(world, first, &controls) == SINEW_OK);
    CHECK(sinew_world_remove_figure(world, first) == SINEW_OK);
    CHECK(sinew_world_steer(world, first, &controls) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_get_footing(world, first, &footing) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_add_figure(world, &hero, &second) == SINEW_OK && second == first);
    CHECK(sinew_world_step(world, 60) == SINEW_OK);
    CHECK(sinew_world_find_particle(world, "character/feet", &feet) == SINEW_OK);
    CHECK(sinew_world_get_particle(world, feet, &state) == SINEW_OK && fabs(state.velocity[0]) < 0.05);
    CHECK(sinew_world_remove_figure(world, second) == SINEW_OK);
    CHECK(add_rope(world, NULL, NULL, 0, &rope) == SINEW_OK && rope == second);
    CHECK(sinew_world_steer(world, rope, &controls) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

static uint64_t hash_of(sinew_world world) {
    uint64_t hash = 0;
    CHECK(sinew_world_state_hash(world, &hash) == SINEW_OK);
    return hash;
}

/* Controls held when a world is saved are held where the bytes are opened: figures of the scene and of calls. */
static void controls_are_saved(void) {
    const char* scene = "{\"sinew\": 1, \"world\": {\"gravity\": [0, -10]}, \"figures\": [{\"prefab\": \"character\", "
                        "\"name\": \"hero\"}, {\"prefab\": \"car\", \"name\": \"racer\", \"at\": [9, 0]}], "
                        "\"colliders\": [{\"shape\": \"box\", \"size\": [90, 1], \"at\": [0, -0.5]}]}";
    const char* names[] = {"hero", "racer", "walker", "driver"};
    const sinew_parameter speed = {"speed", 3, NULL}, torque = {"torque", 90, NULL};
    const sinew_figure_spec walker = {.struct_size = sizeof walker,
                                      .prefab = "character",
                                      .name = "walker",
                                      .position = {-9, 0, 0},
                                      .parameters = &speed,
                                      .parameter_count = 1};
    const sinew_figure_spec driver = {.struct_size = sizeof driver,
                                      .prefab = "car",
                                      .name = "driver",
                                      .position = {-18, 0, 0},
                                      .parameters = &torque,
                                      .parameter_count = 1};
    sinew_world world, copy, loaded;
    CHECK(sinew_world_open(scene, NULL, &world) == SINEW_OK);
    CHECK(sinew_world_add_figure(world, &walker, NULL) == SINEW_OK);
    CHECK(sinew_world_add_figure(world, &driver, NULL) == SINEW_OK);
    for (uint32_t i = 0; i < 4; ++i) {
        const sinew_controls controls = {.struct_size = sizeof controls, .along = i % 2 ? 1 : -0.5, .jump = i == 2};
        const uint8_t* bytes = NULL;
        size_t size = 0;
        uint32_t figure;
        CHECK(sinew_world_find_figure(world, names[i], &figure) == SINEW_OK);
        CHECK(sinew_world_steer(world, figure, &controls) == SINEW_OK &&
              sinew_world_step(world, 7 + 3 * i) == SINEW_OK);
        CHECK(sinew_world_save(world, &bytes, &size) == SINEW_OK);
        CHECK(sinew_world_load(bytes, size, NULL, &loaded) == SINEW_OK);
        CHECK(sinew_world_copy(world, &copy) == SINEW_OK);
        for (int step = 0; step < 20; ++step) {
            CHECK(hash_of(loaded) == hash_of(world) && hash_of(copy) == hash_of(world));
            CHECK(sinew_world_step(world, 1) == SINEW_OK);
            CHECK(sinew_world_step(loaded, 1) == SINEW_OK && sinew_world_step(copy, 1) == SINEW_OK);
        }
        CHECK(sinew_world_steer(loaded, figure, NULL) == SINEW_OK && sinew_world_step(loaded, 20) == SINEW_OK);
        CHECK(sinew_world_step(world, 20) == SINEW_OK && hash_of(loaded) != hash_of(world));
        CHECK(sinew_world_close(loaded) == SINEW_OK && sinew_world_close(copy) == SINEW_OK);
    }
    CHECK(sinew_world_close(world) == SINEW_OK);
}

static void controls_outlast_an_edit_of_the_scene(void) {
    const char* scene =
        "{\"sinew\": 1, \"world\": {\"gravity\": [0, -10]}, \"figures\": [{\"prefab\": \"character\", "
        "\"name\": \"hero\"}], \"colliders\": [{\"shape\": \"box\", \"size\": [90, 1], \"at\": [0, -0.5]}]}";
    const sinew_controls controls = {.struct_size = sizeof controls, .along = 1};
    sinew_world world;
    sinew_particle feet;
    sinew_particle_state state = {.struct_size = sizeof state, .velocity = {0, 0, 0}};
    uint32_t hero = 0;
    CHECK(sinew_world_open(scene, NULL, &world) == SINEW_OK &&
          sinew_world_find_figure(world, "hero", &hero) == SINEW_OK);
    CHECK(sinew_world_steer(world, hero, &controls) == SINEW_OK && sinew_world_step(world, 60) == SINEW_OK);
    CHECK(sinew_world_set(world, "world.damping=0.01") == SINEW_OK && sinew_world_step(world, 60) == SINEW_OK);
    CHECK(sinew_world_find_particle(world, "hero/feet", &feet) == SINEW_OK);
    CHECK(sinew_world_get_particle(world, feet, &state) == SINEW_OK && state.velocity[0] > 3);
    CHECK(sinew_world_restart(world) == SINEW_OK && sinew_world_step(world, 60) == SINEW_OK);
    CHECK(sinew_world_find_particle(world, "hero/feet", &feet) == SINEW_OK);
    CHECK(sinew_world_get_particle(world, feet, &state) == SINEW_OK && fabs(state.velocity[0]) < 0.05);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

static const char* const rope_and_box =
    "{\"sinew\": 1, \"world\": {\"gravity\": [0, -10]}, \"figures\": [{\"prefab\": \"rope\", \"name\": \"rope\", "
    "\"segments\": 6, \"at\": [0, 3]}, {\"prefab\": \"box\", \"name\": \"box\", \"at\": [3, 2]}], "
    "\"colliders\": [{\"name\": \"ground\", \"shape\": \"box\", \"size\": [90, 1], \"at\": [0, -0.5]}]}";

/* Everything that calls can add, remove or set, and its ids. */
struct added {
    uint32_t figure, box;
    sinew_particle end, weight, link, corner;
    sinew_constraint joint;
    sinew_pin pin;
    sinew_collider ground, wall;
};
static struct added added_to(sinew_world world) {
    struct added it;
    const sinew_collider_spec wall = {
        .struct_size = sizeof wall, .shape = SINEW_BOX, .half = {0.5, 5, 1}, .position = {-9, 0, 0}};
    const sinew_particle_spec weight = {.struct_size = sizeof weight, .position = {1, 2, 0}, .mass = 3};
    const sinew_constraint_spec cord = {.struct_size = sizeof cord, .high = 2};
    CHECK(add_rope(world, "second", NULL, 0, &it.figure) == SINEW_OK);
    CHECK(sinew_world_find_figure(world, "box", &it.box) == SINEW_OK);
    CHECK(sinew_world_find_particle(world, "rope/end", &it.end) == SINEW_OK);
    CHECK(sinew_world_find_particle(world, "second/end", &it.link) == SINEW_OK);
    CHECK(sinew_world_add_particle(world, &weight, &it.weight) == SINEW_OK);
    const sinew_particle ends[] = {it.end, it.weight};
    CHECK(sinew_world_add_constraint(world, SINEW_DISTANCE, ends, 2, &cord, &it.joint) == SINEW_OK);
    CHECK(sinew_world_pin_particle(world, it.link, &it.pin) == SINEW_OK);
    CHECK(sinew_world_add_collider(world, &wall, &it.wall) == SINEW_OK);
    CHECK(sinew_world_find_collider(world, "ground", &it.ground) == SINEW_OK);
    CHECK(sinew_world_set_gravity(world, (sinew_point){0, -5, 0}) == SINEW_OK);
    CHECK(sinew_world_set_mass(world, it.end, 7) == SINEW_OK);
    CHECK(sinew_world_set_user_data(world, SINEW_OF_PARTICLE, it.weight, &failures) == SINEW_OK);
    return it;
}

/* The world goes on to the same bits where the edit changes nothing that counts, and all ids hold. */
static void what_calls_have_added_outlasts_an_edit(void) {
    const char* const edits[] = {"view.theme=dark", "figures.1.mass=2", "world.damping=0.1"};
    for (size_t i = 0; i < sizeof edits / sizeof *edits; ++i) {
        sinew_world world = {0}, twin = {0};
        sinew_particle_state state = {.struct_size = sizeof state}, of_twin = {.struct_size = sizeof of_twin};
        sinew_constraint_state joint = {.struct_size = sizeof joint};
        sinew_figure figure = {.struct_size = sizeof figure};
        uint64_t hash = 0, hash_of_twin = 1;
        void* data = NULL;
        CHECK(sinew_world_open(rope_and_box, NULL, &world) == SINEW_OK);
        const struct added it = added_to(world);
        CHECK(sinew_world_step(world, 30) == SINEW_OK && sinew_world_copy(world, &twin) == SINEW_OK);
        CHECK(sinew_world_set(world, edits[i]) == SINEW_OK);
        CHECK(sinew_world_get_particle(world, it.weight, &state) == SINEW_OK);
        CHECK(sinew_world_get_particle(twin, it.weight, &of_twin) == SINEW_OK);
        CHECK(memcmp(state.position, of_twin.position, sizeof state.position) == 0);
        CHECK(memcmp(state.velocity, of_twin.velocity, sizeof state.velocity) == 0 && fabs(state.velocity[1]) > 0.1);
        CHECK(sinew_world_get_particle(world, it.end, &state) == SINEW_OK && fabs(state.inverse_mass * 7 - 1) < 1e-9);
        CHECK(sinew_world_get_constraint(world, it.joint, &joint) == SINEW_OK);
        CHECK(sinew_world_figure_at(world, it.figure, &figure) == SINEW_OK && strcmp(figure.name, "second") == 0);
        CHECK(sinew_world_get_user_data(world, SINEW_OF_PARTICLE, it.weight, &data) == SINEW_OK && data == &failures);
        CHECK(sinew_world_move_collider(world, it.wall, (sinew_point){-9, 1, 0}, 0, NULL) == SINEW_OK);
        CHECK(sinew_world_move_collider(world, it.wall, (sinew_point){-9, 0, 0}, 0, NULL) == SINEW_OK);
        CHECK(sinew_world_move_collider(world, it.ground, (sinew_point){0, -0.5, 0}, 0, NULL) == SINEW_OK);
        CHECK(sinew_world_step(world, 30) == SINEW_OK && sinew_world_step(twin, 30) == SINEW_OK);
        CHECK(sinew_world_state_hash(world, &hash) == SINEW_OK);
        CHECK(sinew_world_state_hash(twin, &hash_of_twin) == SINEW_OK && (i > 0 || hash == hash_of_twin));
        CHECK(sinew_world_get_particle(world, it.link, &state) == SINEW_OK && state.velocity[1] == 0);
        CHECK(sinew_world_unpin(world, it.pin) == SINEW_OK);
        CHECK(sinew_world_remove_figure(world, it.figure) == SINEW_OK);
        CHECK(sinew_world_remove_constraint(world, it.joint) == SINEW_OK);
        CHECK(sinew_world_remove_collider(world, it.wall) == SINEW_OK);
        CHECK(sinew_world_remove_particle(world, it.weight) == SINEW_OK);
        CHECK(sinew_world_close(world) == SINEW_OK && sinew_world_close(twin) == SINEW_OK);
    }
}

static void what_calls_have_removed_stays_away(void) {
    sinew_world world;
    sinew_collider ground;
    sinew_particle start;
    sinew_particle_state state = {.struct_size = sizeof state};
    sinew_pin pin;
    uint32_t box;
    CHECK(sinew_world_open(rope_and_box, NULL, &world) == SINEW_OK);
    CHECK(sinew_world_find_figure(world, "box", &box) == SINEW_OK && sinew_world_remove_figure(world, box) == SINEW_OK);
    CHECK(sinew_world_find_collider(world, "ground", &ground) == SINEW_OK);
    CHECK(sinew_world_remove_collider(world, ground) == SINEW_OK);
    CHECK(sinew_world_find_particle(world, "rope/start", &start) == SINEW_OK);
    CHECK(sinew_world_pin_particle(world, start, &pin) == SINEW_OK && sinew_world_unpin(world, pin) == SINEW_OK);
    CHECK(sinew_world_set(world, "world.damping=0.1") == SINEW_OK);
    CHECK(sinew_world_find_figure(world, "box", &box) == SINEW_NOT_FOUND);
    CHECK(sinew_world_find_collider(world, "ground", &ground) == SINEW_NOT_FOUND);
    CHECK(sinew_world_step(world, 60) == SINEW_OK);
    CHECK(sinew_world_get_particle(world, start, &state) == SINEW_OK && state.velocity[1] < -5);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* An edit that would lose something is an error, and changes nothing. */
static void what_cannot_outlast_an_edit_is_an_error(void) {
    sinew_world world;
    uint64_t before = 0, after = 1;
    CHECK(sinew_world_open(rope_and_box, NULL, &world) == SINEW_OK);
    const struct added it = added_to(world);
    CHECK(sinew_world_step(world, 10) == SINEW_OK && sinew_world_state_hash(world, &before) == SINEW_OK);
    CHECK(sinew_world_set(world, "figures.0.segments=9") == SINEW_BAD_ARGUMENT);
    CHECK(strstr(sinew_message(), "a constraint holds \"rope\"") != NULL);
    CHECK(sinew_world_set(world, "solver.precision=float") == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_set(world, "figures.1.name=second") == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_state_hash(world, &after) == SINEW_OK && before == after);
    CHECK(sinew_world_remove_constraint(world, it.joint) == SINEW_OK);
    CHECK(sinew_world_set(world, "figures.0.segments=9") == SINEW_OK && sinew_world_step(world, 10) == SINEW_OK);
    sinew_constraint link = 0;
    CHECK(sinew_world_constraint_at(world, 0, 2, &link) == SINEW_OK);
    CHECK(sinew_world_remove_constraint(world, link) == SINEW_OK);
    CHECK(sinew_world_set(world, "figures.0.segments=7") == SINEW_BAD_ARGUMENT);
    CHECK(strstr(sinew_message(), "has been cut") != NULL);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* A filter's caller: a platform that nothing touches. */
struct level {
    sinew_world world;
    sinew_collider platform;
    sinew_particle ball;
    int asked, of_ball, refused_changes;
};
static int all_but_platform(void* context, sinew_pending_contact* contact) {
    struct level* level = context;
    void* data = NULL;
    CHECK(contact->struct_size == sizeof *contact && contact->other == SINEW_NO_ID);
    CHECK(fabs(fabs(contact->normal.y) - 1) < 1e-9); /* down for a ball in the lower half of the platform */
    CHECK(fabs(contact->friction - 0.4) < 1e-9);
    CHECK(sinew_world_get_user_data(level->world, SINEW_OF_PARTICLE, contact->particle, &data) == SINEW_OK);
    level->of_ball += data == level;
    level->refused_changes += sinew_world_close(level->world) == SINEW_READ_ONLY &&
                              sinew_world_step(level->world, 1) == SINEW_READ_ONLY &&
                              sinew_world_set_contact_filter(level->world, NULL, NULL) == SINEW_READ_ONLY;
    ++level->asked;
    return contact->collider != level->platform;
}

static void contacts_are_filtered(void) {
    struct level level = {.world = created()};
    sinew_collider ground;
    uint32_t count = 9;
    const sinew_collider_spec floor = {.struct_size = sizeof floor, .position = {0, -3, 0}, .friction = 0.4};
    const sinew_collider_spec platform = {
        .struct_size = sizeof platform, .shape = SINEW_BOX, .half = {2, 0.1, 0}, .friction = 0.4};
    const sinew_figure_spec spec = {.struct_size = sizeof spec, .prefab = "ball", .position = {0, 1, 0}};
    CHECK(sinew_world_add_collider(level.world, &floor, &ground) == SINEW_OK);
    CHECK(sinew_world_add_collider(level.world, &platform, &level.platform) == SINEW_OK);
    CHECK(sinew_world_add_figure(level.world, &spec, NULL) == SINEW_OK);
    CHECK(sinew_world_particle_at(level.world, 0, &level.ball) == SINEW_OK);
    CHECK(sinew_world_set_user_data(level.world, SINEW_OF_PARTICLE, level.ball, &level) == SINEW_OK);
    CHECK(sinew_world_step(level.world, 60) == SINEW_OK && height_of(level.world, level.ball) > 0.1);

    CHECK(sinew_world_set_contact_filter(level.world, all_but_platform, &level) == SINEW_OK);
    CHECK(sinew_world_step(level.world, 30) == SINEW_OK);
    CHECK(sinew_world_contact_count(level.world, &count) == SINEW_OK && count == 0);
    CHECK(sinew_world_run_until(level.world, 4) == SINEW_OK);
    CHECK(height_of(level.world, level.ball) < -2 && height_of(level.world, level.ball) > -3);
    CHECK(sinew_world_contact_count(level.world, &count) == SINEW_OK && count == 1);
    CHECK(level.asked > 0 && level.of_ball == level.asked && level.refused_changes == level.asked);

    const int before = level.asked;
    sinew_world copy;
    CHECK(sinew_world_copy(level.world, &copy) == SINEW_OK && sinew_world_step(copy, 5) == SINEW_OK);
    CHECK(sinew_world_close(copy) == SINEW_OK && level.asked == before);
    CHECK(sinew_world_set_contact_filter(level.world, NULL, NULL) == SINEW_OK &&
          sinew_world_step(level.world, 5) == SINEW_OK);
    CHECK(level.asked == before);
    CHECK(sinew_world_set_contact_filter((sinew_world){12345}, all_but_platform, NULL) == SINEW_BAD_HANDLE);
    CHECK(sinew_world_close(level.world) == SINEW_OK);
}

static uint32_t little(const uint8_t* bytes) {
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* A point cache of a rope: a header of 32 bytes, then three floats a vertex and frame. */
static void files_are_bytes(void) {
    const sinew_world world = created();
    const char* const names[] = {"line"};
    sinew_export_spec spec = {.struct_size = sizeof spec, .figure_count = 1, .figures = names, .fps = 60};
    sinew_export file;
    uint32_t figure = 0, count = 0;
    const char* name = NULL;
    const uint8_t* bytes = NULL;
    size_t size = 0;
    sinew_world other;
    CHECK(add_rope(world, "line", NULL, 0, &figure) == SINEW_OK && sinew_world_copy(world, &other) == SINEW_OK);
    CHECK(sinew_export_begin("out/line.pc2", &spec, &file) == SINEW_OK);
    CHECK(sinew_export_finish(file, &count) == SINEW_BAD_ARGUMENT);
    for (int frame = 0; frame < 5; ++frame) {
        CHECK(sinew_export_frame(file, world) == SINEW_OK);
        CHECK(sinew_export_frame(file, other) == SINEW_BAD_ARGUMENT);
        CHECK(sinew_world_step(world, 1) == SINEW_OK);
    }
    CHECK(sinew_export_file(file, 0, &name, &bytes, &size) == SINEW_NOT_FOUND);
    CHECK(sinew_export_finish(file, &count) == SINEW_OK);
    CHECK(count == 3);
    for (uint32_t i = 0; i < count; ++i) {
        CHECK(sinew_export_file(file, i, &name, &bytes, &size) == SINEW_OK);
        if (strcmp(name, "out/line.pc2") == 0) CHECK(size == 32 + (size_t)little(bytes + 16) * 5 * 12);
    }
    CHECK(sinew_export_frame(file, world) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_export_close(file) == SINEW_OK);
    CHECK(sinew_export_close(file) == SINEW_BAD_HANDLE);

    const char* const wrong[] = {"a.png", "a.xyz", "", "a-%d-%d.obj", "a-%d.glb"};
    for (int i = 0; i < 5; ++i) CHECK(sinew_export_begin(wrong[i], NULL, &file) == SINEW_BAD_ARGUMENT);
    spec.fps = NAN;
    CHECK(sinew_export_begin("a.glb", &spec, &file) == SINEW_BAD_ARGUMENT);
    spec.fps = 0, spec.figures = NULL;
    CHECK(sinew_export_begin("a.glb", &spec, &file) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_export_begin("a.svg", NULL, &file) == SINEW_OK);
    CHECK(sinew_export_frame(file, world) == SINEW_OK);
    CHECK(sinew_export_finish(file, &count) == SINEW_OK && count == 1);
    CHECK(sinew_export_note(file, 0, &name) == SINEW_OK && strstr(name, "px") != NULL);
    CHECK(sinew_export_close(file) == SINEW_OK && sinew_world_close(other) == SINEW_OK);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* A drawing becomes a scene, and a map that refers to a tileset beside it. */
static void other_files_are_scenes(void) {
    static const char drawing[] = "<svg width='90' height='90'>\n<text>a</text><rect width='9' height='9'/></svg>";
    static const char map[] =
        "{\"tilewidth\":8,\"tileheight\":8,\"width\":1,\"height\":1,\"tilesets\":[{\"firstgid\":1,"
        "\"source\":\"t/a.tsx\"}],\"layers\":[{\"type\":\"tilelayer\",\"width\":1,\"height\":1,"
        "\"data\":[1]}]}";
    static const char tiles[] = "<tileset tilewidth='8' tileheight='8'><tile id='0'><objectgroup><object width='8' "
                                "height='8'/></objectgroup></tile></tileset>";
    const char* const names[] = {"a.tsx"};
    const uint8_t* const contents[] = {(const uint8_t*)tiles};
    const size_t sizes[] = {sizeof tiles - 1};
    sinew_import_spec spec = {.struct_size = sizeof spec, .role = "jelly"};
    sinew_import file;
    sinew_world world;
    const char *text = NULL, *place = NULL, *note = NULL;
    const uint8_t* bytes = NULL;
    size_t size = 0;
    CHECK(sinew_import_open("a.svg", (const uint8_t*)drawing, sizeof drawing - 1, &spec, &file) == SINEW_OK);
    CHECK(sinew_import_scene(file, &text) == SINEW_OK && strstr(text, "\"internal_damping\"") != NULL);
    CHECK(sinew_world_open(text, NULL, &world) == SINEW_OK);
    CHECK(sinew_world_step(world, 2) == SINEW_OK && sinew_world_close(world) == SINEW_OK);
    CHECK(sinew_import_note(file, 0, &place, &note) == SINEW_OK);
    CHECK(strncmp(place, "2:2", 3) == 0 && strstr(note, "<text>") != NULL);
    CHECK(sinew_import_note(file, 1, &place, &note) == SINEW_NOT_FOUND);
    CHECK(sinew_import_file(file, 0, &text, &bytes, &size) == SINEW_NOT_FOUND);
    CHECK(sinew_import_close(file) == SINEW_OK);
    CHECK(sinew_import_close(file) == SINEW_BAD_HANDLE);
    CHECK(sinew_import_scene(file, &text) == SINEW_BAD_HANDLE);

    CHECK(sinew_import_open("a.tmj", (const uint8_t*)map, sizeof map - 1, NULL, &file) == SINEW_BAD_ARGUMENT);
    CHECK(strstr(sinew_message(), "a.tmj:1:") != NULL && strstr(sinew_message(), "t/a.tsx") != NULL);
    spec = (sinew_import_spec){.struct_size = sizeof spec, .file_count = 1};
    CHECK(sinew_import_open("a.tmj", (const uint8_t*)map, sizeof map - 1, &spec, &file) == SINEW_BAD_ARGUMENT);
    spec.file_names = names, spec.file_bytes = contents, spec.file_sizes = sizes;
    CHECK(sinew_import_open("a.tmj", (const uint8_t*)map, sizeof map - 1, &spec, &file) == SINEW_OK);
    CHECK(sinew_import_scene(file, &text) == SINEW_OK && strstr(text, "\"colliders\"") != NULL);
    CHECK(sinew_import_close(file) == SINEW_OK);

    CHECK(sinew_import_open("a.svg", NULL, 0, NULL, &file) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_import_open("a.svg", NULL, 9, NULL, &file) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_import_open("a.xyz", (const uint8_t*)"?", 1, NULL, &file) == SINEW_BAD_ARGUMENT);
    spec = (sinew_import_spec){.struct_size = sizeof spec, .role = "king"};
    CHECK(sinew_import_open("a.svg", (const uint8_t*)drawing, sizeof drawing - 1, &spec, &file) == SINEW_BAD_ARGUMENT);
    spec = (sinew_import_spec){.struct_size = sizeof spec, .error = NAN};
    CHECK(sinew_import_open("a.svg", (const uint8_t*)drawing, sizeof drawing - 1, &spec, &file) == SINEW_BAD_ARGUMENT);
}

int main(void) {
    an_empty_world_falls();
    wrong_sizes_and_numbers_are_errors();
    structs_of_a_later_version_are_read_as_far_as_they_are_known();
    structs_of_any_version_are_filled_as_far_as_they_are_known();
    prefabs_take_parameters();
    a_parameter_may_name_a_figure();
    colliders_carry();
    axes_have_any_length();
    user_data_belongs_to_an_object();
    everything_is_drawn();
    drawing_may_close_the_world();
    a_log_hears_of_failures_alone();
    threads_leave_the_world_alone();
    threads_leave_the_player_alone();
    hooks_are_called();
    tasks_are_enqueued_and_finished();
    worlds_have_their_own_tasks();
    instruction_sets_agree();
    memory_is_the_callers();
    figures_are_steered();
    controls_are_saved();
    controls_go_with_their_figure();
    controls_outlast_an_edit_of_the_scene();
    what_calls_have_added_outlasts_an_edit();
    what_calls_have_removed_stays_away();
    what_cannot_outlast_an_edit_is_an_error();
    contacts_are_filtered();
    files_are_bytes();
    other_files_are_scenes();
    if (failures == 0) printf("all right\n");
    return failures != 0;
}
