#include "apps/cli/scrap.h"

#include "apps/cli/console.h"
#include "apps/cli/stepping.h"

#include <fstream>
#include <iterator>
#include <utility>

namespace sinew::cli {

void settle(const canvas::Failure& failure) {
    give_up_if_interrupted();
    if (failure) refuse("sinew", *failure);
}

Scrap::Scrap(const std::filesystem::path& beside, std::string_view ending, std::string called)
    : called_(std::move(called)) {
    if (const auto failure = file_.create(beside, ending)) settle("cannot write " + called_ + ": " + *failure);
}

std::string Scrap::bytes() const {
    std::ifstream in(file_.path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace sinew::cli
