// SPDX-License-Identifier: MIT
#include "exporter/mitsuba/read_mitsuba.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "exporter/mitsuba/reader.h"
#include "exporter/text.h"
#include "scenes/access.h"
#include "scenes/error.h"
#include "scenes/texture.h"

namespace threefold {

namespace mitsuba {

Reader::Reader(Document &document, const Parameters &parameters)
    : document_(document), findings_(document.findings), parameters_(parameters),
      unit_mm_(parameters.number("file.unit_mm")) {}

std::string Reader::name_of(const Node &node) const {
    if (const std::string *id = node.attribute("id"); id && !id->empty()) return *id;
    const std::string *type = node.attribute("type");
    const std::string kind = type ? *type : node.tag;
    return fmt::format("{} at {}:{}", kind, node.place.line, node.place.column);
}

void Reader::emitter(const Node &node) {
    Properties p(node, document_);
    if (p.type() == "directional") {
        const std::optional<Rgb> irradiance = p.colour("irradiance");
        const std::optional<Vec3> direction = p.point("direction");
        const glm::dmat4 m = p.transform("to_world").matrix;
        p.leave_out({"sampling_weight"}, "how the light is found");
        p.finish();
        const Vec3 travel = direction ? *direction : Vec3(m * glm::dvec4(0, 0, 1, 0));
        if (!irradiance) return findings_.problem(node, "irradiance is missing");
        if (!(glm::length(travel) > 0)) return findings_.problem(node, "its direction has no length");
        scene_.lights.push_back({travel, *irradiance});
    } else if (p.type() == "constant") {
        const std::optional<Rgb> radiance = p.colour("radiance");
        p.leave_out({"sampling_weight"}, "how the light is found");
        p.finish();
        if (!radiance) return findings_.problem(node, "radiance is missing");
        if (scene_.environment) return findings_.problem(node, "is a second environment");
        scene_.environment = Environment{*radiance, 0};
    } else
        findings_.problem(node, "is no light that can be said (directional, constant, area on a rectangle or mesh)");
}

void Reader::film(const Node &node, const std::string &axis, double fov) {
    Camera &camera = scene_.camera;
    Properties p(node, document_);
    camera.width_px = p.whole("width").value_or(768);
    camera.height_px = p.whole("height").value_or(576);
    Crop crop{0, 0, camera.width_px, camera.height_px};
    const auto x = p.whole("crop_offset_x"), y = p.whole("crop_offset_y"), w = p.whole("crop_width"),
               h = p.whole("crop_height");
    crop.x_px = x.value_or(crop.x_px);
    crop.y_px = y.value_or(crop.y_px);
    crop.width_px = w.value_or(crop.width_px);
    crop.height_px = h.value_or(crop.height_px);
    if (x || y || w || h) camera.crop = crop;
    p.leave_out({"banner", "pixel_format", "component_format", "file_format", "high_quality_edges", "attach_log",
                 "gamma", "exposure", "tonemap_method", "compensate", "sample_border"},
                "how the picture is written");
    for (const Node *filter : p.children("rfilter"))
        findings_.note(*filter, "not used: a pixel is the mean over its own area");
    p.finish();
    if (camera.width_px <= 0 || camera.height_px <= 0 || camera.width_px > 1'000'000 || camera.height_px > 1'000'000) {
        findings_.problem(node, "its size must lie between 1 and a million pixels");
        camera.width_px = camera.height_px = 1;
        return;
    }
    if (camera.projection != Projection::perspective) return;
    const double width = camera.width_px, height = camera.height_px;
    std::string along = axis;
    if (along == "smaller") along = width <= height ? "x" : "y";
    if (along == "larger") along = width >= height ? "x" : "y";
    const double reach = along == "x"          ? width
                         : along == "y"        ? height
                         : along == "diagonal" ? std::hypot(width, height)
                                               : 0;
    if (reach == 0) return findings_.problem(node, fmt::format("fovAxis '{}' is unknown", one_line(axis)));
    camera.horizontal_fov_deg =
        along == "x" ? fov : 360 / std::numbers::pi * std::atan(std::tan(fov * std::numbers::pi / 360) * width / reach);
}

void Reader::integrator(const Node &node) {
    Properties p(node, document_);
    const int depth = p.whole("max_depth").value_or(-1);
    const std::string type = p.type();
    findings_.note(node, "not used: --with says who renders, glass.shadow how light passes glass");
    if (depth >= 0)
        findings_.change(node, fmt::format("maxDepth {}: here light is followed to its end through glass", depth));
    if (type == "direct") findings_.change(node, "direct light alone: here light is followed through glass to its end");
    if (p.boolean("hide_emitters", false)) findings_.change(node, "hideEmitters: here emitters are seen");
}

void Reader::sensor(const Node &node) {
    Properties p(node, document_);
    if (has_sensor_) return findings_.problem(node, "is a second sensor: a scene has one camera");
    has_sensor_ = true;
    Camera &camera = scene_.camera;
    const bool parallel = p.type() == "orthographic";
    if (!parallel && p.type() != "perspective")
        return findings_.problem(node, "is no camera that can be said (perspective, orthographic)");
    camera.projection = parallel ? Projection::orthographic : Projection::perspective;
    double fov = 1;
    std::string axis = "x";
    if (!parallel) {
        const std::optional<double> given = p.number("fov");
        if (p.named("focal_length")) findings_.problem(node, "focalLength: give the field of view as fov");
        if (!given) findings_.problem(node, "fov is missing");
        if (given && !(*given > 0 && *given < 180))
            findings_.problem(node, fmt::format("fov {:g} does not lie between 0 and 180", *given));
        else
            fov = given.value_or(1);
        axis = p.word("fov_axis", "x");
        for (const char *shift : {"principal_point_offset_x", "principal_point_offset_y"})
            if (p.number(shift).value_or(0) != 0) findings_.problem(node, fmt::format("{} other than 0", shift));
    }
    const Transform place = p.transform("to_world");
    p.leave_out({"focus_distance", "near_clip", "far_clip", "shutter_open", "shutter_close"},
                "the camera is a pinhole that sees to any distance");
    for (const Node *sampler : p.children("sampler")) findings_.note(*sampler, "not used: --spp and --seed say it");
    const std::vector<const Node *> films = p.children("film");
    p.finish();
    const Vec3 left(place.matrix[0]), up(place.matrix[1]), forward(place.matrix[2]);
    const double l = glm::length(left), u = glm::length(up), f = glm::length(forward);
    const bool square = l > 0 && u > 0 && f > 0 && std::abs(glm::dot(left, up)) < 1e-9 * l * u &&
                        std::abs(glm::dot(left, forward)) < 1e-9 * l * f &&
                        std::abs(glm::dot(up, forward)) < 1e-9 * u * f;
    if (!square || std::abs(l - u) > 1e-9 * u)
        findings_.problem(node, "its transform is skewed, or stretches the picture");
    else if (glm::dot(glm::cross(left, up), forward) < 0)
        findings_.problem(node, "its transform mirrors the picture");
    else if (!parallel && std::max({std::abs(l - 1), std::abs(u - 1), std::abs(f - 1)}) > 1e-3)
        findings_.problem(node, "its transform has a scale, which means nothing to a perspective camera");
    camera.eye_mm = unit_mm_ * Vec3(place.matrix[3]);
    if (place.look) {
        camera.target_mm = unit_mm_ * place.look->target;
        camera.up = place.look->up;
    } else {
        camera.target_mm = camera.eye_mm + unit_mm_ * forward;
        camera.up = up;
    }
    if (parallel) camera.orthographic_width_mm = 2 * unit_mm_ * l;
    if (films.size() > 1) return findings_.problem(node, "has more than one film");
    if (films.empty()) {
        const Node none{"film", {{"type", "hdrfilm"}}, {}, node.place, node.folder};
        film(none, axis, fov);
    } else
        film(*films.front(), axis, fov);
}

/// --size and image.*: another size of the same view. A crop takes its film along.
void Reader::fit_picture() {
    Camera &camera = scene_.camera;
    const int width = static_cast<int>(parameters_.number("image.width_px")),
              height = static_cast<int>(parameters_.number("image.height_px"));
    if (width == 0 && height == 0) return;
    const double w = camera.image_width_px(), h = camera.image_height_px();
    const double scale = width > 0 ? width / w : height / h;
    constexpr double most_px = std::numeric_limits<int>::max();
    if (camera.width_px * scale > most_px || camera.height_px * scale > most_px)
        throw Error(Exit::bad_data, fmt::format("{}: at the size asked the whole film would have {:.3g} x {:.3g} px",
                                                one_line(document_.tree.root.place.file), camera.width_px * scale,
                                                camera.height_px * scale));
    const int new_width = width > 0 ? width : std::max(1, static_cast<int>(std::lround(w * scale)));
    const int new_height = height > 0 ? height : std::max(1, static_cast<int>(std::lround(h * scale)));
    if (!camera.crop) {
        camera.width_px = new_width;
        camera.height_px = new_height;
        return;
    }
    Crop &crop = *camera.crop;
    // The same window: its left and its width are shares of a film that may have a fraction of a pixel more.
    const int film = std::max(new_width, static_cast<int>(std::lround(camera.width_px * scale)));
    const double exact = film / static_cast<double>(camera.width_px);
    crop.x_px = std::clamp(static_cast<int>(std::lround(crop.x_px * exact)), 0, film - new_width);
    const int film_height = std::max(new_height, static_cast<int>(std::lround(camera.height_px * exact)));
    crop.y_px = std::clamp(static_cast<int>(std::lround(crop.y_px * exact)), 0, film_height - new_height);
    crop.width_px = new_width;
    crop.height_px = new_height;
    camera.width_px = film;
    camera.height_px = film_height;
}

Scene Reader::scene() {
    for (const Node &node : document_.tree.root.children) {
        const std::string *type = node.attribute("type");
        if (node.tag == "shape" && type && *type == "sphere")
            sphere(node);
        else if (node.tag == "shape" && type && *type == "rectangle")
            rectangle(node);
        else if (node.tag == "shape" && type && (*type == "obj" || *type == "ply"))
            mesh(node);
        else if (node.tag == "shape")
            findings_.problem(node, "is no shape that can be said (sphere, rectangle, obj, ply)");
        else if (node.tag == "emitter")
            emitter(node);
        else if (node.tag == "sensor")
            sensor(node);
        else if (node.tag == "integrator")
            integrator(node);
        else if (node.tag == "bsdf" || node.tag == "texture")
            ; // read where a shape refers to it
        else if (node.tag == "medium" && node.attribute("id"))
            findings_.note(node, "not used by any shape that can be read");
        else
            findings_.problem(node, "is not understood");
    }
    if (!has_sensor_) findings_.problem(document_.tree.root, "has no sensor");
    put_glass_together();
    put_surfaces_together();
    std::size_t reflecting = 0;
    for (const Object &object : scene_.objects) {
        const Surface *surface = surface_of(object.shape);
        const Diffuse *d = surface ? std::get_if<Diffuse>(surface) : nullptr;
        // A mesh may throw light on itself.
        if (d && greatest_value(d->reflectance) != Rgb(0))
            reflecting += std::holds_alternative<Mesh>(object.shape) ? 2 : 1;
    }
    if (reflecting > 1) findings_.change(document_.tree.root, "light that surfaces throw on each other is left out");
    if (const double radiance = parameters_.number("environment.radiance"); radiance >= 0)
        scene_.environment = Environment{Rgb(radiance), 0};
    bool diffuse = false;
    for (const Object &object : scene_.objects) {
        const Mesh *m = std::get_if<Mesh>(&object.shape);
        const Quad *q = std::get_if<Quad>(&object.shape);
        const Surface *surface = m ? &m->surface : q ? &q->surface : nullptr;
        const Diffuse *d = surface ? std::get_if<Diffuse>(surface) : nullptr;
        diffuse |= d && greatest_value(d->reflectance) != Rgb(0);
    }
    if (scene_.environment) {
        const int said = static_cast<int>(parameters_.number("environment.dome_directions"));
        const bool needed = diffuse && scene_.environment->radiance != Rgb(0);
        if (needed && said == 0)
            scene_.environment->dome_directions = 48;
        else
            scene_.environment->dome_directions = said;
        if (needed) {
            findings_.change(document_.tree.root, fmt::format("the environment lights surfaces as {} parallel lights "
                                                              "(environment.dome_directions)",
                                                              scene_.environment->dome_directions));
            if (!spheres_.empty() && parameters_.word("glass.shadow") != "none")
                findings_.change(document_.tree.root, "the environment's light on surfaces stops at glass, or is "
                                                      "weakened there (glass.shadow); Mitsuba follows it through");
        }
    } else if (scene_.lights.empty() && findings_.problems.empty()) {
        bool seen = false;
        for (const Flat &flat : flats_) seen |= !std::holds_alternative<Diffuse>(flat.sides.front);
        if (!seen)
            findings_.problem(document_.tree.root,
                              "has no light, and a sun and sky that Mitsuba 0.5 then adds are not in the file: give it "
                              "one by --set environment.radiance=1");
    }
    const std::string shadow = parameters_.word("glass.shadow");
    scene_.glass_shadow.rule = shadow == "none"       ? GlassShadow::Rule::none
                               : shadow == "constant" ? GlassShadow::Rule::constant
                                                      : GlassShadow::Rule::opaque;
    scene_.glass_shadow.transmittance = parameters_.number("glass.shadow_transmittance");
    fit_picture();
    return std::move(scene_);
}

std::vector<MeshInFile> meshes_of(const Tree &tree) {
    std::vector<MeshInFile> found;
    for (const Node &node : tree.root.children) {
        const std::string *type = node.attribute("type"), *id = node.attribute("id");
        if (node.tag != "shape" || !type || (*type != "obj" && *type != "ply")) continue;
        std::string file;
        for (const Node &child : node.children)
            if (const std::string *name = child.attribute("name"); name && *name == "filename")
                if (const std::string *value = child.attribute("value")) file = *value;
        found.push_back(
            {id && !id->empty() ? *id : fmt::format("{} at {}:{}", *type, node.place.line, node.place.column),
             resolved(file, node, tree.root)});
    }
    return found;
}

} // namespace mitsuba

namespace {

using mitsuba::Tree;

ParameterSpec file_parameter(std::string name, std::string description, double value, double least, double greatest,
                             bool whole = false) {
    return {.name = std::move(name),
            .description = std::move(description),
            .text = value,
            .published = value,
            .least = least,
            .greatest = greatest,
            .whole = whole};
}

/// What our own instruction says and cannot be done is refused: passed over, it would make another picture.
[[noreturn]] void refuse_said(const Tree &tree, const std::string &key, std::string_view why) {
    throw Error(Exit::bad_data, fmt::format("{}: <?threefold {}=\"{}\"?>: {}", one_line(tree.root.place.file), key,
                                            one_line(tree.said.at(key)), why));
}

double said_number(const Tree &tree, const std::string &key, double otherwise, double least, double greatest) {
    const auto said = tree.said.find(key);
    if (said == tree.said.end()) return otherwise;
    const std::optional<double> value = mitsuba::to_number(said->second);
    if (!value || !(*value >= least && *value <= greatest))
        refuse_said(tree, key, fmt::format("must be a number from {:g} to {:g}", least, greatest));
    return *value;
}

std::vector<ParameterSpec> parameters_in(const Tree &tree) {
    std::vector<ParameterSpec> all{
        file_parameter("file.unit_mm", "length of one unit of the file (it does not say; the study's are centimetres)",
                       said_number(tree, "unit_mm", 10, 1e-9, 1e9), 1e-9, 1e9),
        file_parameter("image.width_px", "width of the picture (0: as the file says)", 0, 0, 1e6, true),
        file_parameter("image.height_px", "height of the picture (0: as the file says)", 0, 0, 1e6, true),
        file_parameter("environment.radiance", "radiance of the surroundings (-1: as the file says)", -1, -1, 1e6),
        file_parameter("environment.dome_directions",
                       "parallel lights that stand for the environment's light on surfaces (0: 48 where there are any)",
                       said_number(tree, "dome_directions", 0, 0, 10'000), 0, 10'000, true),
        file_parameter("glass.shadow_transmittance", "share of light behind an orb, under glass.shadow=constant",
                       said_number(tree, "shadow_transmittance", 1, 0, 1), 0, 1),
        file_parameter("thin.wall_share", "wall that stands for a sheet without thickness, as a share of the radius",
                       1e-3, 1e-9, 0.1)};
    ParameterSpec shadow{.name = "glass.shadow",
                         .description = "how light passes glass on its way to a diffuse surface; Mitsuba's path tracer "
                                        "stops it (opaque)",
                         .choices = {"opaque", "none", "constant"}}; // of caustics no renderer is capable
    if (const auto said = tree.said.find("glass_shadow"); said != tree.said.end()) {
        const auto at = std::ranges::find(shadow.choices, said->second);
        if (at == shadow.choices.end())
            refuse_said(tree, "glass_shadow",
                        fmt::format("no renderer can do this; can be: {}", fmt::join(shadow.choices, ", ")));
        std::rotate(shadow.choices.begin(), at, at + 1);
    }
    all.push_back(std::move(shadow));
    const auto has = [&](const std::string &name) { return std::ranges::count(all, name, &ParameterSpec::name) > 0; };
    const auto file = [&](std::string name, std::string description) {
        if (!has(name)) all.push_back({.name = std::move(name), .description = std::move(description), .path = true});
    };
    std::vector<std::string> missing;
    for (const mitsuba::MeshInFile &mesh : mitsuba::meshes_of(tree)) {
        file(mesh.id + ".mesh", "another mesh in its place, in the file's unit");
        file(mesh.id + ".texture", "another picture in place of its own");
        std::error_code ignored;
        if (!std::filesystem::exists(mesh.file, ignored)) missing.push_back(mesh.id);
    }
    // Where one mesh is missing there is no doubt which is meant.
    if (missing.size() == 1 && missing.front() != "robe") {
        file("robe.mesh", "the same as " + missing.front() + ".mesh, the one that is missing");
        file("robe.texture", "the same as " + missing.front() + ".texture");
        all.push_back(
            {.name = "robe.shape", .description = "the shape that robe.* speak of", .choices = {missing.front()}});
    }
    for (const auto &[name, value] : tree.defaults)
        if (const auto n = mitsuba::to_number(value); n && !has("default." + name))
            all.push_back(file_parameter("default." + name, "the file's parameter $" + name, *n, -1e12, 1e12));
    return all;
}

} // namespace

SceneRecipe mitsuba_scene(const std::filesystem::path &file, std::function<void(const std::string &note)> tell,
                          std::function<void(const std::string &change)> warn) {
    const Tree first = mitsuba::read_tree(file, {});
    SceneRecipe recipe;
    recipe.name = one_line(file.stem().string());
    recipe.summary = fmt::format("read from {}", one_line(file.string()));
    recipe.parameters = parameters_in(first);
    const std::vector<std::pair<std::string, std::string>> defaults = first.defaults;
    const auto said_name = first.said.find("name");
    const std::string name = said_name == first.said.end() ? recipe.name : said_name->second;
    recipe.build = [file, tell, warn, defaults, name](const Parameters &p) {
        std::map<std::string, std::string> given;
        for (const auto &[key, value] : defaults)
            if (const auto n = mitsuba::to_number(value); n && p.has("default." + key))
                if (const double now = p.number("default." + key); now != *n) given[key] = fmt::format("{}", now);
        const Tree tree = mitsuba::read_tree(file, given);
        mitsuba::Findings findings{tree.problems, {}, tree.notes};
        mitsuba::Document document(tree, findings);
        mitsuba::Reader reader(document, p);
        Scene scene = reader.scene();
        scene.name = name;
        if (!findings.problems.empty()) {
            constexpr std::size_t most = 100;
            const std::size_t all = findings.problems.size();
            if (all > most) findings.problems.resize(most);
            throw Error(Exit::bad_data, fmt::format("{}: {}: {}{}", one_line(file.string()),
                                                    all == 1 ? "one thing cannot be read"
                                                             : fmt::format("{} things cannot be read", all),
                                                    fmt::join(findings.problems, "; "),
                                                    all > most ? fmt::format("; and {} more", all - most) : ""));
        }
        for (const std::string &change : findings.changes) warn(change);
        for (const std::string &note : findings.notes) tell(note);
        return scene;
    };
    return recipe;
}

} // namespace threefold
