#include "files/in/role.h"

#include <cctype>
#include <string>

namespace sinew::files {
namespace {

/// Role of a word, or of its singular.
std::optional<Role> role_of_word(std::string_view word) {
    if (const auto role = role_called(word)) return role;
    return word.ends_with('s') ? role_called(word.substr(0, word.size() - 1)) : std::nullopt;
}

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

} // namespace

std::optional<Role> role_called(std::string_view word) {
    for (const auto& known : role_words)
        if (known.word == word) return known.role;
    return std::nullopt;
}

std::optional<Role> role_in(std::string_view text) {
    std::string word;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size() && is_letter(text[i])) {
            // A capital within a word begins another: "leftRope".
            const bool inner = i > 0 && is_letter(text[i - 1]) && std::islower(static_cast<unsigned char>(text[i - 1]));
            if (inner && std::isupper(static_cast<unsigned char>(text[i]))) {
                if (const auto role = role_of_word(word)) return role;
                word.clear();
            }
            word += char(std::tolower(static_cast<unsigned char>(text[i])));
            continue;
        }
        if (const auto role = role_of_word(word)) return role;
        word.clear();
    }
    return std::nullopt;
}

} // namespace sinew::files
