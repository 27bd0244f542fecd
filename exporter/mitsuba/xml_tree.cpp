// SPDX-License-Identifier: MIT
#include "exporter/mitsuba/xml_tree.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <system_error>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "exporter/files.h"
#include "exporter/text.h"
#include "scenes/error.h"

namespace threefold::mitsuba {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_bytes = 64 << 20, most_elements = 1'000'000, most_value = 4096;
constexpr int deepest = 32, deepest_include = 15;

[[noreturn]] void refuse(const std::string &what) { throw Error(Exit::bad_data, what); }

/// Offsets of line starts, for positions.
class Lines {
public:
    Lines(std::string file, std::string_view text) : file_(std::move(file)), size_(text.size()) {
        for (std::size_t i = 0; i < text.size(); ++i)
            if (text[i] == '\n') starts_.push_back(i + 1);
    }

    Place at(std::ptrdiff_t offset) const {
        const std::size_t where = offset < 0 ? 0 : std::min(static_cast<std::size_t>(offset), size_);
        const auto after = std::ranges::upper_bound(starts_, where);
        const std::size_t line = static_cast<std::size_t>(after - starts_.begin());
        return {file_, static_cast<int>(line), static_cast<int>(where - starts_[line - 1]) + 1};
    }

private:
    std::string file_;
    std::size_t size_;
    std::vector<std::size_t> starts_{0};
};

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

class Loader {
public:
    explicit Loader(const std::map<std::string, std::string> &given) : given_(given), values_(given) {}

    Tree load(const fs::path &path) {
        main_folder_ = path.parent_path();
        tree_.root.tag = "scene";
        tree_.root.folder = main_folder_;
        tree_.root.place = {path.string(), 1, 1};
        include(path, 0);
        return std::move(tree_);
    }

private:
    void include(const fs::path &path, int depth) {
        const std::int64_t size = require_readable_file(path);
        bytes_ += static_cast<std::size_t>(std::max<std::int64_t>(size, 0));
        if (bytes_ > most_bytes) refuse(fmt::format("{}: scene files of more than 64 MB", path.string()));
        const std::string text = read_file(path);
        pugi::xml_document document;
        const pugi::xml_parse_result parsed =
            document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_pi);
        const Lines lines(path.string(), text);
        if (!parsed) refuse(fmt::format("{}: {}", lines.at(parsed.offset).text(), parsed.description()));
        const pugi::xml_node scene = document.document_element();
        const Place place = lines.at(scene.offset_debug());
        if (std::string_view(scene.name()) != "scene")
            refuse(fmt::format("{}: <{}> is not the <scene> of a Mitsuba file", place.text(), one_line(scene.name())));
        if (depth == 0) begin(document, scene, place);
        for (const pugi::xml_node child : scene.children()) {
            if (child.type() != pugi::node_element) continue;
            if (std::string_view(child.name()) == "include")
                follow(child, lines, path, depth);
            else if (std::string_view(child.name()) == "default")
                define(child, lines);
            else
                tree_.root.children.push_back(copied(child, lines, path.parent_path(), 0));
        }
    }

    void begin(const pugi::xml_document &document, pugi::xml_node scene, const Place &place) {
        tree_.root.place = place;
        const std::string version = scene.attribute("version").value();
        const auto [end, status] = std::from_chars(version.data(), version.data() + version.size(), tree_.version);
        if (status != std::errc{} || !(tree_.version >= 0.4 && tree_.version < 4) ||
            (end != version.data() + version.size() && *end != '.'))
            refuse(fmt::format("{}: <scene>: version '{}' is none that is known (0.5.0 to 3.x)", place.text(),
                               one_line(version)));
        for (const pugi::xml_node child : document.children()) {
            if (child.type() != pugi::node_pi || std::string_view(child.name()) != "threefold") continue;
            pugi::xml_document own;
            if (!own.load_string(fmt::format("<said {}/>", child.value()).c_str()))
                refuse(fmt::format("{}: <?threefold {}?> cannot be read", place.text(),
                                   one_line(std::string(child.value()).substr(0, 80))));
            for (const pugi::xml_attribute a : own.document_element().attributes()) tree_.said[a.name()] = a.value();
        }
    }

    void follow(pugi::xml_node element, const Lines &lines, const fs::path &from, int depth) {
        const Place place = lines.at(element.offset_debug());
        if (depth + 1 > deepest_include)
            refuse(fmt::format("{}: <include>: files include each other more than {} deep: is it a loop?", place.text(),
                               deepest_include));
        if (++includes_ > 1000) refuse(fmt::format("{}: more than 1000 includes", place.text()));
        const std::string named = filled(element.attribute("filename").value(), place);
        if (named.empty()) refuse(fmt::format("{}: <include>: filename is missing", place.text()));
        fs::path path = from.parent_path() / named;
        std::error_code ignored;
        if (!fs::exists(path, ignored) && fs::exists(main_folder_ / named, ignored)) path = main_folder_ / named;
        if (!fs::exists(path, ignored))
            refuse(fmt::format("{}: <include>: there is no file {}", place.text(), one_line(named)));
        const fs::path inside =
            fs::weakly_canonical(path, ignored)
                .lexically_relative(fs::weakly_canonical(main_folder_.empty() ? "." : main_folder_, ignored));
        if (!inside.empty() && *inside.begin() == "..")
            tree_.notes.push_back(
                fmt::format("{}: includes {}, outside the scene's folder", place.text(), one_line(path.string())));
        include(path, depth + 1);
    }

    void define(pugi::xml_node element, const Lines &lines) {
        const Place place = lines.at(element.offset_debug());
        const std::string name = element.attribute("name").value();
        if (name.empty() || !std::ranges::all_of(name, is_word) || !element.attribute("value")) {
            tree_.problems.push_back(fmt::format("{}: <default>: needs a name of letters and a value", place.text()));
            return;
        }
        if (values_.contains(name) && !given_.contains(name)) return; // the first one counts
        const std::string value = filled(element.attribute("value").value(), place);
        values_.try_emplace(name, value);
        if (std::ranges::count(tree_.defaults, name, &std::pair<std::string, std::string>::first) == 0)
            tree_.defaults.emplace_back(name, value);
    }

    std::string filled(std::string_view text, const Place &place) {
        std::string out;
        for (std::size_t i = 0; i < text.size(); ++i) {
            std::size_t end = i + 1;
            while (end < text.size() && is_word(text[end])) ++end;
            if (text[i] != '$' || end == i + 1) {
                out += text[i];
                continue;
            }
            const std::string name(text.substr(i + 1, end - i - 1));
            const auto value = values_.find(name);
            if (value == values_.end())
                tree_.problems.push_back(fmt::format("{}: the parameter ${} has no value", place.text(), name));
            else
                out += value->second;
            i = end - 1;
            if (out.size() > most_value)
                refuse(fmt::format("{}: with its parameters filled in, a value is longer than {} characters",
                                   place.text(), most_value));
        }
        return out;
    }

    Node copied(pugi::xml_node element, const Lines &lines, const fs::path &folder, int depth) {
        Node node;
        node.place = lines.at(element.offset_debug());
        if (depth > deepest)
            refuse(fmt::format("{}: elements are nested more than {} deep", node.place.text(), deepest));
        if (++elements_ > most_elements) refuse(fmt::format("{}: more than a million elements", node.place.text()));
        node.tag = element.name();
        node.folder = folder;
        for (const pugi::xml_attribute a : element.attributes())
            node.attributes.emplace_back(a.name(), filled(a.value(), node.place));
        for (const pugi::xml_node child : element.children()) {
            if (child.type() == pugi::node_element)
                node.children.push_back(copied(child, lines, folder, depth + 1));
            else if (child.type() == pugi::node_pcdata)
                tree_.problems.push_back(
                    fmt::format("{}: <{}>: holds loose text", node.place.text(), one_line(node.tag)));
        }
        return node;
    }

    const std::map<std::string, std::string> given_;
    std::map<std::string, std::string> values_;
    Tree tree_;
    fs::path main_folder_;
    std::size_t bytes_ = 0, elements_ = 0;
    int includes_ = 0;
};

} // namespace

std::string Place::text() const { return fmt::format("{}:{}:{}", one_line(file), line, column); }

const std::string *Node::attribute(std::string_view name) const {
    const auto found = std::ranges::find(attributes, name, &std::pair<std::string, std::string>::first);
    return found == attributes.end() ? nullptr : &found->second;
}

Tree read_tree(const fs::path &path, const std::map<std::string, std::string> &given) {
    return Loader(given).load(path);
}

std::string snake(std::string_view name) {
    std::string out;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const auto is_upper = [](char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; };
        if (is_upper(name[i]) && i > 0 && !is_upper(name[i - 1]) && name[i - 1] != '_') out += '_';
        out += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
    }
    return out;
}

fs::path resolved(const fs::path &named, const Node &node, const Node &root) {
    std::error_code ignored;
    const fs::path here = node.folder / named, main = root.folder / named;
    return !fs::exists(here, ignored) && fs::exists(main, ignored) ? main : here;
}

} // namespace threefold::mitsuba
