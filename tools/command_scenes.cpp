// SPDX-License-Identifier: MIT
// list and show: what there is to render and to check.
#include <memory>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "exporter/file_reader.h"
#include "exporter/mitsuba/read_mitsuba.h"
#include "exporter/scene_json.h"
#include "scenes/validate.h"
#include "tools/commands.h"
#include "verifier/report/text.h"

namespace threefold {

using Json = nlohmann::ordered_json;

std::vector<Assignment> parse_size(const std::string &size) {
    if (size.empty()) return {};
    const std::size_t cross = size.find('x');
    if (cross == std::string::npos || cross == 0 || cross + 1 == size.size())
        throw Error(Exit::usage, fmt::format("--size takes WIDTHxHEIGHT in pixels, not '{}'", size));
    return {{"image.width_px", size.substr(0, cross)}, {"image.height_px", size.substr(cross + 1)}};
}

Parameters parameters_of(const SceneRecipe &recipe, const SceneRequest &request) {
    Parameters values(recipe.parameters, parse_preset(request.preset), file_reader());
    for (const Assignment &a : parse_size(request.size)) values.set(a.name, a.value);
    for (const std::string &text : request.assignments) {
        const Assignment a = parse_assignment(text);
        values.set(a.name, a.value);
    }
    return values;
}

std::string scene_label(const SceneRequest &request) {
    return request.mitsuba.empty() ? request.name : std::filesystem::path(request.mitsuba).stem().string();
}

SceneRecipe recipe_of(const Shop &shop, const SceneRequest &request) {
    if (request.mitsuba.empty() == request.name.empty())
        throw Error(Exit::usage,
                    "name a scene of the catalogue (see: threefold list), or --mitsuba FILE.xml: one of them");
    return request.mitsuba.empty() ? find_scene(shop.scenes, request.name) : mitsuba_recipe(shop, request.mitsuba);
}

SceneRecipe mitsuba_recipe(const Shop &shop, const std::string &file) {
    const auto told = std::make_shared<std::set<std::string>>(); // a claim builds its scene several times
    return mitsuba_scene(
        file,
        [&shop, told](const std::string &note) {
            if (shop.verbosity > 0 && told->insert(note).second) say("note: " + note);
        },
        [told](const std::string &change) {
            if (told->insert(change).second) say("read otherwise than the file says: " + change);
        });
}

Scene scene_of(const Shop &shop, const SceneRequest &request) {
    const SceneRecipe recipe = recipe_of(shop, request);
    Scene scene = recipe.make(parameters_of(recipe, request));
    validate(scene);
    return scene;
}

Exit command_list(const Shop &shop, bool json) {
    if (json) {
        Json all{{"scenes", Json::array()}, {"claims", Json::array()}, {"faults", Json::array()}};
        for (const SceneRecipe &s : shop.scenes) all["scenes"].push_back({{"name", s.name}, {"summary", s.summary}});
        for (const Claim &c : shop.claims)
            all["claims"].push_back({{"name", c.name}, {"statement", c.statement}, {"mutant", to_string(c.mutant)}});
        for (const FaultEntry &f : faults())
            all["faults"].push_back({{"name", f.name}, {"description", f.description}});
        write_result("-", all.dump(2));
        return Exit::holds;
    }
    fmt::print("Scenes ({0} show SCENE, {0} render SCENE):\n", shop.program);
    for (const SceneRecipe &s : shop.scenes) fmt::print("  {:<16} {}\n", s.name, s.summary);
    fmt::print("\nClaims ({} check [CLAIM...]):\n", shop.program);
    for (const Claim &c : shop.claims) fmt::print("  {:<16} {}\n", c.name, c.statement);
    fmt::print("\nFaults ({} check --inject RENDERER:FAULT):\n", shop.program);
    for (const FaultEntry &f : faults()) fmt::print("  {:<20} {}\n", f.name, f.description);
    return Exit::holds;
}

namespace {

std::string range_of(const ParameterSpec &s) {
    if (s.path) return "a file";
    return s.is_number() ? fmt::format("[{:g}, {:g}]", s.least, s.greatest)
                         : fmt::format("{}", fmt::join(s.choices, "|"));
}

/// A file may have any name, and a table row has one line.
std::string value_of(const Parameters &values, const ParameterSpec &s) {
    if (!s.path) return values.text(s.name);
    return values.word(s.name).empty() ? "generated" : shell_quoted(report::one_line(values.word(s.name)));
}

std::string unit_of(const std::string &name) {
    for (const char *unit : {"mm", "px", "deg", "rad"})
        if (name.ends_with(fmt::format("_{}", unit))) return unit;
    return "";
}

} // namespace

Exit command_show(const Shop &shop, const SceneRequest &request, bool json) {
    const SceneRecipe recipe = recipe_of(shop, request);
    const Parameters values = parameters_of(recipe, request);
    const Scene scene = scene_of(shop, request);
    const Parameters text(recipe.parameters, Preset::text), published(recipe.parameters, Preset::published);
    if (json) {
        Json all{{"name", recipe.name},
                 {"summary", recipe.summary},
                 {"preset", request.preset},
                 {"parameters", Json::object()}};
        for (const ParameterSpec &s : recipe.parameters) {
            Json p{{"description", s.description}, {"unit", unit_of(s.name)}};
            if (s.path)
                p.update({{"value", report::valid_utf8(values.word(s.name))},
                          {"text", ""},
                          {"published", ""},
                          {"file", true}});
            else if (s.is_number())
                p.update({{"value", values.number(s.name)},
                          {"text", s.text},
                          {"published", s.published},
                          {"least", s.least},
                          {"greatest", s.greatest}});
            else
                p.update({{"value", values.word(s.name)}, {"choices", s.choices}});
            all["parameters"][s.name] = std::move(p);
        }
        all["scene"] = to_json(scene);
        all["scene_hash"] = scene_hash(scene);
        write_result("-", all.dump(2));
        return Exit::holds;
    }
    fmt::print("{}: {}\n\n", recipe.name, recipe.summary);
    fmt::print("  {:<28} {:>12} {:>12} {:>12}  {:<4} {:<24} {}\n", "parameter", "value", "text", "published", "unit",
               "range", "meaning");
    for (const ParameterSpec &s : recipe.parameters)
        fmt::print("  {:<28} {:>12} {:>12} {:>12}  {:<4} {:<24} {}\n", s.name, value_of(values, s), value_of(text, s),
                   value_of(published, s), unit_of(s.name), range_of(s), s.description);
    const Needs n = needs(scene);
    std::vector<std::string> wants;
    if (n.ray_tree) wants.emplace_back("a tree of reflected and refracted rays");
    if (n.glass && !n.ray_tree) wants.emplace_back("refraction without reflection");
    if (n.direct_light) wants.emplace_back("direct light on diffuse surfaces");
    if (n.glass_shadow) wants.emplace_back("light through glass");
    if (n.caustics) wants.emplace_back("caustics");
    fmt::print("\nneeds: {}\n", wants.empty() ? "nothing but emitters" : fmt::format("{}", fmt::join(wants, ", ")));
    fmt::print("scene hash: {}\n", scene_hash(scene));
    return Exit::holds;
}

} // namespace threefold
