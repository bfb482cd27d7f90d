# bench/peers/: other engines, for `sinew bench`. Packages: group [peers] of packages.apt.
find_package(box2d REQUIRED)
pkg_check_modules(bullet REQUIRED IMPORTED_TARGET bullet)
find_library(chipmunk chipmunk REQUIRED)
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/bench/peers/*.cpp)
list(FILTER sources EXCLUDE REGEX "none.cpp")
target_sources(bench PRIVATE ${sources})
target_link_libraries(bench PRIVATE PkgConfig::bullet box2d::box2d ${chipmunk})
