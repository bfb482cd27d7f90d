#pragma once

#include <string>

/// Places of this build. Functions in one file, so that a test compiles the same wherever the checkout is.
namespace sinew::test {

std::string source_dir();   ///< root of the checkout
std::string scenes_dir();   ///< the catalogue
std::string command_path(); ///< the built `sinew`

} // namespace sinew::test
