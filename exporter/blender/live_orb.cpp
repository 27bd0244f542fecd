// SPDX-License-Identifier: MIT
#include "exporter/blender/live_orb.h"

namespace threefold {

namespace {

constexpr std::string_view live_orb_python = R"python(
# ---- An orb whose numbers can be changed in Blender
#
# The object's own mesh is the sphere of radius 1. A group of geometry nodes, its modifier, makes both surfaces of it by
# scale alone, and gives each face the numbers of the glass, which the materials read: what the panel says is what is
# rendered, with no driver and no script. Materials take the normal from where the object is, so it may be moved too.

INDEX, TRANSMITTANCE = "glass index", "interface transmittance"  # attributes on the faces


def add_input(tree, name, kind, value, least, greatest, description):
    """An input of a group. `kind`: FACTOR, DISTANCE (in the units of the scene), NONE (a plain number) or BOOLEAN."""
    if hasattr(tree, "interface"):  # since 4.0
        socket = tree.interface.new_socket(name, in_out="INPUT",
                                           socket_type="NodeSocketBool" if kind == "BOOLEAN" else "NodeSocketFloat")
        if kind != "BOOLEAN":
            socket.subtype = kind
    else:
        socket = tree.inputs.new({"FACTOR": "NodeSocketFloatFactor", "DISTANCE": "NodeSocketFloatDistance",
                                  "NONE": "NodeSocketFloat", "BOOLEAN": "NodeSocketBool"}[kind], name)
    socket.description = description
    if kind != "BOOLEAN":
        socket.min_value, socket.max_value = least, greatest
    socket.default_value = value


def add_geometry_sockets(tree):
    if hasattr(tree, "interface"):
        for way in ("INPUT", "OUTPUT"):
            tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
        if hasattr(tree, "is_modifier"):
            tree.is_modifier = True
    else:
        tree.inputs.new("NodeSocketGeometry", "Geometry")
        tree.outputs.new("NodeSocketGeometry", "Geometry")


def socket_of(node, name, kind):
    """Nodes that work on several types have an input of the same name for each."""
    return next(s for s in node.inputs if s.name == name and s.type == kind)


def numbers_of_faces(nodes, glass):
    """The counterpart of glass_constants(): what the group stored, and where the object is."""
    info = nodes.add("ShaderNodeObjectInfo")
    attributes = [nodes.add("ShaderNodeAttribute", attribute_name=name) for name in (INDEX, TRANSMITTANCE)]
    index, tint = (attribute.outputs["Fac"] for attribute in attributes)
    return info.outputs["Location"], index, tint


def surface_nodes(nodes, given, radius, side, material):
    """One surface of the orb: the unit sphere times `radius`, which is a socket."""
    sphere = nodes.set(nodes.add("GeometryNodeTransform", given["Geometry"]), Scale=radius)
    if side < 0:
        sphere = nodes.add("GeometryNodeFlipFaces", sphere).outputs[0]
    painted = nodes.add("GeometryNodeSetMaterial", sphere)
    painted.inputs["Material"].default_value = material
    return painted.outputs[0]


def store(nodes, geometry, name, value):
    node = nodes.add("GeometryNodeStoreNamedAttribute", data_type="FLOAT", domain="FACE")
    socket_of(node, "Name", "STRING").default_value = name
    nodes.tree.links.new(geometry, socket_of(node, "Geometry", "GEOMETRY"))
    nodes.tree.links.new(value, socket_of(node, "Value", "VALUE"))
    return node.outputs[0]


def orb_group(thing, materials):
    """The modifier's group: every input has this orb's value as its default."""
    tree = bpy.data.node_groups.new("Glass orb", "GeometryNodeTree")
    outer = thing["radii"][0]
    hollow = len(thing["radii"]) > 1
    wall = outer - thing["radii"][1] if hollow else 0.02 * outer
    finest = 1.2e-5 * (outer + math.hypot(*thing["centre"]))  # a hundred spacings of single precision
    add_geometry_sockets(tree)
    add_input(tree, "Outer radius", "DISTANCE", outer, finest, 1e6 * outer, "From the centre to the outer surface")
    add_input(tree, "Hollow", "BOOLEAN", hollow, 0, 1, "A shell with air inside; otherwise a solid ball")
    add_input(tree, "Wall", "DISTANCE", wall, finest, 1e6 * outer,
              "Thickness of a hollow orb's glass. As thick as the radius: solid")
    add_input(tree, "Index", "NONE", thing["index"], 1.0, 10.0, "Index of refraction of the glass in air")
    add_input(tree, "Transmittance", "FACTOR", thing["transmittance"], 0.0, 1.0,
              "Factor on light at each crossing of a glass surface")

    nodes = Nodes(tree)
    given = nodes.add("NodeGroupInput").outputs
    inner_radius = nodes.add("ShaderNodeMath", given["Outer radius"], given["Wall"], operation="SUBTRACT").outputs[0]
    room = nodes.add("ShaderNodeMath", inner_radius, 0.0, operation="GREATER_THAN").outputs[0]
    has_inner = nodes.add("ShaderNodeMath", room, given["Hollow"], operation="MULTIPLY").outputs[0]
    has_none = nodes.add("ShaderNodeMath", has_inner, 0.5, operation="LESS_THAN").outputs[0]
    outside = surface_nodes(nodes, given, given["Outer radius"], 1, materials[0])
    inside = surface_nodes(nodes, given, inner_radius, -1, materials[1])
    inside = nodes.add("GeometryNodeDeleteGeometry", inside, has_none, domain="FACE").outputs[0]
    both = nodes.add("GeometryNodeJoinGeometry")
    for surface in (inside, outside):  # the last one linked comes first
        nodes.tree.links.new(surface, both.inputs[0])
    geometry = store(nodes, both.outputs[0], INDEX, given["Index"])
    geometry = store(nodes, geometry, TRANSMITTANCE, given["Transmittance"])
    nodes.add("NodeGroupOutput", geometry)
    return tree


def add_live_glass(thing):
    """The counterpart of add_glass(): one object, whatever its surfaces."""
    points, corners, _ = read_mesh(thing["sphere"])
    rule = thing["shadow"]
    seen = rule["rule"] in ("opaque", "constant")
    outer_keeps, inner_keeps = None, None
    if rule["rule"] == "constant":  # straight through an orb are two crossings of its outer surface
        outer_keeps, inner_keeps = math.sqrt(rule["transmittance"]), 1.0
    materials = [glass_material(thing, 1, outer_keeps, numbers_of_faces, "Glass, outer surface"),
                 glass_material(thing, -1, inner_keeps, numbers_of_faces, "Glass, inner surface")]
    # `scale` puts the triangles half outside, half inside the sphere.
    points = array.array("d", [thing["scale"] * p for p in points])
    ball = add_mesh(thing["name"], points, corners, [], 3, materials[0], "Orb")
    ball.data.name = "Unit sphere"
    ball.data.materials.append(materials[1])
    put(ball, visible_shadow=seen)
    ball.location = thing["centre"]
    ball.modifiers.new("Glass orb", "NODES").node_group = orb_group(thing, materials)
    ball["threefold"] = "orb"
    return [functools.partial(check_live_sphere, ball, thing)]


def radii_in(points):
    return list(map(math.hypot, points[0::3], points[1::3], points[2::3]))


def check_live_sphere(ball, thing):
    """The evaluated mesh is the spheres that were asked, one after the other."""
    mesh = ball.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    points = array.array("f", [0]) * (3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", points)
    distances = radii_in(points)
    count = thing["sphere"]["vertices"]
    check(len(distances) == count * len(thing["radii"]), "a sphere has too few vertices")
    for number, radius in enumerate(thing["radii"]):
        wanted = radius * thing["scale"]
        mine = distances[number * count:(number + 1) * count]
        slack = 4e-7 * thing["radii"][0]
        check(wanted - slack <= min(mine) and max(mine) <= wanted + slack, "the radius of a sphere")
    for name, value in ((INDEX, thing["index"]), (TRANSMITTANCE, thing["transmittance"])):
        stored = mesh.attributes[name].data
        check(len(stored) == len(mesh.polygons) and same(stored[0].value, float(value)), "the " + name)
    check(ball.matrix_world == Matrix.Translation(thing["centre"]), "a sphere has been moved")


# ---- The file


def arrange(tree):
    """From left to right in the order of the links: nobody can read nodes that lie on one another."""
    depth = {}

    def place(node, column):
        if depth.get(node, -1) < column:
            depth[node] = column
            for socket in node.inputs:
                for link in socket.links:
                    place(link.from_node, column + 1)

    for node in tree.nodes:
        if not any(socket.is_linked for socket in node.outputs):
            place(node, 0)
    rows = {}
    for node in tree.nodes:
        column = depth.get(node, 0)
        node.location = (-240 * column, -220 * rows.get(column, 0))
        rows[column] = rows.get(column, 0) + 1


def arrange_all():
    for material in bpy.data.materials:
        arrange(material.node_tree)
    for group in bpy.data.node_groups:
        arrange(group)
    for world in bpy.data.worlds:
        arrange(world.node_tree)


def look_through_camera():
    """What is seen first: the verified view, and the panel with the orb's numbers."""
    orb = next((thing for thing in bpy.data.objects if thing.get("threefold") == "orb"), None)
    if orb is not None:
        bpy.context.view_layer.objects.active = orb
        orb.select_set(True)
    for screen in bpy.data.screens:
        for area in screen.areas:
            for space in area.spaces:
                if space.type == "VIEW_3D":
                    space.region_3d.view_perspective = "CAMERA"
                    space.clip_start, space.clip_end = 1e-3, 1e4
                    space.overlay.show_floor = False
                elif space.type == "PROPERTIES" and orb is not None:
                    try:
                        space.context = "MODIFIER"
                    except TypeError:
                        pass  # this editor shows a tab for the object that is active there


def set_units(scene, unit_mm):
    put(scene.unit_settings, system="METRIC", scale_length=unit_mm / 1000)
    scene.unit_settings.length_unit = "MILLIMETERS"


def write_notes(title, notes):
    text = bpy.data.texts.new(title)
    text.write(notes.replace("\0", ""))
    text.cursor_set(0)


def pack_pictures():
    for image in bpy.data.images:
        if image.source == "FILE":
            name = os.path.basename(image.filepath)
            image.pack()
            image.filepath = "//" + name  # where unpacking puts it, and no folder of this machine


def set_picture(scene, replicate):
    put(scene.cycles, seed=replicate["seed"])
    put(scene.camera.data, shift_x=replicate["shift"][0], shift_y=replicate["shift"][1])


def set_samples(cycles, count, pixel_filter, of_render=set_samples):
    """Any later Blender may open the file. From 4.5 on, an offset and a count of older ones are read as a range without
    samples, and the picture is black: a file of theirs starts at sample 0."""
    if hasattr(cycles, "use_sample_subset"):
        of_render(cycles, count, pixel_filter)
    else:
        put(cycles, samples=count, sample_offset=0)


def deliver(scene_data, delivery):
    scene = build(scene_data, add_live_glass)
    scene.name = "Threefold"
    set_view(scene, "Standard")
    set_units(scene, scene_data["unit_mm"])
    set_picture(scene, scene_data["replicates"][0])
    check_settings()
    scene.render.filepath = "//" + delivery["stem"] + "-render.exr"
    for thing in bpy.data.objects:
        if thing.name.startswith("Clear window"):
            thing.hide_viewport = True  # it is for camera rays in a render
            thing.hide_select = True
    write_notes("Threefold", delivery["notes"])
    arrange_all()
    pack_pictures()
    look_through_camera()
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(FOLDER, delivery["file"]), compress=True)


def expect(owner, **values):
    for name, value in values.items():
        found = getattr(owner, name)
        check(same(found, value), "%s is %r, not %r, in the saved file" % (name, found, value))


def inspect(scene_data, delivery):
    """In a Blender that opened the file: the settings and the evaluated orbs are what was asked."""
    globals()["put"] = expect  # the functions that made a setting now read it
    scene = bpy.context.scene
    set_render(scene, scene_data)
    set_view(scene, "Standard")
    set_units(scene, scene_data["unit_mm"])
    set_picture(scene, scene_data["replicates"][0])
    orbs = [thing for thing in bpy.data.collections["Orb"].objects] if "Orb" in bpy.data.collections else []
    glass = [thing for thing in scene_data["objects"] if thing["kind"] == "glass"]
    check(len(orbs) == len(glass), "an orb is missing from the saved file")
    for ball, thing in zip(orbs, glass):
        check_live_sphere(ball, thing)
    check(all(image.packed_file for image in bpy.data.images if image.source == "FILE"), "a picture is not packed")
    check("Threefold" in bpy.data.texts, "the notes are missing")
    print("threefold inspected", flush=True)
)python";

} // namespace

std::string_view live_orb_prelude() { return live_orb_python; }

} // namespace threefold
