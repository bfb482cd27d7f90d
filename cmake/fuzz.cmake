# fuzz/NAME.cpp -> bin/NAME, a fuzzer per file, and a test that runs it. Needs clang. Only what runs once, the
# reader of text among it, tells which of its branches have been taken: the build serves the other tests, too. A seed of
# 0 is another one every time.
target_compile_options(sinew_once PRIVATE -fsanitize=fuzzer-no-link)
target_compile_options(sinew_import PRIVATE -fsanitize=fuzzer-no-link)

# fuzz_test(PROGRAM): new inputs go to the first folder; the corpus is in the tree.
function(fuzz_test name)
    file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/found/${name})
    add_test(NAME fuzz.${name} COMMAND sh -c "bin/${name} -seed=\${FUZZ_SEED:-2001} -max_total_time=\${FUZZ_SECONDS:-20} \
        -timeout=10 -rss_limit_mb=2048 -max_len=4096 -print_final_stats=1 -artifact_prefix=found/${name}/ found/${name} \
        ${PROJECT_SOURCE_DIR}/fuzz/corpus/${name} ${PROJECT_SOURCE_DIR}/tests/hostile"
        WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
    set_tests_properties(fuzz.${name} PROPERTIES COST 800 TIMEOUT 3600)
endfunction()

sinew_sources(fuzz)
add_custom_target(fuzzers)
foreach(source IN LISTS sources)
    cmake_path(GET source STEM name)
    add_executable(${name} ${source})
    target_link_libraries(${name} PRIVATE sinew_face sinew_files play sinew fmt::fmt -fsanitize=fuzzer)
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
    sinew_warnings(${name})
    add_dependencies(fuzzers ${name})
    if(NOT name STREQUAL import_fuzz)
        fuzz_test(${name})
    endif()
endforeach()

# One program with a target for each reader of files, known by the name it is called by.
foreach(format IN ITEMS svg png obj glb gltf tmj json)
    add_custom_command(TARGET import_fuzz POST_BUILD
        COMMAND ${CMAKE_COMMAND} -E create_symlink import_fuzz ${PROJECT_BINARY_DIR}/bin/import_fuzz_${format})
    fuzz_test(import_fuzz_${format})
endforeach()
