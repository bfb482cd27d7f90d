/* The C face, from C: a pendulum keeps its laws, and no handle, id or pointer from outside can do harm. */
#include "bindings/c/sinew.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

#define CHECK(condition)                                                                                               \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            printf("%s:%d: %s (%s)\n", __FILE__, __LINE__, #condition, sinew_message());                               \
            ++failures;                                                                                                \
        }                                                                                                              \
    } while (0)

static const char* const pendulum =
    "{\"sinew\": 1, \"view\": {\"center\": [0, 0], \"height\": 4, \"size\": [400, 400]}, \"world\": {\"gravity\": [0, -10]},"
    " \"figures\": [{\"name\": \"pendulum\", \"particles\": {\"pivot\": {\"at\": [0, 0], \"pinned\": true},"
    " \"bob\": {\"at\": [1, 0]}}, \"constraints\": [{\"name\": \"rod\", \"between\": [\"pivot\", \"bob\"]}]}]}";

static sinew_simulation opened(void) {
    const char* const overrides[] = {"precision=double", "solver.substeps=32"};
    const sinew_open_options options = {.overrides = overrides, .override_count = 2};
    sinew_simulation simulation = {0};
    CHECK(sinew_open(pendulum, &options, &simulation) == SINEW_OK);
    return simulation;
}

/* v^2 = 2 g h, on a circle of one metre. */
static void a_pendulum_keeps_its_energy(void) {
    const sinew_simulation simulation = opened();
    sinew_particle bob = SINEW_NO_ID;
    sinew_particle_state state;
    CHECK(sinew_find_particle(simulation, "pendulum/bob", &bob) == SINEW_OK);
    CHECK(sinew_run_until(simulation, 0.3) == SINEW_OK);
    CHECK(sinew_get_particle(simulation, bob, &state) == SINEW_OK);
    const double square = state.velocity[0] * state.velocity[0] + state.velocity[1] * state.velocity[1];
    CHECK(fabs(square + 20 * state.position[1]) < 0.02);
    CHECK(fabs(hypot(state.position[0], state.position[1]) - 1) < 1e-9);
    CHECK(sinew_close(simulation) == SINEW_OK);
}

static void columns_are_the_state(void) {
    const sinew_simulation simulation = opened();
    sinew_view view;
    CHECK(sinew_get_column(simulation, SINEW_POSITION, &view) == SINEW_OK);
    CHECK(view.rows == 2 && view.components == 2 && view.number_bytes == sizeof(double) && !view.is_integer);
    CHECK(((const double*)view.data)[2] == 1);
    CHECK(sinew_get_column(simulation, SINEW_CONSTRAINT_ENDS, &view) == SINEW_OK);
    CHECK(view.rows == 1 && view.is_integer && ((const uint32_t*)view.data)[1] == 1);
    CHECK(sinew_get_column(simulation, (sinew_column)99, &view) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_close(simulation) == SINEW_OK);
}

static void a_copy_goes_on_to_the_same_bits(void) {
    const sinew_simulation first = opened();
    sinew_simulation second;
    uint64_t a = 0, b = 1;
    CHECK(sinew_step(first, 20) == SINEW_OK);
    CHECK(sinew_copy(first, &second) == SINEW_OK);
    CHECK(sinew_step(first, 20) == SINEW_OK && sinew_step(second, 20) == SINEW_OK);
    CHECK(sinew_state_hash(first, &a) == SINEW_OK && sinew_state_hash(second, &b) == SINEW_OK && a == b);
    CHECK(sinew_close(first) == SINEW_OK && sinew_close(second) == SINEW_OK);
}

static void errors_have_their_places(void) {
    sinew_simulation none = {12345};
    sinew_diagnostic error;
    CHECK(sinew_open("{\"sinew\": 1,\n \"figurs\": []}", NULL, &none) == SINEW_BAD_SCENE);
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
    const sinew_simulation simulation = opened();
    sinew_particle bob, weight;
    sinew_constraint rod;
    sinew_pin pin;
    const sinew_particle_spec spec = {.position = {2, 0, 0}, .mass = 3};
    CHECK(sinew_find_particle(simulation, "pendulum/bob", &bob) == SINEW_OK);
    CHECK(sinew_add_particle(simulation, &spec, &weight) == SINEW_OK);
    const sinew_particle ends[] = {bob, weight};
    CHECK(sinew_add_constraint(simulation, 0, ends, 2, NULL, &rod) == SINEW_OK);
    CHECK(sinew_add_constraint(simulation, 0, ends, 1, NULL, &rod) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_add_constraint(simulation, 31, ends, 2, NULL, &rod) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_pin_particle(simulation, weight, &pin) == SINEW_OK);
    CHECK(sinew_unpin(simulation, pin) == SINEW_OK && sinew_unpin(simulation, pin) == SINEW_BAD_ID);
    CHECK(sinew_remove_constraint(simulation, rod) == SINEW_OK);
    CHECK(sinew_remove_constraint(simulation, rod) == SINEW_BAD_ID);
    CHECK(sinew_remove_particle(simulation, weight) == SINEW_OK);
    CHECK(sinew_set_mass(simulation, weight, 2) == SINEW_BAD_ID);
    CHECK(sinew_set_mass(simulation, bob, 0) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_set_position(simulation, bob, (sinew_point){NAN, 0, 0}) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_close(simulation) == SINEW_OK);
}

/* Ids of every bit pattern, and handles of every kind: none is followed. */
static void made_up_ids_and_handles_do_nothing(void) {
    const sinew_simulation simulation = opened();
    const sinew_simulation closed = opened();
    CHECK(sinew_close(closed) == SINEW_OK);
    uint64_t random = 1, before, after;
    CHECK(sinew_state_hash(simulation, &before) == SINEW_OK);
    for (int i = 0; i < 2000; ++i) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        const uint64_t id = i < 64 ? (uint64_t)1 << i : random;
        sinew_particle_state particle;
        sinew_constraint_state constraint;
        const char* name;
        CHECK(sinew_get_particle(simulation, id, &particle) == SINEW_BAD_ID);
        CHECK(sinew_particle_name(simulation, id, &name) == SINEW_BAD_ID);
        CHECK(sinew_get_constraint(simulation, id, &constraint) == SINEW_BAD_ID);
        CHECK(sinew_remove_particle(simulation, id) == SINEW_BAD_ID);
        CHECK(sinew_remove_constraint(simulation, id) == SINEW_BAD_ID);
        CHECK(sinew_unpin(simulation, id) == SINEW_BAD_ID);
        CHECK(sinew_apply_impulse(simulation, id, (sinew_point){1, 1, 1}) == SINEW_BAD_ID);
        const sinew_simulation made_up = {(uint32_t)(random >> 32)};
        if (made_up.id != simulation.id) CHECK(sinew_step(made_up, 1) == SINEW_BAD_HANDLE);
        CHECK(sinew_player_advance((sinew_player){(uint32_t)random}, 1) == SINEW_BAD_HANDLE);
    }
    CHECK(sinew_step(closed, 1) == SINEW_BAD_HANDLE && sinew_close(closed) == SINEW_BAD_HANDLE);
    CHECK(sinew_state_hash(simulation, &after) == SINEW_OK && before == after);
    CHECK(sinew_close(simulation) == SINEW_OK);
}

static void null_pointers_are_refused(void) {
    const sinew_simulation simulation = opened();
    sinew_simulation out;
    const sinew_open_options holes = {.override_count = 1};
    CHECK(sinew_open(NULL, NULL, &out) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_open(pendulum, NULL, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_open(pendulum, &holes, &out) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_get_info(simulation, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_draw(simulation, 100, 100, 0, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_find_particle(simulation, NULL, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_set(simulation, NULL) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_close(simulation) == SINEW_OK);
}

static void a_picture_is_a_list_of_items(void) {
    const sinew_simulation simulation = opened();
    sinew_picture picture;
    CHECK(sinew_draw(simulation, 400, 400, 0, &picture) == SINEW_OK);
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
    CHECK(sinew_draw(simulation, 0, 400, 0, &picture) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_close(simulation) == SINEW_OK);
}

static void a_player_owns_its_simulation(void) {
    sinew_player player;
    sinew_simulation simulation;
    sinew_player_state state;
    const char* event;
    CHECK(sinew_play(pendulum, NULL, &player) == SINEW_OK);
    CHECK(sinew_player_resize(player, 400, 400, 1) == SINEW_OK);
    CHECK(sinew_player_simulation(player, 0, &simulation) == SINEW_OK);
    CHECK(sinew_player_simulation(player, 1, &simulation) == SINEW_NOT_FOUND);
    CHECK(sinew_step(simulation, 1) == SINEW_READ_ONLY && sinew_close(simulation) == SINEW_READ_ONLY);
    CHECK(sinew_player_pointer(player, 300, 200) == SINEW_OK);
    CHECK(sinew_player_press(player, SINEW_LEFT) == SINEW_OK);
    CHECK(sinew_player_advance(player, 0.05) == SINEW_OK);
    CHECK(sinew_player_get_state(player, &state) == SINEW_OK);
    CHECK(state.is_holding && state.step > 0 && strcmp(state.hovered, "pendulum/bob") == 0);
    CHECK(sinew_player_next_event(player, &event) == SINEW_OK && strstr(event, "grab") != NULL);
    CHECK(sinew_player_do(player, "back") == SINEW_OK && sinew_player_do(player, "save") == SINEW_BAD_ARGUMENT);
    CHECK(sinew_player_close(player) == SINEW_OK);
    sinew_info info;
    CHECK(sinew_get_info(simulation, &info) == SINEW_BAD_HANDLE && sinew_player_close(player) == SINEW_BAD_HANDLE);
}

static void too_many_are_refused(void) {
    static sinew_simulation all[5000];
    size_t count = 0;
    while (count < 5000 && sinew_open(pendulum, NULL, &all[count]) == SINEW_OK) ++count;
    CHECK(count == 4096);
    for (size_t i = 0; i < count; ++i) CHECK(sinew_close(all[i]) == SINEW_OK);
}

int main(void) {
    if (sinew_abi() != SINEW_ABI) return 2;
    a_pendulum_keeps_its_energy();
    columns_are_the_state();
    a_copy_goes_on_to_the_same_bits();
    errors_have_their_places();
    edits_are_undone_by_their_ids();
    made_up_ids_and_handles_do_nothing();
    null_pointers_are_refused();
    a_picture_is_a_list_of_items();
    a_player_owns_its_simulation();
    too_many_are_refused();
    return failures == 0 ? 0 : 1;
}
