#pragma once

#include "sinew/scene/text.h"

#include <cctype>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace sinew::files {

/// Names of figures, colliders and particles, each once.
class NewNames {
  public:
    /// The wanted name in letters, digits, _ and -, so that figure/particle is told apart; with a number where it is
    /// taken.
    std::string take(std::string_view wanted, std::string_view usual) {
        constexpr std::size_t longest = 40;
        std::string base;
        for (const char c : wanted.substr(0, longest))
            base += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '_';
        if (base.empty()) base = usual;
        auto& number = numbers_[base];
        auto name = ++number == 1 ? base : concat(base, "_", number);
        while (!taken_.insert(name).second) name = concat(base, "_", ++number);
        return name;
    }

  private:
    std::map<std::string, std::size_t, std::less<>> numbers_; ///< last one given to a base
    std::set<std::string, std::less<>> taken_;
};

} // namespace sinew::files
