/* CHECK of the programs in C: prints a condition that fails, with the face's message, and counts it. */
#pragma once

#include "bindings/c/sinew.h"

#include <stdio.h>

static int failures = 0;

#define CHECK(condition)                                                                                               \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            printf("%s:%d: %s (%s)\n", __FILE__, __LINE__, #condition, sinew_message());                               \
            ++failures;                                                                                                \
        }                                                                                                              \
    } while (0)
