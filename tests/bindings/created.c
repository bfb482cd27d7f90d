/* Worlds built by calls alone: picture, text, refusals. */
#include "tests/bindings/worlds.h"

#include <math.h>
#include <string.h>

static sinew_world with_rope(void) {
    const sinew_world_spec spec = {.struct_size = sizeof spec, .gravity = {0, -10, 0}};
    const sinew_figure_spec rope = {.struct_size = sizeof rope, .prefab = "rope", .name = "r", .position = {0, 4, 0}};
    sinew_world world = {0};
    CHECK(sinew_world_create(&spec, &world) == SINEW_OK);
    CHECK(sinew_world_add_figure(world, &rope, NULL) == SINEW_OK);
    return world;
}

/* A metre of the world in pixels of its picture, 800 wide and 600 high; the rope's first end is in the picture. */
static double pixels_of_a_metre(sinew_world world) {
    double x = NAN, y = NAN, above = NAN;
    CHECK(sinew_world_project(world, 800, 600, (sinew_point){0, 4, 0}, &x, &y) == SINEW_OK);
    CHECK(sinew_world_project(world, 800, 600, (sinew_point){0, 5, 0}, &x, &above) == SINEW_OK);
    CHECK(x > 0 && x < 800 && y > 0 && y < 600);
    return y - above;
}

/* The picture fits what is there at the first step; it stays, whatever comes to be later. */
static void the_picture_fits_the_figures(void) {
    const sinew_world world = with_rope();
    const double scale = pixels_of_a_metre(world);
    const sinew_particle_spec far = {.struct_size = sizeof far, .position = {900, 0, 0}, .mass = 1};
    sinew_particle stone;
    CHECK(scale > 50 && scale < 600);
    CHECK(sinew_world_step(world, 1) == SINEW_OK && pixels_of_a_metre(world) == scale);
    CHECK(sinew_world_add_particle(world, &far, &stone) == SINEW_OK && sinew_world_step(world, 1) == SINEW_OK);
    CHECK(pixels_of_a_metre(world) == scale);
    CHECK(sinew_world_restart(world) == SINEW_OK);
    CHECK(sinew_world_add_particle(world, &far, &stone) == SINEW_OK);
    const sinew_figure_spec rope = {.struct_size = sizeof rope, .prefab = "rope", .position = {0, 4, 0}};
    CHECK(sinew_world_add_figure(world, &rope, NULL) == SINEW_OK && pixels_of_a_metre(world) < scale / 50);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* What calls have cut of what calls have added is in no text. */
static void the_text_of_a_cut_world_is_a_scene(void) {
    const sinew_world world = with_rope();
    const char* text = NULL;
    uint32_t cut = 0;
    CHECK(sinew_world_cut(world, (sinew_point){-1, 3.4, 0}, (sinew_point){1, 3.4, 0}, &cut) == SINEW_OK && cut > 0);
    CHECK(sinew_world_scene_text(world, &text) == SINEW_OK && strstr(text, "remove") == NULL);
    CHECK(sinew_check(text, NULL) == SINEW_OK);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* An added figure may have the name of one of the scene that is gone. */
static void the_text_knows_namesakes(void) {
    const sinew_world world =
        opened("{\"sinew\": 1, \"figures\": [{\"prefab\": \"rope\", \"name\": \"r\", \"at\": [0, 4]}]}");
    const sinew_figure_spec rope = {.struct_size = sizeof rope, .prefab = "rope", .name = "r", .position = {0, 4, 0}};
    const sinew_point left = {-1, 3.4, 0}, right = {1, 3.4, 0};
    const char* text = NULL;
    uint32_t cut = 0, figure = 0;
    CHECK(sinew_world_cut(world, left, right, &cut) == SINEW_OK && cut > 0);
    CHECK(sinew_world_scene_text(world, &text) == SINEW_OK && strstr(text, "remove") != NULL);
    CHECK(sinew_world_find_figure(world, "r", &figure) == SINEW_OK);
    CHECK(sinew_world_remove_figure(world, figure) == SINEW_OK);
    CHECK(sinew_world_add_figure(world, &rope, NULL) == SINEW_OK);
    CHECK(sinew_world_cut(world, left, right, &cut) == SINEW_OK && cut > 0);
    CHECK(sinew_world_scene_text(world, &text) == SINEW_OK && strstr(text, "remove") == NULL);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

/* Of lengths in the plane no angle in space is told. */
static void limits_are_refused_with_their_reason(void) {
    const sinew_world world = with_rope();
    sinew_constraint link = 0;
    CHECK(sinew_world_constraint_at(world, 0, 0, &link) == SINEW_OK);
    CHECK(sinew_world_set_limits(world, link, -1, -1) == SINEW_BAD_ARGUMENT);
    CHECK(strstr(sinew_message(), "never negative") != NULL && strstr(sinew_message(), "angle") == NULL);
    CHECK(sinew_world_list_contacts(world, 7) == SINEW_BAD_ARGUMENT);
    CHECK(sinew_world_list_contacts(world, 1) == SINEW_OK && sinew_world_list_contacts(world, 0) == SINEW_OK);
    CHECK(sinew_world_close(world) == SINEW_OK);
}

int main(void) {
    the_picture_fits_the_figures();
    the_text_of_a_cut_world_is_a_scene();
    the_text_knows_namesakes();
    limits_are_refused_with_their_reason();
    return failures == 0 ? 0 : 1;
}
