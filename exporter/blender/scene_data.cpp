// SPDX-License-Identifier: MIT
#include "exporter/blender/scene_data.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "exporter/blender/grazing.h"
#include "exporter/blender/objects.h"
#include "exporter/blender/to_blender.h"
#include "exporter/trapped_light.h"
#include "scenes/access.h"
#include "scenes/camera.h"
#include "scenes/light.h"
#include "scenes/validate.h"

namespace threefold {

namespace {

using Json = nlohmann::ordered_json;

constexpr double float_epsilon = 0x1p-23; ///< spacing of Cycles' numbers, relative
/// A gap must be this many spacings wide (measured: right at 120, 7 % of the pixels wrong at 12).
constexpr double spacings_per_gap = 100;
/// A ray that meets an edge between two triangles may slip through both. Measured: one path in 60,000 through an orb.
constexpr double lost_at_edges = 5e-5;
/// Glass farther from the origin than this many of its radii is drawn out of place (measured: right to 10, by 4 pixels
/// wrong at 100).
constexpr double farthest_glass_radii = 10;
/// The camera's near plane stands at 1e-4 units, and the script says so. Measured: an eye 1e-3 units from the glass
/// errs by 1e-4 of the radius, at 1e-4 units it looks from inside.
constexpr double nearest_eye_in_units = 0.99e-3;
constexpr int deepest_path = 256; ///< bounces: DEEPEST of the script

std::vector<Sphere> outer_spheres(const Scene &scene) {
    std::vector<Sphere> spheres;
    for (const Object &object : scene.objects)
        if (const auto sphere = outer_sphere(object.shape)) spheres.push_back(*sphere);
    return spheres;
}

double strength_of(const Directional &light) {
    return std::max({light.irradiance.r, light.irradiance.g, light.irradiance.b});
}

/// Cycles chooses one light for each sample, all alike: a strong one among weak ones is most of the noise. Several suns
/// in the place of one, as strong as the others, are the same light, and are chosen as often as they matter.
constexpr double most_copies = 64;

Json write_lights(const std::vector<Directional> &lights) {
    double sum = 0, squares = 0;
    for (const Directional &light : lights) {
        sum += strength_of(light);
        squares += strength_of(light) * strength_of(light);
    }
    // The mean strength, each light weighted by its own; half of it, so that lights of the usual strength stay whole.
    const double usual = sum > 0 ? squares / sum / 2 : 1;
    Json suns = Json::array();
    for (const Directional &light : lights) {
        const double strength = strength_of(light);
        if (!(strength > 0)) continue;
        const double copies = std::clamp(std::round(strength / usual), 1.0, most_copies);
        const Json sun{{"towards", to_json(glm::normalize(ToBlender::direction(-light.travel)))},
                       {"strength", strength / copies},
                       {"colour", to_json(light.irradiance / strength)}};
        for (int i = 0; i < static_cast<int>(copies); ++i) suns.push_back(sun);
    }
    return suns;
}

/// The film is the crop alone, a window that is shifted off the axis.
Json write_camera(const Camera &camera, const Frame &frame, const ToBlender &to_blender) {
    constexpr int least_film_px = 4, greatest_film_px = 65536;
    const auto [narrow, wide] = std::minmax({camera.image_width_px(), camera.image_height_px()});
    if (narrow < least_film_px || wide > greatest_film_px)
        refuse_for_cycles(fmt::format("a picture of {} x {} pixels: Blender's films have {} to {} on a side",
                                      camera.image_width_px(), camera.image_height_px(), least_film_px,
                                      greatest_film_px));
    const auto [right, up, forward] = camera_frame(camera);
    Json json = {{"eye", to_json(to_blender.point(camera.eye_mm))},
                 {"right", to_json(ToBlender::direction(right))},
                 {"up", to_json(ToBlender::direction(up))},
                 {"back", to_json(ToBlender::direction(-forward))},
                 {"width_px", camera.image_width_px()},
                 {"height_px", camera.image_height_px()},
                 {"farthest", 4 * to_blender.length(frame.extent_mm) + 4}};
    const double half_width = film_half_width(camera) * camera.image_width_px() / camera.width_px;
    switch (camera.projection) {
    case Projection::perspective: {
        // Only the ratio counts; Blender wants a sensor of 1 to 100 mm and a lens of 1 to 5000 mm.
        const double sensor_mm = std::clamp(100 * half_width, 1.0, 100.0);
        const double lens_mm = sensor_mm / (2 * half_width);
        if (lens_mm < 1 || lens_mm > 5000)
            refuse_for_cycles(
                fmt::format("a picture {:.3g} times as wide as it is far away is beyond Blender's lenses, which reach "
                            "from 0.0002 to 100",
                            2 * half_width));
        json["projection"] = "perspective";
        json["sensor_width"] = sensor_mm;
        json["lens"] = lens_mm;
        break;
    }
    case Projection::orthographic:
        json["projection"] = "orthographic";
        json["width"] = to_blender.length(2 * half_width);
        break;
    }
    return json;
}

/// Where the window's centre lies, in widths of the window from the axis.
Vec2 window_shift(const Camera &camera, Vec2 offset_px) {
    const Crop window = camera.crop.value_or(Crop{0, 0, camera.width_px, camera.height_px});
    return Vec2(window.x_px + window.width_px / 2.0 + offset_px.x - camera.width_px / 2.0,
                camera.height_px / 2.0 - window.y_px - window.height_px / 2.0 - offset_px.y) /
           static_cast<double>(window.width_px);
}

/// Blender's seeds have 31 bits. Small seeds stay what they are, so that different ones stay different.
std::uint32_t fold_seed(std::uint64_t seed) {
    return static_cast<std::uint32_t>((seed ^ seed >> 31 ^ seed >> 62) & 0x7fffffff);
}

Json write_replicates(const RenderJob &job, CyclesScene &made) {
    Json replicates = Json::array();
    for (const Replicate &replicate : job.replicates) {
        const std::string output = fmt::format("render_{:04}.exr", replicates.size() + 1);
        const Vec2 shift = window_shift(job.scene.camera, job.scene.camera.film_offset_px + replicate.film_offset_px);
        replicates.push_back({{"output", output}, {"seed", fold_seed(replicate.seed)}, {"shift", {shift.x, shift.y}}});
        made.outputs.push_back(output);
    }
    return replicates;
}

/// Glass chooses between reflection and refraction at random, a lit surface between the lights; all else is certain.
bool is_random(const Needs &needs) { return needs.ray_tree || needs.many_lights; }

Json sampling_by_filter(const RenderJob &job, const Needs &needs) {
    switch (job.sampling) {
    case Sampling::pixel_centres:
        return {{"filter", "GAUSSIAN"},
                {"samples", is_random(needs) ? job.samples_per_pixel : 1},
                {"window", needs.ray_tree}};
    case Sampling::box:
        return {{"filter", "BOX"}, {"samples", job.samples_per_pixel}, {"window", needs.ray_tree}};
    }
    return {};
}

Json write_sampling(const RenderJob &job, const Needs &needs) {
    constexpr int most_samples = 1 << 24; // Blender takes fewer without a word
    if (job.samples_per_pixel > most_samples)
        refuse_for_cycles(fmt::format("{} samples per pixel are more than the {} that it can take",
                                      job.samples_per_pixel, most_samples),
                          "average pictures of different seeds");
    Json sampling = sampling_by_filter(job, needs);
    if (job.most_bounces) sampling["bounces"] = std::clamp(*job.most_bounces, 1, deepest_path);
    return sampling;
}

void refuse_what_cannot_be_said(const Scene &scene, const Needs &needs, const Frame &frame) {
    if (needs.caustics)
        refuse_for_cycles(
            "caustics through glass are not supported: path tracing finds hardly any, and the quicker way loses energy",
            "choose the glass shadow none, opaque or constant");
    if (needs.environment_on_diffuse)
        refuse_for_cycles("the environment's light on a diffuse surface would be an integral",
                          "give the environment a dome of parallel lights, or make the surface emissive");
    const std::vector<Sphere> orbs = outer_spheres(scene);
    double reach_mm = 0; // farthest point of glass from the origin: there numbers are coarsest
    for (const Sphere &orb : orbs) {
        const double offset_mm = glm::distance(orb.centre_mm, frame.origin_mm);
        if (offset_mm > farthest_glass_radii * orb.radius_mm)
            refuse_for_cycles(
                fmt::format("a glass orb of radius {} mm lies {:.6g} mm from the first one; single precision allows {} "
                            "radii, {:.6g} mm",
                            orb.radius_mm, offset_mm, farthest_glass_radii, farthest_glass_radii * orb.radius_mm));
        reach_mm = std::max(reach_mm, offset_mm + orb.radius_mm);
    }
    const double least_mm = spacings_per_gap * float_epsilon * reach_mm;
    if (frame.smallest_gap_mm < least_mm)
        refuse_for_cycles(
            fmt::format("the thinnest wall or gap of the glass is {:.3g} mm; at {:.6g} mm from the orb's centre single "
                        "precision needs at least {:.3g} mm",
                        frame.smallest_gap_mm, reach_mm, least_mm));
}

double unit_of(const Scene &scene, const Frame &frame) {
    double unit_mm = 0;
    for (const Sphere &orb : outer_spheres(scene)) unit_mm = std::max(unit_mm, orb.radius_mm);
    return unit_mm > 0 ? unit_mm : frame.extent_mm / 10;
}

/// JSON in a raw Python string. All text is ASCII and escaped by JSON; the apostrophe, which alone could end the
/// string, stands only inside JSON's own strings, and is escaped there.
std::string text(const Json &json) {
    std::string ascii = json.dump(-1, ' ', true, Json::error_handler_t::replace);
    for (std::size_t at = 0; (at = ascii.find('\'', at)) != std::string::npos;) ascii.replace(at, 1, "\\u0027");
    return ascii;
}

} // namespace

std::string to_python(std::string_view name, const nlohmann::ordered_json &data) {
    std::string out = fmt::format("{} = json.loads(r'''{{", name);
    const char *comma = "\n";
    for (const auto &[key, value] : data.items()) {
        out += fmt::format("{} {}: ", comma, text(key));
        comma = ",\n";
        if (value.is_array() && !value.empty() && value.front().is_object()) {
            const char *inner = "[\n  ";
            for (const Json &element : value) {
                out += inner + text(element);
                inner = ",\n  ";
            }
            out += "]";
        } else {
            out += text(value);
        }
    }
    return out + "\n}''')\n";
}

CyclesScene describe_for_cycles(const RenderJob &job) {
    const Scene &scene = job.scene;
    const Frame frame = render_frame(scene);
    const Needs required = needs(scene);
    if (job.slip != Slip{})
        refuse_for_cycles("it cannot be made to follow light wrongly on purpose",
                          "put this fault into another renderer");
    refuse_what_cannot_be_said(scene, required, frame);
    const double unit_mm = unit_of(scene, frame);
    const ToBlender to_blender(frame, unit_mm);
    for (const Sphere &orb : outer_spheres(scene)) {
        const double gap_mm = std::abs(glm::distance(scene.camera.eye_mm, orb.centre_mm) - orb.radius_mm);
        if (gap_mm < nearest_eye_in_units * unit_mm)
            refuse_for_cycles(
                fmt::format("the eye is {:.3g} mm from the glass; Blender's near plane wants at least {:.3g} mm",
                            gap_mm, nearest_eye_in_units * unit_mm),
                "move the eye away, or use the tracer");
    }

    CyclesScene made;
    CyclesObjects objects = describe_objects(job, to_blender);
    made.files = std::move(objects.files);
    made.accuracy.surface_mm = objects.surface_mm;
    if (required.glass) made.accuracy.lost_paths = lost_at_edges;
    if (required.ray_tree) made.accuracy.trapped_light = trapped_light(scene, deepest_path);
    if (made.accuracy.trapped_light > most_trapped_light)
        refuse_for_cycles(fmt::format("{:.3g} of the picture's light meets more than {} surfaces of glass, where its "
                                      "paths end, and would be lost; at most {:g} may be",
                                      made.accuracy.trapped_light, deepest_path, most_trapped_light),
                          "show more than the outermost rim, or use the tracer");
    if (const double grazing = grazing_share(scene, objects.surface_mm); grazing > most_grazing)
        refuse_for_cycles(
            fmt::format("{:.3g} of the picture's rays graze an orb or its hollow, passing the edge nearer than "
                        "1e-4 of the radius and four times what the mesh strays, and go astray; at most {:g} "
                        "may be",
                        grazing, most_grazing),
            "show more than the outermost rim, or use the tracer");
    made.data = {{"name", scene.name},
                 {"unit_mm", unit_mm},
                 {"origin_mm", to_json(frame.origin_mm)},
                 {"camera", write_camera(scene.camera, frame, to_blender)},
                 {"sampling", write_sampling(job, required)},
                 {"environment", to_json(scene.environment ? scene.environment->radiance : Rgb(0))},
                 {"lights", required.direct_light ? write_lights(lights_on_diffuse(scene)) : Json::array()},
                 {"objects", objects.list},
                 {"replicates", write_replicates(job, made)}};

    made.accuracy.random_branches = is_random(required);
    made.accuracy.radiance_step = greatest_radiance(scene) * float_epsilon / 2;
    made.accuracy.rounding_mm = float_epsilon * frame.extent_mm;
    // The first sample goes just through the pixel's centre. Blender's Gaussian of width w, which spreads the others,
    // is exp(-2 (6 x / w)^2): standard deviation w / 12, and 0.01 is its least width.
    if (job.sampling == Sampling::pixel_centres && is_random(required)) made.accuracy.filter_px = 0.01 / 12;
    return made;
}

} // namespace threefold
