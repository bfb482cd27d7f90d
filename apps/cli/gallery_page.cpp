#include "apps/cli/gallery_page.h"

#include "sinew/scene/document.h"

#include <cstdint>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

constexpr std::string_view head = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Sinew: the catalogue</title>
<style>
:root {
  color-scheme: light dark;
  --paper: #f6f1e7; --card: #fffdf8; --ink: #2b2d42; --soft: #6a6558; --line: #d9cfbb; --accent: #b53d18; --code: #efe8d9;
}
@media (prefers-color-scheme: dark) {
  :root { --paper: #14161d; --card: #1f232e; --ink: #ece9e1; --soft: #a5a9b8; --line: #343a4a; --accent: #ff9a78; --code: #171a22; }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.5 system-ui, sans-serif; }
header, main, footer { max-width: 1240px; margin: 0 auto; padding: 0 24px; }
header { padding-top: 40px; padding-bottom: 8px; }
h1 { margin: 0; font-size: 40px; letter-spacing: -0.02em; line-height: 1.1; }
header p { max-width: 62ch; color: var(--soft); margin: 12px 0 20px; }
.bar { display: flex; flex-wrap: wrap; gap: 12px; align-items: center; }
.bar input[type=search] { flex: 0 1 260px; min-width: 0; font: inherit; color: inherit; background: var(--card);
  border: 1px solid var(--line); border-radius: 8px; padding: 7px 12px; }
fieldset { display: flex; border: 1px solid var(--line); border-radius: 8px; margin: 0; padding: 0; overflow: hidden; background: var(--card); }
fieldset label { cursor: pointer; }
fieldset span { display: block; padding: 7px 14px; }
fieldset input { position: absolute; opacity: 0; }
fieldset input:checked + span { background: var(--ink); color: var(--paper); }
:focus-visible, fieldset input:focus-visible + span { outline: 2px solid var(--accent); outline-offset: 2px; }
#count { color: var(--soft); font-size: 14px; }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(340px, 1fr)); gap: 24px; padding-top: 24px; align-items: start; }
@media (max-width: 420px) { main { grid-template-columns: 1fr; } }
article { background: var(--card); border: 1px solid var(--line); border-radius: 12px; overflow: hidden; }
.screen { aspect-ratio: 4 / 3; background: var(--code); border-bottom: 1px solid var(--line); }
.screen img { display: block; width: 100%; height: 100%; object-fit: contain; }
.classic, body:has(#classic:checked) .physical { display: none; }
body:has(#classic:checked) .classic { display: block; }
.text { padding: 16px 18px 18px; }
h2 { margin: 0 0 6px; font-size: 20px; line-height: 1.25; }
h2 a { color: inherit; text-decoration: none; }
h2 a:hover { text-decoration: underline; }
.text p { margin: 0 0 10px; }
.meta { color: var(--soft); font-size: 14px; }
code, pre { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: 12.5px; }
.command { display: block; background: var(--code); border-radius: 8px; padding: 8px 12px; overflow-x: auto; white-space: nowrap; }
details { margin-top: 10px; border-top: 1px solid var(--line); padding-top: 8px; }
summary { cursor: pointer; color: var(--accent); font-size: 14px; }
pre { background: var(--code); border-radius: 8px; padding: 12px; overflow: auto; max-height: 360px; line-height: 1.45; margin: 8px 0 0; }
dl { margin: 8px 0 0; font-size: 14px; max-height: 360px; overflow: auto; }
dt { margin-top: 8px; overflow-wrap: anywhere; }
dt b { font-weight: 600; font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: 12.5px; }
dd { margin: 0; color: var(--soft); }
footer { color: var(--soft); font-size: 14px; padding-top: 32px; padding-bottom: 48px; }
</style>
</head>
<body>
)";

constexpr std::string_view tail = R"(</main>
<footer>Made by <code>sinew gallery</code>. This page is one file and loads nothing.</footer>
<script>
const cards = [...document.querySelectorAll("article")];
const search = document.getElementById("search"), count = document.getElementById("count");
search.addEventListener("input", () => {
  const words = search.value.toLowerCase().split(/\s+/);
  let shown = 0;
  for (const card of cards) {
    card.hidden = !words.every(word => card.dataset.text.includes(word));
    shown += !card.hidden;
  }
  count.textContent = shown === cards.length ? "" : shown + " of " + cards.length;
});
</script>
</body>
</html>
)";

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) switch (c) {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '"':
            out += "&quot;";
            break;
        default:
            out += c;
        }
    return out;
}

/// RFC 4648.
std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? std::uint32_t(std::uint8_t(bytes[i + k])) : 0;
        };
        const std::uint32_t group = byte(0) << 16U | byte(1) << 8U | byte(2);
        for (unsigned k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63U];
    }
    return out;
}

std::string lowered(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return text;
}

std::string film(const Exhibit& exhibit, std::size_t mode) {
    return fmt::format("<picture class=\"{0}\">"
                       "<source media=\"(prefers-reduced-motion: reduce)\" srcset=\"data:image/png;base64,{1}\">"
                       "<img alt=\"{2}, {0}\" decoding=\"async\" "
                       "src=\"data:image/webp;base64,{3}\"></picture>",
                       modes[mode], base64(exhibit.stills[mode]), escaped(exhibit.page.name),
                       base64(exhibit.films[mode]));
}

std::string parameters(const ScenePage& page) {
    if (page.parameters.empty()) return {};
    std::string list;
    for (const auto& [path, value, unit, help] : page.parameters)
        list += fmt::format("<dt><b>{} = {}</b> {}</dt><dd>{}</dd>\n", escaped(path), escaped(value), escaped(unit),
                            escaped(help));
    return fmt::format("<details><summary>Parameters</summary><dl>\n{}</dl></details>\n", list);
}

std::string card(const Exhibit& exhibit) {
    const auto& page = exhibit.page;
    std::string films;
    for (std::size_t mode = 0; mode < exhibit.films.size(); ++mode) films += film(exhibit, mode);
    const auto text = lowered(page.name + " " + page.about + " " + page.source + " " + page.made_of);
    return fmt::format("<article id=\"{0}\" data-text=\"{1}\">\n<div class=\"screen\">{2}</div>\n<div class=\"text\">\n"
                       "<h2><a href=\"#{0}\">{0}</a></h2>\n<p>{3}</p>\n<p class=\"meta\">{4}. Made of {5}.</p>\n"
                       "<code class=\"command\">sinew render {0} -o a.gif</code>\n{6}"
                       "<details><summary>Scene file</summary><pre>{7}</pre></details>\n</div>\n</article>\n",
                       escaped(page.name), escaped(text), films, escaped(page.about), escaped(page.source),
                       escaped(page.made_of), parameters(page), escaped(page.text));
}

} // namespace

std::string gallery_html(const std::vector<Exhibit>& exhibits) {
    std::string html(head);
    html += fmt::format(R"(<header>
<h1>The catalogue</h1>
<p>{} made of points and constraints, mostly after tutorials that people once typed in. Physical mode is independent of frame
rate and iteration count; classic mode moves as the original did, its quirks included.</p>
<div class="bar">
<fieldset aria-label="Mode"><label><input type="radio" name="mode" id="physical" checked><span>Physical</span></label>
<label><input type="radio" name="mode" id="classic"><span>Classic</span></label></fieldset>
<input type="search" id="search" placeholder="Search" aria-label="Search the scenes">
<span id="count" role="status"></span>
</div>
</header>
<main>
)",
                        exhibits.size() == 1 ? "A scene" : fmt::format("{} scenes", exhibits.size()));
    for (const auto& exhibit : exhibits) html += card(exhibit);
    html += tail;
    return html;
}

} // namespace sinew::cli
