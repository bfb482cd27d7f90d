#include "sinew/math/format.h"
#include "sinew/scene/check.h"

#include <set>

namespace sinew {
namespace {

/// Names within the reach of references: figure/particle, and a star at the end for all names with the stem before.
class NameCheck {
  public:
    NameCheck(const Scene& scene, Document& document, const KnowsName& knows)
        : scene_(scene), document_(document), knows_(knows) {}

    void run() {
        figures();
        for (std::size_t i = 0; i < scene_.figures.size(); ++i)
            if (const auto* by_hand = std::get_if<ByHand>(&scene_.figures[i].made))
                for (const auto& [name, particle] : by_hand->particles)
                    addressable("particle", name, under("figures", i, "particles") + json::pointer_step(name));
        colliders();
    }

  private:
    const Scene& scene_;
    Document& document_;
    const KnowsName& knows_;

    void figures() {
        std::set<std::string_view> seen;
        for (std::size_t i = 0; i < scene_.figures.size(); ++i) {
            if (knows_ && !knows_(i)) continue;
            const auto name = name_of(scene_.figures[i]);
            const auto own = under("figures", i, "name");
            const auto* given = json::find(document_.root, own);
            if (given && given->as<std::string>()) addressable("figure", *given->as<std::string>(), own);
            const bool is_empty = given && scene_.figures[i].name.empty();
            if (!is_empty && !seen.insert(name).second)
                document_.error(scene_.figures[i].name.empty() ? under("figures", i) : own,
                                format_text("there is already a figure called \"{}\"", name),
                                "give each figure its own \"name\"");
        }
    }

    void colliders() {
        std::set<std::string_view> seen;
        for (std::size_t i = 0; i < scene_.colliders.size(); ++i) {
            const auto& name = scene_.colliders[i].name;
            if (!name.empty() && !seen.insert(name).second)
                document_.error(under("colliders", i, "name"),
                                format_text("there is already a collider called \"{}\"", name),
                                "give each collider its own \"name\", or none");
        }
    }

    void addressable(std::string_view what, const std::string& name, const std::string& place) {
        if (name.empty())
            document_.error(place, format_text("a {}'s name cannot be empty", what),
                            "references to it say \"figure/particle\"");
        if (name.find('/') != std::string::npos)
            document_.error(place, format_text("a {}'s name cannot contain a slash, found {}", what, in_quotes(name)),
                            "in references a slash parts the figure from the particle");
        if (name.ends_with('*'))
            document_.error(place, format_text("a {}'s name cannot end in a star, found {}", what, in_quotes(name)),
                            "in references a star stands for all names that begin so");
    }
};

} // namespace

void check_names(const Scene& scene, Document& document, const KnowsName& knows) {
    NameCheck(scene, document, knows).run();
}

} // namespace sinew
