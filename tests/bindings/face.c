/* The C face, from C: a pendulum keeps its laws, and no handle, id or pointer from outside can do harm. */
#include "tests/bindings/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char* const pendulum =
    "{\"sinew\": 1, \"view\": {\"center\": [0, 0], \"height\": 4, \"size\": [400, 400]}, \"world\": {\"gravity\": [0, "
    "-10]},"
    " \"figures\": [{\"name\": \"pendulum\", \"particles\": {\"pivot\": {\"at\": [0, 0], \"pinned\": true},"
    " \"bob\": {\"at\": [1, 0]}}, \"constraints\": [{\"name\": \"rod\", \"between\": [\"pivot\", \"bob\"]}]}]}";

static sinew_world opened(void) {
    const char* const overrides[] = {"precision=double", "solver.substeps=32"};
    const sinew_open_options options = {.struct_size = sizeof options, .overrides = overrides, .override_count = 2};
    sinew_world simulation = {0};
    CHECK(sinew_world_open(pendulum, &options, &simulation) == SINEW_OK);
    return simulation;
}

/* v^2 = 2 g h, on a circle of one metre. */
static void a_pendulum_keeps_its_energy(void) {
    const sinew_world simulation = opened();
    sinew_particle bob = SINEW_NO_ID;
    sinew_particle_state state = {.struct_size = sizeof state};
    CHECK(sinew_world_find_particle(simulation, "pendulum/bob", &bob) == SINEW_OK);
    CHECK(sinew_world_run_until(simulation, 0.3) == SINEW_OK);
    CHECK(sinew_world_run_until(simulation, 1e300) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_get_particle(simulation, bob, &state) == SINEW_OK);
    const double square = state.velocity[0] * state.velocity[0] + state.velocity[1] * state.velocity[1];
    CHECK(fabs(square + 20 * state.position[1]) < 0.02);
    CHECK(fabs(hypot(state.position[0], state.position[1]) - 1) < 1e-9);
    CHECK(sinew_world_close(simulation) == SINEW_OK);
}

static void columns_are_the_state(void) {
    const sinew_world simulation = opened();
    sinew_view view = {.struct_size = sizeof view};
    CHECK(sinew_world_get_column(simulation, SINEW_POSITION, &view) == SINEW_OK);
    CHECK(view.rows == 2 && view.components == 2 && view.number_bytes == sizeof(double) && !view.is_integer);
    CHECK(((const double*)view.data)[2] == 1);
    CHECK(sinew_world_get_column(simulation, SINEW_CONSTRAINT_ENDS, &view) == SINEW_OK);
    CHECK(view.rows == 1 && view.is_integer && ((const uint32_t*)view.data)[1] == 1);
    CHECK(sinew_world_get_column(simulation, (sinew_column)99, &view) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_close(simulation) == SINEW_OK);
}

static void a_copy_goes_on_to_the_same_bits(void) {
    const sinew_world first = opened();
    sinew_world second;
    uint64_t a = 0, b = 1;
    CHECK(sinew_world_step(first, 20) == SINEW_OK);
    CHECK(sinew_world_copy(first, &second) == SINEW_OK);
    CHECK(sinew_world_step(first, 20) == SINEW_OK && sinew_world_step(second, 20) == SINEW_OK);
    CHECK(sinew_world_state_hash(first, &a) == SINEW_OK && sinew_world_state_hash(second, &b) == SINEW_OK && a == b);
    CHECK(sinew_world_close(first) == SINEW_OK && sinew_world_close(second) == SINEW_OK);
}

static void a_saved_simulation_goes_on(void) {
    const sinew_world first = opened();
    sinew_world second = {0};
    const uint8_t* bytes = NULL;
    size_t size = 0;
    uint64_t a = 0, b = 1;
    CHECK(sinew_world_step(first, 20) == SINEW_OK);
    CHECK(sinew_world_save(first, &bytes, &size) == SINEW_OK && size > 64);
    CHECK(sinew_world_load(bytes, size, NULL, &second) == SINEW_OK);
    CHECK(sinew_world_load(bytes, size - 1, NULL, &second) == SINEW_BAD_ARGUMENT);
    CHECK(strstr(sinew_message(), "ends within") != NULL);
    CHECK(sinew_world_load(NULL, 0, NULL, &second) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_step(first, 20) == SINEW_OK && sinew_world_step(second, 20) == SINEW_OK);
    CHECK(sinew_world_state_hash(first, &a) == SINEW_OK && sinew_world_state_hash(second, &b) == SINEW_OK && a == b);
    CHECK(sinew_world_close(first) == SINEW_OK && sinew_world_close(second) == SINEW_OK);
}

static void errors_have_their_places(void) {
    sinew_world none = {12345};
    sinew_diagnostic error = {.struct_size = sizeof error};
    CHECK(sinew_world_open("{\"sinew\": 1,\n \"figurs\": []}", NULL, &none) == SINEW_BAD_SCENE);
    CHECK(none.id == 12345);
    CHECK(sinew_diagnostic_count() == 1);
    CHECK(sinew_diagnostic_at(0, &error) == SINEW_OK);
    CHECK(error.line == 2 && error.column == 2 && error.length == 8 && !error.is_override);
    CHECK(strstr(error.help, "figures") != NULL);
    CHECK(strncmp(error.text, "scene.json:2:2: error: ", 23) == 0);
    CHECK(sinew_diagnostic_at(1, &error) == SINEW_NOT_FOUND);
    CHECK(sinew_check(pendulum, NULL) == SINEW_OK && sinew_diagnostic_count() == 0);
}

static void edits_are_undone_by_their_ids(void) {
    const sinew_world simulation = opened();
    sinew_particle bob, weight;
    sinew_constraint rod;
    sinew_pin pin;
    const sinew_particle_spec spec = {.struct_size = sizeof spec, .position = {2, 0, 0}, .mass = 3};
    CHECK(sinew_world_find_particle(simulation, "pendulum/bob", &bob) == SINEW_OK);
    CHECK(sinew_world_add_particle(simulation, &spec, &weight) == SINEW_OK);
    const sinew_particle ends[] = {bob, weight};
    CHECK(sinew_world_add_constraint(simulation, 0, ends, 2, NULL, &rod) == SINEW_OK);
    CHECK(sinew_world_add_constraint(simulation, 0, ends, 1, NULL, &rod) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_add_constraint(simulation, 31, ends, 2, NULL, &rod) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_pin_particle(simulation, weight, &pin) == SINEW_OK);
    CHECK(sinew_world_unpin(simulation, pin) == SINEW_OK && sinew_world_unpin(simulation, pin) == SINEW_BAD_ID);
    CHECK(sinew_world_remove_constraint(simulation, rod) == SINEW_OK);
    CHECK(sinew_world_remove_constraint(simulation, rod) == SINEW_BAD_ID);
    CHECK(sinew_world_remove_particle(simulation, weight) == SINEW_OK);
    CHECK(sinew_world_set_mass(simulation, weight, 2) == SINEW_BAD_ID);
    CHECK(sinew_world_set_mass(simulation, bob, 0) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_set_position(simulation, bob, (sinew_point){NAN, 0, 0}) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_close(simulation) == SINEW_OK);
}

/* Ids of every bit pattern, and handles of every kind: none is followed. */
static void made_up_ids_and_handles_do_nothing(void) {
    const sinew_world simulation = opened();
    const sinew_world closed = opened();
    CHECK(sinew_world_close(closed) == SINEW_OK);
    uint64_t random = 1, before, after;
    sinew_particle pivot, bob;
    sinew_constraint rod;
    CHECK(sinew_world_find_particle(simulation, "pendulum/pivot", &pivot) == SINEW_OK);
    CHECK(sinew_world_find_particle(simulation, "pendulum/bob", &bob) == SINEW_OK);
    CHECK(sinew_world_find_constraint(simulation, "pendulum/rod", &rod) == SINEW_OK);
    CHECK(sinew_world_state_hash(simulation, &before) == SINEW_OK);
    for (int i = 0; i < 2000; ++i) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        const uint64_t id = i < 64 ? (uint64_t)1 << i : random;
        if (id == pivot || id == bob || id == rod) continue; /* no made-up one */
        sinew_particle_state particle = {.struct_size = sizeof particle};
        sinew_constraint_state constraint = {.struct_size = sizeof constraint};
        const char* name;
        CHECK(sinew_world_get_particle(simulation, id, &particle) == SINEW_BAD_ID);
        CHECK(sinew_world_particle_name(simulation, id, &name) == SINEW_BAD_ID);
        CHECK(sinew_world_get_constraint(simulation, id, &constraint) == SINEW_BAD_ID);
        CHECK(sinew_world_remove_particle(simulation, id) == SINEW_BAD_ID);
        CHECK(sinew_world_remove_constraint(simulation, id) == SINEW_BAD_ID);
        CHECK(sinew_world_unpin(simulation, id) == SINEW_BAD_ID);
        CHECK(sinew_world_apply_impulse(simulation, id, (sinew_point){1, 1, 1}) == SINEW_BAD_ID);
        const sinew_world made_up = {(uint32_t)(random >> 32)};
        if (made_up.id != simulation.id) CHECK(sinew_world_step(made_up, 1) == SINEW_BAD_HANDLE);
        CHECK(sinew_player_advance((sinew_player){(uint32_t)random}, 1) == SINEW_BAD_HANDLE);
    }
    CHECK(sinew_world_step(closed, 1) == SINEW_BAD_HANDLE && sinew_world_close(closed) == SINEW_BAD_HANDLE);
    CHECK(sinew_world_state_hash(simulation, &after) == SINEW_OK && before == after);
    CHECK(sinew_world_close(simulation) == SINEW_OK);
}

static void null_pointers_are_refused(void) {
    const sinew_world simulation = opened();
    sinew_world out;
    const sinew_open_options holes = {.struct_size = sizeof holes, .override_count = 1};
    CHECK(sinew_world_open(NULL, NULL, &out) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_open(pendulum, NULL, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_open(pendulum, &holes, &out) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_get_info(simulation, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_draw(simulation, 100, 100, 0, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_find_particle(simulation, NULL, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_set(simulation, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_close(simulation) == SINEW_OK);
}

static void a_picture_is_a_list_of_items(void) {
    const sinew_world simulation = opened();
    sinew_picture picture = {.struct_size = sizeof picture};
    CHECK(sinew_world_draw(simulation, 400, 400, 0, &picture) == SINEW_OK);
    CHECK(picture.item_count > 0 && picture.width == 400);
    int rods = 0;
    for (uint32_t i = 0; i < picture.item_count; ++i) {
        const sinew_item item = picture.items[i];
        CHECK(item.shape <= SINEW_PANE && item.first + item.count <= picture.point_count);
        const float* const points = picture.points + 2 * item.first;
        rods += item.shape == SINEW_POLYLINE && item.count == 2 && fabsf(points[0] - 200) < 0.01f &&
                fabsf(points[2] - 300) < 0.01f;
    }
    CHECK(rods > 0);
    CHECK(sinew_world_draw(simulation, 0, 400, 0, &picture) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_close(simulation) == SINEW_OK);
}

static void a_player_owns_its_simulation(void) {
    sinew_player player;
    sinew_world simulation;
    sinew_player_state state = {.struct_size = sizeof state};
    const char* event;
    CHECK(sinew_player_create(pendulum, NULL, &player) == SINEW_OK);
    CHECK(sinew_player_resize(player, 400, 400, 1) == SINEW_OK);
    CHECK(sinew_player_world(player, 0, &simulation) == SINEW_OK);
    CHECK(sinew_player_world(player, 1, &simulation) == SINEW_NOT_FOUND);
    CHECK(sinew_player_prefab(player, "ragdol", NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_player_prefab(player, "ragdoll", NULL) == SINEW_OK);
    CHECK(sinew_world_step(simulation, 1) == SINEW_READ_ONLY && sinew_world_close(simulation) == SINEW_READ_ONLY);
    CHECK(sinew_player_pointer(player, 300, 200) == SINEW_OK);
    CHECK(sinew_player_press(player, SINEW_LEFT) == SINEW_OK);
    CHECK(sinew_player_advance(player, 0.05) == SINEW_OK);
    CHECK(sinew_player_get_state(player, &state) == SINEW_OK);
    CHECK(state.is_holding && state.step > 0 && strcmp(state.hovered, "pendulum/bob") == 0);
    CHECK(sinew_player_next_event(player, &event) == SINEW_OK && strstr(event, "grab") != NULL);
    CHECK(sinew_player_do(player, "back") == SINEW_OK && sinew_player_do(player, "save") == SINEW_BAD_ARGUMENT);
    CHECK(sinew_player_close(player) == SINEW_OK);
    sinew_info info = {.struct_size = sizeof info};
    CHECK(sinew_world_get_info(simulation, &info) == SINEW_BAD_HANDLE &&
          sinew_player_close(player) == SINEW_BAD_HANDLE);
}

/* A ball of 1 kg falls on a floor 0.4 m below its surface, rebounds never, and sleeps. */
static const char* const ball =
    "{\"sinew\": 1, \"world\": {\"gravity\": [0, -10]}, \"solver\": {\"sleep\": {\"speed\": 0.05}},"
    " \"colliders\": [{\"name\": \"floor\", \"shape\": \"half_space\"}],"
    " \"figures\": [{\"name\": \"ball\", \"particles\": {\"p\": {\"at\": [0, 0.5], \"radius\": 0.1}}}],"
    " \"events\": [{\"on\": {\"contact\": \"hit\", \"of\": \"ball\", \"with\": \"floor\", \"above\": 2}, \"note\": "
    "\"thud\"}]}";

static void contacts_begin_persist_and_end(void) {
    sinew_world simulation;
    sinew_contact contact = {.struct_size = sizeof contact};
    sinew_event event = {.struct_size = sizeof event};
    sinew_particle particle;
    uint32_t count = 9;
    CHECK(sinew_world_open(ball, NULL, &simulation) == SINEW_OK);
    CHECK(sinew_world_find_particle(simulation, "ball/p", &particle) == SINEW_OK);
    CHECK(sinew_world_contact_count(simulation, &count) == SINEW_OK && count == 0);
    CHECK(sinew_world_contact_at(simulation, 0, &contact) == SINEW_NOT_FOUND);
    for (int i = 0; i < 60 && count == 0; ++i)
        CHECK(sinew_world_step(simulation, 1) == SINEW_OK && sinew_world_contact_count(simulation, &count) == SINEW_OK);
    CHECK(count == 1 && sinew_world_contact_at(simulation, 0, &contact) == SINEW_OK);
    CHECK(contact.phase == SINEW_BEGIN && contact.particle == particle && contact.other == SINEW_NO_ID);
    CHECK(strcmp(contact.collider_name, "floor") == 0 && contact.figure == 0 && contact.other_figure == UINT32_MAX);
    CHECK(contact.blow == contact.impulse && contact.blow > 0 && contact.blow_before == 0);
    CHECK(sinew_world_step(simulation, 1) == SINEW_OK && sinew_world_contact_count(simulation, &count) == SINEW_OK &&
          count == 1);
    CHECK(sinew_world_contact_at(simulation, 0, &contact) == SINEW_OK && contact.phase == SINEW_PERSIST);
    CHECK(fabs(contact.blow - sqrt(2 * 10 * 0.4)) < 0.3); /* m v, and the weight for a step */
    CHECK(sinew_world_event_count(simulation, &count) == SINEW_OK && count == 2);
    CHECK(sinew_world_event_at(simulation, 0, &event) == SINEW_OK && strcmp(event.what, "hit") == 0);
    CHECK(strcmp(event.with, "floor") == 0 && fabs(event.impulse - sqrt(2 * 10 * 0.4)) < 0.3);
    CHECK(sinew_world_event_at(simulation, 1, &event) == SINEW_OK && strcmp(event.where, "thud") == 0);

    CHECK(sinew_world_step(simulation, 10) == SINEW_OK && sinew_world_contact_count(simulation, &count) == SINEW_OK &&
          count == 1);
    CHECK(sinew_world_contact_at(simulation, 0, &contact) == SINEW_OK && contact.phase == SINEW_PERSIST);
    CHECK(sinew_world_apply_impulse(simulation, particle, (sinew_point){0, 3, 0}) == SINEW_OK);
    CHECK(sinew_world_step(simulation, 1) == SINEW_OK && sinew_world_contact_count(simulation, &count) == SINEW_OK &&
          count == 1);
    CHECK(sinew_world_contact_at(simulation, 0, &contact) == SINEW_OK && contact.phase == SINEW_END &&
          contact.impulse == 0);
    CHECK(sinew_world_close(simulation) == SINEW_OK);
}

static void what_rests_falls_asleep(void) {
    sinew_world simulation;
    sinew_particle particle;
    sinew_particle_state state = {.struct_size = sizeof state};
    sinew_info info = {.struct_size = sizeof info};
    sinew_view view = {.struct_size = sizeof view};
    CHECK(sinew_world_open(ball, NULL, &simulation) == SINEW_OK);
    CHECK(sinew_world_find_particle(simulation, "ball/p", &particle) == SINEW_OK);
    CHECK(sinew_world_get_info(simulation, &info) == SINEW_OK && info.asleep == 0);
    CHECK(sinew_world_run_until(simulation, 3) == SINEW_OK);
    CHECK(sinew_world_get_info(simulation, &info) == SINEW_OK && info.asleep == 1);
    CHECK(sinew_world_get_particle(simulation, particle, &state) == SINEW_OK && state.is_asleep);
    CHECK(sinew_world_get_column(simulation, SINEW_ASLEEP, &view) == SINEW_OK && view.rows == 1 && view.is_integer);
    CHECK(((const uint32_t*)view.data)[0] == 1);
    CHECK(sinew_world_apply_impulse(simulation, particle, (sinew_point){0, 3, 0}) == SINEW_OK);
    CHECK(sinew_world_step(simulation, 1) == SINEW_OK);
    CHECK(sinew_world_get_particle(simulation, particle, &state) == SINEW_OK && !state.is_asleep);
    CHECK(sinew_world_close(simulation) == SINEW_OK);
}

static void queries_find_the_nearest_and_the_first(void) {
    const sinew_world simulation = opened(); /* pivot at (0, 0), bob at (1, 0), a rod between */
    sinew_particle bob, particle, found[2];
    sinew_constraint rod, link, links[1];
    double distance, t;
    size_t count;
    CHECK(sinew_world_find_particle(simulation, "pendulum/bob", &bob) == SINEW_OK);
    CHECK(sinew_world_find_constraint(simulation, "pendulum/rod", &rod) == SINEW_OK);
    CHECK(sinew_world_nearest_particle(simulation, (sinew_point){1.3, 0.4, 0}, 1, &particle, &distance) == SINEW_OK);
    CHECK(particle == bob && fabs(distance - 0.5) < 1e-12);
    CHECK(sinew_world_nearest_particle(simulation, (sinew_point){1.3, 0.4, 0}, 0.4, &particle, NULL) ==
          SINEW_NOT_FOUND);
    CHECK(sinew_world_nearest_link(simulation, (sinew_point){0.25, 0.1, 0}, 1, &link, &t, &distance) == SINEW_OK);
    CHECK(link == rod && fabs(t - 0.25) < 1e-12 && fabs(distance - 0.1) < 1e-12);
    CHECK(sinew_world_nearest_link(simulation, (sinew_point){NAN, 0, 0}, 1, &link, NULL, NULL) == SINEW_BAD_ARGUMENT);

    sinew_region region = {.struct_size = sizeof region, .center = {1, 0, 0}, .radius = 0.1};
    CHECK(sinew_world_overlapping_particles(simulation, &region, found, 2, &count) == SINEW_OK);
    CHECK(count == 1 && found[0] == bob);
    CHECK(sinew_world_overlapping_links(simulation, &region, links, 1, &count) == SINEW_OK && count == 1 &&
          links[0] == rod);
    region =
        (sinew_region){.struct_size = sizeof region, .center = {0.5, 0, 0}, .half = {0.8, 0.1, 0}, .turn = 1.5707963};
    CHECK(sinew_world_overlapping_particles(simulation, &region, found, 2, &count) == SINEW_OK && count == 0);
    region.turn = 0;
    CHECK(sinew_world_overlapping_particles(simulation, &region, NULL, 0, &count) == SINEW_OK && count == 2);
    CHECK(sinew_world_overlapping_particles(simulation, &region, NULL, 1, &count) == SINEW_BAD_ARGUMENT);
    region.radius = -1;
    CHECK(sinew_world_overlapping_links(simulation, &region, links, 1, &count) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_close(simulation) == SINEW_OK);
}

static void rays_meet_balls_and_floors(void) {
    sinew_world simulation;
    sinew_ray_hit hit = {.struct_size = sizeof hit};
    sinew_particle particle;
    sinew_collider wall;
    CHECK(sinew_world_open(ball, NULL, &simulation) == SINEW_OK);
    CHECK(sinew_world_find_particle(simulation, "ball/p", &particle) == SINEW_OK);
    CHECK(sinew_world_find_collider(simulation, "floor", &wall) == SINEW_OK);
    CHECK(sinew_world_find_collider(simulation, "ceiling", &wall) == SINEW_NOT_FOUND);
    CHECK(sinew_world_cast_ray(simulation, (sinew_point){0, 2, 0}, (sinew_point){0, 0, 0}, 0, UINT32_MAX, &hit) ==
          SINEW_OK);
    CHECK(hit.particle == particle && hit.collider == SINEW_NO_ID && fabs(hit.share - 0.7) < 1e-6);
    CHECK(fabs(hit.point.y - 0.6) < 1e-6 && hit.normal.y > 0.999);
    CHECK(sinew_world_cast_ray(simulation, (sinew_point){1, 1, 0}, (sinew_point){1, -1, 0}, 0.2, UINT32_MAX, &hit) ==
          SINEW_OK);
    CHECK(hit.collider == wall && hit.particle == SINEW_NO_ID && fabs(hit.share - 0.4) < 1e-6);
    CHECK(sinew_world_cast_ray(simulation, (sinew_point){1, 1, 0}, (sinew_point){1, 2, 0}, 0, UINT32_MAX, &hit) ==
          SINEW_NOT_FOUND);
    CHECK(sinew_world_cast_ray(simulation, (sinew_point){1, 1, 0}, (sinew_point){1, -1, 0}, 0, 0, &hit) ==
          SINEW_NOT_FOUND);
    CHECK(sinew_world_close(simulation) == SINEW_OK);
}

/* A floor that code raises by 1 m/s carries the ball along. */
static void a_moved_collider_carries(void) {
    sinew_world simulation;
    sinew_collider wall;
    sinew_particle particle;
    sinew_particle_state state = {.struct_size = sizeof state};
    CHECK(sinew_world_open(ball, NULL, &simulation) == SINEW_OK);
    CHECK(sinew_world_find_collider(simulation, "floor", &wall) == SINEW_OK);
    CHECK(sinew_world_find_particle(simulation, "ball/p", &particle) == SINEW_OK);
    CHECK(sinew_world_run_until(simulation, 1) == SINEW_OK);
    for (int i = 1; i <= 60; ++i) {
        CHECK(sinew_world_move_collider(simulation, wall, (sinew_point){0, i / 60.0, 0}, 0, NULL) == SINEW_OK);
        CHECK(sinew_world_step(simulation, 1) == SINEW_OK);
    }
    CHECK(sinew_world_get_particle(simulation, particle, &state) == SINEW_OK);
    CHECK(fabs(state.position[1] - 1.1) < 1e-3 && fabs(state.velocity[1] - 1) < 1e-2);
    CHECK(sinew_world_move_collider(simulation, wall + 1, (sinew_point){0, 0, 0}, 0, NULL) == SINEW_BAD_ID);
    CHECK(sinew_world_move_collider(simulation, wall, (sinew_point){INFINITY, 0, 0}, 0, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_close(simulation) == SINEW_OK);
}

static void too_many_are_refused(void) {
    static sinew_world all[5000];
    size_t count = 0;
    while (count < 5000 && sinew_world_open(pendulum, NULL, &all[count]) == SINEW_OK) ++count;
    CHECK(count == 4096);
    for (size_t i = 0; i < count; ++i) CHECK(sinew_world_close(all[i]) == SINEW_OK);
}

int main(void) {
    if (sinew_abi() != SINEW_ABI) return 2;
    a_pendulum_keeps_its_energy();
    columns_are_the_state();
    a_copy_goes_on_to_the_same_bits();
    a_saved_simulation_goes_on();
    errors_have_their_places();
    edits_are_undone_by_their_ids();
    made_up_ids_and_handles_do_nothing();
    null_pointers_are_refused();
    a_picture_is_a_list_of_items();
    a_player_owns_its_simulation();
    contacts_begin_persist_and_end();
    what_rests_falls_asleep();
    queries_find_the_nearest_and_the_first();
    rays_meet_balls_and_floors();
    a_moved_collider_carries();
    too_many_are_refused();
    return failures == 0 ? 0 : 1;
}
