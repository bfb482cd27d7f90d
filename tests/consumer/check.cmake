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
take_block(${source}/docs/how/game.md hello c)
file(WRITE ${work}/hello.c "${block}")
run(${CMAKE_COMMAND} --install ${build} --prefix ${prefix})

run(${CMAKE_COMMAND} -G Ninja -S ${source}/tests/consumer -B ${work}/build -D FOLDER=${work}
    -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_CXX_FLAGS=${flags}
    -D CMAKE_BUILD_TYPE=${type})
run(${CMAKE_COMMAND} --build ${work}/build)
foreach(program IN ITEMS hello game hello_c)
    run(${work}/build/${program})
endforeach()

# A component that does not exist is named.
file(WRITE ${work}/unknown/CMakeLists.txt
    "cmake_minimum_required(VERSION 3.25)\nproject(unknown LANGUAGES CXX)\nfind_package(sinew REQUIRED COMPONENTS cpp)\n")
execute_process(COMMAND ${CMAKE_COMMAND} -G Ninja -S ${work}/unknown -B ${work}/unknown/build -D CMAKE_PREFIX_PATH=${prefix}
    -D CMAKE_CXX_COMPILER=${compiler} RESULT_VARIABLE code OUTPUT_QUIET ERROR_VARIABLE said)
string(REGEX REPLACE "[ \n]+" " " said "${said}")
if(code EQUAL 0 OR NOT said MATCHES "sinew has no component cpp: its components are")
    message(FATAL_ERROR "find_package with an unknown component says: ${said}")
endif()

# The CMake lines of README.md, as pasted beside its program. Bash alone expands a tilde after "=".
file(READ ${source}/README.md readme)
if(readme MATCHES "=~/")
    message(FATAL_ERROR "README.md: a tilde after \"=\" is a folder called \"~\" in sh and zsh: write $HOME")
endif()
take_block(${source}/README.md hello cmake)
file(WRITE ${work}/pasted/CMakeLists.txt "${block}")
file(COPY ${work}/hello.cpp DESTINATION ${work}/pasted)
run(${CMAKE_COMMAND} -G Ninja -S ${work}/pasted -B ${work}/pasted/build -D CMAKE_PREFIX_PATH=${prefix}
    -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_CXX_FLAGS=${flags} -D CMAKE_BUILD_TYPE=${type})
run(${CMAKE_COMMAND} --build ${work}/pasted/build)
run(${work}/pasted/build/hello)

# pkg-config hands on every option and definition that find_package does: they are those of the library, for the same bits.
execute_process(COMMAND ninja -C ${work}/build -t commands hello OUTPUT_VARIABLE commands COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL " -(f[a-z-]+(=[a-z]+)?|DSINEW_[A-Z0-9_=]+|std=[a-z+0-9]+)" handed_on "${commands}")
execute_process(COMMAND sh -c "PKG_CONFIG_PATH=$(dirname $(find ${prefix} -name sinew.pc)) pkg-config --cflags sinew"
    OUTPUT_VARIABLE cflags COMMAND_ERROR_IS_FATAL ANY)
foreach(flag IN ITEMS " -ffp-contract=off" " -fno-math-errno" " -DSINEW_ASSERTIONS=")
    string(FIND "${commands}" "${flag}" at)
    if(at EQUAL -1)
        message(FATAL_ERROR "find_package does not hand on${flag}")
    endif()
endforeach()
foreach(flag IN LISTS handed_on)
    string(FIND " ${flags} ${cflags}" "${flag}" at)
    if(at EQUAL -1 AND NOT flag MATCHES "-std=gnu")
        message(FATAL_ERROR "pkg-config --cflags sinew lacks${flag}: ${cflags}")
    endif()
endforeach()

run(sh -c "PKG_CONFIG_PATH=$(dirname $(find ${prefix} -name sinew.pc)) &&
    export PKG_CONFIG_PATH &&
    ${compiler} ${flags} ${work}/hello.cpp -o ${work}/hello $(pkg-config --cflags --libs sinew) && ${work}/hello")
# A compiler of C adds no library of C++.
string(REPLACE "clang++" "clang" c_compiler "${compiler}")
string(REPLACE "g++" "gcc" c_compiler "${c_compiler}")
string(REPLACE "c++" "cc" c_compiler "${c_compiler}")
run(sh -c "PKG_CONFIG_PATH=$(dirname $(find ${prefix} -name sinew.pc)) &&
    export PKG_CONFIG_PATH && LD_LIBRARY_PATH=$(dirname $(dirname $(find ${prefix} -name sinew.pc))) && export LD_LIBRARY_PATH &&
    ${c_compiler} ${flags} ${work}/hello.c -o ${work}/hello_in_c $(pkg-config --cflags --libs sinew-c) && ${work}/hello_in_c")

# As a subdirectory: without the packages of the command, and without a word of them on any line of the build.
run(${CMAKE_COMMAND} -G Ninja -S ${source}/tests/consumer/subdirectory -B ${work}/subdirectory -D FOLDER=${work}
    -D SINEW_SOURCE=${source} -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_BUILD_TYPE=Release
    -D CMAKE_DISABLE_FIND_PACKAGE_fmt=ON -D CMAKE_DISABLE_FIND_PACKAGE_CLI11=ON -D CMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON)
execute_process(COMMAND ninja -C ${work}/subdirectory -t commands OUTPUT_VARIABLE commands COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "[^ ]*(cairo|CLI11|SDL|ffmpeg|-lfmt|libfmt|FMT_)[^ ]*" needless "${commands}")
if(needless)
    message(FATAL_ERROR "a program that adds the tree as a subdirectory is built with ${needless}")
endif()
