// SPDX-License-Identifier: MIT
#include "verifier/stmap/stmap.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "exporter/temporary_folder.h"
#include "exporter/text.h"
#include "scenes/access.h"
#include "scenes/error.h"
#include "scenes/parameters.h"
#include "verifier/measure/optical_map.h"
#include "verifier/tracer/tracer.h"

namespace threefold {

namespace {

bool has_coordinates(const Shape &shape) {
    return std::visit(overloaded{[](const GlassBall &) { return false; }, [](const GlassShell &) { return false; },
                                 [](const Quad &) { return true; }, [](const Mesh &m) { return !m.uv.empty(); }},
                      shape);
}

/// Only the target gives light, its coordinates; glass bends rays and does nothing else.
Scene probe_of(Scene scene, const std::string &target) {
    for (Object &object : scene.objects) {
        if (Glass *glass = glass_of(object.shape)) *glass = {glass->index, 1, Coating::antireflective};
        if (Surface *surface = surface_of(object.shape)) *surface = Emissive{Rgb(0)};
        if (object.name == target && has_coordinates(object.shape)) *surface_of(object.shape) = CoordinateCard{};
    }
    scene.lights.clear();
    scene.environment.reset();
    return scene;
}

Texture to_16_bits(const Image &image) {
    Texture texture{image.width, image.height, {}};
    for (const Rgb &pixel : image.pixels)
        for (int c = 0; c < 3; ++c)
            texture.rgb.push_back(static_cast<std::uint16_t>(std::lround(65535 * std::clamp(pixel[c], 0.0, 1.0))));
    return texture;
}

} // namespace

std::string stmap_target(const Scene &scene, const std::string &asked) {
    std::vector<std::string> names;
    for (const Object &object : scene.objects)
        if (has_coordinates(object.shape)) names.push_back(object.name);
    if (names.empty())
        throw Error(Exit::bad_data, "the scene has no surface with texture coordinates to make a map of");
    if (!asked.empty()) {
        if (std::ranges::count(names, asked) == 0) throw Error(Exit::usage, unknown_name("surface", asked, names));
        return asked;
    }
    if (names.size() == 1) return names.front();
    std::string all;
    for (const std::string &name : names) all += (all.empty() ? "" : ", ") + one_line(name);
    throw Error(Exit::usage, fmt::format("the scene has several surfaces to make a map of: {}", all),
                "choose one with --onto");
}

Image stmap(const RenderJob &job, const std::string &target) {
    RenderJob probe;
    probe.scene = probe_of(job.scene, target);
    probe.sampling = Sampling::pixel_centres;
    probe.threads = job.threads;
    Image image = trace(probe).images.front();
    for (Rgb &pixel : image.pixels) {
        const auto uv = card_coordinates(pixel);
        pixel = uv ? Rgb(uv->x, uv->y, 1) : Rgb(0);
    }
    return image;
}

std::vector<ExportedFile> make_stmap_files(const ExportJob &job, const std::string &target) {
    const Image map = stmap(job.job, target);
    if (std::ranges::none_of(map.pixels, [](const Rgb &p) { return p.b > 0; }))
        throw Error(Exit::bad_data,
                    fmt::format("no pixel's ray lands on \"{}\": the map would be empty", one_line(target)));
    const std::string name = job.stem() + "-stmap";
    const TemporaryFolder folder;
    write_image(folder.path() / "map.exr", map,
                {{"threefold:scene", one_line(job.provenance.scene)},
                 {"threefold:scene_hash", job.provenance.scene_hash},
                 {"threefold:surface", one_line(target)}});
    return {
        {name + ".exr", read_file(folder.path() / "map.exr")},
        {name + ".png", encode_png16(to_16_bits(map))},
        {"README.txt",
         fmt::format("{}\n{}.exr: 32-bit float, linear. Red is u (to the right), green is v (up), both 0 to 1 over the "
                     "surface \"{}\";\nblue is 1 where the pixel's ray lands on it, and 0 elsewhere. In a "
                     "compositor: STMap with red and green as UV,\nno filter, and blue as the mask.\n{}.png: the "
                     "same in 16 bits, linear, to look at.\n",
                     to_text(job.provenance), name, one_line(target), name)}};
}

} // namespace threefold
