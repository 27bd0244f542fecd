// SPDX-License-Identifier: MIT
#include "exporter/mitsuba/properties.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "exporter/text.h"

namespace threefold::mitsuba {

namespace {

/// Beyond this no number of a scene means anything, and squares of products still are finite.
constexpr double greatest_number = 1e12;

bool is_space(char c) { return c == ' ' || c == ',' || c == '\t' || c == '\n' || c == '\r'; }

/// Numbers apart by commas or blanks; empty where one is none.
std::vector<double> to_numbers(std::string_view text) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < text.size();) {
        if (is_space(text[i])) {
            ++i;
            continue;
        }
        std::size_t end = i;
        while (end < text.size() && !is_space(text[end])) ++end;
        const std::optional<double> number = to_number(text.substr(i, end - i));
        if (!number || numbers.size() == 16) return {};
        numbers.push_back(*number);
        i = end;
    }
    return numbers;
}

std::optional<Vec3> to_vector(const Node &node, std::string_view attribute) {
    const std::string *text = node.attribute(attribute);
    const std::vector<double> n = text ? to_numbers(*text) : std::vector<double>{};
    if (n.size() != 3) return std::nullopt;
    return Vec3(n[0], n[1], n[2]);
}

/// x, y and z as attributes of their own, or three numbers in `value`.
std::optional<Vec3> to_xyz(const Node &node, double otherwise) {
    if (node.attribute("value")) return to_vector(node, "value");
    Vec3 v(otherwise);
    constexpr std::array names{"x", "y", "z"};
    for (int i = 0; i < 3; ++i)
        if (const std::string *text = node.attribute(names[static_cast<std::size_t>(i)])) {
            const std::optional<double> number = to_number(*text);
            if (!number) return std::nullopt;
            v[i] = *number;
        }
    return v;
}

bool is_finite(const glm::dmat4 &m) {
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            if (!(std::abs(m[i][j]) <= greatest_number)) return false;
    return true;
}

double from_srgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

struct Material {
    const char *name;
    double index;
};

/// The names of Mitsuba's manual.
constexpr std::array materials{
    Material{"vacuum", 1.0},      Material{"helium", 1.000036},        Material{"hydrogen", 1.000132},
    Material{"air", 1.000277},    Material{"carbon dioxide", 1.00045}, Material{"water", 1.3330},
    Material{"acetone", 1.36},    Material{"ethanol", 1.361},          Material{"carbon tetrachloride", 1.461},
    Material{"glycerol", 1.4729}, Material{"benzene", 1.501},          Material{"silicone oil", 1.52045},
    Material{"bromine", 1.661},   Material{"water ice", 1.31},         Material{"fused quartz", 1.458},
    Material{"pyrex", 1.470},     Material{"acrylic glass", 1.49},     Material{"polypropylene", 1.49},
    Material{"bk7", 1.5046},      Material{"sodium chloride", 1.544},  Material{"amber", 1.55},
    Material{"pet", 1.5750},      Material{"diamond", 2.419}};

std::string described(const Node &node) {
    std::string text = fmt::format("{}: <{}", node.place.text(), one_line(node.tag));
    for (const char *name : {"type", "name", "id"})
        if (const std::string *value = node.attribute(name))
            text += fmt::format(" {}=\"{}\"", name, one_line(value->substr(0, 80)));
    return text + ">";
}

void collect_ids(const Node &node, std::map<std::string, const Node *> &by_id, Findings &findings) {
    for (const Node &child : node.children) {
        if (const std::string *id = child.attribute("id"); id && !id->empty() && child.tag != "ref")
            if (const auto [other, is_new] = by_id.try_emplace(*id, &child); !is_new)
                findings.problem(child, fmt::format("has the id of another, at {}", other->second->place.text()));
        collect_ids(child, by_id, findings);
    }
}

/// Along the axes: a view stays the same, but for its width.
bool only_scales(const glm::dmat4 &m) {
    const Vec3 scale(m[0].x, m[1].y, m[2].z);
    return scale.x > 0 && scale.y > 0 && scale.z > 0 && m == glm::scale(glm::dmat4(1), scale);
}

/// One element of a transform; empty where it means nothing.
std::optional<glm::dmat4> step_of(const Node &node, Transform &whole) {
    if (node.tag == "translate") {
        const auto v = to_xyz(node, 0);
        return v ? std::optional(glm::translate(glm::dmat4(1), *v)) : std::nullopt;
    }
    if (node.tag == "scale") {
        const std::string *value = node.attribute("value");
        const std::optional<double> one = value ? to_number(*value) : std::nullopt;
        const auto v = one ? std::optional(Vec3(*one)) : to_xyz(node, 1);
        return v ? std::optional(glm::scale(glm::dmat4(1), *v)) : std::nullopt;
    }
    if (node.tag == "rotate") {
        const auto axis = to_xyz(node, 0);
        const std::string *text = node.attribute("angle");
        const auto angle = text ? to_number(*text) : std::nullopt;
        if (!axis || !angle || !(glm::length(*axis) > 0)) return std::nullopt;
        return glm::rotate(glm::dmat4(1), glm::radians(*angle), *axis);
    }
    if (node.tag == "matrix") {
        const std::string *text = node.attribute("value");
        const std::vector<double> n = text ? to_numbers(*text) : std::vector<double>{};
        if (n.size() != 16 || n[12] != 0 || n[13] != 0 || n[14] != 0 || n[15] != 1) return std::nullopt;
        glm::dmat4 m;
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 4; ++column) m[column][row] = n[static_cast<std::size_t>(4 * row + column)];
        return m;
    }
    if (snake(node.tag) == "look_at" || node.tag == "lookat") {
        const auto origin = to_vector(node, "origin"), target = to_vector(node, "target"), up = to_vector(node, "up");
        if (!origin || !target || !up) return std::nullopt;
        const Vec3 forward = glm::normalize(*target - *origin);
        const Vec3 left = glm::normalize(glm::cross(*up, forward)), top = glm::cross(forward, left);
        whole.look = Transform::Look{*target, *up};
        return glm::dmat4(glm::dvec4(left, 0), glm::dvec4(top, 0), glm::dvec4(forward, 0), glm::dvec4(*origin, 1));
    }
    return std::nullopt;
}

} // namespace

std::optional<double> to_number(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    if (text.starts_with('+')) text.remove_prefix(1);
    double number = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || status != std::errc{} || end != text.data() + text.size() ||
        !(std::abs(number) <= greatest_number))
        return std::nullopt;
    return number;
}

void Findings::problem(const Node &node, const std::string &what) {
    problems.push_back(fmt::format("{}: {}", described(node), what));
}

void Findings::change(const Node &node, const std::string &what) {
    changes.push_back(fmt::format("{}: {}", described(node), what));
}

void Findings::note(const Node &node, const std::string &what) {
    notes.push_back(fmt::format("{}: {}", described(node), what));
}

Document::Document(const Tree &whole, Findings &found) : tree(whole), findings(found) {
    collect_ids(tree.root, by_id, findings);
}

Properties::Properties(const Node &element, Document &document) : element_(element), document_(document) {
    for (const Node &child : element.children) {
        const std::string *given = child.attribute("name");
        std::string name = given ? snake(*given) : "";
        const Node *node = &child;
        if (child.tag == "ref") {
            const std::string *id = child.attribute("id");
            const auto found = id ? document.by_id.find(*id) : document.by_id.end();
            if (found == document.by_id.end()) {
                document.findings.problem(child, "nothing in the file has this id");
                continue;
            }
            node = found->second;
        }
        if (!name.empty())
            for (Child &earlier : children_)
                if (earlier.name == name) {
                    if (document.old_dialect())
                        document.findings.note(child, "given more than once: the last one counts");
                    else
                        document.findings.problem(child, "given more than once");
                    earlier.used = true;
                    earlier.name.clear();
                }
        children_.push_back({node, std::move(name)});
    }
}

std::string Properties::type() const {
    const std::string *type = element_.attribute("type");
    return type ? *type : "";
}

Properties::Child *Properties::find(const std::string &name) {
    const auto found = std::ranges::find(children_, name, &Child::name);
    if (found == children_.end()) return nullptr;
    found->used = true;
    return &*found;
}

const std::string *Properties::value_of(const Node &node) {
    const std::string *value = node.attribute("value");
    if (!value) document_.findings.problem(node, "value is missing");
    return value;
}

std::optional<double> Properties::number(const std::string &name) {
    const Child *child = find(name);
    const std::string *value = child ? value_of(*child->node) : nullptr;
    if (!value) return std::nullopt;
    const std::optional<double> number = to_number(*value);
    if (!number)
        document_.findings.problem(*child->node, fmt::format("'{}' is no number within {:g}",
                                                             one_line(value->substr(0, 80)), greatest_number));
    return number;
}

std::optional<int> Properties::whole(const std::string &name) {
    const Child *child = find(name);
    const std::optional<double> value = number(name);
    if (!value) return std::nullopt;
    if (*value != std::floor(*value) || std::abs(*value) > 1e9) {
        document_.findings.problem(*child->node, "must be a whole number up to 1e9");
        return std::nullopt;
    }
    return static_cast<int>(*value);
}

bool Properties::boolean(const std::string &name, bool otherwise) {
    const Child *child = find(name);
    const std::string *value = child ? value_of(*child->node) : nullptr;
    if (!value) return otherwise;
    if (*value != "true" && *value != "false") {
        document_.findings.problem(*child->node, "must be true or false");
        return otherwise;
    }
    return *value == "true";
}

std::string Properties::word(const std::string &name, const std::string &otherwise) {
    const Child *child = find(name);
    const std::string *value = child ? value_of(*child->node) : nullptr;
    return value ? *value : otherwise;
}

std::optional<Vec3> Properties::point(const std::string &name) {
    const Child *child = find(name);
    if (!child) return std::nullopt;
    const std::optional<Vec3> v = to_xyz(*child->node, 0);
    if (!v) document_.findings.problem(*child->node, "needs three numbers");
    return v;
}

Transform Properties::transform(const std::string &name) {
    Transform whole;
    const Child *child = find(name);
    if (!child) return whole;
    for (const Node &node : child->node->children) {
        std::optional<Transform::Look> before = whole.look;
        const bool turned = !only_scales(whole.matrix);
        const std::optional<glm::dmat4> step = step_of(node, whole);
        if (!step || !is_finite(*step)) {
            document_.findings.problem(node, "is no transform that can be read (translate, rotate, scale, lookat with "
                                             "origin, target and up, matrix with last row 0 0 0 1)");
            return whole;
        }
        // What was turned before it, its own target and up say nothing of.
        if (!before && turned) whole.look.reset();
        if (before) {
            whole.look =
                Transform::Look{Vec3(*step * glm::dvec4(before->target, 1)), Vec3(*step * glm::dvec4(before->up, 0))};
        }
        whole.matrix = *step * whole.matrix;
        if (!is_finite(whole.matrix)) {
            document_.findings.problem(node, "takes the transform beyond all numbers");
            whole.matrix = glm::dmat4(1);
            return whole;
        }
    }
    return whole;
}

std::optional<Rgb> to_colour(const Node &node, Document &document) {
    const std::string *value = node.attribute("value");
    const auto fail = [&](const std::string &why) {
        document.findings.problem(node, why);
        return std::optional<Rgb>();
    };
    if (node.tag != "rgb" && node.tag != "srgb" && node.tag != "spectrum" && node.tag != "float")
        return fail("is no colour that can be read");
    if (!value) return fail("value is missing");
    if (value->size() == 7 && value->front() == '#') {
        if (node.tag != "srgb") return fail("write #rrggbb as <srgb>, or as three linear numbers");
        Rgb colour;
        for (int i = 0; i < 3; ++i) {
            unsigned byte = 0;
            const char *first = value->data() + 1 + 2 * i;
            const auto [end, status] = std::from_chars(first, first + 2, byte, 16);
            if (status != std::errc{} || end != first + 2) return fail("is no colour: #rrggbb in hexadecimal digits");
            colour[i] = from_srgb(byte / 255.0);
        }
        return colour;
    }
    const std::vector<double> n = to_numbers(*value);
    Rgb colour;
    if (n.size() == 1)
        colour = Rgb(n[0]);
    else if (n.size() == 3 && node.tag != "spectrum" && node.tag != "float")
        colour = {n[0], n[1], n[2]};
    else
        return fail(node.tag == "spectrum" ? "a spectrum can be read only where it is one number, the same everywhere"
                                           : "needs one number or three");
    if (std::min({colour.r, colour.g, colour.b}) < 0) return fail("must not be negative");
    if (node.tag == "srgb")
        for (int i = 0; i < 3; ++i) colour[i] = from_srgb(colour[i]);
    return colour;
}

std::optional<Rgb> Properties::colour(const std::string &name) {
    const Child *child = find(name);
    return child ? to_colour(*child->node, document_) : std::nullopt;
}

const Node *Properties::named(const std::string &name) {
    const Child *child = find(name);
    return child ? child->node : nullptr;
}

std::vector<const Node *> Properties::children(std::string_view tag) {
    std::vector<const Node *> found;
    for (Child &child : children_)
        if (child.node->tag == tag && !child.used) {
            child.used = true;
            found.push_back(child.node);
        }
    return found;
}

std::optional<double> Properties::index_of(const std::string &name, const std::string &otherwise) {
    const Child *child = find(name);
    std::string value = otherwise;
    if (child) {
        const std::string *given = value_of(*child->node);
        if (!given) return std::nullopt;
        value = *given;
    }
    const auto known = std::ranges::find_if(materials, [&](const Material &m) { return value == m.name; });
    const std::optional<double> index = known != materials.end() ? std::optional(known->index) : to_number(value);
    if (!index || !(*index > 0)) {
        document_.findings.problem(
            child ? *child->node : element_,
            fmt::format("'{}' is no index of refraction, nor the name of a material", one_line(value.substr(0, 80))));
        return std::nullopt;
    }
    return index;
}

void Properties::leave_out(std::initializer_list<const char *> names, const std::string &why) {
    for (const char *name : names)
        if (const Child *child = find(name)) document_.findings.note(*child->node, "not used: " + why);
}

void Properties::finish() {
    for (const Child &child : children_)
        if (!child.used)
            document_.findings.problem(*child.node, fmt::format("is not understood in <{} type=\"{}\">",
                                                                one_line(element_.tag), one_line(type())));
}

} // namespace threefold::mitsuba
