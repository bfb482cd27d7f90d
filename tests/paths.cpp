#include "tests/paths.h"

namespace sinew::test {

std::string source_dir() {
    return SINEW_SOURCE_DIR;
}
std::string scenes_dir() {
    return SINEW_SOURCE_DIR "/scenes";
}
std::string command_path() {
    return SINEW_COMMAND;
}

} // namespace sinew::test
