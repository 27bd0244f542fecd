// SPDX-License-Identifier: MIT
#include "scenes/parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scenes/error.h"

namespace threefold {

namespace {

/// Levenshtein distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

} // namespace

std::string unknown_name(std::string_view kind, std::string_view name, const std::vector<std::string> &valid) {
    const auto nearest = std::ranges::min_element(
        valid, {}, [name](const std::string &candidate) { return edit_distance(name, candidate); });
    const bool close =
        nearest != valid.end() && edit_distance(name, *nearest) <= std::max<std::size_t>(3, name.size() / 2);
    return fmt::format("unknown {} '{}'{}; valid: {}", kind, name,
                       close ? fmt::format(" (did you mean '{}'?)", *nearest) : "", fmt::join(valid, ", "));
}

Preset parse_preset(std::string_view name) {
    if (name == "text") return Preset::text;
    if (name == "published") return Preset::published;
    throw Error(Exit::usage, unknown_name("preset", name, {"text", "published"}));
}

std::string_view to_string(Preset preset) {
    switch (preset) {
    case Preset::text:
        return "text";
    case Preset::published:
        return "published";
    }
    return "";
}

FileReader no_files() {
    const auto refuse = [](const std::string &path) {
        return Error(Exit::internal,
                     fmt::format("the parameters were made without a reader of files: cannot read {}", path));
    };
    return {[refuse](const std::string &path) -> Mesh { throw refuse(path); },
            [refuse](const std::string &path, double) -> std::shared_ptr<const Texture> { throw refuse(path); }};
}

Parameters::Parameters(std::vector<ParameterSpec> specs, Preset preset, FileReader files)
    : specs_(std::move(specs)), preset_(preset), files_(std::move(files)) {
    for (const ParameterSpec &s : specs_) {
        if (s.is_number())
            numbers_[s.name] = preset == Preset::text ? s.text : s.published;
        else
            words_[s.name] = s.path ? "" : s.choices.front();
    }
}

bool Parameters::has(std::string_view name) const {
    return std::ranges::any_of(specs_, [name](const ParameterSpec &s) { return s.name == name; });
}

const ParameterSpec &Parameters::spec(std::string_view name) const {
    const auto found = std::ranges::find(specs_, name, &ParameterSpec::name);
    if (found != specs_.end()) return *found;
    std::vector<std::string> valid;
    for (const ParameterSpec &s : specs_) valid.push_back(s.name);
    throw Error(Exit::usage, unknown_name("parameter", name, valid));
}

void Parameters::set(std::string_view name, double value) {
    const ParameterSpec &s = spec(name);
    if (s.path) throw Error(Exit::bad_data, fmt::format("{} takes the name of a file", name));
    if (!s.choices.empty())
        throw Error(Exit::bad_data, fmt::format("{} takes a word: {}", name, fmt::join(s.choices, ", ")));
    if (!std::isfinite(value))
        throw Error(Exit::bad_data, fmt::format("{} must be a finite number, not {}", name, value));
    if (value < s.least || value > s.greatest)
        throw Error(Exit::bad_data,
                    fmt::format("{} = {} is out of range: it must lie in [{}, {}]", name, value, s.least, s.greatest));
    if (s.whole && value != std::floor(value))
        throw Error(Exit::bad_data, fmt::format("{} = {} must be a whole number", name, value));
    numbers_.find(name)->second = value;
}

void Parameters::set(std::string_view name, std::string_view value) {
    const ParameterSpec &s = spec(name);
    if (s.path) {
        words_.find(name)->second = value;
        return;
    }
    if (!s.choices.empty()) {
        if (std::ranges::find(s.choices, value) == s.choices.end())
            throw Error(Exit::bad_data, unknown_name(fmt::format("value for {}", name), value, s.choices));
        words_.find(name)->second = value;
        return;
    }
    const auto number = parse_number(value);
    if (!number) throw Error(Exit::bad_data, fmt::format("{} must be a number, not '{}'", name, value));
    set(name, *number);
}

double Parameters::number(std::string_view name) const {
    const auto found = numbers_.find(name);
    if (found == numbers_.end())
        throw Error(Exit::internal, fmt::format("the scene asked for a number '{}' that it does not declare", name));
    return found->second;
}

const std::string &Parameters::word(std::string_view name) const {
    const auto found = words_.find(name);
    if (found == words_.end())
        throw Error(Exit::internal, fmt::format("the scene asked for a word '{}' that it does not declare", name));
    return found->second;
}

std::string Parameters::text(std::string_view name) const {
    return spec(name).is_number() ? fmt::format("{}", number(name)) : word(name);
}

std::optional<double> parse_number(std::string_view text) {
    double number = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (status != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

Assignment parse_assignment(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos || equals == 0)
        throw Error(Exit::usage, fmt::format("--set takes name=value, not '{}'", text));
    return {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

Scene SceneRecipe::make(const Parameters &values) const {
    Scene scene = build(values);
    if (scene.name.empty()) scene.name = name;
    return scene;
}

const SceneRecipe &find_scene(const std::vector<SceneRecipe> &scenes, std::string_view name) {
    const auto found = std::ranges::find(scenes, name, &SceneRecipe::name);
    if (found != scenes.end()) return *found;
    std::vector<std::string> valid;
    for (const SceneRecipe &s : scenes) valid.push_back(s.name);
    throw Error(Exit::usage, unknown_name("scene", name, valid));
}

} // namespace threefold
