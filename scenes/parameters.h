// SPDX-License-Identifier: MIT
// A scene is a function of named parameters: their values under the two presets, units, ranges, and `--set name=value`.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/file_reader.h"
#include "scenes/scene.h"

namespace threefold {

/// `text`: the study's wording. `published`: its scene files. They differ; every conclusion is checked under both.
enum class Preset { text, published };

Preset parse_preset(std::string_view name);
std::string_view to_string(Preset preset);

/// One parameter. A number has a range; a word has `choices` and no range; a path has neither.
struct ParameterSpec {
    std::string name; ///< e.g. "orb.wall_mm"; the suffix is the unit
    std::string description{};
    double text = 0, published = 0; ///< value under each preset (numbers)
    double least = -std::numeric_limits<double>::infinity();
    double greatest = std::numeric_limits<double>::infinity();
    bool whole = false;                 ///< only whole numbers
    std::vector<std::string> choices{}; ///< words; the first is the default
    /// The name of a file of the user's own; empty, the default: what the scene generates itself.
    bool path = false;

    bool is_number() const { return choices.empty() && !path; }
};

class Parameters {
public:
    /// `files` reads what path parameters name; without it, a scene that needs a file throws Error(internal).
    Parameters(std::vector<ParameterSpec> specs, Preset preset, FileReader files = no_files());

    /// Throws Error(usage) for an unknown name (with the nearest), Error(bad_data) for a value that is no number, not
    /// finite, out of range or no choice.
    void set(std::string_view name, std::string_view value);
    void set(std::string_view name, double value);

    bool has(std::string_view name) const;
    double number(std::string_view name) const;
    /// A word, or a path.
    const std::string &word(std::string_view name) const;
    /// As `--set` would take it.
    std::string text(std::string_view name) const;

    const std::vector<ParameterSpec> &specs() const { return specs_; }
    Preset preset() const { return preset_; }
    const FileReader &files() const { return files_; }

private:
    const ParameterSpec &spec(std::string_view name) const;

    std::vector<ParameterSpec> specs_;
    Preset preset_;
    FileReader files_;
    std::map<std::string, double, std::less<>> numbers_;
    std::map<std::string, std::string, std::less<>> words_;
};

/// A decimal number and nothing beside it; "inf" and "nan" count as numbers.
std::optional<double> parse_number(std::string_view text);

/// A `name=value` of the command line.
struct Assignment {
    std::string name, value;
};

Assignment parse_assignment(std::string_view text);

/// A scene of the catalogue, or of a user's own.
struct SceneRecipe {
    std::string name;
    std::string summary;
    std::vector<ParameterSpec> parameters;
    std::function<Scene(const Parameters &)> build;

    /// Parameters of the preset with the assignments made, built and named. Not yet validated.
    Scene make(const Parameters &values) const;
};

/// The recipe of that name; Error(usage) names the valid ones and the nearest.
const SceneRecipe &find_scene(const std::vector<SceneRecipe> &scenes, std::string_view name);

/// "unknown KIND 'name'; did you mean 'nearest'? valid: a, b, c": one line for every unknown name.
std::string unknown_name(std::string_view kind, std::string_view name, const std::vector<std::string> &valid);

} // namespace threefold
