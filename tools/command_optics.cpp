// SPDX-License-Identifier: MIT
#include "tools/command_optics.h"

#include <array>
#include <cctype>
#include <cmath>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporter/files.h"
#include "scenes/error.h"
#include "tools/restored_impact.h"
#include "verifier/optics/concentric.h"
#include "verifier/optics/quad.h"

namespace threefold {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view units = "mm, rad";

[[noreturn]] void throw_bad(const std::string &what, std::string hint = {}) {
    throw Error(Exit::bad_data, what, std::move(hint));
}

// ---------------------------------------------------------------------------------------------------------------------
// Numbers as text

std::size_t digits(std::string_view text, std::size_t from) {
    std::size_t end = from;
    while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end]))) ++end;
    return end - from;
}

/// A plain decimal number: sign, digits with at most one point, exponent of at most four digits.
bool is_decimal(std::string_view text) {
    if (text.size() > 1000) return false;
    std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    const std::size_t whole = digits(text, at);
    at += whole;
    std::size_t fraction = 0;
    if (at < text.size() && text[at] == '.') {
        fraction = digits(text, at + 1);
        at += 1 + fraction;
    }
    if (whole + fraction == 0) return false;
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        ++at;
        if (at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
        const std::size_t exponent = digits(text, at);
        if (exponent == 0 || exponent > 4) return false;
        at += exponent;
    }
    return at == text.size();
}

optics::Quad parse_decimal(const std::string &text, const std::string &name) {
    if (!is_decimal(text)) throw_bad(fmt::format("{}: \"{}\" is not a number", name, text.substr(0, 60)));
    return optics::Quad(text[0] == '+' ? text.substr(1) : text);
}

std::string to_text(const optics::Quad &value) { return value.str(30); }
std::string to_text(double value) { return fmt::format("{:.17g}", value); }
std::string to_short_text(const optics::Quad &value) { return value.str(12); }
std::string to_short_text(double value) { return fmt::format("{:.12g}", value); }

template <class T>
Json to_json(const std::optional<T> &value) {
    return value ? Json(to_text(*value)) : Json();
}

// ---------------------------------------------------------------------------------------------------------------------
// One ray

struct Names {
    std::string outer, inner_or_wall, index, impact, eye, plane;
};

struct Input {
    optics::Orb<optics::Quad> orb;
    optics::Impact<optics::Quad> impact;
    optics::Quad eye_mm, plane_mm;
};

/// Far beyond any scene, and narrow enough that no product of lengths overflows a double.
void require_range(const optics::Quad &value, const std::string &name) {
    if (value < 0) throw_bad(fmt::format("{}: {} is negative", name, to_short_text(value)));
    if (value > optics::Quad("1e30") || (value > 0 && value < optics::Quad("1e-30")))
        throw_bad(fmt::format("{}: {} is outside 1e-30 to 1e30", name, to_short_text(value)));
}

void require_positive(const optics::Quad &value, const std::string &name) {
    require_range(value, name);
    if (value == 0) throw_bad(fmt::format("{}: must be greater than 0", name));
}

void require_meaning(const Input &input, const Names &names) {
    const auto &[orb, impact, eye, plane] = input;
    require_positive(orb.outer_mm, names.outer);
    require_range(orb.index, names.index);
    if (orb.index < 1)
        throw_bad(fmt::format("{}: {} is below 1; the closed forms are for glass in air", names.index,
                              to_short_text(orb.index)));
    require_range(impact.b_mm, names.impact);
    if (impact.below_outer_mm < 0)
        throw_bad(fmt::format("{}: {} is larger than the outer radius {}; the ray misses the orb", names.impact,
                              to_short_text(impact.b_mm), to_short_text(orb.outer_mm)));
    require_positive(eye, names.eye);
    if (eye <= orb.outer_mm)
        throw_bad(fmt::format("{}: {} is not outside the orb of radius {}", names.eye, to_short_text(eye),
                              to_short_text(orb.outer_mm)));
    require_positive(plane, names.plane);
}

template <class T>
struct Answer {
    optics::Course course;
    std::optional<T> deflection, rim_deflection, landing;
    std::optional<optics::PathTransmittance<T>> transmittance;
};

template <class T>
Answer<T> answer(const optics::Orb<T> &orb, const optics::Impact<T> &impact, T eye_mm, T plane_mm) {
    return {optics::course(orb, impact), optics::deflection(orb, impact), optics::rim_deflection(orb, impact),
            optics::landing(orb, impact, eye_mm, plane_mm), optics::path_transmittance(orb, impact)};
}

template <class T>
std::optional<T> unpolarised(const Answer<T> &answer) {
    return answer.transmittance ? std::optional(answer.transmittance->unpolarised) : std::nullopt;
}

template <class T>
std::optional<T> polarised(const Answer<T> &answer) {
    return answer.transmittance ? std::optional(answer.transmittance->polarised) : std::nullopt;
}

// ---------------------------------------------------------------------------------------------------------------------
// A file of rows

constexpr std::array row_keys{
    "R_mm",   "r_mm",     "n",         "b_mm", "deflection_rad", "transmittance_unpolarised", "transmittance_polarised",
    "eye_mm", "plane_mm", "landing_mm"};

/// A number may be a string, which keeps all its digits, or a JSON number, which holds no more than a double.
optics::Quad row_number(const Json &row, const std::string &key, const std::string &name) {
    if (!row.contains(key)) throw_bad(fmt::format("{}: is missing", name));
    const Json &value = row[key];
    if (value.is_string()) return parse_decimal(value.get<std::string>(), name);
    if (value.is_number()) return parse_decimal(value.dump(), name);
    throw_bad(fmt::format("{}: must be a number or a decimal string", name));
}

Input read_row(const Json &row, const std::string &where) {
    if (!row.is_object()) throw_bad(where + ": is not an object");
    const auto name = [&](const char *key) { return fmt::format("{}, {}", where, key); };
    const auto number = [&](const char *key) { return row_number(row, key, name(key)); };
    const optics::Quad outer = number("R_mm"), inner = number("r_mm"), index = number("n");
    optics::Quad impact = number("b_mm");
    require_range(inner, name("r_mm"));
    if (row["b_mm"].is_string())
        impact = restored_impact(impact, row["b_mm"].get_ref<const std::string &>(), inner > 0 ? inner : outer);
    if (inner > outer)
        throw_bad(fmt::format("{}: {} is larger than the outer radius {}", name("r_mm"), to_short_text(inner),
                              to_short_text(outer)));
    Input input{{outer, inner, outer - inner, index},
                {impact, outer - impact, inner - impact},
                number("eye_mm"),
                number("plane_mm")};
    require_meaning(input, {name("R_mm"), name("r_mm"), name("n"), name("b_mm"), name("eye_mm"), name("plane_mm")});
    return input;
}

template <class T>
Json answer_row(const Json &row, const Input &input) {
    const Answer<T> result = answer(optics::rounded<T>(input.orb), optics::rounded<T>(input.impact),
                                    static_cast<T>(input.eye_mm), static_cast<T>(input.plane_mm));
    Json computed{{"deflection_rad", to_json(result.deflection)},
                  {"transmittance_unpolarised", to_json(unpolarised(result))},
                  {"transmittance_polarised", to_json(polarised(result))},
                  {"landing_mm", to_json(result.landing)}};
    Json answered = Json::object();
    for (const char *key : row_keys) answered[key] = computed.contains(key) ? computed[key] : row[key];
    for (const auto &[key, value] : row.items())
        if (!answered.contains(key)) answered[key] = value;
    return answered;
}

template <class T>
Json answer_rows(Json document, const std::string &file) {
    if (!document.is_object() || !document.contains("rows") || !document["rows"].is_array())
        throw_bad(file + ": has no list \"rows\"", "the form is {\"units\": \"mm, rad\", \"rows\": [{\"R_mm\": ...}]}");
    if (document.contains("units") && document["units"] != units)
        throw_bad(fmt::format("{}: units must be \"{}\"", file, units));
    Json answered{{"units", units}, {"rows", Json::array()}};
    std::size_t number = 0;
    for (const Json &row : document["rows"])
        answered["rows"].push_back(answer_row<T>(row, read_row(row, fmt::format("{}: row {}", file, ++number))));
    for (const auto &[key, value] : document.items())
        if (!answered.contains(key)) answered[key] = value;
    return answered;
}

Json read_json(const std::string &file) {
    const std::string bytes = read_file(file);
    try {
        return Json::parse(bytes, [&](int depth, Json::parse_event_t, Json &) {
            if (depth > 100) throw_bad(file + ": is nested more than 100 deep");
            return true;
        });
    } catch (const Json::exception &error) {
        // Its message starts with "[json.exception.parse_error.101] "
        std::string_view what = error.what();
        if (const auto end = what.find("] "); end != what.npos) what.remove_prefix(end + 2);
        throw_bad(fmt::format("{}: is not JSON: {}", file, what));
    }
}

// ---------------------------------------------------------------------------------------------------------------------
// A single query

Input read_query(const OpticsQuery &query) {
    const Names names{"--outer-mm", "--wall-mm", "--index", "--impact-mm", "--eye-mm", "--plane-mm"};
    const optics::Quad outer = parse_decimal(query.outer_mm, names.outer);
    const optics::Quad wall = query.solid ? outer : parse_decimal(query.wall_mm, names.inner_or_wall);
    require_positive(outer, names.outer);
    require_range(wall, names.inner_or_wall);
    if (!query.solid && wall >= outer)
        throw_bad(fmt::format("{}: {} is not less than the outer radius {}", names.inner_or_wall, to_short_text(wall),
                              to_short_text(outer)),
                  "--solid asks for a ball without a hollow");
    const optics::Quad index = parse_decimal(query.index, names.index),
                       impact = parse_decimal(query.impact_mm, names.impact);
    Input input{query.solid ? optics::solid_ball(outer, index) : optics::shell(outer, wall, index),
                {},
                parse_decimal(query.eye_mm, names.eye),
                parse_decimal(query.plane_mm, names.plane)};
    input.impact = optics::impact_at(input.orb, impact);
    require_meaning(input, names);
    return input;
}

std::string to_text(optics::Course course, bool solid) {
    switch (course) {
    case optics::Course::misses:
        return "misses the orb";
    case optics::Course::through_glass:
        return solid ? "through the glass" : "through the glass, beside the hollow";
    case optics::Course::through_hollow:
        return "through wall, hollow and wall";
    case optics::Course::totally_reflected:
        return "totally reflected at the inner wall";
    }
    return {};
}

template <class T>
struct Line {
    const char *key, *label;
    std::optional<T> value;
    const char *unit;
};

template <class T>
void answer_single(const OpticsQuery &query, const Input &input, Json &json, std::string &table) {
    const auto orb = optics::rounded<T>(input.orb);
    const auto impact = optics::rounded<T>(input.impact);
    const T eye = static_cast<T>(input.eye_mm), plane = static_cast<T>(input.plane_mm);
    const Answer<T> result = answer(orb, impact, eye, plane);
    const auto in_degrees = [&](const std::optional<T> &angle) -> std::optional<T> {
        using std::atan;
        if (!angle) return std::nullopt;
        return *angle * 45 / atan(T(1));
    };

    const std::vector<Line<T>> lines{
        {"deflection_rad", "deflection", result.deflection, "rad, positive towards the axis"},
        {"deflection_deg", "", in_degrees(result.deflection), "deg"},
        {"rim_deflection_rad", "rim deflection", result.rim_deflection, "rad, of a totally reflected ray"},
        {"rim_deflection_deg", "", in_degrees(result.rim_deflection), "deg"},
        {"transmittance_unpolarised", "transmittance", unpolarised(result), "unpolarised anew at each interface"},
        {"transmittance_polarised", "", polarised(result), "polarisation carried through (the truth)"},
        {"landing_mm", "landing", result.landing, "mm, height on the plane"},
        {"straight_landing_mm", "without the orb", optics::straight_landing(impact.b_mm, eye, plane), "mm"},
        {"paraxial_slope", "paraxial slope", optics::paraxial_slope(orb, eye, plane), "landing over straight landing"},
        {"image_magnification", "magnification", optics::image_magnification(orb, eye, plane),
         "negative when inverted"},
        {"focal_length_mm", "focal length", optics::focal_length(orb), "mm from the centre"},
        {"rim_width_mm", "rim width", optics::rim_width(orb), "mm, ring of total reflection"},
        {"critical_radius_mm", "critical radius", optics::critical_radius(orb), "mm, outer radius / index"},
        {"critical_inversion_index", "critical index", optics::critical_inversion_index(orb.outer_mm, eye, plane),
         "a solid ball inverts the plane above it"},
        {"plane_where_magnifying_ends_mm", "magnifies up to", optics::plane_where_magnifying_ends(orb, eye),
         "mm, plane distance, solid ball"}};

    const std::string course = to_text(result.course, orb.is_solid());
    json = {{"units", units},
            {"precision", query.precision},
            {"outer_mm", query.outer_mm},
            {"wall_mm", query.solid ? Json() : Json(query.wall_mm)},
            {"solid", query.solid},
            {"index", query.index},
            {"impact_mm", query.impact_mm},
            {"eye_mm", query.eye_mm},
            {"plane_mm", query.plane_mm},
            {"course", course}};
    table = fmt::format("{:<20} {}\n", "ray", course);
    for (const Line<T> &line : lines) {
        json[line.key] = to_json(line.value);
        table +=
            fmt::format("{:<20} {:>20}  {}\n", line.label, line.value ? to_short_text(*line.value) : "none", line.unit);
    }
}

} // namespace

int run_optics(const OpticsQuery &query, std::ostream &out) {
    const bool quad = query.precision == "quad";
    if (!quad && query.precision != "double")
        throw Error(Exit::usage, fmt::format("precision \"{}\" is unknown", query.precision), "it is double or quad");

    Json json;
    std::string table;
    if (query.rows_file) {
        Json document = read_json(*query.rows_file);
        json = quad ? answer_rows<optics::Quad>(std::move(document), *query.rows_file)
                    : answer_rows<double>(std::move(document), *query.rows_file);
    } else {
        const Input input = read_query(query);
        quad ? answer_single<optics::Quad>(query, input, json, table)
             : answer_single<double>(query, input, json, table);
    }
    if (query.json && *query.json != "-")
        write_file_atomically(*query.json, json.dump(1) + "\n");
    else if (query.json || query.rows_file)
        out << json.dump(1) << '\n';
    else
        out << table;
    return static_cast<int>(Exit::holds);
}

} // namespace threefold
