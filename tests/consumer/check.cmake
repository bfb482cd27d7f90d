# Takes the program out of README.md (the ```cpp block after <!-- hello -->), installs Sinew, and builds and runs the
# program against the installed tree: once by find_package, once by pkg-config.
set(work ${build}/consumer)
set(prefix ${work}/prefix)

function(run)
    execute_process(COMMAND ${ARGV} RESULT_VARIABLE code)
    if(NOT code EQUAL 0)
        list(JOIN ARGV " " line)
        message(FATAL_ERROR "failed (${code}): ${line}")
    endif()
endfunction()

# Sets `program` to the text between `opening` and the fence that closes it.
function(take_program readme)
    file(READ ${readme} text)
    set(opening "<!-- hello -->\n```cpp\n")
    string(FIND "${text}" "${opening}" start)
    if(start EQUAL -1)
        message(FATAL_ERROR "${readme} has no ```cpp block right after a line <!-- hello -->")
    endif()
    string(LENGTH "${opening}" skip)
    math(EXPR start "${start} + ${skip}")
    string(SUBSTRING "${text}" ${start} -1 text)
    string(FIND "${text}" "```" end)
    string(SUBSTRING "${text}" 0 ${end} text)
    set(program "${text}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${work})
take_program(${source}/README.md)
file(WRITE ${work}/hello.cpp "${program}")
run(${CMAKE_COMMAND} --install ${build} --prefix ${prefix})

run(${CMAKE_COMMAND} -G Ninja -S ${source}/tests/consumer -B ${work}/build -D HELLO_SOURCE=${work}/hello.cpp
    -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_CXX_FLAGS=${flags}
    -D CMAKE_BUILD_TYPE=${type})
run(${CMAKE_COMMAND} --build ${work}/build)
run(${work}/build/hello)

run(sh -c "PKG_CONFIG_PATH=$(dirname $(find ${prefix} -name sinew.pc)) &&
    export PKG_CONFIG_PATH &&
    ${compiler} ${flags} ${work}/hello.cpp -o ${work}/hello $(pkg-config --cflags --libs sinew) && ${work}/hello")
