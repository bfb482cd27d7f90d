/* The C face of Sinew, in C11: everything that a scene file can say, edits, grabs, cuts, events, queries, the state
 * hash and the picture as a display list. The WebAssembly module of web/sinew exports every function but those marked
 * SINEW_PROGRAM_API, which are for programs: empty worlds, user data, debug drawing, export, import, hooks.
 *
 * Two objects, named by handles:
 *   sinew_world   a running scene without a pointer: open, step, read columns, edit, draw.
 *   sinew_player  the interactive player of the window: a world with a clock, tools (grab, cut, pin, rope, polygon,
 *                 cloth, spawn, remove, measure), a camera, undo and a timeline of the last minute.
 * Functions of an object begin with its name, those of the library with sinew_.
 *
 * Handles and ids are values. A made-up handle, one of a closed object, or an id of a removed row is never
 * dereferenced: the function returns SINEW_BAD_HANDLE or SINEW_BAD_ID and changes nothing.
 *
 * Functions return a sinew_status; results come through pointers, which may not be null unless the comment says so, and
 * are written only on SINEW_OK. sinew_message() has the reason of the thread's last failure.
 *
 * Text is UTF-8 and ends with a zero byte. A `const char*` or a view handed out stays valid until the next call with
 * the same object (text without an object: until the next call of the same function in the same thread).
 *
 * An object may be used by one thread at a time; different objects by different threads. The WebAssembly module has one
 * thread.
 *
 * Functions of the caller that the library calls return: an exception of one in C++ ends the program (std::terminate),
 * and none may longjmp. Those of a debug drawing alone may throw, since nothing is done meanwhile.
 *
 * A struct that begins with `struct_size` grows at its end in later versions, those that are filled as those that are
 * read; the others never do. The caller writes sizeof(the struct) there, and 0 into every field that is to have its
 * default:
 *     sinew_world_spec spec = {.struct_size = sizeof spec, .gravity = {0, -9.81, 0}};
 *     sinew_report report = {.struct_size = sizeof report};
 * Programs and libraries of different versions of one SINEW_ABI go together. Of a struct that is read, fields that the
 * program does not know have their defaults, and those that the library does not know may be 0 alone. Of a struct that
 * is filled, the library writes no more than the program knows, and 0 into fields that the library does not know.
 * SINEW_BAD_ARGUMENT for anything else, and for a size below that of the struct's first version.
 *
 * Quantities are in the units of the scene, angles in radians. Points have three numbers; in 2D the third is 0. */
#ifndef SINEW_C_H
#define SINEW_C_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define SINEW_API
#else
#define SINEW_API __attribute__((visibility("default")))
#endif

/* Functions of programs, left out of the WebAssembly module. */
#define SINEW_PROGRAM_API SINEW_API

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this header: raised by every change that breaks a compiled caller. */
#define SINEW_ABI 4u

/* The library's ABI; a caller compiled with another SINEW_ABI must not go on. */
SINEW_API uint32_t sinew_abi(void);
/* Version of the engine: "0.9.0". */
SINEW_API const char* sinew_version(void);
/* Instruction set of the kernels in use: "avx2", "simd128". Results do not depend on it. */
SINEW_API const char* sinew_simd(void);

/* --- failures ---------------------------------------------------------------------------------------------------- */

/* Every int is a value of an enumeration, in C++ as in C: a wrong one is an error, not undefined. */
#ifdef __cplusplus
#define SINEW_INT : int
#else
#define SINEW_INT
#endif

typedef enum sinew_status SINEW_INT {
    SINEW_OK = 0,
    SINEW_BAD_HANDLE = 1,   /* no open world or player has this handle */
    SINEW_BAD_ID = 2,       /* the particle, constraint, pin or figure is gone or never was */
    SINEW_BAD_SCENE = 3,    /* the scene has errors: sinew_diagnostic_at() */
    SINEW_BAD_ARGUMENT = 4, /* a null pointer, a number out of range, an unknown word */
    SINEW_NOT_FOUND = 5,    /* nothing has this name, or is at this place */
    SINEW_READ_ONLY = 6,    /* the world belongs to a player, which alone may change it */
    SINEW_FULL = 7          /* no more objects, or an array of the caller is too short */
} sinew_status;

/* Reason of the last failure in this thread, a sentence; empty if there was none. */
SINEW_API const char* sinew_message(void);

/* An error in a scene, for its author. Valid until the next scene is read in this thread. */
typedef struct sinew_diagnostic {
    uint32_t struct_size;
    const char* source;   /* name of the file, or "<command line>" of an override */
    const char* path;     /* JSON pointer: "/figures/0/mass" */
    const char* message;  /* "unknown property \"masss\"" */
    const char* help;     /* "did you mean \"mass\"?"; may be empty */
    const char* text;     /* the error as the command prints it, with the line and a mark below it */
    uint32_t line;        /* from 1 */
    uint32_t column;      /* from 1, in characters */
    uint32_t length;      /* characters */
    uint32_t is_override; /* 1: the error is in an override, and line and column count in it */
} sinew_diagnostic;

/* Errors found by the thread's last sinew_world_open, sinew_check, sinew_world_set, sinew_player_create or
 * sinew_player_open, in order. */
SINEW_API size_t sinew_diagnostic_count(void);
SINEW_API sinew_status sinew_diagnostic_at(size_t index, sinew_diagnostic* diagnostic);

/* --- scenes ------------------------------------------------------------------------------------------------------ */

typedef struct sinew_world {
    uint32_t id;
} sinew_world;
typedef struct sinew_player {
    uint32_t id;
} sinew_player;

/* Files that a scene names. The library reads no file. */
typedef struct sinew_image_file {
    const char* name; /* as in the scene: "sprites/head.png" */
    uint32_t width;   /* pixels */
    uint32_t height;  /* pixels */
} sinew_image_file;
typedef struct sinew_model_file {
    const char* name; /* as in the scene: "models/sail.obj" */
    const char* text; /* Wavefront OBJ */
} sinew_model_file;

/* Everything but the text of a scene. All zero but `struct_size` is a good start. */
typedef struct sinew_open_options {
    uint32_t struct_size;
    const char* name;             /* of the file, for messages; null: "scene.json" */
    const char* const* overrides; /* "path=value" as on the command line: "solver.substeps=16", "mode=classic" */
    size_t override_count;
    const sinew_image_file* images; /* their sizes; the caller paints them. Others are drawn as plain shapes */
    size_t image_count;
    const sinew_model_file* models;
    size_t model_count;
} sinew_open_options;

/* Opens a scene at its start. `options` may be null. */
SINEW_API sinew_status sinew_world_open(const char* scene, const sinew_open_options* options, sinew_world* world);
/* Reads a scene and reports its errors, without keeping it. `options` may be null. */
SINEW_API sinew_status sinew_check(const char* scene, const sinew_open_options* options);
/* A copy in the present state, which goes on by itself: without filter, task system, user data, and the code of a
 * level. */
SINEW_API sinew_status sinew_world_copy(sinew_world world, sinew_world* copy);
SINEW_API sinew_status sinew_world_close(sinew_world world);

/* The bytes of a world in its present state: scene, world, clock, events, grabs and controls. They are valid until the
 * next call with the world. */
SINEW_API sinew_status sinew_world_save(sinew_world world, const uint8_t** bytes, size_t* size);
/* Opens what sinew_world_save() wrote, on this machine or another: every later hash is that of the world that never
 * stopped, and ids hold. `options` has the images and models of the scene; its overrides are not read. Bytes may come
 * from anybody: SINEW_BAD_ARGUMENT, with place and reason, for what no world of this version wrote. */
SINEW_API sinew_status sinew_world_load(const uint8_t* bytes, size_t size, const sinew_open_options* options,
                                        sinew_world* world);

/* JSON text about the engine. `topic`: "schema" (JSON Schema of a scene), "prefabs" (name, about, dimensions,
 * parameters), "kinds" (of constraints, in 2D and 3D), "overlays", "tools", "joints", "actions" (of a player, with
 * their keys). */
SINEW_API sinew_status sinew_describe(const char* topic, const char** json);

/* Memory for texts and arrays, which the page writes into a module. */
SINEW_API void* sinew_allocate(size_t bytes); /* 8-aligned; null where memory ends */
SINEW_API void sinew_free(void* memory);      /* null is allowed */

/* --- time -------------------------------------------------------------------------------------------------------- */

SINEW_API sinew_status sinew_world_restart(sinew_world world);
/* Takes `count` steps of the scene's rate, with the scene's events. */
SINEW_API sinew_status sinew_world_step(sinew_world world, uint32_t count);
/* Steps until `seconds` of simulated time, at most 1e9, have passed since the start, to within half a step. */
SINEW_API sinew_status sinew_world_run_until(sinew_world world, double seconds);

/* --- reading ----------------------------------------------------------------------------------------------------- */

typedef struct sinew_info {
    uint32_t struct_size;
    uint32_t dimension;  /* 2 or 3 */
    uint32_t real_bytes; /* 4: float, 8: double */
    uint32_t particles;  /* rows of the columns */
    uint32_t constraints;
    uint32_t figures;    /* indices 0 to figures - 1; some may be unused */
    uint32_t is_classic; /* 1: mode "classic" */
    uint32_t y_is_down;  /* 1: y points down, as on screens */
    uint32_t read_only;  /* 1: belongs to a player */
    double rate;         /* steps per second */
    double seconds;      /* how long the scene is worth watching */
    double per_metre;    /* units of length in a metre */
    double per_kilogram;
    double per_second;   /* units of time in a second: 60 if the scene counts frames */
    uint32_t view_width; /* size of the picture that the scene asks for, pixels */
    uint32_t view_height;
    uint32_t asleep; /* particles asleep: at rest, left out of the step until woken */
} sinew_info;
SINEW_API sinew_status sinew_world_get_info(sinew_world world, sinew_info* info);

typedef struct sinew_report {
    uint32_t struct_size;
    double seconds; /* simulated time, seconds */
    double steps;
    double kinetic, potential, stored, energy_lost; /* energies */
    double stretch_max, stretch_mean;               /* of distances, as fractions of their rest lengths */
    double max_speed;
} sinew_report;
SINEW_API sinew_status sinew_world_get_report(sinew_world world, sinew_report* report);

/* Hash of all state relevant to the future: equal on every machine, compiler, instruction set and thread count. */
SINEW_API sinew_status sinew_world_state_hash(sinew_world world, uint64_t* hash);

typedef enum sinew_column SINEW_INT {
    SINEW_POSITION = 0, /* `dimension` reals a row */
    SINEW_PREVIOUS = 1, /* one step ago */
    SINEW_VELOCITY = 2,
    SINEW_INVERSE_MASS = 3, /* one real a row; 0: immovable */
    SINEW_RADIUS = 4,
    SINEW_FIGURE = 5,          /* uint32_t, index of the figure; ~0 for loose particles */
    SINEW_CONSTRAINT_ENDS = 6, /* uint32_t, two rows for each distance */
    SINEW_MOBILITY = 7,        /* inverse mass that the constraints see: 0 while pinned */
    SINEW_ASLEEP = 8,          /* uint32_t, 1: the particle is asleep */
    SINEW_TENSION = 9,         /* double, one for each distance: newtons (or the scene's unit of force), positive when
                                  pulling */
    SINEW_STRAIN = 10,         /* double, one for each distance: error as a fraction of the violated limit */
    SINEW_TRIANGLES = 11 /* uint32_t, three rows of particles for each triangle of filled cloth and of skins; a patch
                            that a blade has divided is none */
} sinew_column;

/* Memory of the world, not a copy: valid until the next call that steps or changes it. In WebAssembly any call may
 * grow the memory and so detach typed arrays made on it. */
typedef struct sinew_view {
    uint32_t struct_size;
    const void* data;
    uint32_t rows;
    uint32_t components;   /* numbers a row */
    uint32_t number_bytes; /* 4 or 8 */
    uint32_t is_integer;   /* 1: uint32_t, 0: float or double */
} sinew_view;
SINEW_API sinew_status sinew_world_get_column(sinew_world world, sinew_column column, sinew_view* view);

/* Ids name rows that move. */
typedef uint64_t sinew_particle;
typedef uint64_t sinew_constraint;
typedef uint64_t sinew_pin;
typedef uint64_t sinew_collider;
typedef uint64_t sinew_force;
typedef uint64_t sinew_grab;
#define SINEW_NO_ID UINT64_MAX

SINEW_API sinew_status sinew_world_particle_at(sinew_world world, uint32_t row, sinew_particle* particle);
SINEW_API sinew_status sinew_world_row_of(sinew_world world, sinew_particle particle, uint32_t* row);
/* "bob/right_hand" */
SINEW_API sinew_status sinew_world_find_particle(sinew_world world, const char* name, sinew_particle* particle);
SINEW_API sinew_status sinew_world_find_constraint(sinew_world world, const char* name, sinew_constraint* constraint);
/* Empty if the particle has no name. */
SINEW_API sinew_status sinew_world_particle_name(sinew_world world, sinew_particle particle, const char** name);

typedef struct sinew_particle_state {
    uint32_t struct_size;
    double position[3];
    double velocity[3];
    double inverse_mass; /* 0: immovable */
    double radius;
    uint32_t figure; /* ~0: none */
    uint32_t is_asleep;
} sinew_particle_state;
SINEW_API sinew_status sinew_world_get_particle(sinew_world world, sinew_particle particle,
                                                sinew_particle_state* state);

typedef struct sinew_constraint_state {
    uint32_t struct_size;
    double measure; /* in the kind's unit: length, radians, area, volume */
    double error;   /* distance outside the limits; negative below the lower limit */
    double strain;  /* error as a fraction of the violated limit; of angles the error itself */
    double tension; /* newtons (or the scene's unit of force), positive when pulling */
} sinew_constraint_state;
SINEW_API sinew_status sinew_world_get_constraint(sinew_world world, sinew_constraint constraint,
                                                  sinew_constraint_state* state);
/* Kinds are numbered from 0 as in sinew_describe("kinds"); SINEW_BAD_ARGUMENT for a kind the dimension has not. */
SINEW_API sinew_status sinew_world_constraint_count(sinew_world world, uint32_t kind, uint32_t* count);
SINEW_API sinew_status sinew_world_constraint_at(sinew_world world, uint32_t kind, uint32_t row,
                                                 sinew_constraint* constraint);

typedef struct sinew_figure {
    uint32_t struct_size;
    const char* name;
    const char* prefab;
    uint32_t particles;
    uint32_t is_quarantined; /* 1: frozen, because a number became infinite or not-a-number */
} sinew_figure;
/* SINEW_NOT_FOUND for an unused index. */
SINEW_API sinew_status sinew_world_figure_at(sinew_world world, uint32_t index, sinew_figure* figure);

typedef struct sinew_event {
    uint32_t struct_size;
    double seconds;    /* simulated time */
    const char* what;  /* "torn", "parted", "quarantined", "touched" (a sensor), the phase of a contact that the scene
                          waits for ("begin", "persist", "end", "hit"), or the name of a scene event */
    const char* where; /* figure or particle, or the text of a note; may be empty */
    uint32_t islands;  /* "parted": number of islands of the figure; else 0 */
    const char* with;  /* contacts: name of the collider or figure touched; may be empty */
    double impulse;    /* contacts: in the step */
} sinew_event;
/* Events since the start; at most 10,000 are kept. */
SINEW_API sinew_status sinew_world_event_count(sinew_world world, uint32_t* count);
SINEW_API sinew_status sinew_world_event_at(sinew_world world, uint32_t index, sinew_event* event);

/* --- contacts ---------------------------------------------------------------------------------------------------- */

typedef enum sinew_phase SINEW_INT {
    SINEW_BEGIN = 0,   /* the touch began in the last step */
    SINEW_PERSIST = 1, /* it went on */
    SINEW_END = 2      /* it ended */
} sinew_phase;

typedef struct sinew_point {
    double x, y, z;
} sinew_point;

/* A contact in the last step. A hit is one whose `blow` is above a number of the caller's, and `blow_before` was not.
 */
typedef struct sinew_contact {
    uint32_t struct_size;
    double impulse;     /* in the last step, newton seconds (or the scene's unit of impulse); friction is not counted */
    double blow;        /* the same; in the step after the touch began, that of both steps: a blow may take two */
    double blow_before; /* in the step before */
    sinew_particle particle;   /* of two figures the particle that is pressed hardest, or an end of a link that is */
    sinew_particle other;      /* the same of the other figure; SINEW_NO_ID: a collider or a plane is touched */
    sinew_collider collider;   /* SINEW_NO_ID: a figure or a plane is touched */
    uint32_t figure;           /* ~0: a loose particle */
    uint32_t other_figure;     /* ~0: a collider or a plane is touched */
    uint32_t phase;            /* a sinew_phase */
    const char* collider_name; /* as in the scene; may be empty; "bounds" for a plane of world.bounds */
    sinew_point point;         /* where it pressed hardest; on the surface of a collider, between two figures */
    sinew_point
        normal;   /* unit length, towards `particle`; zero for a body that is near and does not press, and at an end */
    double speed; /* of approach along the normal there, before the contact acted */
} sinew_contact;
/* Whether touches of figures with figures and with planes of world.bounds are listed too, from the next step on (`on` 0
 * or 1; contacts of figures must be switched on in the scene: "contact": {"figures": true}). Those with colliders
 * always are. A scene whose events wait for contacts lists them anyway. Results do not depend on it. */
SINEW_API sinew_status sinew_world_list_contacts(sinew_world world, uint32_t on);
/* Lists the contacts of the last step, for sinew_world_contact_at until the world is stepped or changed. */
SINEW_API sinew_status sinew_world_contact_count(sinew_world world, uint32_t* count);
SINEW_API sinew_status sinew_world_contact_at(sinew_world world, uint32_t index, sinew_contact* contact);

/* A contact that is about to act in a substep: of a particle, or of a link by its first end. */
typedef struct sinew_pending_contact {
    uint32_t struct_size; /* of the library */
    uint32_t figure;      /* ~0: a loose particle */
    sinew_particle particle;
    sinew_particle other;    /* of the other figure; SINEW_NO_ID: a collider or a plane is touched */
    sinew_collider collider; /* SINEW_NO_ID: a figure or a plane is touched */
    uint32_t other_figure;   /* ~0: a collider or a plane is touched */
    uint32_t reserved;
    sinew_point normal; /* unit length, towards `particle` */
    double gap;         /* at the start of the substep, length; negative for an overlap */
    double speed;       /* of approach along the normal, before the contact acts */
    double friction;    /* may be changed: Coulomb's coefficient, >= 0 */
    double bounce;      /* may be changed: 0 to 1 */
} sinew_pending_contact;
/* Returns 0 for a contact that is not to act in this substep; it is then no touch. Must not change the world that
 * calls it, for which SINEW_READ_ONLY is returned; user data may be read. */
typedef int (*sinew_contact_filter)(void* context, sinew_pending_contact* contact);
/* Null: all contacts act. The filter is asked before a contact acts, in every substep of sinew_world_step and
 * sinew_world_run_until, about planes, colliders, sensors, figures and cloth, in the order of the solver and in the
 * caller's thread, which then takes the steps alone: the same answers give the same bits. A rope that is solved at once
 * is asked about once a step and wall; layers of thin cloth, which never cross, and what sleeps are not asked about.
 * Copies have no filter. An exception of the filter's ends the program. */
SINEW_PROGRAM_API sinew_status sinew_world_set_contact_filter(sinew_world world, sinew_contact_filter filter,
                                                              void* context);

/* --- queries ----------------------------------------------------------------------------------------------------- */

/* Nearest particle whose surface is within `reach` of a point; `distance` (may be null) is from the surface, negative
 * inside. SINEW_NOT_FOUND if there is none. */
SINEW_API sinew_status sinew_world_nearest_particle(sinew_world world, sinew_point at, double reach,
                                                    sinew_particle* particle, double* distance);
/* Nearest link, the segment between the ends of a distance; `t` (may be null) is the place on it, 0 at the first end
 * and 1 at the second. SINEW_NOT_FOUND if there is none within `reach`. */
SINEW_API sinew_status sinew_world_nearest_link(sinew_world world, sinew_point at, double reach, sinew_constraint* link,
                                                double* t, double* distance);

typedef struct sinew_ray_hit {
    uint32_t struct_size;
    double share; /* of the way, 0 to 1 */
    sinew_point point, normal;
    sinew_particle particle; /* SINEW_NO_ID: a collider was met; or a plane of world.bounds, if both are */
    sinew_collider collider; /* SINEW_NO_ID: a particle or a plane was met */
    sinew_particle line_end; /* of a line of a figure, which begins at `particle`; else SINEW_NO_ID */
} sinew_ray_hit;
/* First particle with a radius, line of a figure as it is drawn (the side of a crate, a limb), collider other than a
 * sensor, or plane of world.bounds that a sphere meets on its straight way; radius 0 is a ray. Only layers of `mask`
 * count (~0: all); planes always do. A thing that holds the start is met at once if the way leads further into it, and
 * not if it leads out. SINEW_NOT_FOUND if nothing is met. */
SINEW_API sinew_status sinew_world_cast_ray(sinew_world world, sinew_point from, sinew_point to, double radius,
                                            uint32_t mask, sinew_ray_hit* hit);

/* A sphere (circle), or a box if `half` is not zero, turned about its centre. */
typedef struct sinew_region {
    uint32_t struct_size;
    sinew_point center;
    sinew_point half; /* half of the edges of a box; all zero: a sphere */
    double radius;    /* of a sphere */
    double turn;      /* of a box, in radians, counter-clockwise; in 3D about `axis` */
    sinew_point axis; /* 3D: of any length; all zero: z */
} sinew_region;
/* Ids of the particles, or links, that touch a region, in the order of their rows: at most `room` are written, and
 * `count` says how many there are. */
SINEW_API sinew_status sinew_world_overlapping_particles(sinew_world world, const sinew_region* region,
                                                         sinew_particle* particles, size_t room, size_t* count);
SINEW_API sinew_status sinew_world_overlapping_links(sinew_world world, const sinew_region* region,
                                                     sinew_constraint* links, size_t room, size_t* count);

/* --- the scene of a world ---------------------------------------------------------------------------------------- */

/* The scene as a file states it, with the edits of sinew_world_set(); an event at the start removes cut constraints of
 * its figures. What calls and events have added is in sinew_world_save() alone. */
SINEW_API sinew_status sinew_world_scene_text(sinew_world world, const char** json);
/* Values that a form can show: a JSON array of {path, name, value, type, unit, low, high, choices, help}. Paths are
 * those of overrides; low, high and choices are absent where there are none. */
SINEW_API sinew_status sinew_world_parameters(sinew_world world, const char** json);
/* Sets one value of the running scene by an override "path=value"; figures of the scene that it does not concern go on
 * unchanged. Changes by calls stay, with all ids; a grab ends. A figure whose form changes begins
 * anew, without ids and numbers that were set. SINEW_BAD_ARGUMENT, and no change, where an added thing cannot go on: a
 * constraint or a pin that holds such a figure, a figure that has been cut and would be whole, another dimension. */
SINEW_API sinew_status sinew_world_set(sinew_world world, const char* override_pair);

/* --- edits ------------------------------------------------------------------------------------------------------- */

typedef struct sinew_particle_spec {
    uint32_t struct_size;
    sinew_point position, velocity;
    double mass; /* 1e-30 and above; INFINITY: immovable */
    double radius;
} sinew_particle_spec;
SINEW_API sinew_status sinew_world_add_particle(sinew_world world, const sinew_particle_spec* spec,
                                                sinew_particle* particle);
SINEW_API sinew_status sinew_world_remove_particle(sinew_world world, sinew_particle particle);

typedef struct sinew_constraint_spec {
    uint32_t struct_size;
    double low, high;       /* limits of the measure; low > high: the present measure exactly */
    double compliance;      /* 1 / stiffness; 0: rigid */
    double max_force;       /* 0: without limit */
    double breaking_strain; /* 0: never breaks */
} sinew_constraint_spec;
/* SINEW_BAD_ARGUMENT if `count` is not the number of particles of the kind. `spec` may be null: rigid as it is. */
SINEW_API sinew_status sinew_world_add_constraint(sinew_world world, uint32_t kind, const sinew_particle* particles,
                                                  size_t count, const sinew_constraint_spec* spec,
                                                  sinew_constraint* constraint);
SINEW_API sinew_status sinew_world_remove_constraint(sinew_world world, sinew_constraint constraint);

/* New values for a constraint while it runs. Limits as in sinew_constraint_spec, but low <= high; those of an angle in
 * 3D are not negative. Zero: `compliance` rigid, `max_force` without limit, `strain` and `force` never breaks. */
SINEW_API sinew_status sinew_world_set_limits(sinew_world world, sinew_constraint constraint, double low, double high);
SINEW_API sinew_status sinew_world_set_compliance(sinew_world world, sinew_constraint constraint, double compliance);
SINEW_API sinew_status sinew_world_set_max_force(sinew_world world, sinew_constraint constraint, double max_force);
SINEW_API sinew_status sinew_world_set_breaking_strain(sinew_world world, sinew_constraint constraint, double strain);
/* Force, in newtons (N m for an angle), above which a constraint breaks, rigid or not. */
SINEW_API sinew_status sinew_world_set_break_force(sinew_world world, sinew_constraint constraint, double force);
/* Moves the limits at a rate, per second: a winch, a motor; 0 stops it. SINEW_BAD_ARGUMENT for a motor of unlimited
 * force beside a rigid constraint of the same particles: give it a max_force first. */
SINEW_API sinew_status sinew_world_drive(sinew_world world, sinew_constraint constraint, double rate);

SINEW_API sinew_status sinew_world_set_position(sinew_world world, sinew_particle particle, sinew_point position);
SINEW_API sinew_status sinew_world_set_velocity(sinew_world world, sinew_particle particle, sinew_point velocity);
SINEW_API sinew_status sinew_world_set_mass(sinew_world world, sinew_particle particle, double mass);
/* Collision radius. */
SINEW_API sinew_status sinew_world_set_radius(sinew_world world, sinew_particle particle, double radius);
/* A force for the next step; calls add up. */
SINEW_API sinew_status sinew_world_apply_force(sinew_world world, sinew_particle particle, sinew_point force);
SINEW_API sinew_status sinew_world_apply_impulse(sinew_world world, sinew_particle particle, sinew_point impulse);

/* Holds a particle where it is. A pin that holds it already, such as that of a rope's start, is replaced: its id is
 * gone.
 */
SINEW_API sinew_status sinew_world_pin_particle(sinew_world world, sinew_particle particle, sinew_pin* pin);
/* Target at the end of the next step, approached in a straight line. */
SINEW_API sinew_status sinew_world_move_pin(sinew_world world, sinew_pin pin, sinew_point target);
SINEW_API sinew_status sinew_world_unpin(sinew_world world, sinew_pin pin);

/* Colliders of the scene by name. */
SINEW_API sinew_status sinew_world_find_collider(sinew_world world, const char* name, sinew_collider* collider);
/* Pose of a collider at the end of the next step, approached evenly: what touches it is carried along. `turn` as in
 * sinew_region, `axis` may be null. A collider with a motion of its own in the scene follows that. */
SINEW_API sinew_status sinew_world_move_collider(sinew_world world, sinew_collider collider, sinew_point position,
                                                 double turn, const sinew_point* axis);

/* --- pointer ----------------------------------------------------------------------------------------------------- */

/* Grabs the nearest particle within `radius` (the scene's unit of length), or a point between several, as a pointer
 * does: with a force of 100 times gravity at most. In 3D a particle alone. SINEW_NOT_FOUND if nothing movable is there.
 */
SINEW_API sinew_status sinew_world_grab(sinew_world world, sinew_point at, double radius);
/* Grabs one particle. */
SINEW_API sinew_status sinew_world_grab_particle(sinew_world world, sinew_particle particle);
/* Target of the held point at the end of the next step. */
SINEW_API sinew_status sinew_world_drag(sinew_world world, sinew_point to);
SINEW_API sinew_status sinew_world_let_go(sinew_world world);
/* Position of the pointer, for pins that follow it. */
SINEW_API sinew_status sinew_world_point_at(sinew_world world, sinew_point at);
/* Movable particle whose surface is nearest to the straight way between two points, within `radius`; of several that
 * the way meets the first one. From the eye through a pixel it is the particle under the pointer. `share` (may be null)
 * is its place on the way, 0 to 1: the depth at which a pointer drags it. SINEW_NOT_FOUND if there is none. */
SINEW_API sinew_status sinew_world_pick(sinew_world world, sinew_point from, sinew_point to, double radius,
                                        sinew_particle* particle, double* share);
/* A grab of the same strength beside all others: of a second finger, a hand of a figure. Grabs of the same particle add
 * up. Copies and saved worlds hold it, and it outlasts an edit of the scene. SINEW_NOT_FOUND for a particle that cannot
 * move. */
SINEW_API sinew_status sinew_world_add_grab(sinew_world world, sinew_particle particle, sinew_grab* grab);
/* Target at the end of the next step. SINEW_BAD_ID for a grab that has ended, as with its particle. */
SINEW_API sinew_status sinew_world_move_grab(sinew_world world, sinew_grab grab, sinew_point to);
/* Lets go: the particle keeps its velocity. */
SINEW_API sinew_status sinew_world_remove_grab(sinew_world world, sinew_grab grab);
/* Cuts every distance that crosses the line, as seen in the scene's own view; `count` (may be null) is the number cut.
 */
SINEW_API sinew_status sinew_world_cut(sinew_world world, sinew_point from, sinew_point to, uint32_t* count);

/* --- characters and cars ----------------------------------------------------------------------------------------- */

/* Controls of a figure of the prefab "character" or "car", in every step until they are changed. */
typedef struct sinew_controls {
    uint32_t struct_size;
    uint32_t jump; /* 1: a character jumps whenever it is on the ground; a car brakes */
    uint32_t hold; /* 1: a character reaches for ropes and planks, and holds on */
    uint32_t reserved;
    double along; /* -1 to 1: walks, drives, to the left or to the right */
    double up;    /* -1 to 1: climbs; a car in the air lifts its front */
} sinew_controls;
/* Null: controls of the scene's events again. Controls are a part of the world: copies and saved worlds hold them.
 * SINEW_BAD_ARGUMENT for a figure that has no controls. */
SINEW_API sinew_status sinew_world_steer(sinew_world world, uint32_t figure, const sinew_controls* controls);

typedef struct sinew_footing {
    uint32_t struct_size;
    uint32_t on_ground;  /* 1: a character stands or walks */
    uint32_t is_holding; /* 1: it hangs on a rope or a plank */
    uint32_t figure;     /* the ground's, or the held one's; ~0: a collider, a plane, or nothing */
} sinew_footing;
/* Footing of a character after the last step. */
SINEW_API sinew_status sinew_world_get_footing(sinew_world world, uint32_t figure, sinew_footing* footing);

/* --- picture ----------------------------------------------------------------------------------------------------- */

typedef enum sinew_shape SINEW_INT {
    SINEW_POLYLINE = 0, /* `count` points joined by a stroke of `width` pixels, round caps and joins */
    SINEW_LOOP = 1,     /* the same, closed */
    SINEW_DISC = 2,     /* a point, filled, `width` pixels in diameter */
    SINEW_POLYGON = 3,  /* `count` points, filled (even-odd) */
    SINEW_IMAGE =
        4,          /* an image mapped onto a grid of points, rows of `across`; `color` is blended over opaque pixels */
    SINEW_TEXT = 5, /* a line of text centred on one point, letters `width` pixels high */
    SINEW_PANE = 6  /* the rectangle between two corners, filled; later items are clipped to it */
} sinew_shape;

typedef struct sinew_item {
    uint32_t shape;  /* a sinew_shape */
    uint32_t first;  /* index of the first point */
    uint32_t count;  /* of points */
    float width;     /* pixels */
    float color[4];  /* red, green, blue, alpha: sRGB, straight alpha, 0 to 1 */
    uint32_t number; /* index of the image, or of the text */
    uint32_t across; /* points in a row of an image's grid */
} sinew_item;

/* A display list in pixels: x right, y down, origin at the top left. Items are painted in order. Valid until the object
 * is drawn again or closed. */
typedef struct sinew_picture {
    uint32_t struct_size;
    uint32_t width, height; /* pixels */
    float background[4];
    const float* points; /* two floats a point */
    uint32_t point_count;
    const sinew_item* items;
    uint32_t item_count;
    uint32_t item_bytes; /* from one item to the next: later versions have longer ones */
    uint32_t text_count;
    uint32_t image_count;
} sinew_picture;

/* `overlays`: bit i is overlay i of sinew_describe("overlays"). */
SINEW_API sinew_status sinew_world_draw(sinew_world world, uint32_t width, uint32_t height, uint32_t overlays,
                                        sinew_picture* picture);
SINEW_API sinew_status sinew_world_picture_text(sinew_world world, uint32_t index, const char** text);
/* Name of an image, as in the scene. */
SINEW_API sinew_status sinew_world_picture_image(sinew_world world, uint32_t index, const char** name);
/* Position of a pixel of a picture of that size in a 2D scene, and the pixel of a position. */
SINEW_API sinew_status sinew_world_unproject(sinew_world world, uint32_t width, uint32_t height, double x, double y,
                                             sinew_point* position);
SINEW_API sinew_status sinew_world_project(sinew_world world, uint32_t width, uint32_t height, sinew_point position,
                                           double* x, double* y);

/* --- player ------------------------------------------------------------------------------------------------------ */

/* Opens a scene in a player, running, with a picture of the size that the scene asks for. `options` may be null. */
SINEW_API sinew_status sinew_player_create(const char* scene, const sinew_open_options* options, sinew_player* player);
/* Opens another scene in the player; on failure the old one goes on. */
SINEW_API sinew_status sinew_player_open(sinew_player player, const char* scene, const sinew_open_options* options);
/* Continues as an edited scene; figures that are the same in both keep their state. Can be undone. */
SINEW_API sinew_status sinew_player_become(sinew_player player, const char* scene, const sinew_open_options* options);
SINEW_API sinew_status sinew_player_close(sinew_player player);
/* The world of a pane (0, and 1 in a split view), for reading. Valid until the player is closed or split. */
SINEW_API sinew_status sinew_player_world(sinew_player player, uint32_t pane, sinew_world* world);

/* Size of the picture in pixels, and pixels per nominal pixel (2 on a dense display). */
SINEW_API sinew_status sinew_player_resize(sinew_player player, uint32_t width, uint32_t height, double density);
/* Advances real time and takes the steps due. */
SINEW_API sinew_status sinew_player_advance(sinew_player player, double seconds);
/* The picture with the pointer's marks, interpolated between the last two steps. */
SINEW_API sinew_status sinew_player_draw(sinew_player player, sinew_picture* picture);
SINEW_API sinew_status sinew_player_picture_text(sinew_player player, uint32_t index, const char** text);
SINEW_API sinew_status sinew_player_picture_image(sinew_player player, uint32_t index, const char** name);

/* Input; positions are pixels of the picture. */
typedef enum sinew_button SINEW_INT { SINEW_LEFT = 0, SINEW_MIDDLE = 1, SINEW_RIGHT = 2 } sinew_button;
SINEW_API sinew_status sinew_player_pointer(sinew_player player, double x, double y);
SINEW_API sinew_status sinew_player_leave(sinew_player player); /* the pointer has left the picture */
SINEW_API sinew_status sinew_player_press(sinew_player player, sinew_button button);
SINEW_API sinew_status sinew_player_release(sinew_player player, sinew_button button);
/* Notches of the wheel, positive away from the user: enlarges, or changes the time scale where the scene says so. */
SINEW_API sinew_status sinew_player_scroll(sinew_player player, double notches);
/* A gesture of two fingers: displacement of their middle, ratio of their distances. */
SINEW_API sinew_status sinew_player_pinch(sinew_player player, double dx, double dy, double factor);
/* Moves the picture by pixels; turns the camera of a 3D scene about its target (in 2D: pans). */
SINEW_API sinew_status sinew_player_pan(sinew_player player, double dx, double dy);
SINEW_API sinew_status sinew_player_orbit(sinew_player player, double dx, double dy);
/* Enlarges by a factor about the pointer. */
SINEW_API sinew_status sinew_player_zoom(sinew_player player, double factor);
/* Fingers on a screen: one is the pointer with its left button, two pan and zoom. `phase` 0: down, 1: moved, 2: up. */
SINEW_API sinew_status sinew_player_touch(sinew_player player, int64_t finger, uint32_t phase, double x, double y);
/* A key of the window: "p", "[", "escape", "ctrl+z", "shift". `is_down` 0: released. */
SINEW_API sinew_status sinew_player_key(sinew_player player, const char* name, uint32_t is_down);

/* An action by its name in sinew_describe("actions"): "pause", "step", "back", "restart", "undo", "redo", "gravity",
 * "wind", "mode", "split", "theme", "see_all", "projection", "slower", "faster", "follow", "choose_all",
 * "duplicate". */
SINEW_API sinew_status sinew_player_do(sinew_player player, const char* action);
SINEW_API sinew_status sinew_player_pause(sinew_player player, uint32_t on);
/* Simulated seconds per real second, above 0; brought within 0.01 and 8. */
SINEW_API sinew_status sinew_player_time_scale(sinew_player player, double scale);
/* Restores a step of the last minute (see sinew_player_state) and pauses. */
SINEW_API sinew_status sinew_player_go_to(sinew_player player, double step);
/* Sets one value of the scene; `goes_on` merges the edit with the preceding one of the same path (a slider moves). */
SINEW_API sinew_status sinew_player_set(sinew_player player, const char* path, const char* value, uint32_t goes_on);
SINEW_API sinew_status sinew_player_tool(sinew_player player, const char* name);
/* Prefab of the tool "spawn", with its parameters as a JSON object (null: none). */
SINEW_API sinew_status sinew_player_prefab(sinew_player player, const char* prefab, const char* parameters);
/* Joint of the tool "join": a name in sinew_describe("joints"). */
SINEW_API sinew_status sinew_player_joint(sinew_player player, const char* joint);
SINEW_API sinew_status sinew_player_overlays(sinew_player player, uint32_t overlays);
/* "light" or "dark"; empty: the scene's own. */
SINEW_API sinew_status sinew_player_theme(sinew_player player, const char* theme);

typedef struct sinew_player_state {
    uint32_t struct_size;
    double step, first_step, end_step; /* of the timeline: now, earliest and latest that can be restored */
    double time_scale;
    double share; /* of the step in progress, 0 to 1 */
    uint32_t is_paused;
    uint32_t panes;      /* 1, or 2 in a split view */
    uint32_t is_edited;  /* differs from the scene that was opened */
    uint32_t is_holding; /* the pointer holds something */
    uint32_t overlays;
    const char* tool;
    const char* theme;   /* shown */
    const char* hovered; /* name of the particle under the pointer; may be empty */
    const char* selected;
    const char* message; /* a line about the last action; may be empty */
    const char* undo;    /* name of the edit that undo would take back; empty: none */
    const char* redo;
} sinew_player_state;
SINEW_API sinew_status sinew_player_get_state(sinew_player player, sinew_player_state* state);
/* Takes the next event off the queue as a JSON object: {"what": "grab", "particle": "bob/head"}. SINEW_NOT_FOUND when
 * there is none. The queue keeps the last 1000. */
SINEW_API sinew_status sinew_player_next_event(sinew_player player, const char** json);

/* --- worlds built by calls --------------------------------------------------------------------------------------- */

typedef struct sinew_world_spec {
    uint32_t struct_size;
    uint32_t dimension;  /* 2 or 3; 0: 2 */
    uint32_t real_bytes; /* 4: float, 8: double; 0: 8 */
    uint32_t substeps;   /* of a step; 0: the default of scenes */
    double rate;         /* steps per second; 0: 60 */
    sinew_point gravity; /* metres per second squared; y is up */
    double damping;      /* share of the velocity lost, 1 / s */
} sinew_world_spec;
/* Opens an empty world in metres, kilograms and seconds. Particles, constraints and pins: sinew_world_add_particle()
 * and so on. sinew_world_restart() returns to the empty world; sinew_world_save() keeps all of it,
 * sinew_world_scene_text() only the settings.
 */
SINEW_PROGRAM_API sinew_status sinew_world_create(const sinew_world_spec* spec, sinew_world* world);
/* The world's gravity, force 0; other forces stay. */
SINEW_PROGRAM_API sinew_status sinew_world_set_gravity(sinew_world world, sinew_point gravity);

/* Numbers of the kinds of constraints; an angle and a distance have the same in 2D and 3D. */
typedef enum sinew_kind SINEW_INT {
    SINEW_DISTANCE = 0, /* of two particles: rod, rope, strut, spring */
    SINEW_ANGLE = 1,    /* at the second of three particles */
    SINEW_AREA_2D = 2,  /* of a polygon */
    SINEW_PULLEY_2D = 3,
    SINEW_RAIL_2D = 4,
    SINEW_VOLUME_3D = 2,
    SINEW_DIHEDRAL_3D = 3, /* between two triangles */
    SINEW_PULLEY_3D = 4
} sinew_kind;

/* A value of a figure by its name in a scene: {"segments", 20, NULL}, {"contact.figures", 0, "true"}. */
typedef struct sinew_parameter {
    const char* name;
    double number;    /* counts if `word` is null */
    const char* word; /* JSON: "true", "[1, 2]", or a bare word */
} sinew_parameter;
typedef struct sinew_figure_spec {
    uint32_t struct_size;
    uint32_t parameter_count;
    const sinew_parameter* parameters; /* of the prefab, as sinew_describe("prefabs") lists them, and of any figure:
                                          "contact.figures", "contact.layers", "internal_damping" */
    const char* prefab;                /* "rope" */
    const char* name;                  /* null: that of the prefab, with a number if it is taken */
    sinew_point position;
    sinew_point velocity;
    double turn; /* radians, counter-clockwise; in 3D about z; 0: as a parameter "turn" says, in degrees */
} sinew_figure_spec;
/* Builds a prefab into the world. `figure` (may be null) is the index for sinew_world_figure_at(). SINEW_BAD_SCENE,
 * with diagnostics, for an unknown prefab or a parameter out of its range. */
SINEW_API sinew_status sinew_world_add_figure(sinew_world world, const sinew_figure_spec* spec, uint32_t* figure);
/* New values of a figure that was added, by names as in its spec, those of its place included: "at", "turn" in degrees.
 * It goes on as it moves, and ids hold; numbers that calls have set stay, unless a value concerns them.
 * SINEW_BAD_ARGUMENT, and no change, for a value that changes its form ("segments"), for one that would turn a pinned
 * figure or one that has been cut, and for a figure of the scene: sinew_world_set(). SINEW_BAD_SCENE as above. */
SINEW_API sinew_status sinew_world_set_figure(sinew_world world, uint32_t figure, const sinew_parameter* parameters,
                                              uint32_t count);
/* Removes a figure with its particles. */
SINEW_API sinew_status sinew_world_remove_figure(sinew_world world, uint32_t figure);
/* Index of a figure by name. */
SINEW_API sinew_status sinew_world_find_figure(sinew_world world, const char* name, uint32_t* figure);

typedef enum sinew_collider_shape SINEW_INT {
    SINEW_HALF_SPACE = 0, /* solid below its own x axis (in 3D its xz plane) */
    SINEW_SPHERE = 1,     /* a circle in 2D */
    SINEW_CAPSULE = 2,    /* a segment along its own x axis, thickened by `radius` */
    SINEW_BOX = 3,
    SINEW_POLYGON_2D = 4,     /* convex, corners counter-clockwise */
    SINEW_TERRAIN_2D = 5,     /* a line of points, solid on its right-hand side: below one that runs from left to right,
                                 inside a closed one whose points are clockwise */
    SINEW_MESH_3D = 6,        /* triangles, each solid behind */
    SINEW_HEIGHT_FIELD_3D = 7 /* a landscape over a square grid in the xz plane, solid below: a height y for each x =
                                 column times spacing, z = row times spacing */
} sinew_collider_shape;
typedef struct sinew_collider_spec {
    uint32_t struct_size;
    uint32_t shape;   /* a sinew_collider_shape */
    const char* name; /* may be null */
    sinew_point position;
    sinew_point axis;          /* 3D: of `turn`; all zero: z */
    double turn;               /* radians */
    sinew_point half;          /* box: half of its edges; capsule: half.x is half of its segment */
    double radius;             /* sphere, capsule */
    const sinew_point* points; /* polygon, terrain, mesh: from `position`, within 1e8; at most 2^20 */
    uint32_t point_count;
    uint32_t is_sensor;  /* 1: touched without a push */
    double bounce;       /* share of the approach speed given back, 0 to 1 */
    double friction;     /* Coulomb's coefficient */
    uint32_t layers;     /* bits; 0: the first */
    uint32_t mask;       /* layers that touch it; 0: all */
    sinew_point one_way; /* direction of the normals that are solid, in its own frame; all zero: all */
    /* Fields of later versions. */
    const uint32_t* triangles;    /* mesh: three numbers of points each, counter-clockwise seen from the free side */
    uint32_t triangle_count;      /* at most 2^22 */
    uint32_t is_closed;           /* 1: terrain with an edge from the last point to the first */
    const double* heights;        /* height field: row after row; within 1e8, at most 2^24 */
    uint32_t columns, rows;       /* of heights, 2 and more */
    double spacing;               /* height field: side of a cell, above 0 */
    sinew_point surface_velocity; /* of a belt: the surface runs along itself, in its own frame, length / time */
} sinew_collider_spec;
/* SINEW_BAD_ARGUMENT, with the place ("triangles[7] names point 9 of 8"), for numbers that make no shape. */
SINEW_API sinew_status sinew_world_add_collider(sinew_world world, const sinew_collider_spec* spec,
                                                sinew_collider* collider);
SINEW_API sinew_status sinew_world_remove_collider(sinew_world world, sinew_collider collider);

typedef enum sinew_force_kind SINEW_INT {
    SINEW_GRAVITY = 0,    /* an additional constant acceleration */
    SINEW_DRAG = 1,       /* of still air or water: against the velocity */
    SINEW_WIND = 2,       /* moving air, in gusts */
    SINEW_ATTRACTOR = 3,  /* a point that pulls, or pushes away: strength / distance^2 */
    SINEW_RANDOM_PUSH = 4 /* a force on one random particle each step, of whole numbers from `low` to `high` */
} sinew_force_kind;
/* A force field; fields of other kinds are not read. Quantities are in the scene's units, ranges in metres, kilograms
 * and seconds, as in scenes. */
typedef struct sinew_force_spec {
    uint32_t struct_size;
    uint32_t kind;            /* a sinew_force_kind */
    sinew_point acceleration; /* gravity: length / time^2 */
    sinew_point velocity;     /* wind: of the air */
    sinew_point gust;         /* wind: largest change of the velocity in a gust */
    sinew_point center;       /* attractor: position */
    sinew_point low, high;    /* random push: force */
    double strength;          /* drag, wind: force / velocity, 0 to 1e9, on each particle (of cloth on each 0.01 m^2);
                                 attractor: acceleration times length^2, -1e12 to 1e12, negative to repel */
    double density;           /* wind: mass / length^3, 0 to 1e6; above 0 it presses on areas, lines and balls, too */
    double drag_coefficient;  /* wind with a density: 0 to 1000; 0: 1.2, of a plate */
    double gust_period;       /* wind: time from gust to gust, 0.001 to 1e6 s; 0: 1 s */
    double gust_size;         /* wind: length of a gust, 0 to 1e6 m; 0: the same gust everywhere */
    double softness;          /* attractor: distance below which it is like a spring, 1e-6 to 1e6 m; 0: 0.1 m */
    uint64_t seed;            /* wind: of the gusts; random push */
    const char* figure;       /* attractor: the only figure pulled, with which it goes; null: all */
} sinew_force_spec;
/* SINEW_BAD_ARGUMENT, with the field, for a number out of its range; SINEW_NOT_FOUND for an unknown figure. */
SINEW_API sinew_status sinew_world_add_force(sinew_world world, const sinew_force_spec* spec, sinew_force* force);
/* New values of a force, also of one of the scene; the world's gravity stays one of SINEW_GRAVITY. */
SINEW_API sinew_status sinew_world_set_force(sinew_world world, sinew_force force, const sinew_force_spec* spec);
/* Values of a force; fields of other kinds are 0. */
SINEW_API sinew_status sinew_world_get_force(sinew_world world, sinew_force force, sinew_force_spec* spec);
/* SINEW_BAD_ARGUMENT for the world's gravity, which sinew_world_set_gravity() sets to zero. */
SINEW_API sinew_status sinew_world_remove_force(sinew_world world, sinew_force force);
/* Forces in order: at 0 the world's gravity, then those of the scene, then others; SINEW_NOT_FOUND after the last. */
SINEW_API sinew_status sinew_world_force_at(sinew_world world, uint32_t index, sinew_force* force);

/* --- user data --------------------------------------------------------------------------------------------------- */

typedef enum sinew_object SINEW_INT {
    SINEW_OF_PARTICLE = 0,
    SINEW_OF_CONSTRAINT = 1,
    SINEW_OF_COLLIDER = 2,
    SINEW_OF_FIGURE = 3 /* by its index */
} sinew_object;
/* A pointer of the caller's for an object, never followed; null at first. Copies and loaded worlds have none. */
SINEW_PROGRAM_API sinew_status sinew_world_set_user_data(sinew_world world, sinew_object object, uint64_t id,
                                                         void* data);
SINEW_PROGRAM_API sinew_status sinew_world_get_user_data(sinew_world world, sinew_object object, uint64_t id,
                                                         void** data);

/* --- debug drawing ----------------------------------------------------------------------------------------------- */

typedef enum sinew_debug_part SINEW_INT {
    SINEW_DRAW_LINKS = 1,     /* distances, green at rest to red at 10 % of strain */
    SINEW_DRAW_PARTICLES = 2, /* blue; grey asleep; black pinned or immovable */
    SINEW_DRAW_COLLIDERS = 4, /* brown */
    SINEW_DRAW_CONTACTS = 8   /* of the last step, red: a point, and a line along the normal */
} sinew_debug_part;
/* Callbacks, any of which may be null. Colours are 0xRRGGBB; `context` is the caller's. */
typedef struct sinew_debug_draw {
    uint32_t struct_size;
    uint32_t parts; /* sinew_debug_part bits; 0: all */
    void* context;
    void (*segment)(void* context, sinew_point from, sinew_point to, double radius, uint32_t color);
    void (*sphere)(void* context, sinew_point center, double radius, uint32_t color); /* a circle in 2D */
    void (*polygon)(void* context, const sinew_point* corners, size_t count, uint32_t color);
} sinew_debug_draw;
/* Calls back for everything in the world, in the scene's units. Half-spaces are lines as long as `extent` to each side;
 * meshes and height fields are left out. A callback may change the world, or close it: what is drawn is listed before.
 */
SINEW_PROGRAM_API sinew_status sinew_world_draw_debug(sinew_world world, const sinew_debug_draw* draw, double extent);

/* --- export: files of other programs, as bytes ------------------------------------------------------------------- */

typedef struct sinew_export {
    uint32_t id;
} sinew_export;
/* Wishes for a file. All zero but `struct_size` is a good start. */
typedef struct sinew_export_spec {
    uint32_t struct_size;
    uint32_t figure_count;
    const char* const* figures; /* names, of those that are written alone; none: everything */
    double fps;                 /* frames a second; 0: what is usual for the format */
    double error;               /* by which points may be off between keys: pixels of vectors, millimetres of a .glb;
                                   0: the format's own */
    uint32_t width, height;     /* pixels of vectors; 0: as the scene asks for */
    const char* background;     /* of vectors: "none", "#fa0"; null: the scene's */
    const char* follow;         /* of vectors: figure to keep in the middle; null: the scene's view */
    const char* caption;        /* of vectors: a line at the bottom; null: none */
} sinew_export_spec;
/* Begins a file. The ending of its name says the format: .glb, .pc2, .mdd, .obj, .ply, .svg, .json (Lottie), .csv or
 * .jsonl (a trace). An .obj or .ply holds a frame; a sequence has a place for the number, "silk-%04d.obj". `spec` may
 * be null. */
SINEW_PROGRAM_API sinew_status sinew_export_begin(const char* name, const sinew_export_spec* spec,
                                                  sinew_export* handle);
/* Adds the present moment of a world as the next frame: always the same world. Frames are 1 / fps apart. */
SINEW_PROGRAM_API sinew_status sinew_export_frame(sinew_export handle, sinew_world world);
/* Completes the files, after one frame or more; `count` is their number: a point cache has its .obj and .mtl beside. */
SINEW_PROGRAM_API sinew_status sinew_export_finish(sinew_export handle, uint32_t* count);
/* Name and bytes of a finished file, valid until the export is closed. The caller writes them where it likes. */
SINEW_PROGRAM_API sinew_status sinew_export_file(sinew_export handle, uint32_t index, const char** name,
                                                 const uint8_t** bytes, size_t* size);
/* A sentence about what the format could not take, or how exact the file is; SINEW_NOT_FOUND after the last. */
SINEW_PROGRAM_API sinew_status sinew_export_note(sinew_export handle, uint32_t index, const char** note);
SINEW_PROGRAM_API sinew_status sinew_export_close(sinew_export handle);

/* --- import: files of other programs as scenes -------------------------------------------------------------------- */

typedef struct sinew_import {
    uint32_t id;
} sinew_import;
/* Wishes for a scene, and files beside the imported one. All zero but `struct_size` is a good start. */
typedef struct sinew_import_spec {
    uint32_t struct_size;
    uint32_t file_count;           /* files that the imported one may refer to: buffers, tilesets */
    const char* const* file_names; /* as it calls them, or the last part of that */
    const uint8_t* const* file_bytes;
    const size_t* file_sizes;
    const char* role; /* of shapes whose names tell nothing: "jelly", "collider"; null: the format's own */
    double error;     /* largest distance of a simplified outline, pixels; 0: the format's own */
    double scale;     /* length in the scene of a unit of the file; 0: the format's own */
} sinew_import_spec;
/* Makes a scene of an SVG, a PNG, an OBJ, a glTF, a map of Tiled or Coding Math's points and sticks, by content or else
 * by the ending of `name`. On SINEW_BAD_ARGUMENT sinew_message() has the place in the file: "logo.svg:12:3: ...".
 * `spec` may be null. */
SINEW_PROGRAM_API sinew_status sinew_import_open(const char* name, const uint8_t* bytes, size_t size,
                                                 const sinew_import_spec* spec, sinew_import* handle);
/* The text of the scene, valid until the import is closed. */
SINEW_PROGRAM_API sinew_status sinew_import_scene(sinew_import handle, const char** scene);
/* A file that the scene refers to, an image or a model; SINEW_NOT_FOUND after the last. */
SINEW_PROGRAM_API sinew_status sinew_import_file(sinew_import handle, uint32_t index, const char** name,
                                                 const uint8_t** bytes, size_t* size);
/* Something that a scene cannot hold, with its place in the file ("12:3", "" for the whole); SINEW_NOT_FOUND after the
 * last. */
SINEW_PROGRAM_API sinew_status sinew_import_note(sinew_import handle, uint32_t index, const char** place,
                                                 const char** note);
SINEW_PROGRAM_API sinew_status sinew_import_close(sinew_import handle);

/* --- hooks, set before any other thread calls the library -------------------------------------------------------- */

/* Is told of every failure, in its thread, as sinew_message() has it; not of those of its own calls. Null: nobody. */
typedef void (*sinew_log)(void* context, sinew_status status, const char* message);
SINEW_PROGRAM_API void sinew_set_log(sinew_log log, void* context);
/* Receives a broken assertion of a library that checks them (SINEW_ASSERTIONS). Null: prints it and aborts. */
typedef void (*sinew_assertion_handler)(const char* file, int line, const char* text);
SINEW_PROGRAM_API void sinew_set_assertion_handler(sinew_assertion_handler handler);

/* The caller's threads in place of the library's: calls task(task_context, i) for each i below `count` once, on any
 * threads, and returns when all calls have. Meanwhile the world that steps may be read, and not be changed; a player
 * that advances is not called. */
typedef void (*sinew_parallel)(void* context, void (*task)(void* task_context, uint32_t index), void* task_context,
                               uint32_t count);
/* Null: the library's own threads. Results do not depend on it. */
SINEW_PROGRAM_API void sinew_set_parallel(sinew_parallel parallel, void* context);
/* The same for a task system with handles: `enqueue` begins task(task_context, index) on any thread and returns a
 * handle, or calls it at once and returns null; `finish` waits until the task of a handle is done. */
typedef void* (*sinew_enqueue)(void* context, void (*task)(void* task_context, uint32_t index), void* task_context,
                               uint32_t index);
typedef void (*sinew_finish)(void* context, void* handle);
/* Both null: the library's own threads. SINEW_BAD_ARGUMENT if one is null. */
SINEW_PROGRAM_API sinew_status sinew_set_task_system(sinew_enqueue enqueue, sinew_finish finish, void* context);
/* The same for the steps of one world, in place of those for all; null: those for all. Copies have none of their own.
 */
SINEW_PROGRAM_API sinew_status sinew_world_set_parallel(sinew_world world, sinew_parallel parallel, void* context);
SINEW_PROGRAM_API sinew_status sinew_world_set_task_system(sinew_world world, sinew_enqueue enqueue,
                                                           sinew_finish finish, void* context);
/* Threads of a world; 0: as many as there are cores. 1 never starts any. */
SINEW_PROGRAM_API sinew_status sinew_world_set_threads(sinew_world world, uint32_t threads);
/* Instruction set of a world: "one", "sse2", "avx2", "avx512", "neon"; null: the best, as sinew_simd() has it.
 * Results do not depend on it. SINEW_NOT_FOUND for one that the processor or the library has not. */
SINEW_PROGRAM_API sinew_status sinew_world_set_simd(sinew_world world, const char* name);

/* Memory of the library. `alignment` is a power of 2. Null ends the program (std::terminate): where memory may run out,
 * the function makes room before it returns. `release` gets the size that was asked for. Both may be called by any
 * thread that steps. `context` outlives all blocks, those of the library's own tables and messages included. */
typedef void* (*sinew_allocate_function)(void* context, size_t size, size_t alignment);
typedef void (*sinew_release_function)(void* context, void* memory, size_t size);
/* Null: malloc and free. Blocks go back to where they came from, so the allocator may change at any time. Steps of a
 * world that is not edited allocate nothing. A program that is linked with the archive libsinew.a has the allocator
 * for all of its C++. */
SINEW_PROGRAM_API sinew_status sinew_set_allocator(sinew_allocate_function allocate, sinew_release_function release,
                                                   void* context);

#ifdef __cplusplus
}
#endif

#endif
