# The WebAssembly module of web/sinew: the C face (bindings/c) on the library and the player, without any import.
# Everything is compiled into one module; files, threads and clocks are absent (bindings/wasm/no_system.cpp).

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
list(FILTER all EXCLUDE REGEX "/kernel_(avx[0-9]+|one)[.]cpp")
# The kernels are compiled for speed, the solver around them for size as long as it costs little speed; what reads
# scenes, builds figures and answers a pointer, for size.
set(small ${all})
list(FILTER small INCLUDE REGEX "/sinew/(scene|prefab|session|picture)/|/apps/|/bindings/|/canvas/")
set(fast ${all})
list(REMOVE_ITEM fast ${small})
add_library(wasm_small OBJECT ${small})
target_compile_options(wasm_small PRIVATE -Oz)
add_library(wasm_fast OBJECT ${fast})
target_compile_options(wasm_fast PRIVATE -Oz)
file(GLOB kernels ${PROJECT_SOURCE_DIR}/sinew/solver/kernel_*.cpp)
set_source_files_properties(${kernels} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON COMPILE_OPTIONS -O2)
# Every engine of WebAssembly that runs the module has its SIMD.
set_property(SOURCE sinew/solver/kernel.cpp APPEND PROPERTY COMPILE_DEFINITIONS SINEW_NO_ONE)

add_executable(sinew_wasm $<TARGET_OBJECTS:wasm_small> $<TARGET_OBJECTS:wasm_fast>)
foreach(part IN ITEMS wasm_small wasm_fast)
    target_compile_options(${part} PRIVATE -ffp-contract=off -fvisibility=hidden)
    target_compile_definitions(${part} PRIVATE NDEBUG FMT_HEADER_ONLY FMT_STATIC_THOUSANDS_SEPARATOR=',' JSON_NOEXCEPTION)
    target_include_directories(${part} PRIVATE ${PROJECT_SOURCE_DIR})
    target_include_directories(${part} SYSTEM PRIVATE ${host_headers})
    sinew_warnings(${part})
endforeach()

# The exports are the functions that the C header declares.
file(STRINGS bindings/c/sinew.h declarations REGEX "^SINEW_API ")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS bindings/c/sinew.h)
set(exports)
foreach(declaration IN LISTS declarations)
    string(REGEX MATCH "sinew_[a-z0-9_]+\\(" name ${declaration})
    string(REPLACE "(" "" name ${name})
    list(APPEND exports -Wl,--export=${name})
endforeach()
# A last -O0 keeps clang from running any wasm-opt of the machine.
target_link_options(sinew_wasm PRIVATE -mexec-model=reactor -Wl,--strip-all -Wl,--gc-sections -Wl,-z,stack-size=1048576
    ${exports} -O0)
set_target_properties(sinew_wasm PROPERTIES OUTPUT_NAME sinew SUFFIX .wasm RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
