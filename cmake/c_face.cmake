# The C face, for C and every language that can call C: sinew::c. libsinew.a and libsinew.so hold all of the engine, and
# need neither files nor painters (bindings/no_files.cpp).
file(STRINGS bindings/c/sinew.h abi REGEX "^#define SINEW_ABI ")
string(REGEX MATCH "[0-9]+" abi "${abi}")

sinew_sources(player)
set(player_files ${sources})
list(FILTER player_files INCLUDE REGEX "/player/(files|folder|script)[.]cpp")
list(REMOVE_ITEM sources ${player_files})
add_library(sinew_player OBJECT ${sources} ${headers})
# Models and vectors as bytes; what paints, or writes to disk, is the command's (cmake/command.cmake).
sinew_sources(files/out)
set(painted_files ${sources})
list(FILTER painted_files INCLUDE REGEX "/files/out/(alpha_film|output_file|picture_frames|pixel_writer)[.]cpp")
list(REMOVE_ITEM sources ${painted_files})
add_library(sinew_export OBJECT ${sources} ${headers})
target_link_libraries(sinew_export PRIVATE $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)
# Readers of other programs' files; what reads a folder, or moves a model, is the command's.
sinew_sources(files/in)
set(folder_files ${sources})
list(FILTER folder_files INCLUDE REGEX "/files/in/(folder_file|posed_model|gltf_amending|bone_turns)[.]cpp")
list(REMOVE_ITEM sources ${folder_files})
add_library(sinew_import OBJECT ${sources} ${headers})
sinew_sources(bindings/c)
# Operators new and delete are those of a whole program: for the libraries alone.
list(REMOVE_ITEM sources ${PROJECT_SOURCE_DIR}/bindings/c/native/allocator.cpp)
add_library(sinew_face OBJECT ${sources} ${headers})
foreach(part IN ITEMS sinew_player sinew_export sinew_import sinew_face)
    target_link_libraries(${part} PUBLIC sinew)
    sinew_app(${part})
endforeach()
if(TARGET canvas)
    target_precompile_headers(sinew_player REUSE_FROM canvas)
    target_precompile_headers(sinew_export REUSE_FROM canvas)
    if(NOT SINEW_FUZZ) # instrumented files cannot have the precompiled header of others
        target_precompile_headers(sinew_import REUSE_FROM canvas)
    endif()
    target_precompile_headers(sinew_face REUSE_FROM canvas)
else()
    sinew_precompile(sinew_player "sinew/session/session.h")
    target_precompile_headers(sinew_export REUSE_FROM sinew_player)
    target_precompile_headers(sinew_import REUSE_FROM sinew_player)
    target_precompile_headers(sinew_face REUSE_FROM sinew_player)
endif()

set(parts $<TARGET_OBJECTS:sinew> $<TARGET_OBJECTS:sinew_once> $<TARGET_OBJECTS:sinew_face>
    $<TARGET_OBJECTS:sinew_player> $<TARGET_OBJECTS:sinew_export> $<TARGET_OBJECTS:sinew_import>
    bindings/no_files.cpp bindings/no_folder.cpp canvas/beside.cpp bindings/c/native/allocator.cpp)

# sinew_c_library(TARGET KIND): the C face as a library that C programs need nothing beside.
function(sinew_c_library target kind)
    add_library(${target} ${kind} ${parts})
    target_link_libraries(${target} PRIVATE Threads::Threads)
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}
        INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/bindings/c> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    set_target_properties(${target} PROPERTIES OUTPUT_NAME sinew LINKER_LANGUAGE CXX UNITY_BUILD OFF)
    sinew_warnings(${target})
endfunction()

sinew_c_library(sinew_c STATIC)
target_link_libraries(sinew_c INTERFACE $<$<LINK_LANGUAGE:C>:stdc++> m) # for projects without a C++ compiler
set_target_properties(sinew_c PROPERTIES EXPORT_NAME c_static EXCLUDE_FROM_ALL $<NOT:$<OR:$<BOOL:${SINEW_TESTS}>,$<BOOL:${SINEW_INSTALL}>>>)
if(SINEW_SHARED)
    # C functions are the only symbols: neither C++ of the engine nor of the standard library (bindings/c/symbols.map).
    sinew_c_library(sinew_shared SHARED)
    target_link_options(sinew_shared PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/bindings/c/symbols.map -Wl,--gc-sections -Wl,-z,defs
        -static-libstdc++ -static-libgcc) # the standard library's memory, too, is that of sinew_set_allocator
    set_target_properties(sinew_shared PROPERTIES EXPORT_NAME c VERSION ${abi}.${PROJECT_VERSION} SOVERSION ${abi}
        LINK_DEPENDS ${PROJECT_SOURCE_DIR}/bindings/c/symbols.map)
    add_library(sinew::c ALIAS sinew_shared)
else()
    add_library(sinew::c ALIAS sinew_c)
endif()
