# Configures again, at the next build, when a package of pkg-config has been installed or removed since: every build
# looks again for the files of a glob.
function(sinew_watch_packages)
    set(folders "$ENV{PKG_CONFIG_PATH}:$ENV{PKG_CONFIG_LIBDIR}")
    if(NOT DEFINED ENV{PKG_CONFIG_LIBDIR})
        execute_process(COMMAND ${PKG_CONFIG_EXECUTABLE} --variable=pc_path pkg-config
            OUTPUT_VARIABLE usual OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
        string(APPEND folders "${usual}")
    endif()
    string(REPLACE ":" ";" folders "${folders}")
    list(REMOVE_ITEM folders "")
    foreach(package IN LISTS ARGN)
        list(TRANSFORM folders APPEND "/${package}.pc" OUTPUT_VARIABLE files)
        file(GLOB found CONFIGURE_DEPENDS ${files})
    endforeach()
endfunction()
