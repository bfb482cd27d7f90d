#include "files/in/xml.h"

#include "sinew/scene/text.h"

#include "files/in/import.h"
#include "files/in/xml_references.h"

#include <algorithm>

namespace sinew::files {
namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr std::size_t most_parts = 1'000'000, most_attributes = 256; // of a document, of an element

class XmlReader {
  public:
    XmlReader(std::string_view text, const TextPlaces& places) : text_(text), places_(places) {}

    XmlElement read() {
        if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff"))
            fail(0, "the XML is UTF-16", "save it as UTF-8");
        if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
        while (at_ < text_.size()) read_part();
        if (!open_.empty())
            fail(open_.back().offset, concat("the XML breaks off: <", printable(open_.back().name), "> is not closed"));
        if (!is_done_) fail(0, "the XML has no element");
        return std::move(root_);
    }

  private:
    std::string_view text_;
    const TextPlaces& places_;
    std::size_t at_ = 0, parts_ = 0;
    XmlReferences references_;
    std::vector<XmlElement> open_; ///< elements around `at_`
    XmlElement root_;
    bool is_done_ = false; ///< the root is closed

    [[noreturn]] void fail(std::size_t offset, std::string message, std::string help = {}) const {
        throw ImportError{places_.at(offset), std::move(message), std::move(help)};
    }

    bool is_at(std::string_view word) const { return text_.substr(at_).starts_with(word); }
    char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }

    /// The text up to a word, which is passed over.
    std::string_view take_until(std::string_view word, std::string_view part) {
        const auto begin = at_, end = text_.find(word, at_);
        if (end == text_.npos) fail(begin, concat("the XML breaks off in ", part));
        at_ = end + word.size();
        return text_.substr(begin, end - begin);
    }
    void skip_blanks() { at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size()); }
    std::string_view take_name() {
        const auto begin = at_;
        at_ = std::min(text_.find_first_of(" \t\r\n/>=<\"'", at_), text_.size());
        return text_.substr(begin, at_ - begin);
    }

    void read_part() {
        if (here() != '<') return read_text();
        const auto begin = at_;
        if (is_at("<!--")) {
            at_ += 4;
            take_until("-->", "a comment");
        } else if (is_at("<![CDATA[")) {
            at_ += 9;
            const auto text = take_until("]]>", "a CDATA section");
            if (open_.empty()) fail(begin, "there is text outside the element of the XML");
            references_.append_plain(text, open_.back().text);
        } else if (is_at("<!DOCTYPE")) {
            read_doctype();
        } else if (is_at("<?")) {
            const auto instruction = take_until("?>", "an instruction");
            if (instruction.starts_with("<?xml ")) read_encoding(instruction, begin);
        } else if (is_at("</")) {
            close();
        } else {
            open();
        }
    }

    void read_encoding(std::string_view declaration, std::size_t begin) {
        const auto word = declaration.find("encoding");
        if (word == declaration.npos) return;
        const auto open = declaration.find_first_of("\"'", word);
        if (open == declaration.npos) return;
        const auto close = std::min(declaration.find(declaration[open], open + 1), declaration.size());
        const auto name = declaration.substr(open + 1, close - open - 1);
        if (!references_.set_encoding(name))
            fail(begin, concat("the XML is in the encoding ", in_quotes(name)), "save it as UTF-8");
    }

    void read_text() {
        const auto begin = at_;
        at_ = std::min(text_.find('<', at_), text_.size());
        const auto raw = text_.substr(begin, at_ - begin);
        if (!open_.empty()) return append(raw, begin, open_.back().text);
        if (const auto mark = raw.find_first_not_of(blanks); mark != raw.npos)
            fail(begin + mark, "there is text outside the element of the XML");
    }

    void append(std::string_view raw, std::size_t begin, std::string& target) {
        if (const auto problem = references_.append(raw, target)) fail(begin + problem->at, problem->message);
    }

    /// Entities of the document type; all else in it is passed over.
    void read_doctype() {
        const auto begin = at_;
        for (char quote = 0; at_ < text_.size(); ++at_) {
            const char c = here();
            if (quote != 0)
                quote = c == quote ? '\0' : quote;
            else if (c == '"' || c == '\'')
                quote = c;
            else if (c == '>')
                return void(++at_);
            else if (c == '[')
                break;
        }
        for (++at_; at_ < text_.size(); skip_blanks()) {
            if (is_at("<!--"))
                take_until("-->", "a comment");
            else if (here() == ']')
                return void(take_until(">", "the document type"));
            else
                read_declaration();
        }
        fail(begin, "the XML breaks off in the document type");
    }
    void read_declaration() {
        if (!is_at("<!ENTITY")) {
            if (here() == '<')
                take_until(">", "the document type");
            else
                ++at_;
            return;
        }
        at_ += 8;
        skip_blanks();
        const auto name = take_name();
        skip_blanks();
        if (const char quote = here(); quote == '"' || quote == '\'') {
            const auto begin = ++at_;
            std::string value;
            append(take_until(text_.substr(begin - 1, 1), "an entity"), begin, value);
            references_.declare(name, std::move(value));
        }
        take_until(">", "the document type");
    }

    void open() {
        const auto begin = at_++;
        XmlElement element;
        element.offset = at_;
        element.name = take_name();
        const auto first = element.name.empty() ? '\0' : element.name[0];
        const bool is_name = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z') || first == '_' ||
                             first == ':' || static_cast<unsigned char>(first) >= 0x80;
        if (!is_name) fail(begin, "an element begins with its name: a < in a text is written &lt;");
        if (is_done_) fail(begin, "the XML has a second element outside the first");
        if (open_.size() > ImportLimits::depth)
            fail(element.offset, concat("elements nest more than ", ImportLimits::depth, " deep"));
        for (skip_blanks(); here() != '>' && here() != '/'; skip_blanks()) {
            if (at_ >= text_.size())
                fail(element.offset, concat("the XML breaks off in <", printable(element.name), ">"));
            add_attribute(element);
        }
        count(element.offset);
        const bool is_empty = here() == '/';
        at_ += is_empty ? 1 : 0;
        if (here() != '>') fail(element.offset, concat("<", printable(element.name), "> does not end with >"));
        ++at_;
        open_.push_back(std::move(element));
        if (is_empty) leave();
    }

    void count(std::size_t offset) {
        if (++parts_ > most_parts) fail(offset, concat("more than ", most_parts, " elements and attributes"));
    }

    void add_attribute(XmlElement& element) {
        const auto begin = at_;
        const auto name = take_name();
        skip_blanks();
        if (name.empty() || here() != '=')
            fail(begin, concat("an attribute of <", printable(element.name), "> is name=\"value\""));
        ++at_;
        skip_blanks();
        const char quote = here();
        if (quote != '"' && quote != '\'') fail(begin, concat("the value of ", printable(name), " is in quotes"));
        const auto value_begin = ++at_;
        const auto raw = take_until(text_.substr(value_begin - 1, 1), "an attribute");
        if (const auto mark = raw.find('<'); mark != raw.npos)
            fail(begin, concat("the value of ", printable(name), " has a <, or its quotes do not end"));
        if (element.has(name)) fail(begin, concat("the attribute ", printable(name), " is there twice"));
        if (element.attributes.size() >= most_attributes)
            fail(begin, concat("more than ", most_attributes, " attributes of an element"));
        count(begin);
        auto& value = element.attributes.emplace_back(XmlAttribute{name, {}}).value;
        append(raw, value_begin, value);
    }

    void close() {
        const auto begin = at_;
        at_ += 2;
        const auto name = take_name();
        skip_blanks();
        if (open_.empty() || open_.back().name != name || here() != '>')
            fail(begin, open_.empty()
                            ? concat("</", printable(name), "> closes nothing")
                            : concat("expected </", printable(open_.back().name), ">, found </", printable(name), ">"));
        ++at_;
        leave();
    }

    void leave() {
        auto element = std::move(open_.back());
        open_.pop_back();
        if (open_.empty())
            root_ = std::move(element), is_done_ = true;
        else
            open_.back().children.push_back(std::move(element));
    }
};

} // namespace

const XmlAttribute* XmlElement::find(std::string_view attribute) const {
    const auto found = std::ranges::find(attributes, attribute, &XmlAttribute::name);
    return found == attributes.end() ? nullptr : &*found;
}

const XmlElement* XmlElement::child(std::string_view wanted) const {
    const auto found = std::ranges::find(children, wanted, &XmlElement::name);
    return found == children.end() ? nullptr : &*found;
}

XmlDocument::XmlDocument(std::string text)
    : text_(std::make_unique<const std::string>(std::move(text))), places_(*text_),
      root_(XmlReader(*text_, places_).read()) {}

} // namespace sinew::files
