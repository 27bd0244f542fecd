// SPDX-License-Identifier: MIT
#include "exporter/blender/prelude.h"

namespace threefold {

namespace {

constexpr std::string_view prelude_python = R"python(# SPDX-License-Identifier: MIT
# A scene made by Threefold for Blender's Cycles, 3.4 or later. Run it in the folder that holds it:
#
#   blender -b --factory-startup --disable-autoexec -noaudio --python-exit-code 3 -P scene.py
#
# First come the functions that build a scene, then the scene itself, as data. One Blender unit is `unit_mm`
# millimetres; the orb's centre is the origin, because Cycles computes in single precision.
import array
import functools
import json
import math
import os
import sys

import bpy
from mathutils import Matrix, Vector

FOLDER = os.path.dirname(os.path.abspath(__file__))
DEEPEST = 256  # bounces; a thin wall holds light for long, and every path that is cut makes the rim darker
SETTINGS = []  # every setting made, read again before rendering: Blender clamps a wrong value without a word


def put(owner, **values):
    """Sets attributes, and remembers them for check_settings()."""
    for name, value in values.items():
        setattr(owner, name, value)
        SETTINGS.append((owner, name, value))


def put_where_known(owner, **values):
    """The same for settings that not every version of Blender has."""
    put(owner, **{name: value for name, value in values.items() if hasattr(owner, name)})


def same(found, wanted):
    if isinstance(wanted, float):
        return abs(found - wanted) <= 1e-6 * max(abs(wanted), 1e-6)
    return found == wanted


def check(good, what):
    if not good:
        raise RuntimeError("Blender did not build what was asked: " + what)


def check_settings():
    for owner, name, wanted in SETTINGS:
        found = getattr(owner, name)
        check(same(found, wanted), "%s is %r, not %r" % (name, found, wanted))


# ---- Meshes


def read_array(file, kind, count):
    """Little-endian numbers: 'd' is a double, 'i' a 32-bit integer."""
    numbers = array.array(kind)
    numbers.frombytes(file.read(count * numbers.itemsize))
    check(len(numbers) == count, "a mesh file is too short")
    if sys.byteorder == "big":
        numbers.byteswap()
    return numbers


def read_mesh(mesh):
    """Coordinates (doubles), corners of triangles, texture coordinates (may be empty)."""
    with open(os.path.join(FOLDER, mesh["file"]), "rb") as file:
        points = read_array(file, "d", 3 * mesh["vertices"])
        corners = read_array(file, "i", 3 * mesh["triangles"])
        uv = read_array(file, "d", 2 * mesh["vertices"]) if mesh["uv"] else []
    return points, corners, uv


def collection(name):
    found = bpy.data.collections.get(name)
    if found is None:
        found = bpy.data.collections.new(name)
        bpy.context.scene.collection.children.link(found)
    return found


def add_object(name, data, place):
    # A name is any text. Blender cuts it to its own length and makes it unique.
    thing = bpy.data.objects.new(name.replace("\0", "") or "object", data)
    collection(place).objects.link(thing)
    return thing


def add_mesh(name, points, corners, uv, sides, material, place):
    """Flat faces of `sides` corners each; `uv` holds a pair for every vertex, or nothing."""
    faces = len(corners) // sides
    mesh = bpy.data.meshes.new("mesh")
    mesh.vertices.add(len(points) // 3)
    mesh.vertices.foreach_set("co", array.array("f", points))
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(faces)
    mesh.polygons.foreach_set("loop_start", array.array("i", range(0, len(corners), sides)))
    if bpy.app.version < (3, 6, 0):  # derived from loop_start since
        mesh.polygons.foreach_set("loop_total", array.array("i", [sides]) * faces)
    mesh.polygons.foreach_set("use_smooth", bytes(faces))  # smooth is what new meshes are since 4.1
    if uv:
        layer = mesh.uv_layers.new(name="UVMap")
        flat = array.array("f", [0]) * (2 * len(corners))
        for axis in (0, 1):
            flat[axis::2] = array.array("f", [uv[2 * corner + axis] for corner in corners])
        layer.data.foreach_set("uv", flat)
    mesh.update(calc_edges=True)
    mesh.materials.append(material)
    return add_object(name, mesh, place)


# ---- Materials


class Nodes:
    """A node tree, emptied, with a short way to add and link nodes."""

    def __init__(self, owner):
        if isinstance(owner, bpy.types.NodeTree):
            self.tree = owner
        else:
            if owner.node_tree is None:  # always there since 5.0, and the switch is to go
                owner.use_nodes = True
            self.tree = owner.node_tree
        self.tree.nodes.clear()

    def add(self, kind, *inputs, **settings):
        """A node of a type; inputs in their order: a number, a colour, an output to link, or None to leave it."""
        node = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        for socket, value in zip(node.inputs, inputs):
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, socket)
            elif value is not None:
                socket.default_value = value
        return node

    def set(self, node, **inputs):
        """Inputs by name, for nodes whose order of inputs differs between versions."""
        for name, value in inputs.items():
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[name])
            else:
                node.inputs[name].default_value = value
        return node.outputs[0]


def colour(rgb):
    return (rgb[0], rgb[1], rgb[2], 1.0)


def sharpest(node):
    """A perfectly smooth BSDF: a distribution of its own in 3.x, roughness 0 alone in later versions."""
    if "SHARP" in node.bl_rna.properties["distribution"].enum_items:
        node.distribution = "SHARP"
    return node


def new_material(name):
    material = bpy.data.materials.new(name.replace("\0", "") or "material")
    # Emitters are found by the rays that hit them; sampling them as lights would only add noise.
    if hasattr(material.cycles, "emission_sampling"):  # since 3.5
        put(material.cycles, emission_sampling="NONE")
    else:
        put(material.cycles, sample_as_light=False)
    return material


def glass_constants(nodes, glass):
    """Centre, index and tint of a glass, as inputs of its nodes."""
    return tuple(glass["centre"]), glass["index"], colour([glass["transmittance"]] * 3)


def glass_material(glass, side, shadow, values=glass_constants, name="Glass"):
    """One boundary of glass: `side` is 1 when its faces look out of the sphere, -1 when they look to the centre.

    `shadow` is the share of light that a shadow ray keeps at this boundary, None where no shadow ray sees it.
    """
    material = new_material(name)
    nodes = Nodes(material)
    centre, index, tint = values(nodes, glass)
    # The normal of the sphere itself at the point that was hit, on the side the ray comes from: with the mesh's own
    # normals the picture shows the triangles (1e-3 of a radius at 80,000 faces).
    geometry = nodes.add("ShaderNodeNewGeometry")
    outward = nodes.add("ShaderNodeVectorMath", geometry.outputs["Position"], centre, operation="SUBTRACT")
    unit = nodes.add("ShaderNodeVectorMath", outward.outputs["Vector"], operation="NORMALIZE")
    facing = nodes.add("ShaderNodeMath", geometry.outputs["Backfacing"], -2.0 * side, float(side),
                       operation="MULTIPLY_ADD")
    scaled = nodes.add("ShaderNodeVectorMath", unit.outputs["Vector"], operation="SCALE")
    normal = nodes.set(scaled, Scale=facing.outputs[0])

    fresnel = nodes.set(nodes.add("ShaderNodeFresnel"), IOR=index, Normal=normal)
    if glass["antireflective"]:  # all light goes on below the critical angle, all comes back above it
        fresnel = nodes.add("ShaderNodeMath", fresnel, 0.99999, operation="GREATER_THAN").outputs[0]
    # Not the Glass BSDF, whose colour would tint the reflection too.
    refraction = nodes.set(sharpest(nodes.add("ShaderNodeBsdfRefraction")), Color=tint, Roughness=0.0, IOR=index,
                           Normal=normal)
    reflection = nodes.set(sharpest(nodes.add("ShaderNodeBsdfGlossy")), Color=colour([1, 1, 1]), Roughness=0.0,
                           Normal=normal)
    light = nodes.add("ShaderNodeMixShader", fresnel, refraction, reflection).outputs[0]
    if shadow is not None:
        path = nodes.add("ShaderNodeLightPath")
        through = nodes.add("ShaderNodeBsdfTransparent", colour([shadow] * 3))
        light = nodes.add("ShaderNodeMixShader", path.outputs["Is Shadow Ray"], light, through.outputs[0]).outputs[0]
    nodes.add("ShaderNodeOutputMaterial", light)
    for node in nodes.tree.nodes:
        if node.type in ("FRESNEL", "BSDF_REFRACTION") and not node.inputs["IOR"].is_linked:
            check(same(node.inputs["IOR"].default_value, float(index)), "the index of a glass")
    return material


def paint(nodes, value):
    """A constant, or a texture by its file's name."""
    if not isinstance(value, str):
        return colour(value)
    image = bpy.data.images.load(os.path.join(FOLDER, value), check_existing=True)
    image.colorspace_settings.name = "Non-Color"  # samples are radiances
    texture = nodes.add("ShaderNodeTexImage", image=image, interpolation="Linear", extension="EXTEND")
    return nodes.set(texture, Vector=nodes.add("ShaderNodeUVMap").outputs["UV"])


def surface_material(name, surface):
    material = new_material(name)
    nodes = Nodes(material)
    kind = surface["kind"]
    if kind == "diffuse":
        bsdf = nodes.add("ShaderNodeBsdfDiffuse")
        nodes.add("ShaderNodeOutputMaterial",
                  nodes.set(bsdf, Color=paint(nodes, surface["reflectance"]), Roughness=0.0))
    elif kind == "emissive":
        nodes.add("ShaderNodeOutputMaterial",
                  nodes.set(nodes.add("ShaderNodeEmission"), Color=paint(nodes, surface["radiance"]),
                            Strength=surface["strength"]))
    elif kind == "coordinates":  # (u, v, 1) without any image
        uv = nodes.add("ShaderNodeSeparateXYZ", nodes.add("ShaderNodeUVMap").outputs["UV"])
        both = nodes.add("ShaderNodeCombineXYZ", uv.outputs[0], uv.outputs[1], 1.0)
        nodes.add("ShaderNodeOutputMaterial",
                  nodes.set(nodes.add("ShaderNodeEmission"), Color=both.outputs[0], Strength=1.0))
    else:
        raise ValueError("a surface of a kind that this script does not know")
    return material


# ---- What stands in the scene


def add_glass(thing):
    """A ball is one sphere. A shell is two: the inner one's faces look to the centre, out of the glass."""
    x, y, z = thing["centre"]
    points, corners, _ = read_mesh(thing["sphere"])
    rule = thing["shadow"]
    for number, radius in enumerate(thing["radii"]):
        side = 1 if number == 0 else -1
        # `scale` puts the triangles half outside, half inside the sphere.
        size = radius * thing["scale"]
        placed = array.array("d", points)
        for axis, centre in enumerate((x, y, z)):
            placed[axis::3] = array.array("d", [size * p + centre for p in points[axis::3]])
        turned = array.array("i", corners)
        if side < 0:
            turned[1::3], turned[2::3] = corners[2::3], corners[1::3]
        seen = rule["rule"] == "opaque" or (rule["rule"] == "constant" and number == 0)
        # Straight through an orb are two crossings of its outer surface.
        keeps = math.sqrt(rule["transmittance"]) if seen and rule["rule"] == "constant" else None
        ball = add_mesh(thing["name"], placed, turned, [], 3, glass_material(thing, side, keeps), "Orb")
        put(ball, visible_shadow=seen)
        yield functools.partial(check_sphere, ball, radius, thing)


def check_sphere(ball, radius, thing):
    """The evaluated mesh is the sphere that was asked, to single precision."""
    centre = Vector(thing["centre"])
    mesh = ball.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    points = array.array("f", [0]) * (3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", points)
    distances = list(map(math.dist, zip(points[0::3], points[1::3], points[2::3]), [tuple(centre)] * len(mesh.vertices)))
    wanted = radius * thing["scale"]
    slack = 4e-7 * (centre.length + radius)
    check(len(distances) == thing["sphere"]["vertices"], "a sphere has too few vertices")
    check(wanted - slack <= min(distances) and max(distances) <= wanted + slack, "the radius of a sphere")
    check(ball.matrix_world == Matrix.Identity(4), "a sphere has been moved")


def add_surface(thing):
    if thing["kind"] == "quad":
        points, corners, uv = sum(thing["corners"], []), array.array("i", range(4)), [0, 0, 1, 0, 1, 1, 0, 1]
        sides = 4
    else:
        points, corners, uv = read_mesh(thing["mesh"])
        sides = 3
    material = surface_material(thing["name"], thing["surface"])
    body = add_mesh(thing["name"], points, corners, uv, sides, material, "Figure")
    # Light on a diffuse surface comes from the scene's lights alone; an emitter is a thing to be seen.
    put(body, visible_diffuse=thing["surface"]["kind"] == "diffuse")


def add_light(light):
    sun = bpy.data.lights.new("Light", "SUN")
    # Irradiance on a plane that faces the sun; a diffuse surface of reflectance r then shows r E / pi.
    put(sun, energy=light["strength"], angle=0.0)
    sun.color = light["colour"]
    thing = add_object("Light", sun, "Lights")
    thing.rotation_mode = "QUATERNION"
    thing.rotation_quaternion = Vector(light["towards"]).to_track_quat("Z", "Y")


def set_world(scene, radiance):
    world = bpy.data.worlds.new("World")
    scene.world = world
    nodes = Nodes(world)
    nodes.add("ShaderNodeOutputWorld", nodes.add("ShaderNodeBackground", colour(radiance), 1.0).outputs[0])
    # It lights no diffuse surface: parallel lights stand for it there.
    world.cycles.sampling_method = "NONE"
    put(world.cycles_visibility, diffuse=False)


def add_camera(scene, camera):
    data = bpy.data.cameras.new("Camera")
    put(data, sensor_fit="HORIZONTAL", clip_start=1e-4, clip_end=camera["farthest"])
    if camera["projection"] == "perspective":
        put(data, type="PERSP", sensor_width=camera["sensor_width"], lens=camera["lens"])
    else:
        put(data, type="ORTHO", ortho_scale=camera["width"])
    eye = add_object("Camera", data, "Cameras")
    columns = camera["right"], camera["up"], camera["back"], camera["eye"]
    placed = Matrix([list(row) for row in zip(*columns)] + [[0.0, 0.0, 0.0, 1.0]])
    # As the inverse of a parent the matrix stays as it is; as rotation angles it would lose the last digits.
    stand = add_object("Camera stand", None, "Cameras")
    eye.parent = stand
    eye.matrix_parent_inverse = placed
    scene.camera = eye
    return eye, placed


def add_window(camera, replicates):
    """A clear window before the eye, seen by camera rays alone.

    At the first thing a ray meets, Cycles gives every branch an eighth of the samples, however little light it holds:
    three times the noise where glass reflects 4 %. What is met behind a window is not the first thing.
    """
    eye, right, up, back = (Vector(camera[name]) for name in ("eye", "right", "up", "back"))
    distance = 1e-3 * (1 + eye.length)
    if camera["projection"] == "perspective":
        half = distance * camera["sensor_width"] / (2 * camera["lens"])
    else:
        half = camera["width"] / 2
    # Twice as far as the picture reaches: half a width or height, and as many widths as it is shifted.
    farthest = max(abs(shift) for replicate in replicates for shift in replicate["shift"])
    reach = 2 * half * (max(1, camera["height_px"] / camera["width_px"]) + 2 * farthest)
    middle = eye - distance * back
    points = [x for h, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)) for x in middle + reach * (h * right + v * up)]
    material = new_material("Clear window")
    nodes = Nodes(material)
    nodes.add("ShaderNodeOutputMaterial", nodes.add("ShaderNodeBsdfTransparent", colour([1, 1, 1])).outputs[0])
    window = add_mesh("Clear window", points, array.array("i", range(4)), [], 4, material, "Cameras")
    put(window, visible_diffuse=False, visible_glossy=False, visible_transmission=False, visible_volume_scatter=False,
        visible_shadow=False)


# ---- Rendering


def set_samples(cycles, count, pixel_filter):
    """Cycles sends sample number 0 of every pixel through the pixel's centre.

    That is what a picture of pixel centres wants. A mean over the pixel would lean towards the centre by 1 / count, so
    it starts at a later number: the next power of two, from where the samples are again spread evenly.
    """
    first = 0 if pixel_filter == "GAUSSIAN" else 1 << (count - 1).bit_length()
    if hasattr(cycles, "use_sample_subset"):  # since 4.5
        put(cycles, use_sample_subset=True, samples=first + count, sample_subset_length=count, sample_offset=first)
    else:
        put(cycles, samples=count, sample_offset=first)


def set_render(scene, scene_data):
    camera, sampling = scene_data["camera"], scene_data["sampling"]
    put(scene.render, engine="CYCLES", resolution_x=camera["width_px"], resolution_y=camera["height_px"],
        resolution_percentage=100, pixel_aspect_x=1.0, pixel_aspect_y=1.0, use_border=False,
        film_transparent=False, dither_intensity=0.0, use_compositing=False, use_sequencer=False,
        use_motion_blur=False, use_simplify=False, use_multiview=False, use_stamp=False,
        use_persistent_data=len(scene_data["replicates"]) > 1)
    set_samples(scene.cycles, sampling["samples"], sampling["filter"])
    deepest = sampling.get("bounces", DEEPEST)
    put(scene.cycles, device="CPU",
        # One-pixel box, exact whatever the width; a narrow Gaussian stands for the pixel's centre alone.
        pixel_filter_type=sampling["filter"], filter_width=0.01,
        use_animated_seed=False, use_adaptive_sampling=False, time_limit=0.0, use_denoising=False,
        max_bounces=deepest, glossy_bounces=deepest, transmission_bounces=deepest, transparent_max_bounces=DEEPEST,
        diffuse_bounces=0,  # direct light only
        min_light_bounces=DEEPEST, min_transparent_bounces=DEEPEST,  # no roulette: what tint takes, it takes evenly
        caustics_reflective=True, caustics_refractive=True, blur_glossy=0.0,
        sample_clamp_direct=0.0, sample_clamp_indirect=0.0, light_sampling_threshold=0.0,
        use_fast_gi=False, film_exposure=1.0)
    put_where_known(scene.cycles, use_auto_tile=False, use_guiding=False)
    image = scene.render.image_settings
    put_where_known(image, media_type="IMAGE")  # since 5.0, and first
    put(image, file_format="OPEN_EXR", color_mode="RGB", color_depth="32", exr_codec="ZIP")


def set_view(scene, transform):
    """How a picture is shown; one that is stored as EXR holds radiance whatever is said here."""
    put(scene.view_settings, view_transform=transform, look="None", exposure=0.0, gamma=1.0)


def render(scene, replicates):
    for number, replicate in enumerate(replicates):
        print("threefold replicate %d of %d" % (number + 1, len(replicates)), flush=True)
        put(scene.cycles, seed=replicate["seed"])
        put(scene.camera.data, shift_x=replicate["shift"][0], shift_y=replicate["shift"][1])
        output = os.path.join(FOLDER, replicate["output"])
        scene.render.filepath = output
        check_settings()
        if os.path.exists(output):
            os.remove(output)
        bpy.ops.render.render(write_still=True)
        check(os.path.exists(output), "a picture is missing")
        del SETTINGS[-3:]
    print("threefold done", flush=True)


def remove_factory_scene():
    for kind in ("objects", "meshes", "lights", "cameras", "materials", "worlds", "collections"):
        things = getattr(bpy.data, kind)
        for thing in list(things):
            things.remove(thing)


def build(scene_data, glass_adder):
    """The whole scene; `glass_adder` adds a thing of glass, and gives what it wants checked once all is there."""
    remove_factory_scene()
    scene = bpy.context.scene
    set_render(scene, scene_data)
    set_world(scene, scene_data["environment"])
    checks = []
    for thing in scene_data["objects"]:
        if thing["kind"] == "glass":
            checks += glass_adder(thing)
        else:
            add_surface(thing)
    for light in scene_data["lights"]:
        add_light(light)
    eye, placed = add_camera(scene, scene_data["camera"])
    if scene_data["sampling"]["window"]:
        add_window(scene_data["camera"], scene_data["replicates"])

    bpy.context.view_layer.update()
    check(eye.matrix_world == placed, "the camera's place")
    for good in checks:
        good()
    check_settings()
    return scene


def main(scene_data):
    scene = build(scene_data, add_glass)
    set_view(scene, "Raw")
    render(scene, scene_data["replicates"])
)python";

} // namespace

std::string_view cycles_prelude() { return prelude_python; }

} // namespace threefold
