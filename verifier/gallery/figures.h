// SPDX-License-Identifier: MIT
// The study's figures as data: which scene, with which parameters, in which window. The letters are the study's.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/parameters.h"

namespace threefold {

/// A parameter's value under each preset.
struct FigureSetting {
    std::string name, text, published;
};

struct FigureSource {
    std::string scene; ///< of the catalogue
    std::vector<FigureSetting> settings{};
};

/// One way to make a figure. Sizes and window are the study's, in pixels; a gallery scales them.
struct FigureWay {
    std::vector<FigureSource> averaged;  ///< the figure is the mean of their pictures
    int width_px = 512, height_px = 512; ///< of the full film
    std::optional<Crop> window{};        ///< rendered alone, by the scene's image.crop_* parameters
};

struct Figure {
    std::string number; ///< "3A"
    std::string caption;
    std::vector<FigureWay> ways; ///< the first whose scenes and parameters the catalogue has
};

std::vector<Figure> study_figures();

/// Null where the catalogue has none of them.
const FigureWay *possible_way(const Figure &figure, const std::vector<SceneRecipe> &scenes);

/// What a source is rendered with: the user's assignments where the scene has them, then the figure's own, then the
/// size of the scaled film and of the window on it.
std::vector<Assignment> assignments_of(const FigureWay &way, const FigureSource &source, const SceneRecipe &recipe,
                                       Preset preset, const std::vector<Assignment> &user, double scale);

} // namespace threefold
