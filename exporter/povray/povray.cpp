// SPDX-License-Identifier: MIT
#include "exporter/povray/povray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "exporter/povray/writer.h"
#include "exporter/trapped_light.h"
#include "scenes/light.h"
#include "scenes/validate.h"

namespace threefold {
namespace {

using povray::number;

// The greatest radiance is stored one step below full scale, so that rounding never clips it.
constexpr double most_pixels = 1 << 28;
constexpr double white = 65535, brightest = 65534;
/// How far a stored radiance may be off, as a share of the least that shines in the scene: more shows in a picture.
constexpr double most_step = 0.02;

/// How many pictures are quickest where each takes its share of the lights: asking for lights takes the time of all
/// samples and lights once, divided by their number; each picture takes the time to start it and to parse the scene.
/// The constants are rough figures of two cores: they choose a way to the same mean.
double quickest_pictures(const RenderJob &job) {
    constexpr double start_s = 0.2, parse_s_per_triangle = 1e-5, light_s = 2e-7;
    double picture_s = start_s;
    for (const Object &object : job.scene.objects)
        if (const Mesh *mesh = std::get_if<Mesh>(&object.shape))
            picture_s += parse_s_per_triangle * static_cast<double>(mesh->triangles.size());
    const Camera &camera = job.scene.camera;
    const double samples =
        static_cast<double>(camera.image_width_px()) * camera.image_height_px() * job.samples_per_pixel;
    return std::sqrt(samples * static_cast<double>(lights_on_diffuse(job.scene).size()) * light_s / picture_s);
}

/// A mean over the pixel takes pictures in mirrored pairs: see grid_shifts_px.
povray::Grid grid_of(const RenderJob &job, const Needs &needs) {
    switch (job.sampling) {
    case Sampling::pixel_centres:
        return {1, 1};
    case Sampling::box: {
        constexpr double most_pictures = 32;
        const int samples = std::max(job.samples_per_pixel, 1);
        int pictures = 2;
        if (needs.many_lights)
            pictures =
                2 *
                std::max(1, static_cast<int>(
                                std::min({quickest_pictures(job), most_pictures, static_cast<double>(samples)}) / 2));
        return {std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(samples) / pictures)))), pictures};
    }
    }
    return {};
}

/// POV-Ray puts the frame's number before the extension, with as many digits as the last frame has; not so for one
/// frame.
std::vector<std::string> output_names(std::size_t count) {
    if (count == 1) return {"picture.png"};
    const std::size_t digits = std::to_string(count).size();
    std::vector<std::string> names;
    for (std::size_t i = 1; i <= count; ++i) names.push_back(fmt::format("picture{:0{}}.png", i, digits));
    return names;
}

/// Everything that changes the picture is said here: a povray.ini of the user's may say otherwise.
std::vector<std::string> arguments(const RenderJob &job, int supersampling, std::size_t pictures) {
    std::vector<std::string> all{
        "Input_File_Name=scene.pov",
        "Output_File_Name=picture.png",
        fmt::format("Width={}", job.scene.camera.image_width_px() * supersampling),
        fmt::format("Height={}", job.scene.camera.image_height_px() * supersampling),
        "Output_to_File=on",
        "Output_File_Type=N", // PNG; EXR would be half precision
        "Bits_Per_Color=16",
        "Output_Alpha=off",
        "File_Gamma=1.0", // linear
        "Dither=off",
        "Antialias=off", // POV-Ray's own is no mean over the pixel: we average ourselves
        "Jitter=off",
        "Quality=9",
        "Continue_Trace=off",
        "Initial_Frame=1", // one frame a replicate
        fmt::format("Final_Frame={}", pictures),
        "Display=off",
        "Pause_When_Done=off",
    };
    return all;
}

/// POV-Ray's limit is 256, but its threads have 2 MB of stack and it crashes near 200 levels of the total reflection
/// that it finds by refraction, which is how coated glass reflects. Such light is one ray of a few segments.
int greatest_depth(const Scene &scene) {
    for (const Object &object : scene.objects)
        if (const Glass *glass = glass_of(object.shape); glass && glass->coating == Coating::antireflective) return 160;
    return 256;
}

/// A path of some ten intersections, each rounded at the scale of the scene. From afar POV-Ray loses more: it takes the
/// square of half a chord as radius^2 - distance^2 + (distance along the ray)^2.
double rounding_mm(const povray::Space &space) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    const double extent_mm = space.extent / space.units_per_mm;
    return std::max(16 * epsilon * extent_mm, 4 * epsilon * extent_mm * extent_mm / space.smallest_sphere_mm);
}

std::string head(const RenderJob &job, const povray::Space &space, double radiance_scale) {
    return fmt::format("// {}\n"
                       "// One unit is {} mm, the origin is at {} mm; radiance is multiplied by {}.\n"
                       "#version 3.7;\n"
                       "global_settings {{\n"
                       "  assumed_gamma 1.0\n"
                       "  max_trace_level {}\n"
                       "  adc_bailout {} // the weight below which a branch is dropped\n"
                       "}}\n",
                       povray::in_quotes(job.scene.name), number(1 / space.units_per_mm),
                       povray::vector(space.origin_mm), number(radiance_scale),
                       std::clamp(job.most_bounces.value_or(256), 1, greatest_depth(job.scene)),
                       number(job.cut_weight));
}

} // namespace

Exported compile_povray(const RenderJob &job) {
    povray::refuse_what_cannot_be_said(job);
    const Needs needed = needs(job.scene);
    const povray::Grid grid = grid_of(job, needed);
    const double greatest = greatest_radiance(job.scene) * povray::greatest_share(job.scene, grid);
    povray::Writer writer{.job = job,
                          .grid = grid,
                          .space = povray::choose_space(job.scene),
                          .radiance_scale = greatest > 0 ? brightest / white / greatest : 1,
                          .mesh_rounding_mm = 0,
                          .text = {},
                          .textures = {},
                          .texture_of_file = {}};

    Exported exported;
    exported.supersampling = grid.supersampling;
    const double pixels = static_cast<double>(job.scene.camera.image_width_px()) * job.scene.camera.image_height_px() *
                          exported.supersampling * exported.supersampling;
    if (pixels > most_pixels)
        povray::refuse(
            fmt::format("{} samples per pixel make a picture of {:.3g} pixels; at most {:.3g} can be read back",
                        job.samples_per_pixel, pixels, most_pixels));
    const int depth = greatest_depth(job.scene);
    const double trapped = needed.ray_tree ? trapped_light(job.scene, depth) : 0;
    if (trapped > most_trapped_light)
        povray::refuse(fmt::format("{:.3g} of the picture's light meets more than {} surfaces of glass, its limit, and "
                                   "would be lost; at most {:g} may be",
                                   trapped, depth, most_trapped_light),
                       "show more than the outermost rim, or use the tracer");
    const double step = 0.5 / white / writer.radiance_scale, least = least_shining_radiance(job.scene);
    if (least > 0 && step > most_step * least)
        povray::refuse(
            fmt::format("it stores 16 bits of up to {:.3g}, the brightest radiance in the scene, whether or not "
                        "the camera sees it: a radiance of {:.3g}, which is in the scene too, would be wrong by "
                        "up to {:.3g}",
                        greatest, least, step),
            fmt::format("let the brightest be at most {:.0f} times the dimmest, or use another renderer",
                        std::floor(most_step * 2 * white)));
    exported.radiance_scale = writer.radiance_scale;
    writer.text = head(job, writer.space, writer.radiance_scale);
    write_camera(writer);
    write_lights(writer);
    for (const Object &object : job.scene.objects) write_object(writer, object);

    exported.pictures_per_replicate = grid.pictures;
    const std::size_t pictures = job.replicates.size() * static_cast<std::size_t>(exported.pictures_per_replicate);
    exported.arguments = arguments(job, exported.supersampling, pictures);
    if (job.threads > 0) exported.thread_arguments = {fmt::format("Work_Threads={}", job.threads)};
    exported.outputs = output_names(pictures);
    exported.accuracy.radiance_step = step;
    exported.accuracy.rounding_mm = std::max(writer.mesh_rounding_mm, rounding_mm(writer.space));
    exported.accuracy.cut_weight = job.cut_weight;
    exported.accuracy.trapped_light = trapped;
    exported.files.push_back({"scene.pov", std::move(writer.text)});
    for (ExportedFile &texture : writer.textures) exported.files.push_back(std::move(texture));
    return exported;
}

} // namespace threefold
