/* A level for `sinew play my_level.so`: C or C++ that builds a world and acts in it, shown in the window of Sinew with
 * its tools, its panel and its time line. Compiled again, it is loaded again, and the world goes on: what is built as
 * before stays where it is.
 *
 *     #include <sinew_level.h>
 *
 *     static sinew_status build(sinew_world world) {
 *         return sinew_world_add_figure(world, &rope, NULL);
 *     }
 *     SINEW_LEVEL(.build = build)
 *
 *     cc -shared -fPIC my_level.c -o my_level.so $(pkg-config --cflags sinew-c) && sinew play ./my_level.so
 *
 * The functions of sinew.h are those of the player: a level links no library. A function that returns anything but
 * SINEW_OK is shown with sinew_message(), one that throws with its exception, and neither is called again until the
 * level is compiled again. A crash ends the player, which names the level. */
#ifndef SINEW_LEVEL_H
#define SINEW_LEVEL_H

#ifndef SINEW_C_H
#include <sinew.h>
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The moment before a step. */
typedef struct sinew_moment {
    uint32_t struct_size;
    uint32_t has_pointer; /* 1: the pointer has been over the picture */
    uint64_t step;        /* steps since the start */
    double seconds;       /* simulated */
    sinew_point pointer;  /* position, in the scene's unit */
    double along, up;     /* arrow keys: -1, 0 or 1 */
    uint32_t jump, hold;  /* 1: space, h is held down */
    void* memory;         /* `memory` bytes that the level has asked for: zero at first, and kept with the world, so
                             that going back in time, and a level that is compiled again, find them as they were */
} sinew_moment;

typedef struct sinew_level {
    uint32_t struct_size;
    uint32_t abi;                             /* SINEW_ABI */
    const char* scene;                        /* a scene file's text; null: an empty world with gravity */
    sinew_status (*build)(sinew_world world); /* adds to the world at its start; may be null */
    sinew_status (*step)(sinew_world world, const sinew_moment* moment); /* before each step; may be null */
    size_t memory;                                                       /* bytes, at most 1 GiB */
} sinew_level;

#ifdef __cplusplus
}
#define SINEW_LEVEL_ENTRY extern "C" SINEW_API
#else
#define SINEW_LEVEL_ENTRY SINEW_API
#endif

/* Defines the level of a shared object: SINEW_LEVEL(.scene = text, .build = build, .step = step). */
#define SINEW_LEVEL(...)                                                                                               \
    SINEW_LEVEL_ENTRY const sinew_level* sinew_level_entry(void);                                                      \
    const sinew_level* sinew_level_entry(void) {                                                                       \
        _Pragma("GCC diagnostic push")                                                                                 \
            _Pragma("GCC diagnostic ignored \"-Wmissing-field-initializers\"") /* members left out are zero */         \
            static const sinew_level level = {.struct_size = sizeof(sinew_level), .abi = SINEW_ABI, __VA_ARGS__};      \
        _Pragma("GCC diagnostic pop") return &level;                                                                   \
    }

#endif
