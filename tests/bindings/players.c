/* The player and the reading of worlds from C: functions that pages use by way of WebAssembly, called as a program
 * does. */
#include "tests/bindings/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char scene[] = "{\"sinew\": 1, \"world\": {\"gravity\": [0, -10]},"
                            " \"view\": {\"center\": [0, 0], \"height\": 4, \"size\": [400, 400]},"
                            " \"figures\": [{\"prefab\": \"rope\", \"name\": \"rope\", \"at\": [0, 1]}]}";

static sinew_player played(void) {
    sinew_player player = {0};
    CHECK(sinew_player_create(scene, NULL, &player) == SINEW_OK);
    return player;
}

static sinew_player_state state_of(sinew_player player) {
    sinew_player_state state = {.struct_size = sizeof state};
    CHECK(sinew_player_get_state(player, &state) == SINEW_OK);
    return state;
}

static void play(sinew_player player, int frames) {
    for (int i = 0; i < frames; ++i) CHECK(sinew_player_advance(player, 1 / 60.0) == SINEW_OK);
}

static void the_clock_stops_slows_and_goes_back(void) {
    const sinew_player player = played();
    CHECK(sinew_player_pause(player, 1) == SINEW_OK);
    play(player, 30);
    CHECK(state_of(player).is_paused == 1 && state_of(player).step == 0);
    CHECK(sinew_player_pause(player, 0) == SINEW_OK);
    CHECK(sinew_player_time_scale(player, 0.5) == SINEW_OK);
    play(player, 60);
    CHECK(fabs(state_of(player).step - 30) <= 1); /* rounding of sixtieths */
    CHECK(sinew_player_go_to(player, 10) == SINEW_OK);
    CHECK(state_of(player).step == 10 && state_of(player).is_paused == 1 && state_of(player).end_step >= 29);
    CHECK(sinew_player_time_scale(player, 100) == SINEW_OK && state_of(player).time_scale == 8);
    CHECK(sinew_player_close(player) == SINEW_OK);
}

static void edits_are_undone_and_scenes_replaced(void) {
    const sinew_player player = played();
    CHECK(sinew_player_set(player, "world.gravity.1", "-5", 0) == SINEW_OK);
    CHECK(state_of(player).is_edited == 1 && strcmp(state_of(player).undo, "world.gravity.1") == 0);
    CHECK(sinew_player_set(player, "world.nope", "-5", 0) == SINEW_BAD_SCENE);
    CHECK(strstr(sinew_message(), "unknown property \"nope\"") != NULL);
    CHECK(sinew_player_do(player, "undo") == SINEW_OK && state_of(player).is_edited == 0);
    CHECK(sinew_player_become(player, "{", NULL) == SINEW_BAD_SCENE &&
          sinew_player_open(player, "{", NULL) == SINEW_BAD_SCENE);

    play(player, 20);
    CHECK(sinew_player_become(player, "{\"sinew\": 1}", NULL) == SINEW_OK); /* an edit: it can be undone */
    CHECK(*state_of(player).undo != '\0' && state_of(player).is_edited == 1);
    CHECK(sinew_player_open(player, scene, NULL) == SINEW_OK); /* another document */
    CHECK(*state_of(player).undo == '\0' && state_of(player).is_edited == 0 && state_of(player).step == 0);
    CHECK(sinew_player_close(player) == SINEW_OK);
}

/* The end of the rope hangs a metre below the middle of a picture of four metres. */
static void the_mouse_takes_what_it_is_over(void) {
    const sinew_player player = played();
    sinew_world world;
    sinew_particle end;
    sinew_particle_state particle = {.struct_size = sizeof particle};
    double x = 0, y = 0;
    CHECK(sinew_player_tool(player, "grab") == SINEW_OK);
    CHECK(sinew_player_world(player, 0, &world) == SINEW_OK);
    CHECK(sinew_world_find_particle(world, "rope/end", &end) == SINEW_OK);
    CHECK(sinew_world_get_particle(world, end, &particle) == SINEW_OK);
    CHECK(sinew_world_project(world, 400, 400, (sinew_point){particle.position[0], particle.position[1], 0}, &x, &y) ==
          SINEW_OK);
    CHECK(sinew_world_step(world, 1) == SINEW_READ_ONLY);

    CHECK(sinew_player_pointer(player, x, y) == SINEW_OK && sinew_player_press(player, SINEW_LEFT) == SINEW_OK);
    play(player, 2);
    CHECK(state_of(player).is_holding == 1);
    CHECK(sinew_player_pointer(player, x + 50, y) == SINEW_OK);
    play(player, 60);
    CHECK(sinew_player_world(player, 0, &world) == SINEW_OK);
    CHECK(sinew_world_get_particle(world, end, &particle) == SINEW_OK &&
          particle.position[0] > 0.3); /* 50 pixels: 0.5 m */
    CHECK(sinew_player_release(player, SINEW_LEFT) == SINEW_OK && sinew_player_leave(player) == SINEW_OK);
    play(player, 2);
    CHECK(state_of(player).is_holding == 0 && *state_of(player).hovered == '\0');
    CHECK(sinew_player_close(player) == SINEW_OK);
}

static void gestures_and_words_that_are_none_change_nothing(void) {
    const sinew_player player = played();
    CHECK(sinew_player_tool(player, "cut") == SINEW_OK && sinew_player_tool(player, "nonsense") == SINEW_BAD_ARGUMENT);
    CHECK(strcmp(state_of(player).tool, "cut") == 0);
    CHECK(sinew_player_theme(player, "dark") == SINEW_OK && sinew_player_theme(player, "pink") == SINEW_BAD_ARGUMENT);
    CHECK(strcmp(state_of(player).theme, "dark") == 0);
    CHECK(sinew_player_joint(player, "hinge") == SINEW_OK &&
          sinew_player_joint(player, "nonsense") == SINEW_BAD_ARGUMENT);
    CHECK(sinew_player_overlays(player, 5) == SINEW_OK && state_of(player).overlays == 5);
    CHECK(sinew_player_key(player, "p", 1) == SINEW_OK && sinew_player_key(player, "p", 0) == SINEW_OK);
    CHECK(sinew_player_time_scale(player, NAN) == SINEW_BAD_ARGUMENT &&
          sinew_player_go_to(player, NAN) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_player_zoom(player, 0) == SINEW_BAD_ARGUMENT && sinew_player_zoom(player, 2) == SINEW_OK);
    CHECK(sinew_player_pan(player, INFINITY, 0) == SINEW_BAD_ARGUMENT && sinew_player_pan(player, 10, 0) == SINEW_OK);
    CHECK(sinew_player_orbit(player, NAN, 0) == SINEW_BAD_ARGUMENT && sinew_player_orbit(player, 1, 1) == SINEW_OK);
    CHECK(sinew_player_pinch(player, 0, 0, -1) == SINEW_BAD_ARGUMENT &&
          sinew_player_pinch(player, 0, 0, 1.1) == SINEW_OK);
    CHECK(sinew_player_scroll(player, NAN) == SINEW_BAD_ARGUMENT && sinew_player_scroll(player, 1) == SINEW_OK);
    CHECK(sinew_player_touch(player, 1, 3, 0, 0) == SINEW_BAD_ARGUMENT);
    for (uint32_t phase = 0; phase < 3; ++phase) CHECK(sinew_player_touch(player, 1, phase, 200, 200) == SINEW_OK);
    CHECK(sinew_player_press(player, (sinew_button)9) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_player_close(player) == SINEW_OK && sinew_player_leave(player) == SINEW_BAD_HANDLE);
}

static void pictures_have_their_texts(void) {
    const sinew_player player = played();
    sinew_picture picture = {.struct_size = sizeof picture};
    const char* text = NULL;
    CHECK(sinew_player_overlays(player, ~0u) == SINEW_OK && sinew_player_draw(player, &picture) == SINEW_OK);
    CHECK(picture.width == 400 && picture.height == 400 && picture.item_count > 20 && picture.text_count > 0);
    CHECK(sinew_player_picture_text(player, 0, &text) == SINEW_OK && text && *text);
    CHECK(sinew_player_picture_text(player, picture.text_count, &text) == SINEW_NOT_FOUND);
    CHECK(sinew_player_picture_image(player, picture.image_count, &text) == SINEW_NOT_FOUND);
    CHECK(sinew_player_close(player) == SINEW_OK);
}

static void worlds_are_read(void) {
    sinew_world world;
    sinew_particle end, back;
    sinew_point at;
    sinew_picture picture = {.struct_size = sizeof picture};
    uint32_t row = 0, count = 0;
    double x = 0, y = 0;
    const char* text = NULL;
    CHECK(sinew_world_open(scene, NULL, &world) == SINEW_OK);
    CHECK(sinew_world_find_particle(world, "rope/end", &end) == SINEW_OK);
    CHECK(sinew_world_row_of(world, end, &row) == SINEW_OK && sinew_world_particle_at(world, row, &back) == SINEW_OK);
    CHECK(memcmp(&end, &back, sizeof end) == 0);
    CHECK(sinew_world_constraint_count(world, SINEW_DISTANCE, &count) == SINEW_OK && count == row); /* a link less */
    CHECK(sinew_world_constraint_count(world, 99, &count) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_unproject(world, 400, 400, 100, 300, &at) == SINEW_OK && at.x == -1 && at.y == -1);
    CHECK(sinew_world_project(world, 400, 400, at, &x, &y) == SINEW_OK && x == 100 && y == 300);
    CHECK(sinew_world_unproject(world, 0, 400, 100, 300, &at) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_parameters(world, &text) == SINEW_OK && strstr(text, "\"world.gravity\"") != NULL);
    CHECK(sinew_world_scene_text(world, &text) == SINEW_OK && sinew_check(text, NULL) == SINEW_OK);
    CHECK(sinew_world_draw(world, 400, 400, 0, &picture) == SINEW_OK);
    CHECK(sinew_world_picture_text(world, picture.text_count, &text) == SINEW_NOT_FOUND);
    CHECK(sinew_world_picture_image(world, picture.image_count, &text) == SINEW_NOT_FOUND);
    CHECK(sinew_world_close(world) == SINEW_OK && sinew_world_row_of(world, end, &row) == SINEW_BAD_HANDLE);
}

static void topics_are_described(void) {
    static const char* const topics[] = {"overlays", "actions", "joints", "tools", "prefabs"};
    const char* json = NULL;
    for (size_t i = 0; i < sizeof topics / sizeof *topics; ++i)
        CHECK(sinew_describe(topics[i], &json) == SINEW_OK && json[0] == '[');
    CHECK(sinew_describe("nonsense", &json) == SINEW_BAD_ARGUMENT && sinew_describe(NULL, &json) == SINEW_BAD_ARGUMENT);
    CHECK(strchr(sinew_version(), '.') != NULL);
    void* const memory = sinew_allocate(100);
    CHECK(memory && (uintptr_t)memory % 8 == 0 && sinew_allocate(SIZE_MAX) == NULL);
    sinew_free(memory);
    sinew_free(NULL);
}

int main(void) {
    the_clock_stops_slows_and_goes_back();
    edits_are_undone_and_scenes_replaced();
    the_mouse_takes_what_it_is_over();
    gestures_and_words_that_are_none_change_nothing();
    pictures_have_their_texts();
    worlds_are_read();
    topics_are_described();
    return failures;
}
