# The WebAssembly modules of web/sinew: the C face (bindings/c) on the library and the player, without any import, once
# with worlds of double and once with worlds of float. Files, threads and clocks are absent (bindings/wasm/no_system.cpp).

# Header-only libraries are the host's; the host's C headers must stay out of the search path.
set(host_headers ${PROJECT_BINARY_DIR}/host_headers)
file(MAKE_DIRECTORY ${host_headers})
foreach(name IN ITEMS nlohmann xxhash.h)
    file(CREATE_LINK /usr/include/${name} ${host_headers}/${name} SYMBOLIC)
endforeach()

set(all)
foreach(folder IN ITEMS sinew player bindings/c bindings/wasm)
    sinew_sources(${folder})
    list(APPEND all ${sources})
endforeach()
list(FILTER all EXCLUDE REGEX "/player/(files|folder|script)[.]cpp|/bindings/c/native/|/bindings/wasm/exceptions[.]cpp")
list(APPEND all canvas/beside.cpp bindings/no_files.cpp bindings/c/native/world.cpp bindings/c/native/collider.cpp
    bindings/c/native/collider_shape.cpp bindings/c/native/figure.cpp)
list(TRANSFORM all PREPEND ${PROJECT_SOURCE_DIR}/ REGEX "^[^/]")
list(FILTER all EXCLUDE REGEX "/targets/(avx[0-9]+|one)[.]cpp") # every engine has SIMD
set_property(SOURCE sinew/solver/simd/kernel.cpp APPEND PROPERTY COMPILE_DEFINITIONS SINEW_NO_ONE SINEW_NO_AVX2 SINEW_NO_AVX512)
# The files where the time goes are compiled for speed, and all else for size. Blocks weigh 5 % of the module more, and
# ragdolls are six times as fast; pictures and the step weigh 5 %, and cloth is drawn three to five times as fast and
# stepped up to twice as fast. Unrolled and vectorized loops would weigh another 1 % and win nothing.
set_source_files_properties(sinew/solver/simd/targets/sse2.cpp sinew/solver/direct/step_blocks.cpp
    sinew/picture/draw.cpp sinew/picture/outline.cpp sinew/solver/step/step.cpp PROPERTIES
    SKIP_UNITY_BUILD_INCLUSION ON COMPILE_OPTIONS "-O2;-fno-unroll-loops;-fno-vectorize;-fno-slp-vectorize")

# The exports are the functions that the C header declares.
file(STRINGS bindings/c/sinew.h declarations REGEX "^SINEW_API ")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS bindings/c/sinew.h)
set(exports)
foreach(declaration IN LISTS declarations)
    string(REGEX MATCH "sinew_[a-z0-9_]+\\(" name ${declaration})
    string(REPLACE "(" "" name ${name})
    list(APPEND exports -Wl,--export=${name})
endforeach()

# Decimal numbers are the engine's own (sinew/math/decimal.h), in place of the C library's in 128-bit arithmetic.
# A last -O0 keeps clang from running any wasm-opt of the machine.
# The exports of a module are all of these, or those named.
function(sinew_wasm_options name)
    if(ARGN)
        list(TRANSFORM ARGN PREPEND -Wl,--export= OUTPUT_VARIABLE exports)
    endif()
    # Functions of 2D and 3D, of one record and another, are often the same code: compiled once, they save 14 KB.
    target_compile_options(${name} PRIVATE -Oz -Xclang -fmerge-functions -ffp-contract=off -fno-math-errno
        -fvisibility=hidden -fno-threadsafe-statics -fno-c++-static-destructors)
    target_compile_definitions(${name} PRIVATE NDEBUG JSON_NOEXCEPTION
        ${worlds_left_out} SINEW_SMALL)
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_include_directories(${name} SYSTEM PRIVATE ${host_headers})
    sinew_warnings(${name})
    target_link_options(${name} PRIVATE -mexec-model=reactor -Wl,--strip-all -Wl,--gc-sections -Wl,--compress-relocations -Wl,-z,stack-size=1048576
        -Wl,-Map=${PROJECT_BINARY_DIR}/bin/${name}.map ${exports} -Wl,--wrap=strtod -lc-printscan-no-floating-point -O0)
    set_target_properties(${name} PROPERTIES SUFFIX .wasm RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
endfunction()

# What divides work among threads is compiled twice: for one thread, and for shared memory.
set(shared ${all})
list(FILTER shared INCLUDE REGEX "/solver/([a-z_]+/)?(step|quarantine|wavefront|workers[a-z_]*)[.]cpp|/wasm/serve[.]cpp")
list(REMOVE_ITEM all ${shared})

# sinew_modules(NAME REAL): bin/NAME.wasm, with worlds of one precision, bin/NAME-threads.wasm, and the linker's maps.
function(sinew_modules name real)
    set(SINEW_WORLDS 2-${real} 3-${real})
    include(cmake/worlds.cmake)
    add_library(${name}-objects OBJECT ${all})
    add_library(${name}-alone OBJECT ${shared})
    add_executable(${name} $<TARGET_OBJECTS:${name}-objects> $<TARGET_OBJECTS:${name}-alone>)
    add_executable(${name}-threads $<TARGET_OBJECTS:${name}-objects> ${shared})
    foreach(target IN ITEMS ${name}-objects ${name}-alone ${name} ${name}-threads)
        sinew_wasm_options(${target})
    endforeach()
    # thread_local is for stopwatches, which no page has: plain in every object. Nothing that workers call allocates, so
    # the C library may do without atomics.
    target_compile_options(${name}-threads PRIVATE -matomics -mbulk-memory -Dthread_local=)
    target_link_options(${name}-threads PRIVATE -Wl,--shared-memory -Wl,--no-check-features -Wl,--import-memory
        -Wl,--initial-memory=33554432 -Wl,--max-memory=1073741824 -Wl,--export=__stack_pointer -Wl,--export=sinew_serve)
endfunction()

sinew_modules(sinew double)
sinew_modules(sinew-float float)

# bin/sinew-export.wasm: the same engine and the formats of files/out that need no painter. A page loads it when a file is
# asked for (web/sinew/export.js).
set(SINEW_WORLDS 2-double 3-double)
include(cmake/worlds.cmake)
sinew_sources(files/out)
list(FILTER sources EXCLUDE REGEX "/files/out/(alpha_film|output_file|picture_frames|pixel_writer)[.]cpp")
add_executable(sinew-export ${sources} bindings/c/native/export.cpp $<TARGET_OBJECTS:sinew-objects> $<TARGET_OBJECTS:sinew-alone>)
sinew_wasm_options(sinew-export)
file(STRINGS bindings/c/sinew.h declarations REGEX "^SINEW_PROGRAM_API sinew_status sinew_export_")
foreach(declaration IN LISTS declarations)
    string(REGEX MATCH "sinew_export_[a-z]+" name ${declaration})
    target_link_options(sinew-export PRIVATE -Wl,--export=${name})
endforeach()

# bin/sinew-import.wasm: the readers of files/in, and of the engine as much as they need: no solver, no world. A page loads
# it when such a file is dropped (web/sinew/import.js). The readers throw; exceptions of WebAssembly need little of a
# runtime (bindings/wasm/exceptions.cpp).
sinew_sources(files/in)
list(FILTER sources EXCLUDE REGEX "/files/in/(folder_file|posed_model|gltf_amending|bone_turns)[.]cpp")
list(APPEND sources bindings/c/native/import.cpp bindings/c/failure.cpp bindings/c/memory.cpp bindings/no_folder.cpp
    bindings/wasm/no_system.cpp bindings/wasm/numbers.cpp bindings/wasm/exceptions.cpp files/out/deflate.cpp files/out/png_writer.cpp)
foreach(name IN ITEMS math/color math/decimal math/format collide/decompose scene/text scene/json scene/json_parse scene/json_syntax
        scene/json_text scene/diagnostic scene/svg_path scene/fill_rule prefab/obj prefab/jelly prefab/tetrahedra prefab/problem)
    list(APPEND sources sinew/${name}.cpp)
endforeach()
add_executable(sinew-import ${sources})
target_compile_options(sinew-import PRIVATE -fexceptions -fwasm-exceptions)
set_source_files_properties(bindings/wasm/exceptions.cpp PROPERTIES COMPILE_OPTIONS -frtti)
file(STRINGS bindings/c/sinew.h declarations REGEX "^SINEW_PROGRAM_API sinew_status sinew_import_")
string(REGEX MATCHALL "sinew_import_[a-z]+" names "${declarations}")
sinew_wasm_options(sinew-import ${names} sinew_abi sinew_allocate sinew_free sinew_message)
target_link_options(sinew-import PRIVATE -Wl,--max-memory=1073741824)
add_custom_target(sinew_wasm DEPENDS sinew sinew-threads sinew-float sinew-float-threads sinew-export sinew-import)
