// SPDX-License-Identifier: MIT
#include "verifier/gallery/figures.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

namespace threefold {

namespace {

constexpr int whole_width_px = 1408, whole_height_px = 2072;
// The windows of the published files: the orb, and its upper right boundary on a finer film.
constexpr Crop orb_window{872, 1530, 512, 512};
constexpr int fine_width_px = 3072, fine_height_px = 4521;
constexpr Crop boundary_window{2513, 3300, 512, 512};

const FigureSetting thick_wall{"orb.wall_mm", "2.6", "2.72"}, cloth{"robe.surface", "cloth", "cloth"};
// The study's words move the orb to the left, its files the relief to the right.
const FigureSetting orb_shifted{"orb.shift_mm", "-10", "0"}, robe_shifted{"robe.shift_mm", "0", "10"};
constexpr std::string_view crop_parameters[]{"image.crop_x_px", "image.crop_y_px", "image.crop_width_px",
                                             "image.crop_height_px"};

FigureWay whole(std::string scene, int width_px = 512, int height_px = 512) {
    return {{{std::move(scene)}}, width_px, height_px};
}

FigureWay orb_of_painting(std::vector<FigureSetting> settings) {
    return {{{"salvator", std::move(settings)}}, whole_width_px, whole_height_px, orb_window};
}

FigureWay boundary_of_painting(std::vector<FigureSetting> settings) {
    return {{{"salvator", std::move(settings)}}, fine_width_px, fine_height_px, boundary_window};
}

FigureWay with(std::string scene, std::vector<FigureSetting> settings) {
    return {{{std::move(scene), std::move(settings)}}};
}

bool has_parameter(const SceneRecipe &recipe, std::string_view name) {
    return std::ranges::count(recipe.parameters, name, &ParameterSpec::name) > 0;
}

bool can_show(const SceneRecipe &recipe, const FigureWay &way, const FigureSource &source) {
    const auto has = [&](std::string_view name) { return has_parameter(recipe, name); };
    return std::ranges::all_of(source.settings, has, &FigureSetting::name) &&
           (!way.window || std::ranges::all_of(crop_parameters, has));
}

int scaled(int px, double scale) { return std::max(1, static_cast<int>(std::lround(px * scale))); }

} // namespace

std::vector<Figure> study_figures() {
    return {
        {"1B", "The whole composition, with a hollow orb.", {whole("salvator", whole_width_px, whole_height_px)}},
        {"2", "The set-up seen from aside: relief, hand, orb and camera.", {whole("setup", 1024, 512)}},
        {"3A",
         "A solid orb. In the study it turns what lies behind it upside down, and hides the palm (claims "
         "solid-vs-hollow, palm).",
         {orb_of_painting({{"orb.kind", "solid", "solid"}}), whole("solid")}},
        {"3B",
         "A hollow orb. In the study it leaves that upright and nearly in its place.",
         {orb_of_painting({}), whole("hollow")}},
        {"4A",
         "Three lines behind an orb, seen from aside: how the next three pictures are made.",
         {whole("three-lines-setup")}},
        {"4B",
         "Three lines behind a hollow orb. In the study the middle one crosses its boundary unbroken (claim "
         "three-lines).",
         {whole("three-lines-hollow")}},
        {"4C",
         "The same three lines behind a solid orb. In the study, again, only the middle one crosses unbroken.",
         {whole("three-lines-solid")}},
        {"4D", "The middle line bent outside the orb. In the study it breaks now too.", {whole("three-lines-bent")}},
        {"5C",
         "The study's thin wall: it saw the folds cross the upper right boundary with no break that one notices. What "
         "an eye would notice is the matter of the claim wall-limit.",
         {boundary_of_painting({}), with("folds", {cloth})}},
        {"5D",
         "Five folds cross the boundary; four of them aim at the orb's centre, the leftmost does not. In the study "
         "that one breaks (claim folds).",
         {with("folds", {cloth})}},
        {"6A",
         "A wall of twice the thickness. In the study a dark layer, a reflection of the surroundings, cuts the folds "
         "(claims rim-reads-wall, dark-layer).",
         {boundary_of_painting({thick_wall}), with("folds", {cloth, thick_wall})}},
        {"6B",
         "Orb and robe 1 cm out of line. In the study the folds break (claim shift).",
         {boundary_of_painting({orb_shifted, robe_shifted}), with("folds", {cloth, orb_shifted, robe_shifted})}},
        {"7",
         "A solid ball of calcite, as the mean of two balls with its two indices: in the study it distorts far more "
         "than its double image separates (claim calcite).",
         {{{{"calcite", {{"calcite.ray", "ordinary", "ordinary"}}},
            {"calcite", {{"calcite.ray", "extraordinary", "extraordinary"}}}}},
          {{{"solid", {{"glass.index", "1.486", "1.486"}}}, {"solid", {{"glass.index", "1.658", "1.658"}}}}}}},
    };
}

const FigureWay *possible_way(const Figure &figure, const std::vector<SceneRecipe> &scenes) {
    for (const FigureWay &way : figure.ways) {
        const bool possible = std::ranges::all_of(way.averaged, [&](const FigureSource &source) {
            const auto recipe = std::ranges::find(scenes, source.scene, &SceneRecipe::name);
            return recipe != scenes.end() && can_show(*recipe, way, source);
        });
        if (possible) return &way;
    }
    return nullptr;
}

std::vector<Assignment> assignments_of(const FigureWay &way, const FigureSource &source, const SceneRecipe &recipe,
                                       Preset preset, const std::vector<Assignment> &user, double scale) {
    std::vector<Assignment> all;
    const auto add = [&](Assignment a) {
        if (!has_parameter(recipe, a.name)) return;
        std::erase_if(all, [&](const Assignment &earlier) { return earlier.name == a.name; });
        all.push_back(std::move(a));
    };
    for (const Assignment &a : user) add(a);
    for (const FigureSetting &s : source.settings) add({s.name, preset == Preset::text ? s.text : s.published});
    add({"image.width_px", std::to_string(scaled(way.width_px, scale))});
    add({"image.height_px", std::to_string(scaled(way.height_px, scale))});
    if (way.window) {
        const auto at = [&](int px) { return std::to_string(static_cast<int>(std::lround(px * scale))); };
        const std::string values[]{at(way.window->x_px), at(way.window->y_px),
                                   std::to_string(scaled(way.window->width_px, scale)),
                                   std::to_string(scaled(way.window->height_px, scale))};
        for (std::size_t i = 0; i < std::size(values); ++i) add({std::string(crop_parameters[i]), values[i]});
    }
    return all;
}

} // namespace threefold
