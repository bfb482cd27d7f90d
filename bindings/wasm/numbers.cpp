// Decimal numbers for the JSON parser, which asks the C library; the linker redirects its calls (cmake/wasm.cmake).
#include "sinew/math/decimal.h"

#include <algorithm>

extern "C" double __wrap_strtod(const char* text, char** end) {
    const std::string_view all(text);
    const auto size = std::min(all.find_first_not_of("0123456789+-.eE"), all.size());
    if (end) *end = const_cast<char*>(text + size);
    return sinew::decimal::parse(all.substr(0, size));
}
