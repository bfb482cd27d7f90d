#pragma once

#include <filesystem>

namespace sinew::cli {

/// True for the path of a source file in C or C++: .c, .cpp, .cc, .cxx.
bool is_source(const std::filesystem::path& path);

/// Compiles a source file to a shared object, by CC or CXX of the environment, else by cc or c++, with the folder of
/// sinew.h and what CFLAGS or CXXFLAGS add. Throws CommandError with what the compiler says.
void compile(const std::filesystem::path& source, const std::filesystem::path& object);

} // namespace sinew::cli
