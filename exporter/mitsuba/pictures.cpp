// SPDX-License-Identifier: MIT
#include "exporter/mitsuba/pictures.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "exporter/mitsuba/write_mitsuba.h"
#include "exporter/process/shell.h"
#include "scenes/access.h"
#include "scenes/error.h"
#include "scenes/geometry.h"
#include "scenes/validate.h"

namespace threefold {

namespace {

/// Odd: the middle part of a pixel has the pixel's centre.
constexpr int parts = 15;

/// Paths choose one branch at random where light splits: samples for one of a renderer that follows both.
constexpr int sample_factor = 16;

/// Greatest share of paths that single precision loses in glass. With Mitsuba 3.8, scalar_rgb, it was about one in a
/// million.
constexpr double lost_in_glass = 5e-6;

int part_of(double offset_px) {
    return std::clamp(static_cast<int>(std::floor((0.5 + offset_px) * parts)), 0, parts - 1);
}

Camera finer(Camera camera) {
    if (!camera.crop) camera.crop = Crop{0, 0, camera.width_px, camera.height_px};
    Crop &crop = *camera.crop;
    if (std::max(camera.width_px, camera.height_px) > std::numeric_limits<int>::max() / parts)
        throw Error(Exit::bad_data, fmt::format("Mitsuba: a film of {} x {} px cannot be made {} times finer",
                                                camera.width_px, camera.height_px, parts));
    for (int *pixels : {&camera.width_px, &camera.height_px, &crop.x_px, &crop.y_px, &crop.width_px, &crop.height_px})
        *pixels *= parts;
    camera.film_offset_px = Vec2(0);
    return camera;
}

double extent_mm(const Scene &scene) {
    double extent = glm::length(scene.camera.eye_mm);
    for (const Object &object : scene.objects) {
        if (const auto orb = outer_sphere(object.shape))
            extent = std::max(extent, glm::length(orb->centre_mm) + orb->radius_mm);
        for_each_triangle(object.shape, [&](const Triangle &t) {
            extent = std::max({extent, glm::length(t.a), glm::length(t.b), glm::length(t.c)});
        });
    }
    return extent;
}

/// Pictures are named by a label and a hash of all that they depend on.
std::string label_of(const std::filesystem::path &picture) {
    const std::string name = picture.filename().string();
    return name.substr(0, std::min(name.rfind('-'), name.size()));
}

Error missing_picture(const std::filesystem::path &path) {
    std::error_code ignored;
    for (const auto &entry : std::filesystem::directory_iterator(path.parent_path(), ignored))
        if (label_of(entry.path()) == label_of(path) && entry.path().stem().extension() == path.stem().extension())
            return {Exit::input_output,
                    fmt::format("the picture {} is missing: the folder has {}, which was exported with other options",
                                path.string(), entry.path().filename().string()),
                    "give check --image the options that --export had: --quick, --preset, --set, --seed, --replicates"};
    return {Exit::input_output, fmt::format("the picture {} is missing", path.string()),
            "check --export mitsuba=FOLDER writes the scenes and the script that renders them"};
}

} // namespace

MitsubaJob to_mitsuba_job(const RenderJob &job, std::string_view label) {
    const auto refuse = [](const std::string &what) { throw Error(Exit::bad_data, "Mitsuba: " + what); };
    if (job.most_bounces) refuse("how many surfaces a path may meet is not asked of it");
    if (job.slip != Slip{}) refuse("it cannot be made to follow light wrongly on purpose");
    const bool centres = job.sampling == Sampling::pixel_centres;
    const Needs needed = needs(job.scene);
    if (job.samples_per_pixel > std::numeric_limits<int>::max() / sample_factor)
        refuse(fmt::format("{} samples per pixel are too many", job.samples_per_pixel));
    MitsubaJob made;
    made.finer = centres ? parts : 1;
    made.samples_per_pixel =
        (centres ? 4 : job.samples_per_pixel) * (needed.ray_tree || needed.many_lights ? sample_factor : 1);
    if (centres && !needed.ray_tree && !needed.many_lights) made.samples_per_pixel = 1;
    Scene scene = job.scene;
    if (centres)
        scene.camera = finer(scene.camera);
    else
        for (const Replicate &r : job.replicates)
            if (r.film_offset_px != Vec2(0)) refuse("replicates of whole pixels that are shifted");
    MitsubaFiles files = to_mitsuba(scene, "scene", made.samples_per_pixel, 1);
    std::vector<std::string> lost;
    for (const MitsubaLoss &loss : files.losses)
        if (loss.changes_picture) lost.push_back(loss.what);
    if (!lost.empty()) refuse(fmt::format("it cannot say {}", fmt::join(lost, "; ")));

    std::string content;
    for (const ExportedFile &file : files.files) content += file.name + '\0' + content_hash(file.bytes);
    for (const Replicate &r : job.replicates) {
        made.seeds.push_back(r.seed % 0x7fffffff);
        content += fmt::format("{} {} {}\n", made.seeds.back(), r.film_offset_px.x, r.film_offset_px.y);
    }
    for (const char c : label)
        made.name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
    made.name += "-" + content_hash(content).substr(0, 10);
    files.files.front().name = made.name + ".xml";
    made.files = std::move(files.files);
    for (std::size_t k = 1; k <= job.replicates.size(); ++k)
        made.pictures.push_back(fmt::format("{}.{}.exr", made.name, k));
    made.width_px = job.scene.camera.image_width_px() * made.finer;
    made.height_px = job.scene.camera.image_height_px() * made.finer;

    constexpr double epsilon = std::numeric_limits<float>::epsilon();
    made.accuracy.radiance_step = greatest_radiance(job.scene) * epsilon / 2;
    made.accuracy.rounding_mm = epsilon * extent_mm(job.scene);
    if (needed.glass) {
        made.accuracy.lost_paths = lost_in_glass;
        made.accuracy.paths_per_pixel = made.samples_per_pixel;
    }
    made.accuracy.random_branches = needed.ray_tree || needed.many_lights;
    // A sample lies anywhere in its part of the pixel, and the part's centre up to half a part from the place asked
    // for.
    if (centres) made.accuracy.filter_px = std::sqrt(2.0 / 12) / parts;
    return made;
}

double samples_to_render(const std::vector<MitsubaJob> &jobs) {
    double samples = 0;
    for (const MitsubaJob &job : jobs)
        samples += static_cast<double>(job.width_px) * job.height_px * job.samples_per_pixel *
                   static_cast<double>(job.pictures.size());
    return samples;
}

std::string render_script(const std::vector<MitsubaJob> &jobs) {
    std::string script =
        "#!/bin/sh\n"
        "# Renders every picture that is not there yet, with Mitsuba 3 (MITSUBA: the program; VARIANT).\n"
        "set -eu\ncd \"$(dirname \"$0\")\"\n"
        "picture() { # scene seed picture\n"
        "    [ -e \"$3\" ] && return\n"
        "    \"${MITSUBA:-mitsuba}\" -m \"${VARIANT:-scalar_rgb}\" -D seed=\"$2\" -o \"part-$3\" \"$1\"\n"
        "    mv \"part-$3\" \"$3\"\n}\n";
    for (const MitsubaJob &job : jobs)
        for (std::size_t k = 0; k < job.pictures.size(); ++k)
            script += fmt::format("picture {} {} {}\n", shell_quoted(job.files.front().name), job.seeds[k],
                                  shell_quoted(job.pictures[k]));
    return script;
}

std::vector<Image> read_pictures(const MitsubaJob &asked, const RenderJob &job, const std::filesystem::path &folder) {
    std::vector<Image> images;
    for (std::size_t k = 0; k < asked.pictures.size(); ++k) {
        const std::filesystem::path path = folder / asked.pictures[k];
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) throw missing_picture(path);
        const Image read = read_image(path, Encoding::linear);
        if (read.width != asked.width_px || read.height != asked.height_px)
            throw Error(Exit::bad_data, fmt::format("the picture {} is {} x {} px, not {} x {}", path.string(),
                                                    read.width, read.height, asked.width_px, asked.height_px));
        if (asked.finer == 1) {
            images.push_back(read);
            continue;
        }
        const Vec2 offset = job.scene.camera.film_offset_px + job.replicates[k].film_offset_px;
        Image image(job.scene.camera.image_width_px(), job.scene.camera.image_height_px());
        for (int row = 0; row < image.height; ++row)
            for (int column = 0; column < image.width; ++column)
                image.at(column, row) = read.at(column * parts + part_of(offset.x), row * parts + part_of(offset.y));
        images.push_back(std::move(image));
    }
    return images;
}

} // namespace threefold
