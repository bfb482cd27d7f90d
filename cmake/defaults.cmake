# Defaults of a top-level build. A project that adds Sinew as a subdirectory keeps its own choices.
if(PROJECT_IS_TOP_LEVEL)
    if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
        set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug, RelWithDebInfo or MinSizeRel" FORCE)
    endif()
    set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)

# -Wconversion finds lost precision; -Wsign-conversion would add too many warnings about index arithmetic. The last two
# flags silence false positives about the standard library: g++ 12 at string concatenation (GCC bug 105651), clang 19
# inside libstdc++'s std::stable_sort.
function(sinew_warnings target)
    # In a unity build the local names of one file are visible in the others.
    set(unity_warnings -Wno-shadow)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        list(APPEND unity_warnings -Wno-subobject-linkage -Wno-maybe-uninitialized)
    endif()
    target_compile_options(${target} PRIVATE
        -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wshadow $<$<BOOL:${SINEW_WERROR}>:-Werror>
        $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>
        "$<$<BOOL:${CMAKE_UNITY_BUILD}>:${unity_warnings}>"
        "$<$<BOOL:${worlds_left_out}>:-Wno-unused-function>")
endfunction()

# sinew_precompile(TARGET HEADER...): what most files of a target include is compiled once: these headers, the standard
# library and fmt. `./dev check clang` builds without (CMAKE_DISABLE_PRECOMPILE_HEADERS), and so finds what a file forgot
# to include. g++ 12 reports strings of the precompiled library wrongly (its bug 105651).
function(sinew_precompile target)
    list(TRANSFORM ARGN PREPEND "${PROJECT_SOURCE_DIR}/" OUTPUT_VARIABLE headers)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <functional> <limits> <memory>
        <optional> <span> <string> <string_view> <tuple> <utility> <variant> <vector> ${headers})
    target_compile_options(${target} PRIVATE
        "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-maybe-uninitialized>")
endfunction()

# sinew_app(TARGET): a target around the library, which takes the time. All have the same options, and so can have one
# precompiled header.
function(sinew_app target)
    target_link_libraries(${target} PRIVATE $<TARGET_NAME_IF_EXISTS:fmt::fmt>) # its definition is part of the precompiled header
    target_compile_options(${target} PRIVATE $<IF:$<CONFIG:Debug>,-O0,-Og>)
    sinew_warnings(${target})
endfunction()
