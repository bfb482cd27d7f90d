# The WebAssembly modules of web/sinew: the C face (bindings/c) on the library and the player, without any import, once
# with worlds of double and once with worlds of float. Files, threads and clocks are absent (bindings/wasm/no_system.cpp).

# Header-only libraries are the host's; the host's C headers must stay out of the search path.
set(host_headers ${PROJECT_BINARY_DIR}/host_headers)
file(MAKE_DIRECTORY ${host_headers})
foreach(name IN ITEMS fmt nlohmann xxhash.h)
    file(CREATE_LINK /usr/include/${name} ${host_headers}/${name} SYMBOLIC)
endforeach()

set(all)
foreach(folder IN ITEMS sinew apps/play bindings/c bindings/wasm)
    sinew_sources(${folder})
    list(APPEND all ${sources})
endforeach()
list(APPEND all ${PROJECT_SOURCE_DIR}/canvas/beside.cpp) # put_beside: a picture of pictures
list(FILTER all EXCLUDE REGEX "/apps/play/(files|folder|script)[.]cpp") # bindings/wasm/no_files.cpp
list(FILTER all EXCLUDE REGEX "/kernel_(avx[0-9]+|one)[.]cpp") # every engine has SIMD
set_property(SOURCE sinew/solver/kernel.cpp APPEND PROPERTY COMPILE_DEFINITIONS SINEW_NO_ONE)
# The kernels, where the time goes, are compiled for speed, and all else for size.
set_source_files_properties(sinew/solver/kernel_sse2.cpp PROPERTIES
    SKIP_UNITY_BUILD_INCLUSION ON COMPILE_OPTIONS -O2)

# The exports are the functions that the C header declares.
file(STRINGS bindings/c/sinew.h declarations REGEX "^SINEW_API ")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS bindings/c/sinew.h)
set(exports)
foreach(declaration IN LISTS declarations)
    string(REGEX MATCH "sinew_[a-z0-9_]+\\(" name ${declaration})
    string(REPLACE "(" "" name ${name})
    list(APPEND exports -Wl,--export=${name})
endforeach()

# sinew_module(NAME REAL): bin/NAME.wasm, with worlds of one precision, and the linker's map beside it.
function(sinew_module name real)
    add_executable(${name} ${all})
    target_compile_options(${name} PRIVATE -Oz ${SINEW_WASM_FLAGS} -ffp-contract=off -fvisibility=hidden -fno-threadsafe-statics
        -fno-c++-static-destructors)
    target_compile_definitions(${name} PRIVATE NDEBUG FMT_HEADER_ONLY FMT_STATIC_THOUSANDS_SEPARATOR=',' JSON_NOEXCEPTION
        SINEW_ONE_PRECISION=${real})
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_include_directories(${name} SYSTEM PRIVATE ${host_headers})
    sinew_warnings(${name})
    # A last -O0 keeps clang from running any wasm-opt of the machine.
    target_link_options(${name} PRIVATE -mexec-model=reactor -Wl,--strip-all -Wl,--gc-sections -Wl,-z,stack-size=1048576
        -Wl,-Map=${PROJECT_BINARY_DIR}/bin/${name}.map ${exports} ${SINEW_WASM_LINK} -O0)
    set_target_properties(${name} PROPERTIES SUFFIX .wasm RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
endfunction()

sinew_module(sinew double)
sinew_module(sinew-float float)
add_custom_target(sinew_wasm DEPENDS sinew sinew-float)
