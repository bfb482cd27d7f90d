# Takes the program out of README.md (the ```cpp block after <!-- hello -->) and that of docs/how/cpp.md (all of its ```cpp
# blocks), installs Sinew, and builds and runs them against the installed tree: once by find_package, once by pkg-config.
include(${source}/tests/page.cmake)
set(work ${build}/consumer)
set(prefix ${work}/prefix)

file(REMOVE_RECURSE ${work})
take_block(${source}/README.md hello cpp)
file(WRITE ${work}/hello.cpp "${block}")
take_blocks(${source}/docs/how/cpp.md cpp)
file(WRITE ${work}/game.cpp "${block}")
run(${CMAKE_COMMAND} --install ${build} --prefix ${prefix})

run(${CMAKE_COMMAND} -G Ninja -S ${source}/tests/consumer -B ${work}/build -D FOLDER=${work}
    -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_CXX_FLAGS=${flags}
    -D CMAKE_BUILD_TYPE=${type})
run(${CMAKE_COMMAND} --build ${work}/build)
foreach(program IN ITEMS hello game)
    run(${work}/build/${program})
endforeach()

# The CMake lines of README.md, as pasted beside its program.
take_block(${source}/README.md hello cmake)
file(WRITE ${work}/pasted/CMakeLists.txt "${block}")
file(COPY ${work}/hello.cpp DESTINATION ${work}/pasted)
run(${CMAKE_COMMAND} -G Ninja -S ${work}/pasted -B ${work}/pasted/build -D CMAKE_PREFIX_PATH=${prefix}
    -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_CXX_FLAGS=${flags} -D CMAKE_BUILD_TYPE=${type})
run(${CMAKE_COMMAND} --build ${work}/pasted/build)
run(${work}/pasted/build/hello)

run(sh -c "PKG_CONFIG_PATH=$(dirname $(find ${prefix} -name sinew.pc)) &&
    export PKG_CONFIG_PATH &&
    ${compiler} ${flags} ${work}/hello.cpp -o ${work}/hello $(pkg-config --cflags --libs sinew) && ${work}/hello")
