// SPDX-License-Identifier: MIT
#include "verifier/claims/whole_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/access.h"
#include "scenes/camera.h"
#include "scenes/error.h"
#include "verifier/claims/unshadowed.h"

namespace threefold {

namespace {

constexpr double tile_share = 0.024;  ///< of the predicted mean: shadows make the picture darker than predicted
constexpr double tiles_needed = 0.99; ///< a renderer's facets may show in one tile of a hundred
constexpr double border_px = 0.05;

std::vector<Assignment> size_of(int width_px, int height_px) {
    return {assign("image.width_px", width_px), assign("image.height_px", height_px)};
}

/// Side of a pixel at the nearest orb; 0 where there is none.
double pixel_at_orb_mm(const Scene &scene) {
    const Film film(scene.camera);
    double least = 0;
    for (const Object &object : scene.objects)
        if (const auto sphere = outer_sphere(object.shape)) {
            const double distance = film.is_perspective() ? glm::length(film.eye_mm() - sphere->centre_mm) : 1;
            least = least > 0 ? std::min(least, film.pixel() * distance) : film.pixel() * distance;
        }
    return least;
}

} // namespace

void compare_as_picture(Experiment &e, int replicates) {
    // One ray a pixel, through another point of it in each replicate and through the same one in all renderers.
    e.sampling = Sampling::pixel_centres;
    e.samples_per_pixel = 96;
    e.shift_replicates = true;
    e.replicates = replicates;
    e.cut_weight = 1e-5; // at 1e-3 a rim before something bright lacked a fifth of the picture's mean radiance
    e.tile_px = 16;
    e.tiles_needed_share = tiles_needed;
    e.surface_tolerance_mm = 0.01 * pixel_at_orb_mm(e.scene);
    const double mean = unshadowed_mean_radiance(e.scene);
    if (!(mean > 0))
        throw Error(Exit::bad_data,
                    fmt::format("{}: nothing in the picture, glass left out, is lit or sends light", e.record.scene),
                    "point the camera at something, or --set environment.radiance=1");
    e.tile_budget = [=](const Accuracy &, const Accuracy &) {
        return std::vector<BudgetItem>{
            {"resolution", tile_share * mean,
             fmt::format("{:.2g} % of the picture's mean radiance as it would be without shadows ({:.3g}), the least "
                         "difference that matters here; quantisation, tessellation and cut ray trees lie far below it",
                         100 * tile_share, mean)}};
    };
}

Experiment whole_picture(const ClaimContext &context, const std::string &scene, int width_px, int height_px,
                         int replicates) {
    std::vector<Assignment> defaults = size_of(width_px, height_px);
    // Fewer facets and fewer lights than the scene's own: what they are makes no difference to whether renderers agree.
    defaults.push_back(assign("robe.relief_resolution", 150));
    defaults.push_back(assign("environment.dome_directions", 12));
    Experiment e = context.experiment(scene + "-picture", "the lit and painted scene, to be compared tile by tile",
                                      scene, defaults, {assign("figure.surface", "painted")});
    compare_as_picture(e, replicates);
    return e;
}

Experiment border_experiment(const ClaimContext &context, const std::string &scene, int width_px, int height_px,
                             const Border &border) {
    std::vector<Assignment> defaults = size_of(width_px, height_px);
    defaults.push_back(assign("robe.relief_resolution", 50));
    Experiment e =
        context.experiment(scene + "-border", fmt::format("where the {}'s border lies", border.object), scene, defaults,
                           {assign("figure.surface", "identity"), assign("glass.coating", "antireflective")});
    e.sampling = Sampling::box;
    e.samples_per_pixel = 64;
    e.replicates = 4;
    e.surface_tolerance_mm = 0.1 * pixel_at_orb_mm(e.scene);
    const std::string quantity = fmt::format("left border of the {}", border.object);
    Camera &camera = e.scene.camera;
    const int top = camera.height_px * 2 / 5, rows = std::max(1, camera.height_px / 10);
    double where = 0;
    for (int row = 0; row < rows; ++row) where += border.column_px(camera, top + row + 0.5) / rows;
    if (camera.crop || !(where > 1 && where < camera.width_px - 1)) return e; // not in this picture
    camera.crop = Crop{0, top, std::min(camera.width_px, static_cast<int>(where) + 10), rows};
    e.predict = [=](const Accuracy &) {
        return std::vector<Expected>{
            {quantity,
             "px",
             Relation::equal,
             where,
             {{"sampling", border_px, "a border's place by the coverage of pixels, each from a finite grid of rays"}}}};
    };
    e.measure = [=](const Image &image, const Camera &) {
        double sum = 0;
        for (int row = 0; row < image.height; ++row) {
            double before = 0;
            for (int column = 0; column < image.width; ++column) {
                const double inside = glm::dot(image.at(column, row), border.inside);
                before += 1 - std::clamp(inside, 0.0, 1.0);
                if (inside > 0.99) break;
            }
            sum += before;
        }
        return std::vector<Reading>{{quantity, sum / image.height}};
    };
    e.draw = [=](const Image &, const Camera &from) {
        return std::vector<Mark>{{Mark::Kind::line,
                                  {border.column_px(from, top), 0},
                                  {border.column_px(from, top + rows), static_cast<double>(rows)},
                                  0,
                                  Mark::Meaning::expected,
                                  quantity}};
    };
    return e;
}

} // namespace threefold
