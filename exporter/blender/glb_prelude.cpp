// SPDX-License-Identifier: MIT
#include "exporter/blender/glb_prelude.h"

namespace threefold {

namespace {

constexpr std::string_view glb_python = R"python(
# ---- glTF: metres, and materials that its exporter understands


def principled(nodes, **inputs):
    """A Principled BSDF; an input is given by its names, the oldest first."""
    node = nodes.add("ShaderNodeBsdfPrincipled")
    names = {"transmission": ("Transmission", "Transmission Weight"), "specular": ("Specular", "Specular IOR Level"),
             "base": ("Base Color",), "roughness": ("Roughness",), "ior": ("IOR",)}
    for name, value in inputs.items():
        found = next(n for n in names[name] if n in node.inputs)
        nodes.set(node, **{found: value})
    nodes.add("ShaderNodeOutputMaterial", node.outputs[0])


def thickness_group():
    """The exporter reads a thickness from a group of this name."""
    name = "glTF Material Output"
    group = bpy.data.node_groups.get(name)
    if group is None:
        group = bpy.data.node_groups.new(name, "ShaderNodeTree")
        if hasattr(group, "interface"):  # since 4.0
            # Where the group has an occlusion too, as the exporter's own has, 5.2 reads the tree as it stands;
            # otherwise it reads one in which only what leads to the output is left: no thickness.
            for socket in ("Occlusion", "Thickness"):
                group.interface.new_socket(socket, in_out="INPUT", socket_type="NodeSocketFloat")
        else:
            group.inputs.new("NodeSocketFloat", "Thickness")
    return group


def gltf_glass(name, glass, thickness):
    material = new_material(name)
    material.use_backface_culling = True
    nodes = Nodes(material)
    principled(nodes, base=colour([1, 1, 1]), roughness=0.0, transmission=1.0, ior=glass["index"])
    group = nodes.add("ShaderNodeGroup", node_tree=thickness_group())
    group.inputs["Thickness"].default_value = thickness
    return material


def gltf_paint(nodes, value):
    if not isinstance(value, str):
        return colour(value)
    image = bpy.data.images.load(os.path.join(FOLDER, value), check_existing=True)
    texture = nodes.add("ShaderNodeTexImage", image=image, interpolation="Linear", extension="EXTEND")
    return texture.outputs["Color"]


def gltf_surface(name, surface):
    material = new_material(name)
    material.use_backface_culling = False  # both sides are alike
    nodes = Nodes(material)
    if surface["kind"] == "diffuse":
        principled(nodes, base=gltf_paint(nodes, surface["reflectance"]), roughness=1.0, specular=0.0,
                   ior=1.5)  # the format's own, so that it need not be said
    elif surface["kind"] == "emissive":
        emission = nodes.set(nodes.add("ShaderNodeEmission"), Color=gltf_paint(nodes, surface["radiance"]),
                             Strength=surface["strength"])
        nodes.add("ShaderNodeOutputMaterial", emission)
    else:
        raise ValueError("a surface of a kind that this script does not know")
    return material


def add_gltf_glass(thing):
    points, corners, _ = read_mesh(thing["sphere"])
    radii = thing["radii"]
    # How much glass a ray meets: a viewer bends light by it.
    thickness = 2 * radii[0] if len(radii) == 1 else radii[0] - radii[1]
    material = gltf_glass(thing["name"], thing, thickness)
    for number, radius in enumerate(radii):
        size = radius * thing["scale"]
        placed = array.array("d", [size * p for p in points])
        turned = array.array("i", corners)
        if number > 0:  # the inner surface looks to the centre
            turned[1::3], turned[2::3] = corners[2::3], corners[1::3]
        ball = add_mesh(thing["name"], placed, turned, [], 3, material, "Orb")
        ball.data.polygons.foreach_set("use_smooth", bytes([1]) * len(ball.data.polygons))
        ball.location = thing["centre"]


def add_gltf_surface(thing):
    if thing["kind"] == "quad":
        points, corners, uv = sum(thing["corners"], []), array.array("i", range(4)), [0, 0, 1, 0, 1, 1, 0, 1]
        sides = 4
    else:
        points, corners, uv = read_mesh(thing["mesh"])
        sides = 3
    add_mesh(thing["name"], points, corners, uv, sides, gltf_surface(thing["name"], thing["surface"]), "Figure")


def add_gltf_camera(scene, camera):
    data = bpy.data.cameras.new("Camera")
    put(data, sensor_fit="HORIZONTAL", clip_start=camera["farthest"] * 1e-4, clip_end=camera["farthest"])
    if camera["projection"] == "perspective":
        put(data, type="PERSP", angle=camera["angle"])
    else:
        put(data, type="ORTHO", ortho_scale=camera["width"])
    eye = add_object("Camera", data, "Cameras")
    columns = camera["right"], camera["up"], camera["back"], camera["eye"]
    eye.matrix_world = Matrix([list(row) for row in zip(*columns)] + [[0.0, 0.0, 0.0, 1.0]])
    scene.camera = eye
    put(scene.render, resolution_x=camera["width_px"], resolution_y=camera["height_px"], resolution_percentage=100,
        pixel_aspect_x=1.0, pixel_aspect_y=1.0)


def write_glb(scene_data, delivery):
    try:
        import numpy  # the exporter's own need
    except ImportError:
        raise RuntimeError("Blender's glTF exporter needs numpy: apt-get install python3-numpy") from None
    for old, new in (("bool", bool), ("int", int), ("float", float), ("object", object)):
        if old not in numpy.__dict__:  # gone since numpy 1.24; Blender 3.4 is older
            setattr(numpy, old, new)
    remove_factory_scene()
    scene = bpy.context.scene
    scene.name = "Threefold"
    engines = [item.identifier for item in bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items]
    # Where lights have nodes the exporter would read those; sun strengths are plain under this engine.
    scene.render.engine = next((e for e in engines if "EEVEE" in e), scene.render.engine)
    for thing in scene_data["objects"]:
        if thing["kind"] == "glass":
            add_gltf_glass(thing)
        else:
            add_gltf_surface(thing)
    for light in scene_data["lights"]:
        add_light(light)
    add_gltf_camera(scene, scene_data["camera"])
    bpy.context.view_layer.update()
    check_settings()
    path = os.path.join(FOLDER, delivery["file"])
    # RAW: emitters and lights keep their ratio, which photometric factors would change.
    known = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
    mode = {name: "RAW" for name in ("convert_lighting_mode", "export_import_convert_lighting_mode") if name in known}
    check(len(mode) == 1, "the exporter's way with light is unknown")
    bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", export_cameras=True, export_lights=True,
                              export_yup=True, export_animations=False, export_materials="EXPORT", **mode)
    check(os.path.exists(path), "the glTF file is missing")
    with open(path, "rb") as written:
        said = written.read()
    check(b"KHR_materials_volume" in said or not any(thing["kind"] == "glass" for thing in scene_data["objects"]),
          "the glTF file lacks the glass's thickness")
    print("threefold wrote glTF", flush=True)
)python";

} // namespace

std::string_view glb_prelude() { return glb_python; }

} // namespace threefold
