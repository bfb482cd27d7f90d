# Does what docs/how/extending.md says about a new kind of constraint, to a copy of the tree: writes the file, applies the
# patch, builds without optimization, runs the tests of every kind, and plays the page's scene in each precision and
# dimension.
include(${source}/tests/page.cmake)
set(work ${build}/extending)
set(tree ${work}/tree)
set(page ${source}/docs/how/extending.md)

file(REMOVE_RECURSE ${tree})
file(COPY ${source}/sinew DESTINATION ${tree})
file(COPY ${source}/tests/constraint DESTINATION ${tree}/tests)
take_block(${page} kind cpp)
file(WRITE ${tree}/sinew/constraint/height.h "${block}")
take_block(${page} kinds diff)
file(WRITE ${work}/kinds.diff "${block}")
take_block(${page} scene json)
file(WRITE ${work}/scene.json "${block}")
# As in a tree of its own: inside a repository, git would take the paths from its top.
run(${CMAKE_COMMAND} -E env GIT_CEILING_DIRECTORIES=${work} git -C ${tree} apply ${work}/kinds.diff)

run(${CMAKE_COMMAND} -G Ninja -S ${source}/tests/extending -B ${work}/build -D TREE=${tree}
    -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_CXX_COMPILER_LAUNCHER=${launcher} -D CMAKE_CXX_FLAGS=${flags})
run(${CMAKE_COMMAND} --build ${work}/build --parallel 1) # one test of several at a time
run(${work}/build/kinds_test --gtest_brief=1)
foreach(precision IN ITEMS float double)
    run(${work}/build/play_scene ${work}/scene.json precision=${precision})
endforeach()
