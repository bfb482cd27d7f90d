# fuzz/NAME.cpp -> bin/NAME, a fuzzer per file. Needs clang.
sinew_sources(fuzz)
foreach(source IN LISTS sources)
    cmake_path(GET source STEM name)
    add_executable(${name} ${source})
    target_link_libraries(${name} PRIVATE sinew fmt::fmt -fsanitize=fuzzer)
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
    sinew_warnings(${name})
endforeach()
