# Sets `sources` and `headers` to the files of one folder. A new file needs no line here: every build looks again.
function(sinew_sources folder)
    file(GLOB_RECURSE found_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
    file(GLOB_RECURSE found_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.h)
    set(sources ${found_sources} PARENT_SCOPE)
    set(headers ${found_headers} PARENT_SCOPE)
endfunction()

# What many files of a target include, compiled once. Only for a first build (./dev), as CMAKE_UNITY_BUILD is: who
# changes a file should see what it forgot to include.
function(sinew_precompile target)
    if(CMAKE_UNITY_BUILD)
        target_precompile_headers(${target} PRIVATE <algorithm> <array> <functional> <map> <memory> <optional> <span>
            <string> <string_view> <variant> <vector> <fmt/format.h> ${ARGN})
    endif()
endfunction()
