// SPDX-License-Identifier: MIT
#include "exporter/blender/glb_file.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "exporter/blender/glb_prelude.h"
#include "exporter/blender/objects.h"
#include "exporter/blender/prelude.h"
#include "exporter/blender/run_script.h"
#include "exporter/blender/scene_data.h"
#include "exporter/export/display_sphere.h"
#include "exporter/files.h"
#include "exporter/temporary_folder.h"
#include "scenes/access.h"
#include "scenes/camera.h"

namespace threefold {

namespace {

using Json = nlohmann::ordered_json;

constexpr double unit_mm = 1000; // the format's unit is the metre

/// The coarsest sphere that is round enough for the smallest orb.
double surface_tolerance_mm(const Scene &scene) {
    double least_mm = std::numeric_limits<double>::infinity();
    for (const Object &object : scene.objects)
        if (const auto sphere = outer_sphere(object.shape)) least_mm = std::min(least_mm, sphere->radius_mm);
    return display_tolerance * least_mm;
}

Json lights_of(const Scene &scene) {
    Json lights = Json::array();
    for (const Directional &light : scene.lights) {
        const double strength = std::max({light.irradiance.r, light.irradiance.g, light.irradiance.b});
        if (!(strength > 0)) continue;
        lights.push_back({{"towards", to_json(glm::normalize(ToBlender::direction(-light.travel)))},
                          {"strength", strength},
                          {"colour", to_json(light.irradiance / strength)}});
    }
    return lights;
}

Json camera_of(const Camera &camera, const Frame &frame, const ToBlender &to_blender) {
    const auto [right, up, forward] = camera_frame(camera);
    Json json{{"eye", to_json(to_blender.point(camera.eye_mm))},
              {"right", to_json(ToBlender::direction(right))},
              {"up", to_json(ToBlender::direction(up))},
              {"back", to_json(ToBlender::direction(-forward))},
              {"width_px", camera.width_px},
              {"height_px", camera.height_px},
              {"farthest", 4 * to_blender.length(frame.extent_mm)}};
    switch (camera.projection) {
    case Projection::perspective:
        json["projection"] = "perspective";
        json["angle"] = camera.horizontal_fov_deg * std::numbers::pi / 180;
        break;
    case Projection::orthographic:
        json["projection"] = "orthographic";
        json["width"] = to_blender.length(camera.orthographic_width_mm);
        break;
    }
    return json;
}

} // namespace

std::vector<ExportedFile> make_glb_file(const ExportJob &job, const InstalledRenderer &blender) {
    refuse_coordinate_card(job.job.scene, "glTF");
    RenderJob shown = job.job;
    shown.surface_tolerance_mm = surface_tolerance_mm(shown.scene);
    const Frame frame = render_frame(shown.scene);
    const ToBlender to_blender(frame, unit_mm);
    CyclesObjects objects = describe_objects(shown, to_blender, TextureEncoding::srgb8);

    const std::string file = job.stem() + ".glb";
    const Json data{{"objects", objects.list},
                    {"lights", lights_of(shown.scene)},
                    {"camera", camera_of(shown.scene.camera, frame, to_blender)}};
    const Json delivery{{"file", file}};
    const TemporaryFolder folder;
    for (const ExportedFile &made : objects.files) write_file_atomically(folder.path() / made.name, made.bytes);
    write_file_atomically(folder.path() / "build.py",
                          fmt::format("{}{}\n\n# ---- The scene\n\n{}\n{}\nwrite_glb(SCENE, DELIVERY)\n",
                                      cycles_prelude(), glb_prelude(), to_python("SCENE", data),
                                      to_python("DELIVERY", delivery)));
    run_in_blender(blender, {folder.path(), "build.py", {}, "threefold wrote glTF", job.time_limit});
    return {{file, read_file(folder.path() / file)},
            {"README.txt",
             fmt::format(
                 "{}\nWritten by the glTF exporter of Blender {}. Metres, +y up; the point ({}, {}, {}) mm of the "
                 "scene is the origin.\nEmission and light are in the scene's own units, as "
                 "KHR_materials_emissive_strength and KHR_lights_punctual.\n",
                 to_text(job.provenance), blender.version, frame.origin_mm.x, frame.origin_mm.y, frame.origin_mm.z)}};
}

} // namespace threefold
