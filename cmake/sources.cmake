# Sets `sources` and `headers` to the files of a folder. A new file needs no line here: every build repeats the glob.
function(sinew_sources folder)
    file(GLOB_RECURSE found_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
    file(GLOB_RECURSE found_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.h)
    set(sources ${found_sources} PARENT_SCOPE)
    set(headers ${found_headers} PARENT_SCOPE)
endfunction()
