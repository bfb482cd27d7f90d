# The command, and what it is made of beside the painters: the player, its window, and the benchmarks.

# --- other programs' files, in and out --------------------------------------------------------------------------
add_library(sinew_files STATIC ${folder_files} ${painted_files} $<TARGET_OBJECTS:sinew_export>
    $<TARGET_OBJECTS:sinew_import> ${headers})
target_link_libraries(sinew_files PUBLIC canvas sinew PRIVATE fmt::fmt nlohmann_json::nlohmann_json)
sinew_app(sinew_files)
target_precompile_headers(sinew_files REUSE_FROM canvas)

# --- interactive player, independent of the window ----------------------------------------------------------------
add_library(play STATIC $<TARGET_OBJECTS:sinew_player> ${player_files})
target_link_libraries(play PUBLIC canvas sinew PRIVATE fmt::fmt)
sinew_app(play)
target_precompile_headers(play REUSE_FROM canvas)

if(SINEW_PYTHON)
    include(cmake/python.cmake)
endif()

# --- window -------------------------------------------------------------------------------------------------------
sinew_watch_packages(sdl2 imgui epoxy)
if(SINEW_WINDOW STREQUAL "AUTO")
    pkg_check_modules(window_needs QUIET IMPORTED_TARGET sdl2 imgui epoxy)
elseif(SINEW_WINDOW)
    pkg_check_modules(window_needs REQUIRED IMPORTED_TARGET sdl2 imgui epoxy)
endif()
if(SINEW_WINDOW AND window_needs_FOUND)
    sinew_sources(apps/window)
    add_library(window STATIC ${sources} ${headers})
    target_link_libraries(window PUBLIC play PRIVATE PkgConfig::window_needs Threads::Threads)
    target_compile_definitions(window INTERFACE SINEW_WINDOW)
    sinew_app(window)
    sinew_precompile(window "sinew/session/session.h") # SDL defines a word: a precompiled header of its own
endif()

# --- benchmark cases and contenders --------------------------------------------------------------------------------
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/bench/*.cpp ${PROJECT_SOURCE_DIR}/bench/families/*.cpp)
add_library(bench STATIC ${sources})
target_link_libraries(bench PUBLIC sinew PRIVATE fmt::fmt)
sinew_app(bench)
target_precompile_headers(bench REUSE_FROM canvas)
# Only the textbook runs inside the timed sections.
set_source_files_properties(bench/textbook.cpp PROPERTIES COMPILE_OPTIONS $<$<NOT:$<CONFIG:Debug>>:-O3>
    SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
# Families define constants and functions of the same names.
list(FILTER sources INCLUDE REGEX "/families/")
set_source_files_properties(${sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
if(SINEW_PEERS)
    include(cmake/peers.cmake)
else()
    target_sources(bench PRIVATE bench/peers/none.cpp)
endif()

# --- command line ------------------------------------------------------------------------------------------------
sinew_sources(apps/cli)
# `render` alone is all that the first picture needs.
set(render_sources ${sources})
list(FILTER render_sources INCLUDE REGEX "/(main|arguments|catalogue|console|help|pointer_file|process_limits|render|scene_file|scrap|shooting|stage|stepping|watched_files)[.]cpp")
list(APPEND render_sources ${PROJECT_SOURCE_DIR}/player/action.cpp) # what a pointer does

# sinew_command(NAME SOURCE...)
function(sinew_command name)
    add_executable(${name} ${ARGN} ${headers})
    target_link_libraries(${name} PRIVATE canvas sinew fmt::fmt CLI11::CLI11)
    sinew_app(${name})
    target_precompile_headers(${name} REUSE_FROM canvas)
    if(CMAKE_POSITION_INDEPENDENT_CODE) # the precompiled header has -fPIC, where a program alone has -fPIE
        target_compile_options(${name} PRIVATE ${CMAKE_CXX_COMPILE_OPTIONS_PIC})
    endif()
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
endfunction()

if(SINEW_ONLY_RENDER)
    sinew_command(sinew_cli ${render_sources})
    target_compile_definitions(sinew_cli PRIVATE SINEW_ONLY_COMMAND=render)
else()
    sinew_command(sinew_cli ${sources})
    target_link_libraries(sinew_cli PRIVATE $<TARGET_NAME_IF_EXISTS:window> play bench sinew_files ${CMAKE_DL_LIBS})
    # A level, a shared object that `play` loads, calls the C face of the command.
    target_sources(sinew_cli PRIVATE $<TARGET_OBJECTS:sinew_face>)
    target_link_options(sinew_cli PRIVATE LINKER:--export-dynamic-symbol=sinew_*)
    if(SINEW_TESTS) # a file that it lacks is told by the linker alone
        sinew_command(render_alone ${render_sources})
        target_compile_definitions(render_alone PRIVATE SINEW_ONLY_COMMAND=render)
    endif()
endif()
set_source_files_properties(apps/cli/catalogue.cpp PROPERTIES
    COMPILE_DEFINITIONS SINEW_SCENES_DIR="${PROJECT_SOURCE_DIR}/scenes")
set_source_files_properties(apps/cli/compiler.cpp PROPERTIES
    COMPILE_DEFINITIONS SINEW_INCLUDE_DIR="${PROJECT_SOURCE_DIR}/bindings/c")
set_source_files_properties(apps/cli/bench_weights.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON) # shared names
set_target_properties(sinew_cli PROPERTIES OUTPUT_NAME sinew)
